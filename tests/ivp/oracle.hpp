/// @file
/// The exact motion of the free Duffing oscillator in extended precision, for tests.
#pragma once

#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>

#include "nlmech/problems/duffing.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::oracle {

/// 50 digits.
using Real = ExtendedReal<50>;

/// Period of the oscillator of Table 4.1 of the dissertation, to 50 digits by Taylor series of order 64.
inline constexpr double duffing_period = 4.7680220291024608063;

/// Position and velocity at time t from x = X at rest: X cn(omega t | m).
[[gnu::noinline]] inline Vector<double, 2> duffing(double t, const problems::Duffing& problem = {},
                                                   double amplitude = 1) {
  using boost::multiprecision::sqrt;
  const Real x0 = amplitude, omega = problem.argument_frequency(x0), m = problem.elliptic_parameter(x0);
  Real cn, dn;
  const Real sn = boost::math::jacobi_elliptic(Real(sqrt(m)), Real(omega * t), &cn, &dn);
  return {static_cast<double>(x0 * cn), static_cast<double>(-x0 * omega * sn * dn)};
}

/// Largest absolute difference of the components.
template <class A, class B>
[[nodiscard]] double distance(const A& a, const B& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

}  // namespace nlmech::oracle

/// @file
/// 50 digits for the tests of collocation, and Legendre polynomials by separate recurrences.
#pragma once

#include <array>
#include <boost/multiprecision/eigen.hpp>
#include <limits>
#include <stdexcept>
#include <string>

#include "nlmech/collocation/nodes.hpp"
#include "nlmech/collocation/radial/kernels.hpp"
#include "nlmech/support/extended_real.hpp"
#include "tests/thrown.hpp"

namespace nlmech::collocation::oracle {

namespace mp = boost::multiprecision;
using Real = ExtendedReal<50>;

inline constexpr double eps = std::numeric_limits<double>::epsilon();

inline Real pi() { return 4 * atan(Real(1)); }
inline double to_double(const Real& x) { return x.convert_to<double>(); }

/// P_{n-1}, P_n and the derivatives of both.
struct Legendre {
  Real previous = 0, value = 1, previous_slope = 0, slope = 0;
};

/// By (k+1) P_{k+1} = (2k+1) x P_k - k P_{k-1} and P'_{k+1} = P'_{k-1} + (2k+1) P_k.
inline Legendre legendre(int n, const Real& x) {
  Legendre p;
  for (int k = 0; k < n; ++k) {
    const Real next = (Real(2 * k + 1) * x * p.value - Real(k) * p.previous) / Real(k + 1);
    const Real next_slope = p.previous_slope + Real(2 * k + 1) * p.value;
    p = {p.value, next, p.slope, next_slope};
  }
  return p;
}

/// Integral of P_k from -1 to x: (P_{k+1} - P_{k-1})/(2k + 1).
inline Real legendre_integral(int k, const Real& x) {
  if (k == 0) return x + 1;
  return (legendre(k + 1, x).value - legendre(k - 1, x).value) / Real(2 * k + 1);
}

/// f at every node, with one rounding error.
template <class F>
Eigen::VectorXd sample(const Eigen::VectorXd& nodes, F&& f) {
  Eigen::VectorXd values(nodes.size());
  for (Eigen::Index i = 0; i < nodes.size(); ++i) values[i] = to_double(f(Real(nodes[i])));
  return values;
}

/// LGL nodes mapped to [0, h].
inline Eigen::VectorXd lgl_times(int n, double h = 1) {
  return h / 2 * (legendre_gauss_lobatto(n).array() + 1);
}

/// The text of the std::invalid_argument that @p call throws; empty if it throws none.
template <class F>
std::string refusal(F&& call) {
  return tests::thrown<std::invalid_argument>(call);
}

inline constexpr std::array families = {NodeFamily::legendre_gauss_lobatto, NodeFamily::left_end_and_radau,
                                        NodeFamily::chebyshev_gauss_lobatto};
inline constexpr std::array kernels = {Kernel::gaussian, Kernel::inverse_quadratic, Kernel::multiquadric,
                                       Kernel::inverse_multiquadric};

}  // namespace nlmech::collocation::oracle

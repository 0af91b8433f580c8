/// @file
/// Arcs of the free Duffing oscillator, on which the study of shapes differentiates.
#pragma once

#include <boost/math/special_functions/jacobi_elliptic.hpp>

#include "nlmech/collocation/nodes.hpp"
#include "nlmech/collocation/radial/shape_choice.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::chapters::rbf_ivp {

/// Start of the arcs, s: at no symmetry of the motion, where errors would cancel.
inline constexpr double arc_start = 1.1;

/// x(t) of Eq. 4.23 with X = 1 and its derivative at the n Legendre-Gauss-Lobatto nodes of an interval, which
/// is the unit of time; computed with 50 digits, then rounded.
/// @param n       number of nodes
/// @param periods length of the interval in periods of the oscillator
/// @param start   start of the interval, s
[[nodiscard]] inline collocation::Sampled duffing_arc(int n, double periods, double start = arc_start) {
  using Digits50 = ExtendedReal<50>;
  const problems::Duffing problem;
  const Digits50 X = 1, omega = problem.argument_frequency(X), h = periods * problem.period(X);
  const Digits50 m = problem.elliptic_parameter(X), modulus = sqrt(m);
  const collocation::Vector<Digits50> nodes =
      (collocation::nodes<Digits50>(collocation::NodeFamily::legendre_gauss_lobatto, n).array() + 1) / 2;
  collocation::Sampled arc{nodes.cast<double>(), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index j = 0; j < n; ++j) {
    Digits50 cn;
    const Digits50 u = omega * (start + h * nodes[j]), sn = boost::math::jacobi_elliptic(modulus, u, &cn);
    const Digits50 dn = sqrt(1 - m * sn * sn);  // the library's own is a quotient of zeros at quarter periods
    arc.values[j] = static_cast<double>(Digits50(X * cn));
    arc.slopes[j] = static_cast<double>(Digits50(-X * omega * h * sn * dn));
  }
  return arc;
}

}  // namespace nlmech::chapters::rbf_ivp

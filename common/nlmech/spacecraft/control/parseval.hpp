/// @file
/// Quadratic costs of the step response: closed forms by Parseval's theorem and contour integration, and the
/// same integrals by quadrature over frequency.
#pragma once

#include "nlmech/spacecraft/control/closed_loop.hpp"

namespace nlmech::spacecraft {

/// Integrals over t from 0 to infinity for a step theta_f = 1, e = theta - theta_f, kappa = 2 + k2.
struct StepCosts {
  double error;           ///< int e^2 = k3/(2 k1) + (I_hub + kappa B_0)/(2 k3), s
  double rate;            ///< int theta'^2 = k1/(2 k3), 1/s
  double acceleration;    ///< int theta''^2 = k1^2/(2 k3 I_hub), 1/s^3; infinite without a hub
  double torque;          ///< int u^2 = k1^2/(2 k3) (I_hub + 4 B_0/kappa), (lb ft)^2 s
  double deflection;      ///< int y(x)^2 = C(x) k1^2/(k3 kappa), ft^2 s
  double deflection_dot;  ///< int y'(x)^2 = G(x, x) k1^2/(2 k3 kappa), ft^2/s
};

/// Closed forms, from P(s) - P(-s) = 2 k3 s (derived on the chapter's page). B_0 = B(0), C and G as in
/// Statics.
/// @param gains k1 > 0, k2 > -2, k3 > 0
/// @param x place of the deflection
/// @throws std::invalid_argument naming what is out of range
[[nodiscard]] StepCosts step_costs(const Parameters& parameters, const Gains& gains, double x);

/// Three of them by quadrature.
struct QuadratureCosts {
  double error = 0;       ///< int e^2
  double torque = 0;      ///< int u^2
  double deflection = 0;  ///< int y(x)^2
  double change = 0;      ///< relative change of the torque's by the last doubling of the range
  Status status;          ///< success, or what the poles' was
};

/// (1/pi) int_0^inf |f(j omega)|^2 domega of the exact transfer functions. About the frequency of each pole
/// and each hub-locked resonance omega is stretched as c + w sinh v, where w is the distance of j c to the
/// nearest pole, by Gauss's rule with 10 points on pieces of 0.5 in v. Beyond the pole of number @p modes the
/// tail is extrapolated from the integrals up to a quarter, a half and all of them, as a power
/// series in 1/sqrt(omega).
///
/// Accuracy with 128 modes (tests/spacecraft, against the closed forms): error 1e-10, deflection 1e-11,
/// torque 1e-7 of themselves for the gains of the source and the optimal ones.
/// @param x place of the deflection
/// @param modes 16 to 2000
/// @throws std::invalid_argument naming what is out of range
[[nodiscard]] QuadratureCosts costs_by_quadrature(const Parameters& parameters, const Gains& gains, double x,
                                                  int modes = 128);

}  // namespace nlmech::spacecraft

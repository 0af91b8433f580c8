/// @file
/// Quadratic costs of the step response by Parseval's theorem, and the gains that minimise int e^2 + W y(L)^2
/// + R u^2 dt, all in closed form.
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

/// Closed forms, from P(s) - P(-s) = 2 k3 s (derivation on the page of the chapter). B_0 = B(0), C and G as
/// in Statics.
/// @param gains k1 > 0, k2 > -2, k3 > 0
/// @param x place of the deflection, ft
/// @throws std::invalid_argument naming what is out of range, or as require_cantilever()
[[nodiscard]] StepCosts step_costs(const Parameters& parameters, const Gains& gains, double x);

/// W and R of the cost int (theta - theta_f)^2 + W y(L)^2 + R u^2 dt for theta_f = 1.
struct CostWeights {
  double deflection = 0;     ///< W at least 0, 1/ft^2
  double torque = 1 / 144.;  ///< R > 0, 1/(lb ft)^2: 1/u_max^2
};

/// Cost of given gains, by the closed forms of step_costs().
/// @throws std::invalid_argument naming a weight or gain out of range
[[nodiscard]] double cost(const Parameters& parameters, const Gains& gains, const CostWeights& weights);

/// Gains with their cost.
struct OptimalGains {
  Gains gains;  ///< gains of least cost
  double cost;  ///< their cost
};

/// Global and unique minimum of the cost over k1, k3 > 0, k2 > -2:
///
///     k1 = 1/sqrt R,  k2 = 2 sqrt(1 + W C/(2 B_0 R)) - 2,  k3 = k1 J,
///     J^2 = 2 I_hub sqrt R + 4 B_0 sqrt(R + W C/(2 B_0)),   C = C(L), B_0 = B(0).
///
/// Large k2 has small stability margins: see margins().
///
/// Tests check the gains to twelve digits, their cost against the time response by residues (1e-6), and that
/// no random gains have a smaller cost (1e-13).
/// @throws std::invalid_argument naming a weight out of range, or both weights if the optimum is outside the
/// range of double, or as require_physical()
[[nodiscard]] OptimalGains optimal_gains(const Parameters& parameters, const CostWeights& weights);

/// Minimum of the cost over k1 and k3 with k2 = 0, with the total inertia J_2:
///
///     k1 = sqrt(J_2/(W C + R J_2)),  k3 = k1 J,  J^2 = 2 sqrt(J_2 (W C + R J_2)).
///
/// @throws std::invalid_argument as optimal_gains()
[[nodiscard]] OptimalGains optimal_pd_gains(const Parameters& parameters, const CostWeights& weights);

}  // namespace nlmech::spacecraft

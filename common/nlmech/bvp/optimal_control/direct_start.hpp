/// @file
/// A start for extremals by a direct method: the cost is brought down step by step on piecewise constant
/// controls.
#pragma once

#include "nlmech/bvp/optimal_control/extremal.hpp"

namespace nlmech::bvp {

/// Options of direct_start().
struct DirectOptions {
  int pieces = 100;           ///< of the control, 2 to 5000
  int iterations = 60;        ///< at most, for each weight of the end conditions
  double first_weight = 1;    ///< of the prescribed values at the end and at waypoints, rho
  double weight_growth = 10;  ///< from one round to the next
  int rounds = 7;             ///< how many weights
  double tolerance = 1e-7;    ///< a round ends when a step lowers the cost by less than this fraction
};

/// A trajectory with its control, from which a direct method begins.
struct ControlGuess {
  Eigen::VectorXd begin;                                      ///< x(t_0); prescribed components are replaced
  std::function<void(double t, Eigen::VectorXd& u)> control;  ///< in true time
};

/// Where a direct method ended.
struct DirectResult {
  Start start;      ///< states and co-states on its grid, for solve_extremal
  double cost = 0;  ///< J without penalties, on piecewise constant controls
  double miss = 0;  ///< largest distance from the prescribed end values and waypoints
  Status status;    ///< non_finite if even the guess could not be integrated; else success
};

/// Minimises the cost over piecewise constant controls and the free initial values, by differential dynamic
/// programming in the form of Gauss and Newton (iLQR: W. Li, E. Todorov, Iterative linear quadratic regulator
/// design for nonlinear biological movement systems, ICINCO 2004) with Levenberg's regularisation, the
/// dynamics by the classical Runge-Kutta method; prescribed values by an augmented Lagrangian of growing
/// weight. Every iteration lowers the cost, so that it ends near a local minimum from almost everywhere,
/// which Newton's iteration for the extremal does not. A free final time is held at its guess.
[[nodiscard]] DirectResult direct_start(const ExtremalProblem& problem, const ControlGuess& guess,
                                        const DirectOptions& options = {});

}  // namespace nlmech::bvp

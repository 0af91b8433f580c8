/// @file
/// Initial guess for extremals by a direct method: descent of the cost over piecewise constant controls.
#pragma once

#include "nlmech/bvp/optimal_control/extremal.hpp"

namespace nlmech::bvp {

/// Options of direct_start().
struct DirectOptions {
  int pieces = 100;           ///< pieces of the control, 2 to 5000
  int iterations = 60;        ///< largest number of iterations per weight of the end conditions
  double first_weight = 1;    ///< first weight rho of the prescribed values at the end and at waypoints
  double weight_growth = 10;  ///< factor of the weight per round
  int rounds = 7;             ///< number of weights
  double tolerance = 1e-7;    ///< a round ends when a step decreases the cost by less than this fraction
  Eigen::VectorXd low = {};   ///< lower bound of each control; empty: that of the constraints
  Eigen::VectorXd high = {};  ///< upper bound of each control; empty: that of the constraints
};

/// Initial guess of a direct method.
struct ControlGuess {
  Eigen::VectorXd begin;  ///< x(t_0); prescribed components are overwritten
  std::function<void(double t, Eigen::VectorXd& u)> control;  ///< sets u at the true time t
};

/// Result of a direct method.
struct DirectResult {
  Start start;                    ///< states and co-states on the grid, for solve_extremal
  Eigen::MatrixXd controls = {};  ///< q rows; one column for each piece
  Eigen::MatrixXd adjoint =
      {};           ///< co-states by the adjoint equation: n rows; a column for each end of a piece
  double cost = 0;  ///< J without penalties, on piecewise constant controls
  double miss = 0;  ///< largest deviation from the prescribed end values and waypoints
  Status status;    ///< non_finite if the guess could not be integrated; else success
};

/// Minimises the cost over piecewise constant controls and the free initial values, by Gauss-Newton
/// differential dynamic programming (iLQR: W. Li, E. Todorov, Iterative linear quadratic regulator design for
/// nonlinear biological movement systems, ICINCO 2004) with Levenberg regularisation, the classical
/// Runge-Kutta method for the dynamics, and an augmented Lagrangian of increasing weight for prescribed
/// values. Every iteration decreases the cost, so almost every guess leads to a local minimum, unlike with
/// Newton's iteration for the extremal. A free final time is fixed at its guess.
[[nodiscard]] DirectResult direct_start(const ExtremalProblem& problem, const ControlGuess& guess,
                                        const DirectOptions& options = {});

}  // namespace nlmech::bvp

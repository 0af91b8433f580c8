/// @file
/// Solver for optimal control problems with bounds on controls and states.
#pragma once

#include <string>

#include "nlmech/bvp/optimal_control/arcs.hpp"
#include "nlmech/bvp/optimal_control/direct_start.hpp"
#include "nlmech/bvp/solve.hpp"

namespace nlmech::bvp {

/// Extremal of a ControlProblem: states, co-states and controls that satisfy the necessary conditions.
struct ControlSolution {
  Status status;                              ///< success, or why no extremal was found
  std::shared_ptr<const ArcProblem> problem;  ///< its arcs; null without a solution
  Solution solution;                          ///< (x, lambda) in the time of the problem
  double cost = 0;                            ///< phi + integral of L
  SecondOrder second_order;                   ///< untested with bounds and other than prescribed values
  int extremals = 0;                          ///< number of extremals of different cost that were found

  /// x, lambda, u, mu at the time @p s of the problem.
  [[nodiscard]] Eigen::VectorXd at(double s, Side side = Side::after) const;
  /// H at the time @p s of the problem.
  [[nodiscard]] double hamiltonian(double s, Side side = Side::after) const;
};

/// Finds the extremal of least cost that is reached from several controls; with linear equations and a
/// quadratic cost, the first.
///
/// From each guess direct_start() minimises the cost over piecewise constant controls, with penalties for
/// bounds on states and small quadratic costs of controls in which H is linear. Its controls show the arcs:
/// which bounds are active, where bounds on states are touched, which arcs are singular. The necessary
/// conditions on these arcs, with unknown times of the junctions, are solved by collocation (ArcProblem),
/// verified by integration, and checked between the nodes: signs of dH/du and of multipliers, bounds,
/// Legendre's condition. With one bound on a state of order two or more an arc on the bound and a contact are
/// both tried.
///
/// Tests compare with closed forms: Breakwell's problem, the double integrator with bounded force and in
/// least time (1e-9).
/// @param guesses initial values where they are free, and controls; at least one
[[nodiscard]] ControlSolution solve_control(const ControlProblem& problem,
                                            const std::vector<ControlGuess>& guesses,
                                            const Options& options = {});

/// Controls to start from: the middle of the bounds, both bounds or +-@p size, and harmonic functions of
/// time.
/// @param begin initial values of the states, used where they are free
[[nodiscard]] std::vector<ControlGuess> control_guesses(const ControlProblem& problem,
                                                        const Eigen::VectorXd& begin, double size);

}  // namespace nlmech::bvp

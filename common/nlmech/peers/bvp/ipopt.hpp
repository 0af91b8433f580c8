/// @file
/// Direct transcription solved by Ipopt: a peer, and a robust initial guess for extremals; optional.
#pragma once

#include "nlmech/bvp/optimal_control/direct_start.hpp"

namespace nlmech::peers {

/// Does this build have Ipopt?
[[nodiscard]] bool ipopt_available() noexcept;

/// Options of ipopt_start().
struct IpoptOptions {
  int pieces = 100;         ///< number of intervals of the trapezoidal rule, 2 to 20000
  int iterations = 500;     ///< limit of the number of iterations
  double tolerance = 1e-8;  ///< Ipopt's `tol`
};

/// Minimises the cost of a control problem over states and controls at equidistant nodes, with the
/// trapezoidal rule as constraints, by the interior-point method of A. Waechter and L. T. Biegler (Math.
/// Program. 106 (2006) 25-57) with exact first and second derivatives. Prescribed values, the control's limit
/// and the states' bounds are bounds of its variables, so no penalties are added. A free final time is fixed
/// at its guess.
/// @param guess initial state and control; the other states are integrated with this control
/// @return states and co-states (the multipliers) as initial guess for solve_extremal, the cost, which is
/// within O(h^2) of the extremal's, and a status: `infeasible`, `step_limit` or `not_converged` as reported
/// by Ipopt
/// @throws std::logic_error if the build has no Ipopt, std::invalid_argument for options out of range
[[nodiscard]] bvp::DirectResult ipopt_start(const bvp::ExtremalProblem& problem,
                                            const bvp::ControlGuess& guess, const IpoptOptions& options = {});

}  // namespace nlmech::peers

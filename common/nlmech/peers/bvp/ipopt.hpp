/// @file
/// Direct transcription solved by Ipopt, if this build has it: a peer, and a robust start for extremals.
#pragma once

#include "nlmech/bvp/optimal_control/direct_start.hpp"

namespace nlmech::peers {

/// Was the library found when this program was built?
[[nodiscard]] bool ipopt_available() noexcept;

/// Options of ipopt_start().
struct IpoptOptions {
  int pieces = 100;         ///< of the trapezoidal rule, 2 to 20000
  int iterations = 500;     ///< at most
  double tolerance = 1e-8;  ///< Ipopt's `tol`
};

/// Minimises the cost of a control task over states and controls on equal intervals, joined by the
/// trapezoidal rule, by the interior-point method of A. Waechter and L. T. Biegler (Math. Program. 106 (2006)
/// 25-57) with exact first and second derivatives. Prescribed values, the control's limit and the states'
/// bounds are bounds of its variables, so no penalties are added. A free final time is held at its guess.
/// @param guess the start and the control; the states between are integrated with it
/// @return states and co-states (the multipliers) as a start for solve_extremal, the cost, which is within
/// O(h^2) of the extremal's, and a status: `infeasible`, `step_limit` or `not_converged` as Ipopt says
/// @throws std::logic_error if the build has no Ipopt, std::invalid_argument for options out of range
[[nodiscard]] bvp::DirectResult ipopt_start(const bvp::ExtremalProblem& problem,
                                            const bvp::ControlGuess& guess, const IpoptOptions& options = {});

}  // namespace nlmech::peers

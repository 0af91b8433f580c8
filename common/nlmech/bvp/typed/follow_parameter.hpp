/// @file
/// Solutions of a typed boundary value problem followed in a parameter, through folds.
#pragma once

#include <string>
#include <vector>

#include "nlmech/bvp/typed/typed_problem.hpp"

namespace nlmech::bvp {

/// Where to follow a solution.
struct ParameterRange {
  std::string name;  ///< name of a definition or of nothing else in the equations
  double from = 0;   ///< value with a solution
  double to = 1;     ///< value at which solutions are wanted
  /// Whether to go on along the branch beyond the first solution at `to`, for all others.
  bool all = false;
};

/// Result of follow_parameter().
struct Continuation {
  Status status;                    ///< success: the end value is reached; with `all`, why the branch ends
  std::vector<Solution> solutions;  ///< different solutions at the end value, in their order on the branch
  std::vector<double> folds;        ///< values at which the branch turns back, to the tolerance
  double reached = 0;               ///< value of the last point
  int steps = 0;                    ///< points of the branch
};

/// Follows a solution in a parameter. Steps are geometric if both values have one sign, chosen by the success
/// of Newton's iteration. Where they fail, as at a fold, and for further solutions, the branch is followed by
/// its length: the parameter is unknown, and a condition is added that is linear in the solution, the
/// integral of its product with the last change of the branch, projected on six cosines of time (H. B.
/// Keller, Applications of Bifurcation Theory, 1977). Values of folds and points at the end value are located
/// on the branch; the solutions are those of solve_typed().
///
/// The branch is followed through folds until the end value is reached; until it returns to the first value
/// (or, with `all`, has passed both); or for 200 steps. A parameter in times of conditions or in the guess
/// has no branch by length.
/// @param text the problem; its setting of the parameter is replaced
/// @param guess see TypedProblem
/// @param solution solution at `from`
/// @param tolerance of the residual, see Options
[[nodiscard]] Continuation follow_parameter(const ProblemText& text, const std::string& guess,
                                            const ParameterRange& range, Solution solution, double tolerance);

}  // namespace nlmech::bvp

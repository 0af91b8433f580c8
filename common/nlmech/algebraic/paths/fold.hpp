/// @file
/// Limit points: where a path turns back in its load.
#pragma once

#include "nlmech/algebraic/paths/path_system.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::algebraic {

/// Newton's iteration for F(x, load) = 0 and g(x, load) = 0, where g is the bordered function
///
///     (K b; b^T 0) (v; g) = (0; 1),
///
/// zero where K is singular, with a b near the null vector (Griewank and Reddien 1984; Govaerts 2000). Its
/// derivative is -v^T (dK/dx) v, for which K v is differenced along v: that is wrong in the sixth digit or
/// so, and the iteration quadratic down to there, then faster by that factor in each step. x and load are
/// right to the rounding of F, x as far as the curvature of the path allows. For symmetric K.
/// @param system of F
/// @param at near a limit point, then the limit point
/// @param direction near the null vector of K there, such as the path's tangent; then the null vector
/// @return success; `not_converged`, `non_finite` or `singular_matrix`, @p at being of no use then
[[nodiscard]] Outcome refine_fold(PathSystem& system, PathVector& at, Eigen::VectorXd& direction);

}  // namespace nlmech::algebraic

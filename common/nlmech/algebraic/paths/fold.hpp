/// @file
/// Singular points of an equilibrium path: limit points, where the load has an extremum, and simple
/// bifurcation points, where two branches cross.
#pragma once

#include <Eigen/Core>

#include "nlmech/algebraic/paths/path_system.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::algebraic {

/// Newton's iteration for F(x, load) = 0 and g(x, load) = 0, where g is the bordered function
///
///     (K b; b^T 0) (v; g) = (0; 1),
///
/// which is zero where K is singular; b is near the null vector (Griewank and Reddien 1984; Govaerts 2000).
/// Its derivative -v^T (dK/dx) v comes from a difference of K v along v, with a relative error of about 1e-6:
/// convergence is quadratic down to that level, then linear with that factor. x and load are accurate to the
/// rounding of F, x as far as the curvature of the path allows. For symmetric K.
/// @param system of F
/// @param at in: a point near a limit point; out: the limit point
/// @param direction in: approximate null vector of K, such as the tangent of the path; out: the null vector
/// @return success; else `not_converged`, `non_finite` or `singular_matrix`, and @p at is not usable
[[nodiscard]] Outcome refine_fold(PathSystem& system, PathVector& at, Eigen::VectorXd& direction);

/// Simple bifurcation point: K has one null vector, and the load does no work along it.
struct Fork {
  PathVector at;              ///< the bifurcation point
  Eigen::VectorXd null = {};  ///< null vector of K, of length 1
  PathVector across = {};     ///< tangent of the branch that is not tangential to the null vector
  Eigen::Index negative = 0;  ///< number of negative eigenvalues of K, without the vanishing one
};

/// Computes the bifurcation point near a point of any of its branches, to rounding. With b near the null
/// vector
///
///     F(x, load) + mu b = 0,  b^T x = s
///
/// have one solution for each (s, load), also where branches cross; the branches are mu(s, load) = 0
/// (Lyapunov-Schmidt reduction). Branches cross where both derivatives of mu vanish. Newton's iteration
/// solves for that point, with second derivatives by differences. For symmetric K.
///
/// Tests compare it with a pitchfork bifurcation in closed form, from either branch.
/// @param system of F
/// @param fork in: `at`, a point near the bifurcation; out: all members
/// @param reach largest distance of the bifurcation, scaled; differences use a hundredth of it
/// @param load largest distance of the bifurcation in the load, scaled; differences use a hundredth of it
/// @return success; `wrong_branch` if |mu| there exceeds 16 times the rounding of F and of the data of the
/// equations: two branches pass each other without crossing; `not_converged`, `non_finite` or
/// `singular_matrix`. @p fork is not usable after a failure
[[nodiscard]] Outcome refine_fork(PathSystem& system, Fork& fork, double reach, double load);

}  // namespace nlmech::algebraic

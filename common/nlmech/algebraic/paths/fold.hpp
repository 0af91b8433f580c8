/// @file
/// Singular points of a path: limit points, where it turns back in its load, and simple bifurcations, where
/// two branches cross.
#pragma once

#include <Eigen/Core>

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

/// A point where K has one null vector and the load does no work along it.
struct Fork {
  PathVector at;              ///< where
  Eigen::VectorXd null = {};  ///< null vector of K, of length 1
  PathVector across = {};     ///< tangent of the branch that does not leave along the null vector
  Eigen::Index negative = 0;  ///< negative eigenvalues of K, the vanishing one not counted
};

/// The bifurcation near a point, to rounding, from any of its branches. With a b near the null vector
///
///     F(x, load) + mu b = 0,  b^T x = s
///
/// have one solution for each (s, load), also where branches cross, and mu(s, load) = 0 are the branches
/// (Lyapunov and Schmidt). They cross where both derivatives of mu vanish: Newton's iteration for these,
/// whose own derivatives are differenced. For symmetric K.
///
/// Tests hold it to a pitchfork in closed form from either branch.
/// @param system of F
/// @param fork `at`: near the bifurcation, and then it; all else is filled in
/// @param reach how far the bifurcation may be, scaled, and differences go to a hundredth of it
/// @param load the same for the load, scaled
/// @return success; `wrong_branch` if mu does not vanish there, but for 16 times the rounding of F and of the
/// data of the equations: no branches cross, but two pass each other; `not_converged`, `non_finite` or
/// `singular_matrix`. @p fork is of no use after a failure
[[nodiscard]] Outcome refine_fork(PathSystem& system, Fork& fork, double reach, double load);

}  // namespace nlmech::algebraic

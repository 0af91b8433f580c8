/// @file
/// Methods that linearise F and minimise |F|: nonlinear least squares, Levenberg's and Marquardt's
/// damped steps, and Powell's dogleg: Newton's step within a trust region, bent towards steepest descent.
#pragma once

#include <cstdint>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// Gaussian least-squares differential correction (Elgohary 2015, Eq. 2.5): dx minimises |F + B dx|, found by
/// a QR decomposition and not by the printed normal equations, which square the condition. Where B is of full
/// rank that is Newton's step; where it is not, dx is the shortest minimiser, by a complete orthogonal
/// decomposition, and the iteration goes on through a singular B.
///
/// Tests compare the step of a singular matrix with the pseudo-inverse's, to the condition of its range, and
/// that of a regular one with Newton's.
struct LeastSquares {
  /// Pivots below this part of the greatest are taken for 0; positive. The default allows for the rounding of
  /// B itself.
  double rank = 1e-13;
  double tolerance = 1e-10;       ///< done when |F|, Euclidean, is no greater; not negative
  std::int64_t iterations = 500;  ///< at most so many steps
};

/// Needs the matrix. A sparse B is decomposed sparsely, and once more as a dense one if its rank is deficient
/// (counted as a fallback). Outcomes besides success: `not_converged` where F is normal to the range of B;
/// `non_finite`; `step_limit`; `interrupted`.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations,
/// std::logic_error if they have no matrix
[[nodiscard]] Report find_root(const LeastSquares& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

/// Levenberg (1944) and Marquardt (1963): dx minimises |F + B dx|^2 + mu |dx|^2, with mu by the ratio of the
/// actual to the predicted fall of |F|^2 (Nielsen 1999). Never needs a regular B. Past a limit point it ends
/// in a minimum of |F| that is no root, as all methods do that only let |F| fall.
struct LevenbergMarquardt {
  double damping = 1e-3;             ///< first mu in parts of the greatest |B e_j|^2; positive
  double tolerance = 1e-10;          ///< done when |F|, Euclidean, is no greater; not negative
  std::int64_t iterations = 10'000;  ///< at most so many steps, rejected ones included
};

/// Needs the matrix. A dense problem is solved by QR of B over sqrt(mu) I, a sparse one by sparse LU of the
/// augmented matrix. Outcomes besides success: `singular_matrix` where B^T F is 0; `not_converged` where it
/// is, to rounding, normal to the range of B or mu has grown until steps no longer move x; `non_finite` at
/// the start or if B is; `step_limit`; `interrupted`.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations,
/// std::logic_error if they have no matrix
[[nodiscard]] Report find_root(const LevenbergMarquardt& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

/// Powell's hybrid method (1970) with the exact derivative: the step goes to Newton's point if that is within
/// the radius, else along the path from here over Cauchy's point (least linearised |F| along -B^T F) to
/// Newton's point up to the radius. Where B is singular, Cauchy's part alone is taken. Past a limit point it
/// ends in a minimum of |F| that is no root.
///
/// Tests: Newton's step within the radius, and no step longer than that.
struct Dogleg {
  double radius = 1;                 ///< first radius, a length in the space of x; positive
  double tolerance = 1e-10;          ///< done when |F|, Euclidean, is no greater; not negative
  std::int64_t iterations = 10'000;  ///< at most so many steps, rejected ones included
};

/// Needs the matrix. Outcomes besides success: `singular_matrix` where B^T F is 0; `not_converged` where F
/// is, to rounding, normal to the range of B or the radius no longer moves x; `non_finite` at the start or if
/// B is, else the radius shrinks; `step_limit`; `interrupted`. A step by a singular B counts as a fallback.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations,
/// std::logic_error if they have no matrix
[[nodiscard]] Report find_root(const Dogleg& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

}  // namespace nlmech::algebraic

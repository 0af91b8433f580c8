/// @file
/// Methods that minimise the linearised |F|: nonlinear least squares, Levenberg-Marquardt, and Powell's
/// dogleg.
#pragma once

#include <cstdint>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// Gaussian least-squares differential correction (Elgohary 2015, Eq. 2.5): dx minimises |F + B dx|, computed
/// by a QR decomposition; the printed normal equations would square the condition number. For B of full rank
/// dx is Newton's step. Otherwise dx is the shortest minimiser, by a complete orthogonal decomposition, so
/// the iteration continues through a singular B.
///
/// Tests compare the step of a singular matrix with that of the pseudo-inverse, within the condition number
/// on its range, and that of a regular one with Newton's.
struct LeastSquares {
  /// Pivots below this part of the greatest count as 0; above 0, below 1. The default allows for the rounding
  /// of B.
  double rank = 1e-13;
  double tolerance = 1e-10;       ///< converged when |F|, Euclidean, is at most this; not negative
  std::int64_t iterations = 500;  ///< limit of steps
};

/// Needs the matrix. A sparse B gets a sparse QR decomposition; if it is rank-deficient, a dense one follows
/// (counted as a fallback). Outcomes besides success: `not_converged` where F is normal to the range of B;
/// `non_finite`; `step_limit`; `interrupted`.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations,
/// std::logic_error if they have no matrix
[[nodiscard]] Report find_root(const LeastSquares& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

/// Levenberg (1944) and Marquardt (1963): dx minimises |F + B dx|^2 + mu |dx|^2, mu is adapted by the ratio
/// of actual to predicted decrease of |F|^2 (Nielsen 1999). B may be singular. Past a limit point the method
/// stops at a minimum of |F| that is no root, as all methods do that only reduce |F|.
struct LevenbergMarquardt {
  double damping = 1e-3;             ///< first mu, divided by the greatest |B e_j|^2; positive
  double tolerance = 1e-10;          ///< converged when |F|, Euclidean, is at most this; not negative
  std::int64_t iterations = 10'000;  ///< limit of steps, including rejected ones
};

/// Needs the matrix. A dense problem is solved by QR of B over sqrt(mu) I, a sparse one by sparse LU of the
/// augmented matrix. Outcomes besides success: `singular_matrix` where B^T F is 0; `not_converged` where F is
/// normal to the range of B to rounding, or where mu has grown until steps no longer change x; `non_finite`
/// if F at the start or B is not finite; `step_limit`; `interrupted`.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations,
/// std::logic_error if they have no matrix
[[nodiscard]] Report find_root(const LevenbergMarquardt& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

/// Powell's hybrid method (1970) with the exact derivative: the step is Newton's if that lies within the
/// radius. Otherwise it ends where the polygon iterate, Cauchy's point (least linearised |F| along -B^T F),
/// Newton's point leaves the radius. For a singular B only the part to Cauchy's point is used. Past a limit
/// point the method stops at a minimum of |F| that is no root.
///
/// Tests check that the step is Newton's within the radius and never longer than the radius.
struct Dogleg {
  double radius = 1;                 ///< first radius, a length in the space of x; positive
  double tolerance = 1e-10;          ///< converged when |F|, Euclidean, is at most this; not negative
  std::int64_t iterations = 10'000;  ///< limit of steps, including rejected ones
};

/// Needs the matrix. Outcomes besides success: `singular_matrix` where B^T F is 0; `not_converged` where F is
/// normal to the range of B to rounding, or where the radius no longer changes x; `non_finite` if F at the
/// start or B is not finite (elsewhere the radius shrinks); `step_limit`; `interrupted`. A singular B counts
/// as a fallback.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations,
/// std::logic_error if they have no matrix
[[nodiscard]] Report find_root(const Dogleg& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

}  // namespace nlmech::algebraic

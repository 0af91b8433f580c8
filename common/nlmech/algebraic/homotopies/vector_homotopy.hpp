/// @file
/// Vector homotopies: F(x) = 0 as the end, at t = 1, of a path H(x, t) = 0 that starts at a known point.
#pragma once

#include <cstdint>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// Which H; both vanish at the start x(0) for t = 0 and are F for t = 1.
enum class Homotopy : std::uint8_t {
  fixed_point,  ///< H = t F + (1 - t)(x - x(0)), Elgohary 2015, Eq. 2.8
  newton        ///< H = t F + (1 - t)(F - F(x(0))) = F - (1 - t) F(x(0)), Eq. 2.9
};

/// Follows the path in t: dx/dt = -(dH/dx)^-1 dH/dt from t = 0 to 1 (Eq. 2.10), and ends by Newton's
/// iteration at t = 1. It cannot pass a turning point, where dH/dx is singular: see ChowYorke.
///
/// Tests hold the iterates to the path.
struct VectorHomotopy {
  Homotopy function = Homotopy::fixed_point;  ///< which H
  /// Steps are of order 3 after Bogacki and Shampine: the estimated error of each is at most this part of 1 +
  /// |x|, and the distance from the path, by Newton's step, at most 100 times that; positive.
  double accuracy = 1e-3;
  double tolerance = 1e-10;     ///< done when |F|, Euclidean, is no greater; not negative
  std::int64_t limit = 10'000;  ///< at most so many steps in all, rejected ones included
};

/// Needs the matrix. Report::time is t. Outcomes besides success: `singular_matrix` at a turning point that a
/// stage happens to meet; `step_underflow` if a step falls below 1e-10, as on the way to one;
/// `non_finite` at the start; `not_converged` if Newton's iteration at t = 1 does not end in 20 steps;
/// `step_limit`; `interrupted`.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations,
/// std::logic_error if they have no matrix
[[nodiscard]] Report find_root(const VectorHomotopy& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

/// Follows the path in its arc length s, ds^2 = |dx|^2 + dt^2, through turning points (Chow, Mallet-Paret and
/// Yorke 1978): a step along the tangent, then Newton's iteration normal to it, with matrices of n + 1 rows
/// that stay regular where dH/dx does not. The step grows after short corrections and shrinks after long
/// ones, or where the tangent turns by more than `turn`. When the path passes t = 1, Newton's iteration from
/// the secant ends it; if that goes elsewhere the step is repeated at half its length.
///
/// Tests hold it to the path (5e-6), past turning points and singular starts to the root (2e-11), and to a
/// straight line for linear equations (1e-12).
struct ChowYorke {
  Homotopy function = Homotopy::fixed_point;  ///< which H
  double step = 0.1;                          ///< first length, positive
  double longest = 10;                        ///< no step is longer; positive
  double turn = 0.3;                 ///< a tangent may turn so much in a step; radians, above 0, at most 1
  double accuracy = 1e-6;            ///< |H| on the path, in parts of |F(x(0))|; positive
  double tolerance = 1e-10;          ///< done when |F|, Euclidean, is no greater; not negative
  std::int64_t iterations = 10'000;  ///< at most so many steps, rejected ones included
};

/// Needs the matrix. Report::time and the observer's time are t, which falls between turning points.
/// Statistics::newton_iterations counts linear solves, and fallbacks a start whose tangent had to be found
/// from another border. Outcomes besides success: `singular_matrix` if dH/dx and dH/dt are of deficient rank
/// together; `step_underflow` if a step falls below 1e-10; `non_finite` at the start; `step_limit`, as when
/// the path runs to infinity; `interrupted`.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations,
/// std::logic_error if they have no matrix
[[nodiscard]] Report find_root(const ChowYorke& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

}  // namespace nlmech::algebraic

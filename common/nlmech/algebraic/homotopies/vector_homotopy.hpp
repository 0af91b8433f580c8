/// @file
/// Vector homotopy methods: follow H(x, t) = 0 from a known point at t = 0 to F(x) = 0 at t = 1.
#pragma once

#include <cstdint>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// Choice of H; both vanish at x(0) for t = 0 and equal F for t = 1.
enum class Homotopy : std::uint8_t {
  fixed_point,  ///< H = t F + (1 - t)(x - x(0)), Elgohary 2015, Eq. 2.8
  newton        ///< H = t F + (1 - t)(F - F(x(0))) = F - (1 - t) F(x(0)), Eq. 2.9
};

/// Integrates dx/dt = -(dH/dx)^-1 dH/dt from t = 0 to 1 (Eq. 2.10), then applies Newton's iteration at t = 1.
/// It cannot pass a turning point, where dH/dx is singular: see ChowYorke.
///
/// Tests compare the iterates with the path.
struct VectorHomotopy {
  Homotopy function = Homotopy::fixed_point;  ///< which H
  /// Tolerance of the Bogacki-Shampine method of order 3, relative to 1 + |x|, on the error estimate of each
  /// step; the distance from the path, by Newton's step, is at most 100 times that; positive.
  double accuracy = 1e-3;
  double tolerance = 1e-10;     ///< converged when |F|, Euclidean, is at most this; not negative
  std::int64_t limit = 10'000;  ///< limit of steps, including rejected ones
};

/// Needs the matrix. Report::time is t. Outcomes besides success: `singular_matrix` at a turning point;
/// `step_underflow` if the step size falls below 1e-10, as near a turning point; `non_finite` at the start;
/// `not_converged` if Newton's iteration at t = 1 does not end in 20 steps; `step_limit`; `interrupted`.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations,
/// std::logic_error if they have no matrix
[[nodiscard]] Report find_root(const VectorHomotopy& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

/// Follows the path by arc length s, ds^2 = |dx|^2 + dt^2, through turning points (Chow, Mallet-Paret and
/// Yorke 1978): a predictor step along the tangent, then Newton's iteration normal to it, with matrices of n
/// + 1 rows that stay regular where dH/dx is singular. The step size grows after few corrections and shrinks
/// after many, or where the tangent turns by more than `turn`. When the path passes t = 1, Newton's iteration
/// starts from the secant; if it leaves the neighbourhood, the step is repeated at half its size.
///
/// Tests compare it with the path (5e-6), with the root past turning points and singular starts (2e-11), and
/// with a straight line for linear equations (1e-12).
struct ChowYorke {
  Homotopy function = Homotopy::fixed_point;  ///< which H
  double step = 0.1;                          ///< first step size, positive
  double longest = 10;                        ///< largest step size; positive
  double turn = 0.3;         ///< largest rotation of the tangent in a step; radians, above 0, at most 1
  double accuracy = 1e-6;    ///< tolerance of |H| on the path, relative to |F(x(0))|; positive
  double tolerance = 1e-10;  ///< converged when |F|, Euclidean, is at most this; not negative
  std::int64_t iterations = 10'000;  ///< limit of steps, including rejected ones
};

/// Needs the matrix. Report::time and the observer's time are t, which may decrease between turning points.
/// Statistics::newton_iterations counts linear solves; fallbacks counts a start whose tangent needed another
/// border row. Outcomes besides success: `singular_matrix` if the matrix (dH/dx, dH/dt) is rank-deficient;
/// `step_underflow` if a step falls below 1e-10; `non_finite` at the start; `step_limit`, as when the path
/// runs to infinity; `interrupted`.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations,
/// std::logic_error if they have no matrix
[[nodiscard]] Report find_root(const ChowYorke& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

}  // namespace nlmech::algebraic

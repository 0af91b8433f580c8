/// @file
/// Newton's iteration for F(x) = 0, plain and damped, with a reusable workspace.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "nlmech/algebraic/dense_lu.hpp"
#include "nlmech/support/statistics.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::algebraic {

/// Newton's iteration with full steps: converges quadratically near a regular root. The size of an update is
/// max |dx_i| / (1 + |x_i|).
///
/// Tests check regular roots to rounding, and the error of an iterate against the square of the previous
/// error with the theoretical constant.
struct Newton {
  double tolerance = 1e-12;  ///< converged when an update is at most this
  /// Rounding level of the update: an update of at most this size that is more than half the previous one
  /// ends the iteration with success, counted as a fallback. 0: off.
  double noise = 0;
  int iterations = 50;  ///< limit of updates
  double residual = 0;  ///< also converged when |F|, Euclidean, is at most this; 0: off
};

/// Damped Newton iteration for starts far from the root: the step is halved until the residual norm decreases
/// (Armijo's rule).
///
/// Tests find the root of arctan from starts for which Newton's iteration diverges.
struct DampedNewton {
  double tolerance = 1e-12;   ///< as for Newton
  double noise = 0;           ///< as for Newton
  int iterations = 200;       ///< limit of updates
  double shortest = 0x1p-30;  ///< smallest fraction of Newton's step; below it `not_converged`
  double residual = 0;        ///< as for Newton
};

/// Workspace of the iteration; sized once, reused by later solves.
/// @tparam V column vector, Eigen
template <class V>
struct Workspace {
  /// Workspace for @p n unknowns.
  explicit Workspace(Eigen::Index n) : residual(n), update(n), trial(n), matrix(n, n), lu(n) {}
  V residual;              ///< F(x)
  V update;                ///< Newton's step
  V trial;                 ///< the damped iteration's next x
  Eigen::MatrixXd matrix;  ///< dF/dx
  DenseLu<double> lu;      ///< its factors

  /// Factorises dF/dx at @p x. @return success or `non_finite`
  template <class Derivative>
  [[nodiscard]] Outcome factorise(Derivative& derivative, const V& x) {
    derivative(x, matrix);
    if (!matrix.allFinite()) return Outcome::non_finite;
    lu.compute(matrix);
    return Outcome::success;
  }
  /// Solves for the update from the residual. @return success or `singular_matrix`
  [[nodiscard]] Outcome solve() {
    lu.solve(residual, update);
    return update.allFinite() ? Outcome::success : Outcome::singular_matrix;
  }
};

namespace detail {

/// max |dx_i| / (1 + |x_i|); NaN if a component is NaN.
template <class V>
[[nodiscard]] double length_of_update(const V& update, const V& x) {
  double length = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double part = std::abs(update[i]) / (1 + std::abs(x[i]));
    if (!(part <= length)) length = part;  // keeps a NaN
  }
  return length;
}

/// Writes Newton's step at x to w.update; w.residual must hold F(x).
template <class V, class Work, class Derivative>
[[nodiscard]] Outcome newton_step(Derivative& derivative, const V& x, Work& w, Statistics& statistics) {
  if (!w.residual.allFinite()) return Outcome::non_finite;
  const Outcome outcome = w.factorise(derivative, x);
  ++statistics.jacobians;
  if (outcome == Outcome::non_finite) return outcome;
  ++statistics.factorisations;
  ++statistics.newton_iterations;
  return outcome == Outcome::success ? w.solve() : outcome;
}

/// Has the iteration converged after an update of size @p length? @p before is the size of the previous
/// update.
[[nodiscard]] inline bool is_done(double length, double before, double tolerance, double noise,
                                  Statistics& statistics) {
  if (length <= tolerance) return true;
  if (!(length <= noise && length > before / 2)) return false;
  ++statistics.fallbacks;
  return true;
}

}  // namespace detail

/// Solves F(x) = 0 from the start x. On failure x is not usable.
/// @param method tolerance and bounds
/// @param residual `residual(x, f)` writes F(x) to f
/// @param derivative `derivative(x, j)` writes dF/dx to j
/// @param x start, then the root
/// @param w a Workspace of the size of x, which avoids allocation, or another type with its members
/// @param statistics Newton iterations, Jacobians, factorisations and fallbacks are added to it
/// @return success; at the iteration limit `not_converged` if the last update was below 1e-3, else
/// `newton_diverged`; `singular_matrix` if an update is not finite; `non_finite` if F or its derivative is
/// not
template <class V, class Work, class Residual, class Derivative>
[[nodiscard]] Outcome solve(const Newton& method, Residual&& residual, Derivative&& derivative, V& x, Work& w,
                            Statistics& statistics) {
  double before = HUGE_VAL;
  for (int k = 0; k < method.iterations; ++k) {
    residual(x, w.residual);
    if (method.residual > 0 && w.residual.norm() <= method.residual) return Outcome::success;
    const Outcome outcome = detail::newton_step(derivative, x, w, statistics);
    if (outcome != Outcome::success) return outcome;
    const double length = detail::length_of_update(w.update, x);
    x -= w.update;
    if (detail::is_done(length, before, method.tolerance, method.noise, statistics)) return Outcome::success;
    before = length;
  }
  return before < 1e-3 ? Outcome::not_converged : Outcome::newton_diverged;
}

/// Solves by the damped iteration; arguments and outcomes as for Newton, and `not_converged` if no fraction
/// of a step reduces |F|.
template <class V, class Work, class Residual, class Derivative>
[[nodiscard]] Outcome solve(const DampedNewton& method, Residual&& residual, Derivative&& derivative, V& x,
                            Work& w, Statistics& statistics) {
  double before = HUGE_VAL;
  residual(x, w.residual);
  for (int k = 0; k < method.iterations; ++k) {
    if (method.residual > 0 && w.residual.norm() <= method.residual) return Outcome::success;
    const Outcome outcome = detail::newton_step(derivative, x, w, statistics);
    if (outcome != Outcome::success) return outcome;
    const double norm = w.residual.norm();
    const double length = detail::length_of_update(w.update, x);
    if (length <= method.tolerance) {
      x -= w.update;
      return Outcome::success;
    }
    double fraction = 1;
    for (;; fraction /= 2) {
      w.trial = x - fraction * w.update;
      residual(w.trial, w.residual);
      // Armijo's rule with the constant 1e-4: the linear model predicts a decrease by `fraction`. The
      // comparison is false for NaN.
      if (w.residual.norm() <= (1 - 1e-4 * fraction) * norm) break;
      if (fraction < method.shortest) return Outcome::not_converged;
      if (length <= method.noise) break;  // the residual is noise already
    }
    x = w.trial;
    if (fraction == 1 && detail::is_done(length, before, method.tolerance, method.noise, statistics))
      return Outcome::success;
    before = length;
  }
  return before < 1e-3 ? Outcome::not_converged : Outcome::newton_diverged;
}

}  // namespace nlmech::algebraic

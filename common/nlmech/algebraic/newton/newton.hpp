/// @file
/// Newton's iteration for F(x) = 0, plain and damped, on a workspace that is allocated once.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "nlmech/algebraic/dense_lu.hpp"
#include "nlmech/support/statistics.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::algebraic {

/// Newton's iteration with full steps: converges quadratically from near a regular root.
/// An update is measured by max |dx_i| / (1 + |x_i|).
///
/// Tests hold regular roots to rounding and the error of an iterate to the square of the one before, with the
/// constant of theory.
struct Newton {
  double tolerance = 1e-12;  ///< done when an update is no longer than this
  /// An update that is no longer than this and no longer shrinks (to less than half the one before) is
  /// rounding noise: done, counted as a fallback. Zero: never.
  double noise = 0;
  int iterations = 50;  ///< at most so many updates
  double residual = 0;  ///< done, too, where |F|, Euclidean, is no greater; 0: the updates alone decide
};

/// Newton's direction, shortened until the residual's norm falls (Armijo's rule, halving): for starts that
/// are far from the root.
///
/// Tests hold it to the root of arctan from starts from which Newton's iteration diverges.
struct DampedNewton {
  double tolerance = 1e-12;   ///< as for Newton
  double noise = 0;           ///< as for Newton
  int iterations = 200;       ///< at most so many updates
  double shortest = 0x1p-30;  ///< a shorter fraction of Newton's step ends with `not_converged`
  double residual = 0;        ///< as for Newton
};

/// What the iteration works on; sized once, reused from solve to solve.
/// @tparam V column vector, Eigen
template <class V>
struct Workspace {
  /// For n unknowns.
  explicit Workspace(Eigen::Index n) : residual(n), update(n), trial(n), matrix(n, n), lu(n) {}
  V residual;              ///< F(x)
  V update;                ///< Newton's step
  V trial;                 ///< the damped iteration's next x
  Eigen::MatrixXd matrix;  ///< dF/dx
  DenseLu<double> lu;      ///< its factors

  /// dF/dx at @p x, factorised. @return success or `non_finite`
  template <class Derivative>
  [[nodiscard]] Outcome factorise(Derivative& derivative, const V& x) {
    derivative(x, matrix);
    if (!matrix.allFinite()) return Outcome::non_finite;
    lu.compute(matrix);
    return Outcome::success;
  }
  /// The update from the residual. @return success or `singular_matrix`
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

/// Newton's step at x, whose residual is known, into w.update.
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

/// Is the iteration done after an update of this length, @p before being the length of the one before?
[[nodiscard]] inline bool is_done(double length, double before, double tolerance, double noise,
                                  Statistics& statistics) {
  if (length <= tolerance) return true;
  if (!(length <= noise && length > before / 2)) return false;
  ++statistics.fallbacks;
  return true;
}

}  // namespace detail

/// Solves F(x) = 0 from the start x. On failure x is of no use.
/// @param method tolerance and bounds
/// @param residual `residual(x, f)` writes F(x) to f
/// @param derivative `derivative(x, j)` writes dF/dx to j
/// @param x start, then the root
/// @param w a Workspace of the size of x, with which nothing is allocated, or another type with its members
/// @param statistics Newton iterations, Jacobians, factorisations and fallbacks are added to it
/// @return success; when the iterations are used up `not_converged` if the last update was short (below
/// 1e-3), else `newton_diverged`; `singular_matrix` if an update is not finite; `non_finite` if F or its
/// derivative is not
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

/// The same with damped steps.
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
      // Armijo: along Newton's direction the norm should fall by the fraction; a hundredth of a percent of it
      // will do. The comparison is false for NaN.
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

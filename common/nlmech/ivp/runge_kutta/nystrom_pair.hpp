/// @file
/// Pairs of Runge-Kutta-Nystroem formulas.
#pragma once

#include <algorithm>
#include <cmath>

#include "nlmech/ivp/runge_kutta/embedded_runge_kutta.hpp"
#include "nlmech/ivp/second_order.hpp"

namespace nlmech::ivp {

/// A trial step of a second-order problem.
template <class S, class P>
struct NystromStep : TrialStep<S, P> {
  using Half = typename S::Half;  ///< positions or velocities
  /// For states of @p size components.
  explicit NystromStep(int size) : TrialStep<S, P>(size), q0(Half::Zero(size / 2)), v0(q0), q(q0), v(q0) {}
  Half q0;  ///< positions at the start
  Half v0;  ///< velocities at the start
  Half q;   ///< positions at a stage
  Half v;   ///< workspace for velocities
};

/// An EmbeddedPair for q'' = a(t, q): positions of stage i are q0 + c_i h v0 + h^2 sum_j a_ij k_j. Positions
/// at the end have the weights `position`, in place of a last row of `a`, and `error_weights`; velocities v0
/// + h sum_j b_j k_j have the weights `velocity` and `velocity_error_weights`. Dense output is a shorter
/// step.
template <class P>
struct NystromPair : EmbeddedPair<P> {
  /// The trial step.
  template <class S>
  using Trial = NystromStep<S, P>;
  static constexpr bool is_nystrom = true;  ///< uses accelerations

  /// Evaluates the first stage, at the start.
  template <class S>
  static void start(const S& system, double time, NystromStep<S, P>& step) {
    step.q0 = positions(step.x0);
    step.v0 = velocities(step.x0);
    system.acceleration(time, step.q0, step.v0, step.k[0]);
  }
  /// Evaluates stage @p i. The last stage is added at the end, so the other terms do not depend on it.
  template <std::size_t i, class S>
  [[gnu::always_inline]] static void stage(const S& system, double time, NystromStep<S, P>& step) {
    const double h = step.h, square = h * h;
    const Eigen::Index m = step.q.size();
    for (Eigen::Index d = 0; d < m; ++d) {
      double q = step.q0.data()[d] + P::c[i] * h * step.v0.data()[d];
      if constexpr (i > 1) q += square * weighted<stage_weights<P, i>, i - 1>(step.k, d);
      step.q.data()[d] = q + square * P::a[i][i - 1] * step.k[i - 1].data()[d];
    }
    system.acceleration(time, step.q, step.v0, step.k[i]);
  }
  /// Largest relative rate of a position or a velocity at the start.
  template <class S>
  [[nodiscard]] static double rate(const NystromStep<S, P>& step, double floor) {
    const auto rate = [&](double slope, double x) { return std::abs(slope) / std::max(std::abs(x), floor); };
    double largest = 0;
    for (Eigen::Index i = 0; i < step.q0.size(); ++i)
      largest = std::max({largest, rate(step.v0[i], step.q0[i]), rate(step.k[0][i], step.v0[i])});
    return largest;
  }
  /// Computes the state at the end from the stages.
  template <class S>
  static void state(NystromStep<S, P>& step, typename S::State& x) {
    constexpr std::size_t stages = P::position.size();
    const double h = step.h;
    const Eigen::Index m = step.q0.size();
    x.resize(2 * m);
    for (Eigen::Index d = 0; d < m; ++d) {
      const double q0 = step.q0.data()[d], v0 = step.v0.data()[d];
      x.data()[d] = q0 + h * v0 + h * h * weighted<P::position, stages>(step.k, d);
      x.data()[m + d] = v0 + h * weighted<P::velocity, stages>(step.k, d);
    }
  }
  /// Writes the state at the end. @return the error of positions and velocities in tolerances, as
  /// EmbeddedPair
  template <class S>
  [[nodiscard]] static double finish(NystromStep<S, P>& step, const auto& method) {
    constexpr std::size_t stages = P::position.size();
    state(step, step.x1);
    double largest = 0;
    const auto add = [&](double e, double before, double after) {
      enlarge(largest,
              std::abs(e) / (method.absolute_tolerance +
                             method.relative_tolerance * std::max(std::abs(before), std::abs(after))));
    };
    const double h = step.h;
    const Eigen::Index m = step.q0.size();
    for (Eigen::Index d = 0; d < m; ++d) {
      add(h * h * weighted<P::error_weights, stages>(step.k, d), step.x0[d], step.x1[d]);
      add(h * weighted<P::velocity_error_weights, stages>(step.k, d), step.x0[m + d], step.x1[m + d]);
    }
    return largest;
  }
  /// Does the acceleration at the start depend on the velocities? Costs two evaluations.
  template <class S>
  [[nodiscard]] static bool uses_velocities(const S& system, double time, NystromStep<S, P>& step) {
    bool depends = false;
    for (const double factor : {0.0, -1.0}) {
      for (int i = 0; i < step.v.size(); ++i) step.v[i] = factor * step.v0[i] - i - 1;
      system.acceleration(time, step.q0, step.v, step.k[1]);
      depends = depends || (step.k[1].allFinite() && step.k[0].allFinite() && step.k[1] != step.k[0]);
    }
    return depends;
  }
};

}  // namespace nlmech::ivp

/// @file
/// The walk of a fixed-step method from begin to end: steps that land on discontinuities, statuses,
/// observers.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "nlmech/ivp/failures.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/limits.hpp"
#include "nlmech/ivp/step_control.hpp"

namespace nlmech::ivp {

/// Steps of equal length over one smooth segment. If the asked length does not divide the segment (to 1e-9 of
/// a step), the last step is shorter; the end is met exactly.
struct StepGrid {
  double begin;        ///< begin of the segment
  double end;          ///< its end
  double step;         ///< signed length of all steps but perhaps the last
  double last;         ///< signed length of the last step
  std::int64_t count;  ///< number of steps; at most 2^62

  /// Time after k steps.
  [[nodiscard]] double time(std::int64_t k) const {
    return k == count ? end : begin + static_cast<double>(k) * step;
  }
  /// Length of step k (from 0): the same double for every full step, so that steppers may keep what depends
  /// on it.
  [[nodiscard]] double length(std::int64_t k) const { return k + 1 == count ? last : step; }
};

/// @param length positive length asked for
[[nodiscard]] StepGrid make_step_grid(double begin, double end, double length);

/// The shortest step from @p t0 to @p t1: 512 spacings of doubles at the later time. A rounded time is off by
/// up to half a spacing, and so are the times at which forces are evaluated and rows are read; this is less
/// than a thousandth of a longer step, so that three digits of what a step changes are right. Steps from 0
/// that are shorter would be 1e13 or more.
[[nodiscard]] inline double shortest_fixed_step(double t0, double t1) {
  return 512 * spacing(std::max(std::abs(t0), std::abs(t1)));
}

/// Base of fixed-step steppers. A stepper has `std::string_view name() const`, a member
/// `Status step(double t, double h, const State& x0, State& x1, Statistics&)` that goes from t to t +
/// h, and dense output over that step. One with values at inner nodes says so by has_nodes, and fills times_
/// and states_ in step(). One that carries derivatives from step to step, or looks at the end of a step, has
/// `void begin_segment(double begin, double end)`, called before the first step of each stretch between
/// discontinuities.
template <SystemLike S>
class StepperOf : public DenseOutputOf<S> {
 public:
  /// For states of @p size components.
  explicit StepperOf(int size) : times_(1), states_(size, 1) {}
  /// Times with values of the method's own within the latest step, its end last. By default the end alone.
  [[nodiscard]] std::span<const double> times() const { return times_; }
  /// States at times(), one a column.
  [[nodiscard]] const typename S::Nodes& states() const { return states_; }
  /// Called by the walk after a step without inner nodes: the end of the step is the only value.
  void set_end(double t, const typename S::State& x) {
    times_[0] = t;
    states_.col(0) = x;
  }
  /// Does step() fill times and states itself?
  static constexpr bool has_nodes = false;

 protected:
  std::vector<double> times_;  ///< filled by steppers with has_nodes
  typename S::Nodes states_;   ///< filled by steppers with has_nodes
};

/// For every System.
using Stepper = StepperOf<System>;

/// Integrates from problem.t0 to problem.t1 with steps of the length @p h > 0.
template <SystemLike S, class MethodStepper>
[[nodiscard]] SolutionOf<S> integrate_fixed_steps(const InitialValueProblemOf<S>& problem, double h,
                                                  MethodStepper& stepper) {
  const std::string_view name = stepper.name();
  SolutionOf<S> now{problem.t0, problem.x0, {}, {}};
  typename S::State next = problem.x0;
  std::vector<double> ends = problem.system.discontinuities(problem.t0, problem.t1);
  ends.push_back(problem.t1);
  if (const double shortest = shortest_fixed_step(problem.t0, problem.t1); h < shortest) {
    now.status = time_too_coarse(name, now.t, h, shortest);
    return now;
  }
  const Stopwatch watch;
  for (const double end : ends) {
    const StepGrid grid = make_step_grid(now.t, end, h);
    if constexpr (requires { stepper.begin_segment(now.t, end); }) stepper.begin_segment(now.t, end);
    for (std::int64_t k = 0; k < grid.count; ++k) {
      now.status = check_limits(name, now.t, now.statistics, problem.limits, watch);
      if (!now.status.ok()) return now;
      const double length = grid.length(k), t1 = grid.time(k + 1);
      now.status = stepper.step(now.t, length, now.x, next, now.statistics);
      if (now.status.ok() && !next.allFinite()) now.status = non_finite_state(name, now.t, length);
      if (!now.status.ok()) return now;
      ++now.statistics.steps;
      if (problem.observer) {
        if constexpr (!MethodStepper::has_nodes) stepper.set_end(t1, next);
        const bool go_on = problem.observer(
            {now.statistics.steps, now.t, t1, now.x, next, stepper.times(), stepper.states(), stepper});
        if (!go_on) now.status = interrupted(name, t1);
      }
      std::swap(now.x, next);
      now.t = t1;
      if (!now.status.ok()) return now;
    }
  }
  return now;
}

}  // namespace nlmech::ivp

/// @file
/// Loop of a fixed-step method: steps that end on discontinuities, statuses, observers.
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

/// Grid of equal steps over one smooth segment. If the step size does not divide the segment (to 1e-9 of a
/// step), the last step is shorter. The last step ends exactly at the end.
struct StepGrid {
  double begin;        ///< start of the segment
  double end;          ///< end of the segment
  double step;         ///< signed step size of all steps but possibly the last
  double last;         ///< signed size of the last step
  std::int64_t count;  ///< number of steps; at most 2^62

  /// Time after k steps.
  [[nodiscard]] double time(std::int64_t k) const {
    return k == count ? end : begin + static_cast<double>(k) * step;
  }
  /// Size of step k (from 0): the same double for every full step, so that steppers may reuse what depends on
  /// it.
  [[nodiscard]] double length(std::int64_t k) const { return k + 1 == count ? last : step; }
};

/// @param length step size, positive
[[nodiscard]] StepGrid make_step_grid(double begin, double end, double length);

/// The smallest fixed step from @p t0 to @p t1: 512 spacings of doubles at the later time. The rounding error
/// of a time at which forces are evaluated is up to half a spacing, less than a thousandth of such a step, so
/// the change over a step has three correct digits. An integration from 0 with smaller steps would need 1e13
/// of them or more.
[[nodiscard]] inline double shortest_fixed_step(double t0, double t1) {
  return 512 * spacing(std::max(std::abs(t0), std::abs(t1)));
}

/// Base of fixed-step steppers. A stepper has `std::string_view name() const`, a member
/// `Status step(double t, double h, const State& x0, State& x1, Statistics&)` that integrates from t to t +
/// h, and dense output over that step. A stepper with values at inner nodes sets has_nodes and fills times_
/// and states_ in step(). A stepper that passes derivatives from step to step, or evaluates f at the end of a
/// step, has `void begin_segment(double begin, double end)`, called before the first step of each interval
/// between discontinuities.
template <SystemLike S>
class StepperOf : public DenseOutputOf<S> {
 public:
  /// For states of @p size components.
  explicit StepperOf(int size) : times_(1), states_(size, 1) {}
  /// Times of the output points of the latest step, its end last. Default: the end only.
  [[nodiscard]] std::span<const double> times() const { return times_; }
  /// States at times(), one per column.
  [[nodiscard]] const typename S::Nodes& states() const { return states_; }
  /// Sets the end of the step as the only output point; called after a step without inner nodes.
  void set_end(double t, const typename S::State& x) {
    times_[0] = t;
    states_.col(0) = x;
  }
  /// Does step() fill times_ and states_?
  static constexpr bool has_nodes = false;

 protected:
  std::vector<double> times_;  ///< filled by steppers with has_nodes
  typename S::Nodes states_;   ///< filled by steppers with has_nodes
};

/// Base of fixed-step steppers for System.
using Stepper = StepperOf<System>;

/// Integrates from problem.t0 to problem.t1 with steps of size @p h > 0.
/// @param parts number of equal parts of a step, whose size is the one that the user gives: for messages
template <SystemLike S, class MethodStepper>
[[nodiscard]] SolutionOf<S> integrate_fixed_steps(const InitialValueProblemOf<S>& problem, double h,
                                                  MethodStepper& stepper, int parts = 1) {
  const std::string_view name = stepper.name();
  SolutionOf<S> now{problem.t0, problem.x0, {}, {}};
  typename S::State next = problem.x0;
  std::vector<double> ends = problem.system.discontinuities(problem.t0, problem.t1);
  ends.push_back(problem.t1);
  if (const double shortest = shortest_fixed_step(problem.t0, problem.t1); h < shortest) {
    now.status = time_too_coarse(name, now.t, h / parts, shortest / parts);
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

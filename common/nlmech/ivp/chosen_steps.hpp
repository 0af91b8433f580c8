/// @file
/// Loop of a method with adaptive steps: intervals between discontinuities, trial steps, limits, observer.
#pragma once

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

/// Base of one integration with adaptive steps; integrate_fixed_steps() is its counterpart for equal steps.
/// The method, Run, declares this class a friend and has
///  - `Status begin(double end)`: starts control_ at now_ on an interval on which f is smooth;
///  - `double attempt(double t1)`: error of a trial step from now_ divided by the tolerance; NaN if the trial
///    state is not finite;
///  - `Status accept(double t1, double error)`, called if that is 1 or less: updates control_ and calls
///    take();
///  - `double shorter(double error)`, called otherwise: step size of the next trial.
template <SystemLike S, class Run>
class AdaptiveStepLoop {
 public:
  using State = typename S::State;  ///< all components

  /// Integrates from t0 to t1; call once.
  [[nodiscard]] SolutionOf<S> run() {
    std::vector<double> ends = problem_.system.discontinuities(problem_.t0, problem_.t1);
    ends.push_back(problem_.t1);
    for (const double end : ends) {
      now_.status = self().begin(end);
      if (problem_.limits.first_step > 0) control_.start(problem_.limits.first_step);
      while (now_.t != end && now_.status.ok()) now_.status = step(end);
      if (!now_.status.ok()) break;
    }
    return std::move(now_);
  }

 protected:
  /// @param problem outlives the integration
  /// @param name of the method, for messages
  /// @param refine number of equally spaced output points per step for observers
  AdaptiveStepLoop(const InitialValueProblemOf<S>& problem, std::string_view name, const StepRule& rule,
                   int refine = 1)
      : problem_(problem),
        now_{problem.t0, problem.x0, {}, {}},
        control_(bounded(rule, problem.limits.largest_step)),
        name_(name),
        times_(static_cast<std::size_t>(refine)),
        states_(problem.system.size(), refine),
        between_(problem.system.size()) {}

  /// Called before the first trial of each step; a method may plan the step in it.
  [[nodiscard]] Status prepare() { return {}; }
  /// Failure if a trial of the smallest step size, to @p t1, is rejected.
  [[nodiscard]] Status missed(double t1, double error) const {
    return std::isnan(error) ? non_finite_state(name_, now_.t, t1 - now_.t)
                             : tolerance_missed(name_, now_.t, t1 - now_.t);
  }
  /// Counts the step to (@p t1, @p x1), passes it to the observer and updates now_.
  /// @return `interrupted` if the observer returns false
  [[nodiscard]] Status take(double t1, const State& x1, const DenseOutputOf<S>& dense) {
    ++now_.statistics.steps;
    Status status;
    if (problem_.observer && !show(t1, x1, dense)) status = interrupted(name_, t1);
    now_.x = x1;
    now_.t = t1;
    return status;
  }

  const InitialValueProblemOf<S>& problem_;  ///< the problem to integrate
  SolutionOf<S> now_;                        ///< current time, state, status and statistics
  StepControl control_;                      ///< step-size control

 private:
  Run& self() { return static_cast<Run&>(*this); }

  // Tries steps until one is accepted or the integration fails.
  Status step(double end) {
    for (bool is_first = true;; is_first = false) {
      Status status = check_limits(name_, now_.t, now_.statistics, problem_.limits, watch_);
      if (!status.ok()) return status;
      if (is_first) {
        if (Status ready = self().prepare(); !ready.ok()) return ready;
      }
      const double t1 = control_.plan(now_.t, end);
      if (t1 == now_.t) return step_underflow(name_, now_.t, control_.length());
      const double error = self().attempt(t1);
      if (error <= 1) return self().accept(t1, error);
      ++now_.statistics.rejected;
      if (!control_.rejected(self().shorter(error))) return self().missed(t1, error);
    }
  }

  [[nodiscard]] bool show(double t1, const State& x1, const DenseOutputOf<S>& dense) {
    const auto count = states_.cols();
    for (Eigen::Index i = 0; i + 1 < count; ++i) {
      const double t = now_.t + (static_cast<double>(i) + 1) / static_cast<double>(count) * (t1 - now_.t);
      times_[static_cast<std::size_t>(i)] = t;
      dense.at(t, between_);
      states_.col(i) = between_;
    }
    times_.back() = t1;
    states_.col(count - 1) = x1;
    return problem_.observer({now_.statistics.steps, now_.t, t1, now_.x, x1, times_, states_, dense});
  }

  std::string_view name_;
  std::vector<double> times_;
  typename S::Nodes states_;
  State between_;
  Stopwatch watch_;
};

}  // namespace nlmech::ivp

/// @file
/// The project's own integrator: collocation at Radau nodes with control of step and error.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "nlmech/ivp/collocation_sweeps.hpp"
#include "nlmech/ivp/failures.hpp"
#include "nlmech/ivp/integrate.hpp"

namespace nlmech::ivp {

/// Collocation with polynomials at the left end and Radau nodes, the method Radau IIA of high order, step by
/// step under an error estimate; in the form for accelerations where the problem has them.
///
/// Dense output solves the equations of the step anew up to the asked time: as accurate as the steps are.
struct AdaptiveCollocation {
  static constexpr std::string_view name = "adaptive-collocation";  ///< on command lines and in tables
  double relative_tolerance = 1e-9;                                 ///< rtol, from 0 to 0.1
  double absolute_tolerance = 1e-9;                                 ///< atol, positive
  int nodes = 0;            ///< N, the left end among them: 9, 13 or 17; 0: by the tolerance
  double largest_step = 0;  ///< 0: the interval
};

/// @throws std::invalid_argument naming an option out of range and its value
void check_options(const AdaptiveCollocation& method);

namespace adaptive {

/// One integration from begin to end by an engine: sweeps::Sweeper.
template <class S, class Engine>
class Run {
 public:
  static constexpr int n = S::dimension;  ///< components of the state
  /// @param task outlives the run  @param order of the error in the step
  Run(const Task<S>& task, const AdaptiveCollocation& method, Engine engine, int order)
      : task_(task),
        largest_(method.largest_step > 0 ? method.largest_step : std::abs(task.t1 - task.t0)),
        order_(order),
        engine_(std::move(engine)),
        now_{task.t0, task.x0, {}, {}},
        states_(task.system.size(), 1) {}

  /// The answer; call once.
  Solution<n> run() {
    std::vector<double> ends = task_.system.discontinuities(task_.t0, task_.t1);
    ends.push_back(task_.t1);
    for (const double end : ends) {
      now_.status = cross(end);
      if (!now_.status.ok()) break;
    }
    return std::move(now_);
  }

 private:
  static constexpr std::string_view name = AdaptiveCollocation::name;
  static constexpr double safety = 0.85;
  static constexpr double rest = 1.2;        ///< a longer step has to be longer by this
  static constexpr int many_sweeps = 8;      ///< more than that are dearer than shorter steps
  static constexpr double most_growth = 2;   ///< of a step
  static constexpr double first_growth = 8;  ///< of the first ones, whose length was a guess

  Status cross(double end) {
    engine_.begin_segment(now_.t, end, now_.x);
    ++now_.statistics.right_hand_sides;
    if (!engine_.begin_is_finite()) return non_finite_rhs(name, now_.t);
    length_ = std::min(largest_, engine_.first_length(std::abs(end - now_.t)));
    before_ = 0;
    guesses_ = 3;
    Status status;
    while (now_.t != end && status.ok()) status = step(end);
    return status;
  }

  [[nodiscard]] static double spacing(double t) {
    return std::nextafter(std::abs(t), std::numeric_limits<double>::infinity()) - std::abs(t);
  }

  // One accepted step, if there is one.
  Status step(double end) {
    const double shortest = 16 * spacing(now_.t);
    length_ = std::min(largest_, std::max(shortest, length_));
    for (;;) {
      if (Status status = check_limits(); !status.ok()) return status;
      // No stub at the end: what is left is one step or two equal ones.
      const double left = std::abs(end - now_.t);
      const double taken = length_ >= left ? left : std::min(length_, std::max(left / 2, shortest));
      const double t1 = taken >= left ? end : now_.t + std::copysign(taken, end - now_.t);
      if (t1 == now_.t) return step_underflow(name, now_.t, length_);
      const sweeps::Trial trial = engine_.attempt(now_.t, t1, now_.statistics);
      now_.statistics.newton_iterations += trial.sweeps;
      if (trial.converged && trial.error <= 1) return accept(t1, taken, trial);
      ++now_.statistics.rejected;
      if (taken <= shortest) return tolerance_missed(name, now_.t, t1 - now_.t);
      const double change = trial.error > 1 ? std::clamp(safety / root(trial.error), 0.2, 0.9) : 0.5;
      length_ = std::max(shortest, taken * change);
    }
  }

  [[nodiscard]] double root(double error) const { return std::pow(std::max(error, 1e-30), 1. / order_); }

  Status accept(double t1, double taken, const sweeps::Trial& trial) {
    ++now_.statistics.steps;
    Status status;
    if (task_.observer) {
      states_.col(0) = engine_.end_state();
      if (!task_.observer({now_.statistics.steps, now_.t, t1, engine_.begin_state(), engine_.end_state(),
                           std::span(&t1, 1), states_, engine_}))
        status = interrupted(name, t1);
    }
    length_ = std::max(taken < length_ ? length_ : 0, taken * growth(taken, trial));
    now_.x = engine_.end_state();
    now_.t = t1;
    engine_.accept();
    return status;
  }

  // What the next step may be times as long: by the error, as it grows from step to step (Gustafsson), and by
  // the sweeps.
  [[nodiscard]] double growth(double taken, const sweeps::Trial& trial) {
    const double r = root(trial.error);
    double change = safety / r;
    if (before_ > 0) change = std::min(change, change * (taken / before_) * (root_before_ / r));
    before_ = taken;
    root_before_ = r;
    if (change >= 1 && change < rest) change = 1;
    if (trial.sweeps > many_sweeps)
      change = std::min(change, std::pow(static_cast<double>(many_sweeps) / trial.sweeps, 0.7));
    return std::clamp(change, 0.2, guesses_-- > 0 ? first_growth : most_growth);
  }

  [[nodiscard]] Status check_limits() const {
    if (now_.statistics.steps + now_.statistics.rejected >= task_.limits.steps)
      return step_limit(name, now_.t, task_.limits.steps);
    if (std::isfinite(task_.limits.seconds) && watch_.seconds() > task_.limits.seconds)
      return time_limit(name, now_.t, task_.limits.seconds);
    return {};
  }

  const Task<S>& task_;
  double largest_, length_ = 0, before_ = 0, root_before_ = 0;
  int order_, guesses_ = 0;
  Engine engine_;
  Solution<n> now_;
  Nodes<n> states_;
  Stopwatch watch_;
};

/// Runs sweeps of s nodes.
template <int s, class S>
[[nodiscard]] Solution<S::dimension> run_sweeps(const Task<S>& task, const AdaptiveCollocation& method) {
  const sweeps::Tolerance tolerance{method.absolute_tolerance, method.relative_tolerance};
  if constexpr (has_halves<S::dimension>) {
    if (task.system.second_order() && task.system.size() % 2 == 0) {
      using Engine = sweeps::Sweeper<S, s, true>;
      return Run<S, Engine>(task, method, Engine(task.system, tolerance), 2 * s).run();
    }
  }
  using Engine = sweeps::Sweeper<S, s, false>;
  return Run<S, Engine>(task, method, Engine(task.system, tolerance), 2 * s).run();
}

/// Nodes that cost least for a tolerance, on problems of a few components.
[[nodiscard]] int nodes_for(double relative_tolerance);

}  // namespace adaptive

/// Runs adaptive-collocation.
template <SystemLike S>
struct Integrator<S, AdaptiveCollocation> {
  /// See integrate().
  static Solution<S::dimension> run(const Task<S>& task, const AdaptiveCollocation& method);
};

template <SystemLike S>
Solution<S::dimension> Integrator<S, AdaptiveCollocation>::run(const Task<S>& task,
                                                               const AdaptiveCollocation& method) {
  check_options(method);
  switch (method.nodes > 0 ? method.nodes : adaptive::nodes_for(method.relative_tolerance)) {
    case 9: return adaptive::run_sweeps<8>(task, method);
    case 13: return adaptive::run_sweeps<12>(task, method);
    default: return adaptive::run_sweeps<16>(task, method);
  }
}

}  // namespace nlmech::ivp

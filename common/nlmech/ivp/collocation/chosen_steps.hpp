/// @file
/// What methods that choose their steps share: stretches between discontinuities, limits, the observer.
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "nlmech/ivp/failures.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/limits.hpp"

namespace nlmech::ivp {

/// Distance to the next double, away from 0.
[[nodiscard]] inline double spacing(double t) {
  return std::nextafter(std::abs(t), std::numeric_limits<double>::infinity()) - std::abs(t);
}

/// Base of one integration with steps of chosen length; walk() is its counterpart for equal ones.
template <SystemLike S>
class ChosenSteps {
 public:
  static constexpr int n = S::dimension;  ///< components of the state

 protected:
  /// @param task outlives the integration
  /// @param name the method, in sentences
  ChosenSteps(const Task<S>& task, std::string_view name)
      : task_(task), now_{task.t0, task.x0, {}, {}}, states_(task.system.size(), 1), name_(name) {}

  /// Goes from begin to end, call once: `cross(end)` takes now_ over a stretch on which f is smooth, or says
  /// why it cannot.
  template <class Cross>
  [[nodiscard]] Solution<n> run_by(Cross&& cross) {
    std::vector<double> ends = task_.system.discontinuities(task_.t0, task_.t1);
    ends.push_back(task_.t1);
    for (const double end : ends) {
      now_.status = cross(end);
      if (!now_.status.ok()) break;
    }
    return std::move(now_);
  }

  /// `step_limit` or `time_limit` if a limit is used up.
  [[nodiscard]] Status check_limits() const {
    return ivp::check_limits(name_, now_.t, now_.statistics, task_.limits, watch_);
  }

  /// Shows the step from now_.t to @p t1, already counted, to the observer. @return `interrupted` if that
  /// says stop
  [[nodiscard]] Status show(double t1, const State<n>& x0, const State<n>& x1, const DenseOutput<n>& dense) {
    if (!task_.observer) return {};
    states_.col(0) = x1;
    if (task_.observer({now_.statistics.steps, now_.t, t1, x0, x1, std::span(&t1, 1), states_, dense}))
      return {};
    return interrupted(name_, t1);
  }

  const Task<S>& task_;  ///< what is asked
  Solution<n> now_;      ///< how far it has come

 private:
  Nodes<n> states_;
  std::string_view name_;
  Stopwatch watch_;
};

}  // namespace nlmech::ivp

/// @file
/// Step-size control of error-controlled methods.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace nlmech::ivp {

/// Distance to the next double, away from 0.
[[nodiscard]] inline double spacing(double t) {
  return std::nextafter(std::abs(t), std::numeric_limits<double>::infinity()) - std::abs(t);
}

/// Method-specific constants of step-size control. The formula for the step size is in each method, as
/// published.
struct StepRule {
  double largest = std::numeric_limits<double>::infinity();  ///< largest planned step size
  double bound = std::numeric_limits<double>::infinity();  ///< largest step size of a trial, stretched or not
  double shortest = 16;  ///< smallest step size, in spacings of doubles at t; 0: any h with t + h != t
  double stretch = 0;  ///< largest factor on the first trial to reach the end (ode45: 1.1); 0: the remainder
                       ///< is taken in one step, or in two equal steps if it is below two steps
  double again = 0;    ///< factor after a repeated rejection; 0: by the error, as after the first
  double least_change = 0;  ///< smallest factor to the next step after a rejection
  double most_change = 1;   ///< largest factor to the next step after a rejection
  double kept_from = 1;     ///< after a step shortened to hit the end: keep the planned step size if the
                            ///< controller would change the shortened one by this factor or more
  bool measured = false;    ///< taken() is the difference of a trial's ends, otherwise the planned step size
};

/// @p rule with step sizes of at most @p largest_step (Limits).
[[nodiscard]] inline StepRule bounded(StepRule rule, double largest_step) {
  rule.largest = std::min(rule.largest, largest_step);
  rule.bound = std::min(rule.bound, largest_step);
  return rule;
}

/// Step sizes of one integration. Trials of a step are planned until one is accepted. Step sizes are positive
/// in both directions of time.
///
/// Tests assert the exact step sizes of each rule.
class StepControl {
 public:
  /// Step-size control by @p rule.
  explicit StepControl(const StepRule& rule) : rule_(rule) {}
  /// The constants.
  [[nodiscard]] const StepRule& rule() const { return rule_; }

  /// Starts with step size @p length and without history.
  void start(double length) {
    length_ = length;
    rejections_ = 0;
    forget();
  }
  /// Discards the error of the last step; for a change of the error estimate.
  void forget() { before_ = 0; }

  /// End of the next trial from @p t towards @p end; @p t if t + h == t.
  [[nodiscard]] double plan(double t, double end) {
    if (rejections_ == 0) {
      shortest_ = rule_.shortest > 0 ? rule_.shortest * spacing(t) : 0;
      length_ = std::min(rule_.largest, std::max(shortest_, length_));
    }
    const double left = std::abs(end - t);
    double planned = length_;
    if (rule_.stretch > 0) {
      if (rejections_ == 0 && rule_.stretch * length_ >= left) planned = left;
    } else {
      planned = length_ >= left ? left : std::min(length_, std::max(left / 2, shortest_));
    }
    planned = std::min(planned, rule_.bound);
    begin_ = t;
    end_ = planned >= left ? end : t + std::copysign(planned, end - t);
    taken_ = rule_.measured ? std::abs(end_ - t) : planned;
    is_cut_ = planned < length_;
    is_shortest_ = planned <= shortest_;
    return end_;
  }
  /// Planned step size, before it is shortened or stretched to hit the end.
  [[nodiscard]] double length() const { return length_; }
  /// Step size of the trial.
  [[nodiscard]] double taken() const { return taken_; }

  /// Accepts the trial; @p wanted is the wanted size of the next step.
  void accepted(double wanted) {
    if (rejections_ > 0) wanted = std::clamp(wanted, rule_.least_change * taken_, rule_.most_change * taken_);
    const bool keeps_planned = is_cut_ && wanted >= rule_.kept_from * taken_;
    length_ = keeps_planned ? std::max(length_, wanted) : wanted;
    rejections_ = 0;
  }
  /// Rejects the trial; @p wanted is the wanted step size of the next one. @return false if the step size
  /// cannot be reduced
  [[nodiscard]] bool rejected(double wanted) {
    if (rejections_++ > 0 && rule_.again > 0) wanted = rule_.again * taken_;
    length_ = std::max(shortest_, wanted);
    return !is_shortest_ && begin_ + std::copysign(length_, end_ - begin_) != begin_;
  }

  /// Factor on the step size after the trial: safety / root, less if errors grow from step to step (K.
  /// Gustafsson, Control-theoretic techniques for stepsize selection in implicit Runge-Kutta methods, ACM
  /// Trans. Math. Software 20 (1994) 496-517). Call once per step, before accepted().
  /// @param root err^(1/k), positive, for an error proportional to h^k
  /// @param remembered value of root that the next call uses as that of this step
  [[nodiscard]] double change(double safety, double root, double remembered) {
    double change = safety / root;
    if (before_ > 0) change = std::min(change, change * (taken_ / before_) * (root_before_ / root));
    before_ = taken_;
    root_before_ = remembered;
    return change;
  }

 private:
  StepRule rule_;
  double length_ = 0, taken_ = 0, shortest_ = 0;
  double before_ = 0, root_before_ = 0;  // size of the last step, and its root for change()
  double begin_ = 0, end_ = 0;           // ends of the trial
  int rejections_ = 0;
  bool is_cut_ = false, is_shortest_ = false;
};

}  // namespace nlmech::ivp

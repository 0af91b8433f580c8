/// @file
/// How a method that controls its error goes from one length of a step to the next.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace nlmech::ivp {

/// Distance to the next double, away from 0.
[[nodiscard]] inline double spacing(double t) {
  return std::nextafter(std::abs(t), std::numeric_limits<double>::infinity()) - std::abs(t);
}

/// In what methods differ, but for the formulas by which an error gives a length: those are each method's
/// own, as published.
struct StepRule {
  double largest = std::numeric_limits<double>::infinity();  ///< no step is planned to be longer
  double bound = std::numeric_limits<double>::infinity();    ///< no trial is longer, stretched or not
  double shortest = 16;  ///< no step is shorter than so many spacings of doubles; 0: unless it is lost in t
  double stretch = 0;    ///< the first trial may be so many times longer to meet the end (ode45: 1.1);
                         ///< 0: what is left is one step or two equal ones, never a stub
  double again = 0;      ///< factor after further rejections; 0: by the error, as after the first
  double least_change = 0;  ///< from a step that was rejected before to the next, at least
  double most_change = 1;   ///< and at most
  double kept_from = 1;     ///< if the end cut a step short and its error would have it change so many times
                            ///< or more, the length that was planned holds on
  bool measured = false;    ///< formulas start from the difference of a trial's ends, else from what was
                            ///< planned, which rounding may make another double
};

/// The rule, where steps are at most @p largest_step long besides (Limits).
[[nodiscard]] inline StepRule bounded(StepRule rule, double largest_step) {
  rule.largest = std::min(rule.largest, largest_step);
  rule.bound = std::min(rule.bound, largest_step);
  return rule;
}

/// The lengths of one integration's steps. A step is planned until a trial of it is accepted; lengths are
/// positive in both directions of time.
///
/// Tests hold it to the lengths that each rule says, exactly.
class StepControl {
 public:
  /// By @p rule.
  explicit StepControl(const StepRule& rule) : rule_(rule) {}
  /// What it goes by.
  [[nodiscard]] const StepRule& rule() const { return rule_; }

  /// Plans the next step to be @p length long, with nothing of the steps before remembered.
  void start(double length) {
    length_ = length;
    rejections_ = 0;
    forget();
  }
  /// Forgets the error of the step before, if errors are no longer of the same kind.
  void forget() { before_ = 0; }

  /// Where the next trial ends, from @p t towards @p end; @p t if its length is lost in the time.
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
  /// Length that was planned, before the end cut or stretched it.
  [[nodiscard]] double length() const { return length_; }
  /// Length of the trial.
  [[nodiscard]] double taken() const { return taken_; }

  /// The trial is the step; the next one is to be @p wanted long.
  void accepted(double wanted) {
    if (rejections_ > 0) wanted = std::clamp(wanted, rule_.least_change * taken_, rule_.most_change * taken_);
    const bool kept = is_cut_ && wanted >= rule_.kept_from * taken_;
    length_ = kept ? std::max(length_, wanted) : wanted;
    rejections_ = 0;
  }
  /// The next trial is to be @p wanted long. @return false if it cannot be shorter
  [[nodiscard]] bool rejected(double wanted) {
    if (rejections_++ > 0 && rule_.again > 0) wanted = rule_.again * taken_;
    length_ = std::max(shortest_, wanted);
    return !is_shortest_ && begin_ + std::copysign(length_, end_ - begin_) != begin_;
  }

  /// By what the length may change after the trial: safety / root, less if errors grow from step to step (K.
  /// Gustafsson, Control-theoretic techniques for stepsize selection in implicit Runge-Kutta methods, ACM
  /// Trans. Math. Software 20 (1994) 496-517). Call once a step, before accepted().
  /// @param root err^(1/k), positive, where the error of a step of length h goes with h^k
  /// @param remembered what the next step takes for it
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
  double before_ = 0, root_before_ = 0;  // length of the step before, and what change() remembers of it
  double begin_ = 0, end_ = 0;           // of the trial
  int rejections_ = 0;
  bool is_cut_ = false, is_shortest_ = false;
};

}  // namespace nlmech::ivp

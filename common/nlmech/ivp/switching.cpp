#include "nlmech/ivp/switching.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "nlmech/ivp/smooth_segment.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::ivp {
namespace {

/// A point where the equations of a mode cease to be valid.
struct Switch {
  std::size_t surface;  ///< index of the switching function
  double t;             ///< time
  State x;              ///< state
};

/// Integrates a system mode by mode.
class Walk {
 public:
  Walk(const System& system, double t0, double t1, const SmoothRun& run, const Observer& observer,
       const Limits& limits)
      : system_(system),
        run_(run),
        observer_(observer),
        limits_(limits),
        direction_(t1 > t0 ? 1 : -1),
        first_(t0),
        end_(t1),
        mode_(static_cast<std::size_t>(system.switches()), 1),
        values_(mode_.size()),
        rates_(mode_.size()),
        greatest_(mode_.size()),
        before_(mode_.size()),
        after_(mode_.size()) {}

  Solution from(double t, const State& x0) {
    solution_ = {t, x0, {}, {}};
    // Switching functions may jump at discontinuities: all modes are determined anew there.
    std::vector<double> ends = system_.discontinuities(t, end_);
    ends.push_back(end_);
    for (const double end : ends) {
      stretch_end_ = end;
      segment_ = SmoothSegment(solution_.t, end);
      begin(solution_.t, solution_.x);
      while (solution_.status.ok() && solution_.t != stretch_end_) segment();
    }
    solution_.statistics.seconds = watch_.seconds();
    return solution_;
  }

 private:
  static constexpr int places = 4;  // smallest number of points of a step at which surfaces are evaluated
  static constexpr int most_repeated = 32;  // limit of successive switches at once,
  static constexpr double at_once = 1e-12;  // that is within this fraction of the interval of integration

  /// Distance of a switching function from the end of validity of the mode, negative beyond it, and its rate
  /// in the direction of integration.
  struct Margin {
    double value, slope;
  };

  // Sets values_ and rates_.
  void evaluate(const Mode& mode, double t, const State& x) {
    in(mode).surfaces(segment_(t), x, values_, rates_);
  }
  const System& in(const Mode& mode) {
    const auto known = systems_.find(mode);
    if (known != systems_.end()) return known->second;
    constexpr std::size_t most_known = 256;
    if (systems_.size() > most_known) systems_.clear();
    return systems_.emplace(mode, system_.in_mode(mode)).first->second;
  }
  // Rate of function i in the direction of integration, with the equations of the given side of its zero.
  double rate(std::size_t i, int side, double t, const State& x) {
    Mode mode = mode_;
    mode[i] = static_cast<std::int8_t>(side);
    evaluate(mode, t, x);
    return direction_ * rates_[i];
  }

  // Sets the mode: the sign of each function that is not zero; at a zero the side to which the motion leads,
  // which may depend on the other functions.
  void begin(double t, const State& x) {
    if (!solution_.status.ok()) return;
    std::fill(mode_.begin(), mode_.end(), std::int8_t{1});
    std::vector<bool> zero(mode_.size());
    for (std::size_t i = 0; i < mode_.size(); ++i) {
      evaluate(mode_, t, x);
      if (std::isnan(values_[i])) return undefined(i, t);
      zero[i] = values_[i] == 0;
      if (values_[i] < 0) mode_[i] = -1;
    }
    Mode last;
    for (std::size_t k = 0; k <= mode_.size() && mode_ != last; ++k) {
      last = mode_;
      for (std::size_t i = 0; i < mode_.size(); ++i) {
        if (zero[i]) choose(i, t, x);
      }
    }
    for (std::size_t i = 0; i < mode_.size(); ++i) {
      if (zero[i] && mode_[i] != 0) prefer_smooth(i, t, x);
    }
    if (solution_.status.ok()) hold(t, x);
  }
  // Selects the side with finite derivatives if no side leads away, as in an empty tank, h' = -sqrt(max(h,
  // 0)).
  void prefer_smooth(std::size_t i, double t, const State& x) {
    if (rate(i, 1, t, x) != 0 || rate(i, -1, t, x) != 0 || is_smooth(t, x)) return;
    mode_[i] = static_cast<std::int8_t>(-mode_[i]);
    if (!is_smooth(t, x)) mode_[i] = static_cast<std::int8_t>(-mode_[i]);
  }
  // Are the derivatives close to the state finite?
  bool is_smooth(double t, const State& x) {
    constexpr double beside = 1e-30, steep = 1e12;
    Jacobian j(x.size(), x.size());
    in(mode_).jacobian(segment_(t), (x.array() + beside).matrix(), j);
    return j.allFinite() && j.cwiseAbs().maxCoeff() < steep;
  }

  // [choose]
  // Sets the mode of a function at its zero: the side to which the motion leads; 0 if both sides lead to the
  // surface.
  void choose(std::size_t i, double t, const State& x) {
    const double above = rate(i, 1, t, x), below = rate(i, -1, t, x);
    if (above > 0 && below < 0 && direction_ < 0) {
      no_past(i, t);
    } else if (above > 0 || below < 0) {
      mode_[i] = above > 0 ? 1 : -1;
    } else if (above < 0 || below > 0) {
      mode_[i] = 0;
    }
  }
  // [choose]
  // Checks that there is a motion on the surfaces of this mode.
  void hold(double t, const State& x) {
    evaluate(mode_, t, x);
    for (std::size_t i = 0; i < mode_.size(); ++i) {
      if (mode_[i] != 0) continue;
      if (direction_ < 0) return no_past(i, t);
      if (std::isnan(values_[i]))
        return fail(Outcome::outside_validity, t,
                    "the equations do not define the sliding motion on the surface of switching function {}",
                    i + 1);
    }
  }
  void no_past(std::size_t i, double t) {
    fail(Outcome::outside_validity, t,
         "a sliding motion on the surface of switching function {} cannot be integrated backwards; integrate "
         "forwards",
         i + 1);
  }
  void undefined(std::size_t i, double t) {
    fail(Outcome::non_finite, t, "switching function {} is not a number; the equations end here", i + 1);
  }
  template <class... Args>
  void fail(Outcome outcome, double t, fmt::format_string<Args...> sentence, Args&&... args) {
    solution_.status = failed_with(outcome, "switching at t = {:.17g}: {}", t,
                                   fmt::format(sentence, std::forward<Args>(args)...));
  }

  // Margin of function i from values_ and rates_.
  [[nodiscard]] Margin margin(std::size_t i) const {
    const double value = values_[i], side = mode_[i];
    if (mode_[i] == 0) return {std::min(value, 1 - value), 0};
    return {side * value, side * direction_ * rates_[i]};
  }
  Margin margin(std::size_t i, double t, const State& x) {
    evaluate(mode_, t, x);
    return margin(i);
  }
  void margins(double t, const State& x, std::vector<Margin>& all) {
    evaluate(mode_, t, x);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = margin(i);
  }

  void segment() {
    if (used() >= limits_.steps)
      return fail(Outcome::step_limit, solution_.t, "{} steps are used up", limits_.steps);
    if (watch_.seconds() > limits_.seconds)
      return fail(Outcome::time_limit, solution_.t, "{} s are used up", limits_.seconds);
    const System smooth = in(mode_);  // a copy: in() may clear the cache
    found_.reset();
    armed_.assign(mode_.size(), false);
    is_reported_ = false;
    const Observer look_out = [this, &smooth](const Step& step) { return seen(smooth, step); };
    const double begin = solution_.t;
    Solution part = run_(smooth, solution_.x, begin, stretch_end_, look_out, left());
    solution_.statistics += part.statistics;
    if (found_ && !is_reported_) {
      solution_.t = found_->t;
      solution_.x = found_->x;
      repeated_ = std::abs(found_->t - begin) <= at_once * std::abs(end_ - first_) ? repeated_ + 1 : 0;
      if (repeated_ > most_repeated)
        fail(Outcome::outside_validity, begin, "switches accumulate; smooth the equation there");
      else
        change(*found_);
      return;
    }
    solution_.t = part.t;
    solution_.x = part.x;
    if (solution_.status.ok()) solution_.status = part.status;
  }
  // The remaining limits.
  [[nodiscard]] Limits left() const {
    return {std::max<std::int64_t>(limits_.steps - used(), 1),
            std::max(limits_.seconds - watch_.seconds(), 1e-6), limits_.largest_step};
  }
  [[nodiscard]] std::int64_t used() const {
    return solution_.statistics.steps + solution_.statistics.rejected;
  }
  void change(const Switch& at) {
    const std::int8_t before = mode_[at.surface];
    if (before == 0) {
      mode_[at.surface] = rate(at.surface, 1, at.t, at.x) > 0 ? 1 : -1;
    } else {
      // choose() decides by the rates; if they do not decide, the motion crosses to the other side.
      mode_[at.surface] = static_cast<std::int8_t>(-before);
      choose(at.surface, at.t, at.x);
    }
    if (solution_.status.ok()) hold(at.t, at.x);
  }

  // Searches a step of the method: the first switch in it ends the segment.
  bool seen(const System& smooth, const Step& step) {
    double from = step.t0;
    margins(from, step.x0, before_);
    while (from != step.t1) {
      const double to = next_place(step, from);
      for (std::size_t i = 0; i < mode_.size(); ++i) {
        if (after_[i].value > 0) armed_[i] = true;
        const double beyond = after_[i].value < 0 ? to : dip(step, i, from, to);
        if (beyond != from && (!found_ || earlier(first_zero(step, i, from, beyond), found_->t)))
          found(smooth, step, i, from, beyond);
      }
      if (found_) return cut(step);
      for (std::size_t i = 0; i < mode_.size(); ++i) {
        if (std::isnan(after_[i].value)) undefined(i, to);
      }
      if (!solution_.status.ok()) return false;
      from = to;
      std::swap(before_, after_);
    }
    return !observer_ || observer_(step) || stop();
  }
  // Next evaluation point of the functions after @p from; sets after_ to their margins there. A step may be
  // long compared with the changes of a function: for a motion at constant speed its size is unbounded. So
  // parts of the step are halved until the values and rates at both ends predict the functions between them.
  // The next part is at most twice as long, also in the next step.
  double next_place(const Step& step, double from) {
    const double whole = std::abs(step.t1 - step.t0) / places, least = whole * 0x1p-30;
    for (double part = std::min(part_, whole);; part /= 2) {
      const double after = from + direction_ * part,
                   to = earlier(after, step.t1 - direction_ * part / 16) ? after : step.t1;
      margins(to, step.at(to), after_);
      if (part > least && to != from && !is_resolved(step, from, to)) continue;
      part_ = 2 * part;
      return to == from ? step.t1 : to;
    }
  }
  // Do the functions agree with the cubics through their values and rates at both ends, at three points
  // between whose fractions are irrational against aliasing?
  bool is_resolved(const Step& step, double from, double to) {
    constexpr double part_of_size = 0.01, noise = 1e-12;
    const double h = std::abs(to - from);
    for (const double s : {0.3819660112501051, 0.1458980337503154, 0.7639320225002103}) {
      const double r = 1 - s, t = from + s * (to - from);
      evaluate(mode_, t, step.at(t));
      for (std::size_t i = 0; i < mode_.size(); ++i) {
        if (mode_[i] == 0) continue;  // the share of a motion on the surface has no rate
        const Margin &a = before_[i], &b = after_[i];
        const double cubic = r * r * ((1 + 2 * s) * a.value + s * h * a.slope) +
                             s * s * ((1 + 2 * r) * b.value - r * h * b.slope);
        const double here = margin(i).value,
                     size = std::max({std::abs(a.value), std::abs(b.value), std::abs(here)});
        greatest_[i] = std::max(greatest_[i], size);
        if (std::abs(here - cubic) > part_of_size * size + noise * greatest_[i]) return false;
      }
    }
    return true;
  }
  // A time between two points at which a function is negative although it is positive at both; @p from if
  // there is none.
  double dip(const Step& step, std::size_t i, double from, double to) {
    if (!(before_[i].slope < 0 && after_[i].slope > 0 && before_[i].value > 0)) return from;
    constexpr int halvings = 26;  // minimum to a relative 2^-52: the square of 2^-26
    double low = from, high = to;
    for (int k = 0; k < halvings; ++k) {
      const double middle = low + (high - low) / 2;
      const Margin there = margin(i, middle, step.at(middle));
      if (there.value < 0) return middle;
      (there.slope < 0 ? low : high) = middle;
    }
    return from;
  }
  bool stop() {
    is_reported_ = true;
    return false;
  }
  [[nodiscard]] bool earlier(double a, double b) const { return direction_ * (a - b) < 0; }

  // The first double at which the mode is not valid, by the dense output. For a function that has not been
  // positive in this segment, the search halves the distance to the start.
  double first_zero(const Step& step, std::size_t i, double from, double to) {
    while (!armed_[i]) {
      const double after = from + (to - from) / 2;
      if (after == from || after == to) return step.t0;
      const bool positive = margin(i, after, step.at(after)).value > 0;
      (positive ? from : to) = after;
      if (positive) break;
    }
    for (;;) {
      const double middle = from + (to - from) / 2;
      if (middle == from || middle == to) return to;
      (margin(i, middle, step.at(middle)).value < 0 ? to : from) = middle;
    }
  }

  void found(const System& smooth, const Step& step, std::size_t i, double from, double to) {
    double t = first_zero(step, i, from, to);
    State x = t == step.t0 ? step.x0 : step.at(t);
    if (t != step.t0) refine(smooth, step, i, t, x);
    found_ = Switch{i, t, x};
  }
  // Refines a switch by integrating from the start of the step: Newton's iteration for the time, and the
  // state.
  void refine(const System& smooth, const Step& step, std::size_t i, double& t, State& x) {
    constexpr int most = 4;
    for (int k = 1;; ++k) {
      const Solution there = run_(smooth, step.x0, step.t0, t, {}, left());
      solution_.statistics += there.statistics;
      if (!there.status.ok()) return;
      x = there.x;
      if (mode_[i] == 0 || k == most) return;
      smooth.surfaces(segment_(t), x, values_, rates_);
      const double change = -values_[i] / rates_[i], next = t + change;
      const bool inside = earlier(step.t0, next) && !earlier(step.t1, next);
      if (!inside || std::abs(change) <= 4 * std::numeric_limits<double>::epsilon() * std::abs(t)) return;
      t = next;
    }
  }
  // Passes the part of the step before the switch to the observer.
  bool cut(const Step& step) {
    if (!observer_ || found_->t == step.t0) return false;
    Nodes states(step.x0.size(), 1);
    states.col(0) = found_->x;
    const double end = found_->t;
    if (!observer_({step.index, step.t0, end, step.x0, found_->x, {&end, 1}, states, step.dense}))
      is_reported_ = true;
    return false;
  }

  const System& system_;
  const SmoothRun& run_;
  const Observer& observer_;
  const Limits& limits_;
  int direction_;
  double first_, end_;
  double stretch_end_ = end_;  // next discontinuity, or the end
  SmoothSegment segment_;      // up to stretch_end_
  Mode mode_;
  std::map<Mode, System> systems_;
  std::vector<double> values_, rates_;
  std::vector<double> greatest_;  // largest magnitude of each function so far
  std::vector<Margin> before_, after_;
  std::vector<bool> armed_;
  std::optional<Switch> found_;
  double part_ = std::numeric_limits<double>::infinity();  // limit on the part between two evaluations
  bool is_reported_ = false;
  int repeated_ = 0;
  Solution solution_;
  Stopwatch watch_;
};

}  // namespace

Solution integrate_switching(const System& system, const State& x0, double t0, double t1,
                             const SmoothRun& run, const Observer& observer, const Limits& limits) {
  return Walk(system, t0, t1, run, observer, limits).from(t0, x0);
}

Mode mode_at(const System& system, double t, const State& x, const State& errors) {
  const auto count = static_cast<std::size_t>(system.switches());
  std::vector<double> values(count), moved(count), rates(count), spread(count);
  Mode mode(count, 1);
  const System any = system.in_mode(mode);
  any.surfaces(t, x, values, rates);
  State beside = x;
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    beside[j] = x[j] + errors[j];
    any.surfaces(t, beside, moved, rates);
    for (std::size_t i = 0; i < count; ++i) spread[i] += std::abs(moved[i] - values[i]);
    beside[j] = x[j];
  }
  for (std::size_t i = 0; i < count; ++i) mode[i] = values[i] < 0 ? -1 : 1;
  const auto rate = [&](std::size_t i, std::int8_t side) {
    Mode on = mode;
    on[i] = side;
    system.in_mode(on).surfaces(t, x, moved, rates);
    return rates[i];
  };
  // Whether both sides of a surface lead to it depends on the other surfaces.
  Mode last;
  for (std::size_t k = 0; k <= count && mode != last; ++k) {
    last = mode;
    for (std::size_t i = 0; i < count; ++i) {
      if (!(std::abs(values[i]) <= spread[i])) continue;
      const bool stays = rate(i, 1) < 0 && rate(i, -1) > 0;
      mode[i] = static_cast<std::int8_t>(stays ? 0 : values[i] < 0 ? -1 : 1);
    }
  }
  return mode;
}

}  // namespace nlmech::ivp

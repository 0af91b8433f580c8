#include "nlmech/ivp/switching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "nlmech/ivp/smooth_segment.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::ivp {
namespace {

using program::stays_on_surface;

constexpr double greatest_rounded = 1e9;  // the cell must be an int

/// The cell of a function; the upper side on a surface.
int cell_of(bool rounded, double value) {
  if (!rounded) return value < 0 ? -1 : 1;
  return std::abs(value) <= greatest_rounded ? 2 * static_cast<int>(std::floor(value)) + 1 : 1;
}

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
        layout_(system.layout()),
        mode_(static_cast<std::size_t>(system.switches()), 1),
        values_(mode_.size()),
        rates_(mode_.size()),
        greatest_(mode_.size()),
        before_(mode_.size()),
        after_(mode_.size()) {
    for (int i = 0; i < system.switches(); ++i) rounded_.push_back(system.is_rounded(i));
  }

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
      if (solution_.status.ok() && layout_.columns > 0) cross_at_end();
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
  // Rate of function i in the direction of integration, with the equations of a cell beside its surface.
  double rate(std::size_t i, int cell, double t, const State& x) {
    evaluate(beside(i, cell, t, x), t, x);
    return direction_ * rates_[i];
  }
  // The mode in a cell of function i: functions that jump with it, as mod(x, 1) - 0.5 with floor(x), have the
  // cells of their new values.
  Mode beside(std::size_t i, int cell, double t, const State& x) {
    Mode mode = mode_;
    evaluate(mode, t, x);
    std::vector<double> before = values_;
    mode[i] = cell;
    for (std::size_t k = 0; k < mode.size(); ++k) {
      evaluate(mode, t, x);
      const Mode last = mode;
      for (std::size_t j = 0; j < mode.size(); ++j) {
        if (j == i || stays_on_surface(mode[j]) || !is_jump(j, before[j], values_[j])) continue;
        mode[j] = cell_of(rounded_[j], values_[j]);
        before[j] = values_[j];
      }
      if (mode == last) break;
    }
    return mode;
  }
  // Do two values of function j at one point differ by more than errors of the state do?
  [[nodiscard]] bool is_jump(std::size_t j, double before, double after) const {
    constexpr double relative = 1e-6;
    return greatest_[j] > 0 &&
           std::abs(after - before) > relative * std::max({greatest_[j], std::abs(before), std::abs(after)});
  }

  // Sets the mode: the cell of each function; on a surface the side to which the motion leads, which may
  // depend on the other functions.
  void begin(double t, const State& x) {
    if (!solution_.status.ok()) return;
    const Cells cells = cells_at(system_, segment_(t), x);
    mode_ = cells.mode;
    std::vector<int> surface(mode_.size(), off_surfaces);
    for (std::size_t i = 0; i < mode_.size(); ++i) {
      if (std::isnan(cells.values[i])) return undefined(i, t);
      if (rounded_[i] && std::abs(cells.values[i]) > greatest_rounded) return too_great(i, t);
      if (is_on_surface(rounded_[i], cells.values[i])) surface[i] = mode_[i] - 1;
    }
    Mode last;
    for (std::size_t k = 0; k <= mode_.size() && mode_ != last; ++k) {
      last = mode_;
      for (std::size_t i = 0; i < mode_.size(); ++i) {
        if (surface[i] != off_surfaces) choose_at_start(i, surface[i], t, x);
      }
    }
    for (std::size_t i = 0; i < mode_.size(); ++i) {
      if (surface[i] == 0 && !rounded_[i] && mode_[i] != 0) prefer_smooth(i, t, x);
    }
    if (solution_.status.ok()) hold(t, x);
  }
  // At an integer floor has the value of the upper side, which is taken unless it leads away.
  void choose_at_start(std::size_t i, int surface, double t, const State& x) {
    const bool is_upper = rounded_[i] && rate(i, surface + 1, t, x) >= 0;
    mode_[i] = is_upper ? surface + 1 : chosen(i, surface, mode_[i], t, x);
  }
  // Selects the side with finite derivatives if no side leads away, as in an empty tank, h' = -sqrt(max(h,
  // 0)).
  void prefer_smooth(std::size_t i, double t, const State& x) {
    if (rate(i, 1, t, x) != 0 || rate(i, -1, t, x) != 0 || is_smooth(t, x)) return;
    mode_[i] = -mode_[i];
    if (!is_smooth(t, x)) mode_[i] = -mode_[i];
  }
  // Are the derivatives close to the state finite?
  bool is_smooth(double t, const State& x) {
    constexpr double beside = 1e-30, steep = 1e12;
    Jacobian j(x.size(), x.size());
    in(mode_).jacobian(segment_(t), (x.array() + beside).matrix(), j);
    return j.allFinite() && j.cwiseAbs().maxCoeff() < steep;
  }

  // [choose]
  // The cell of a function on a surface: the side to which the motion leads, or the surface if both sides
  // lead to it; @p undecided if the rates do not decide.
  int chosen(std::size_t i, int surface, int undecided, double t, const State& x) {
    const double above = rate(i, surface + 1, t, x), below = rate(i, surface - 1, t, x);
    if (above > 0 && below < 0 && direction_ < 0) {
      no_past(i, t);
    } else if (above > 0 || below < 0) {
      return surface + (above > 0 ? 1 : -1);
    } else if (above < 0 || below > 0) {
      return surface;
    }
    return undecided;
  }
  // [choose]
  // Checks that there is a motion on the surfaces of this mode.
  void hold(double t, const State& x) {
    evaluate(mode_, t, x);
    for (std::size_t i = 0; i < mode_.size(); ++i) {
      if (!stays_on_surface(mode_[i])) continue;
      if (direction_ < 0) return no_past(i, t);
      if (layout_.columns > 0)
        return fail(Outcome::outside_validity, t,
                    "sensitivities do not continue where the solution stays on the surface of switching "
                    "function {}; end before, or smooth the equation there",
                    i + 1);
      const bool is_open = std::isnan(values_[i]);
      if (is_open && rate(i, mode_[i] + 1, t, x) == 0 && rate(i, mode_[i] - 1, t, x) == 0) {
        ++mode_[i];  // both sides rest there, as those of sqrt(abs(x)) sign(x) do: each share is as good
        return hold(t, x);
      }
      if (is_open)
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
  void too_great(std::size_t i, double t) {
    fail(Outcome::outside_validity, t,
         "the argument of floor, ceil, frac or mod of switching function {} is beyond {:.0e} periods; scale "
         "it",
         i + 1, greatest_rounded);
  }
  template <class... Args>
  void fail(Outcome outcome, double t, fmt::format_string<Args...> sentence, Args&&... args) {
    solution_.status = failed_with(outcome, "switching at t = {:.17g}: {}", t,
                                   fmt::format(sentence, std::forward<Args>(args)...));
  }

  // Margin of function i from values_ and rates_.
  [[nodiscard]] Margin margin(std::size_t i) const {
    const double value = values_[i];
    if (stays_on_surface(mode_[i])) return {std::min(value, 1 - value), 0};
    if (!rounded_[i]) return {mode_[i] * value, mode_[i] * direction_ * rates_[i]};
    const auto [below, above] = distances(i);
    return {below * above, (above - below) * direction_ * rates_[i]};
  }
  // Distances of a rounded function from the integers that bound its cell.
  struct Distances {
    double below, above;
  };
  [[nodiscard]] Distances distances(std::size_t i) const {
    const int below = (mode_[i] - 1) / 2;
    const double n = below;
    return {values_[i] - n, n + 1 - values_[i]};
  }
  // The surface that is nearest to the value of function i: zero, or an end of its cell.
  [[nodiscard]] int surface_of(std::size_t i) const {
    if (!rounded_[i]) return 0;
    const auto [below, above] = distances(i);
    return below < above ? mode_[i] - 1 : mode_[i] + 1;
  }
  // Distance of function i from that surface.
  [[nodiscard]] double to_surface(std::size_t i) const {
    if (!rounded_[i]) return values_[i];
    const auto [below, above] = distances(i);
    return below < above ? below : -above;
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
        change(*found_, found_->t == begin);
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
  // @param at_start does the present mode end where it begins?
  void change(const Switch& at, bool at_start) {
    const std::size_t i = at.surface;
    const int before = mode_[i];
    const Mode mode_before = mode_;
    if (stays_on_surface(before)) {
      mode_ = beside(i, before + (rate(i, before + 1, at.t, at.x) > 0 ? 1 : -1), at.t, at.x);
    } else {
      evaluate(mode_, at.t, at.x);
      const int surface = surface_of(i);
      // Where the rates do not decide, or by rounding for the mode that ends at once, the motion crosses to
      // the other side.
      const int across = 2 * surface - before;
      int cell = chosen(i, surface, across, at.t, at.x);
      if (at_start && cell == before) cell = across;
      if (stays_on_surface(cell))
        mode_[i] = cell;
      else
        mode_ = beside(i, cell, at.t, at.x);
    }
    if (solution_.status.ok()) hold(at.t, at.x);
    if (solution_.status.ok() && layout_.columns > 0) saltate(mode_before, i, at);
  }
  // At the time of a switch the sensitivities are those after it, so that a run may be continued by another
  // one, which starts with the mode after it.
  void cross_at_end() {
    for (std::size_t i = 0; i < mode_.size() && solution_.status.ok(); ++i) {
      in(mode_).surfaces(solution_.t, solution_.x, values_, rates_);
      const Margin m = margin(i);
      if (m.value <= 0 && m.slope < 0) change({i, solution_.t, solution_.x}, false);
    }
  }
  // The jump of the sensitivities where f jumps by d at a zero of g, S+ = S + d (g_x S)/(g_t + g_x f): the
  // time of the switch depends on what S is the derivative by. (M. di Bernardo et al., Piecewise-smooth
  // Dynamical Systems, 2008, sec. 2.5.)
  void saltate(const Mode& before, std::size_t i, const Switch& at) {
    const double t = segment_(at.t);
    State f(at.x.size()), jump = f, direction = State::Zero(at.x.size());
    in(before).rhs(t, at.x, f);
    in(mode_).rhs(t, at.x, jump);
    jump -= f;
    evaluate(before, at.t, at.x);
    const double rate = rates_[i];
    for (int k = 1; k <= layout_.columns; ++k) {
      for (int j = 0; j < layout_.size; ++j) direction[layout_.place(j)] = at.x[layout_.place(j, k)];
      in(before).surfaces_along(t, at.x, direction, rates_);
      for (int j = 0; j < layout_.size; ++j) {
        const double d = jump[layout_.place(j)];
        if (d != 0) solution_.x[layout_.place(j, k)] += d * rates_[i] / rate;
      }
    }
    if (!solution_.x.allFinite())
      fail(Outcome::outside_validity, at.t,
           "the solution touches the surface of switching function {}, where sensitivities are not defined",
           i + 1);
  }

  // Searches a step of the method: the first switch in it ends the segment.
  bool seen(const System& smooth, const Step& step) {
    double from = step.t0;
    margins(from, step.x0, before_);
    while (from != step.t1) {
      const double to = next_place(step, from);
      for (std::size_t i = 0; i < mode_.size(); ++i) {
        if (after_[i].value > 0 || inside_[i]) armed_[i] = true;
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
      inside_.assign(mode_.size(), false);
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
        if (stays_on_surface(mode_[i])) continue;  // the share of a motion on the surface has no rate
        const Margin &a = before_[i], &b = after_[i];
        const double cubic = r * r * ((1 + 2 * s) * a.value + s * h * a.slope) +
                             s * s * ((1 + 2 * r) * b.value - r * h * b.slope);
        const double here = margin(i).value,
                     size = std::max({std::abs(a.value), std::abs(b.value), std::abs(here)});
        greatest_[i] = std::max(greatest_[i], size);
        if (here > 0) inside_[i] = true;
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
      if (stays_on_surface(mode_[i]) || k == most) return;
      smooth.surfaces(segment_(t), x, values_, rates_);
      const double change = -to_surface(i) / rates_[i], next = t + change;
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
  program::VariationalLayout layout_;
  double stretch_end_ = end_;             // next discontinuity, or the end
  SmoothSegment segment_;                 // up to stretch_end_
  static constexpr int off_surfaces = 1;  // surfaces are even
  Mode mode_;
  std::vector<bool> rounded_;  // does each function switch at every integer?
  std::map<Mode, System> systems_;
  std::vector<double> values_, rates_;
  std::vector<double> greatest_;  // largest magnitude of each function so far
  std::vector<Margin> before_, after_;
  std::vector<bool> armed_;   // has the margin been positive in this segment?
  std::vector<bool> inside_;  // is it positive within the part that was evaluated last?
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

Cells cells_at(const System& system, double t, const State& x) {
  const auto count = static_cast<std::size_t>(system.switches());
  Cells at{Mode(count, 1), std::vector<double>(count)};
  std::vector<double> rates(count);
  bool is_new = true;
  for (std::size_t i = 0; i < count; ++i) {
    if (is_new) system.in_mode(at.mode).surfaces(t, x, at.values, rates);
    const int cell = cell_of(system.is_rounded(static_cast<int>(i)), at.values[i]);
    is_new = cell != at.mode[i];
    at.mode[i] = cell;
  }
  return at;
}

bool is_on_surface(bool rounded, double value) { return rounded ? value == std::floor(value) : value == 0; }

Mode mode_at(const System& system, double t, const State& x, const State& errors) {
  Cells cells = cells_at(system, t, x);
  Mode& mode = cells.mode;
  const std::vector<double>& values = cells.values;
  const std::size_t count = mode.size();
  std::vector<double> moved(count), rates(count), spread(count);
  const System here = system.in_mode(mode);
  State beside = x;
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    beside[j] = x[j] + errors[j];
    here.surfaces(t, beside, moved, rates);
    for (std::size_t i = 0; i < count; ++i) spread[i] += std::abs(moved[i] - values[i]);
    beside[j] = x[j];
  }
  const auto rate = [&](std::size_t i, int cell) {
    Mode on = mode;
    on[i] = cell;
    system.in_mode(on).surfaces(t, x, moved, rates);
    return rates[i];
  };
  // Whether both sides of a surface lead to it depends on the other surfaces.
  Mode last;
  for (std::size_t k = 0; k <= count && mode != last; ++k) {
    last = mode;
    for (std::size_t i = 0; i < count; ++i) {
      const bool is_rounded = system.is_rounded(static_cast<int>(i));
      const double nearest = is_rounded ? std::round(values[i]) : 0;
      if (!(std::abs(values[i] - nearest) <= spread[i])) continue;
      const int surface = 2 * static_cast<int>(nearest);
      const bool stays = rate(i, surface + 1) < 0 && rate(i, surface - 1) > 0;
      mode[i] = stays ? surface : cell_of(is_rounded, values[i]);
    }
  }
  return std::move(mode);
}

}  // namespace nlmech::ivp

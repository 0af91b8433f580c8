#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "nlmech/ivp/domain.hpp"
#include "nlmech/ivp/near_zero.hpp"
#include "nlmech/ivp/singular_start.hpp"
#include "nlmech/support/doubles.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::ivp {
namespace {

using program::Interval;

constexpr double tolerances_of_a_run = 10;  // allowance for the accumulated errors of all steps

/// "1.52 +- 0.02": a time with the digits that its uncertainty leaves.
std::string with_digits(double t, double uncertainty) {
  const double size = std::pow(10, std::floor(std::log10(uncertainty)));
  if (!(uncertainty > 1e-9 * std::abs(t))) return fmt::format("{:.9g}", t);
  const int decimals = std::clamp(-static_cast<int>(std::log10(size)), 0, 17);
  return fmt::format("{:.{}f} +- {:.1g}", t, decimals, std::ceil(uncertainty / size) * size);
}

/// Are @p t and @p of equal to 8 roundings?
bool is_near(double t, double of) {
  return std::abs(t - of) <= 8 * eps * std::max(std::abs(t), std::abs(of));
}

/// Is a function of the time zero at @p t?
bool is_zero_at(const Event& g, double t, const State& x) {
  return std::abs(g.value(t, x)) <= 8 * eps * std::abs(t) * at_point(g.rate_bounds, t, x, {}).magnitude();
}

/// One integration that checks the domain of its equations.
class Guarded {
 public:
  Guarded(const SmoothRun& run, const Domain& domain, StateAccuracy accuracy, bool* rests,
          const System& system, double t0, double t1, const Observer& observer, const Limits& limits)
      : run_(run),
        domain_(domain),
        accuracy_(accuracy),
        has_rested_(rests),
        system_(system),
        t0_(t0),
        t1_(t1),
        direction_(t1 > t0 ? 1 : -1),
        observer_(observer),
        limits_(limits),
        boundaries_(domain.arguments.size()) {}

  Solution from(const State& x0) {
    all_ = {t0_, x0, {}, {}};
    x0_ = x0;
    if (t0_ == t1_ || !x0.allFinite()) return run_(system_, x0, t0_, t1_, observer_, limits_);
    begin();
    constexpr int most_parts = 10'000;
    for (int k = 0; all_.status.ok() && all_.t != t1_ && !is_stopped_; ++k) {
      if (k == most_parts)
        all_.status = failed_with(
            Outcome::outside_validity,
            "roots or powers reach the end of their domain infinitely often near t = {:.9g}", all_.t);
      else
        part();
    }
    if (!all_.status.ok()) name_end();
    all_.statistics.seconds = watch_.seconds();
    return all_;
  }

 private:
  // Handles a singular point or a zero argument at the start.
  void begin() {
    const auto is_singular = [this](const Event& g) { return is_zero_at(g, t0_, all_.x); };
    if (std::ranges::any_of(domain_.timed, is_singular)) return begin_series();
    for (std::size_t i = 0; i < domain_.arguments.size(); ++i) {
      const double value = domain_.arguments[i].value(all_.t, all_.x);
      const bool is_zero = value == 0 || (i < domain_.corners && value < 0 && value >= -margin_of(i));
      if (is_zero && direction_ * rate_at(domain_.beyond_arguments[i], all_.t, all_.x) <= 0) rest(i);
    }
  }
  void begin_series() {
    StatePolynomial series;
    all_.status = begin_at_singular_point(system_, all_.x, t0_, t1_, series);
    if (!all_.status.ok()) return;
    const double end = series.end();
    const State x = series.last();
    all_.t = end;
    ++all_.statistics.steps;
    Nodes states = x;
    const State x0 = all_.x;
    all_.x = x;
    if (observer_ && !observer_({1, t0_, end, x0, x, {&end, 1}, states, series})) interrupt();
  }
  void interrupt() {
    is_stopped_ = true;
    all_.status = failed_with(Outcome::interrupted, "the observer stopped the run at t = {:.17g}", all_.t);
  }

  [[nodiscard]] bool rests() const { return std::ranges::any_of(boundaries_, &Boundary::rests); }

  // Integrates to the next zero of an argument, or to the end of the rest at one.
  void part() {
    stop_.reset();
    finder_.emplace(watched(),
                    accuracy_);  // dense output: a run that ends at a singular point is inaccurate
    const System& system = rests() ? *domain_.beyond : system_;
    const Observer observer = domain_.watches() || !domain_.sums.empty()
                                  ? Observer([this, &system](const Step& step) { return see(system, step); })
                                  : observer_;
    Limits left = limits_;
    left.steps = std::max<std::int64_t>(limits_.steps - all_.statistics.steps - all_.statistics.rejected, 1);
    left.seconds = std::max(limits_.seconds - watch_.seconds(), 1e-6);
    const Solution part = run_(system, all_.x, all_.t, t1_, observer, left);
    all_.statistics += part.statistics;
    all_.t = stop_ ? stop_->t : part.t;
    all_.x = stop_ ? stop_->x : part.x;
    all_.status = part.status;
    if (!finder_->status().ok()) all_.status = finder_->status();
    if (is_stopped_) return;
    if (!stop_) return rest_at_failure();
    all_.status = stop_->status;
    if (!all_.status.ok()) return;
    const std::size_t i = stop_->event / 2;
    if (!boundaries_[i].rests)
      rest(i);
    else if (stop_->event % 2 == 0)
      boundaries_[i].rests = false;
    else
      leave(i);
  }
  // Trial steps beyond the zero of an argument are not finite, so the last accepted step may end before it.
  void rest_at_failure() {
    const Outcome outcome = all_.status.outcome();
    if (outcome != Outcome::non_finite && outcome != Outcome::step_underflow) return;
    for (std::size_t i = 0; i < domain_.arguments.size(); ++i) {
      if (boundaries_[i].rests || boundaries_[i].is_passed) continue;
      if (!(std::abs(domain_.arguments[i].value(all_.t, all_.x)) <= margin_of(i))) continue;
      const Status failed = all_.status;
      all_.status = {};
      rest(i);
      if (boundaries_[i].rests || !all_.status.ok()) return;
      all_.status = failed;
    }
  }
  // Two events for each argument: its zero, or its departure from a rest at zero to either side.
  [[nodiscard]] std::vector<Event> watched() const {
    std::vector<Event> events;
    const bool is_beyond = rests();
    for (std::size_t i = 0; i < boundaries_.size(); ++i) {
      const Boundary& at = boundaries_[i];
      if (at.rests) {
        events.push_back(shifted(i, -at.margin, Crossing::rising));
        events.push_back(shifted(i, at.margin, Crossing::falling));
        continue;
      }
      events.push_back(at.is_passed ? never()
                                    : (is_beyond ? domain_.beyond_arguments : domain_.arguments)[i]);
      events.back().ends = i < domain_.corners ? 1 : 0;  // see() ends at corners that are touched
      events.push_back(never());
    }
    events.insert(events.end(), domain_.crossings.begin(), domain_.crossings.end());
    events.insert(events.end(), domain_.timed.begin(), domain_.timed.end());
    events.insert(events.end(), domain_.timed_arguments.begin(), domain_.timed_arguments.end());
    return events;
  }
  static Event never() {
    Event event;
    event.value = [](double, const State&) { return 1.; };
    event.bounds = event.rate_bounds = [](const Interval&, std::span<const Interval>) { return Interval(1); };
    return event;
  }
  [[nodiscard]] Event shifted(std::size_t i, double by, Crossing crossing) const {
    const Event& g = domain_.beyond_arguments[i];
    Event event;
    event.value = [&g, by](double t, const State& x) { return g.value(t, x) + by; };
    event.bounds = [&g, by](const Interval& t, std::span<const Interval> x) { return g.bounds(t, x) + by; };
    event.rate_bounds = g.rate_bounds;
    event.slopes = g.slopes;
    event.crossing = crossing;
    event.ends = 1;
    return event;
  }
  // Bounds of g at (t, x) for accumulated errors of all steps.
  [[nodiscard]] Interval bounds_of(const Event& g, double t, const State& x) const {
    return at_point(g.bounds, t, x,
                    {tolerances_of_a_run * accuracy_.relative, tolerances_of_a_run * accuracy_.absolute});
  }
  // Error of an argument due to the errors of the states.
  [[nodiscard]] double margin_of(std::size_t i) const {
    const Interval there = bounds_of(domain_.arguments[i], all_.t, all_.x);
    const double size = at_point(domain_.arguments[i].bounds, t0_, all_.x, {1, 0}).magnitude();
    const double wide = std::isfinite(there.width()) ? there.width() : 0;
    return std::max(5 * wide, 1e-12 * (std::isfinite(size) ? size : 1)) + std::numeric_limits<double>::min();
  }
  // The time @p t of a zero of g at a state x close to it, as text: with the digits that the tolerances
  // leave, or three of a method without a tolerance.
  [[nodiscard]] std::string time_of_zero(const Event& g, double t, const State& x, double rate) const {
    return time_of_zero(t, bounds_of(g, t, x).width() / std::abs(rate));
  }
  // @param wide uncertainty of the time due to the errors of the state
  [[nodiscard]] std::string time_of_zero(double t, double wide) const {
    if (accuracy_.absolute == 0 && accuracy_.relative == 0) return fmt::format("{:.3g}", t);
    return with_digits(t, tolerances_of_a_run * accuracy_.relative * std::abs(t - t0_) +
                              (std::isfinite(wide) ? wide / 2 : 0));
  }

  // Continues with the equations `beyond` from the zero of argument i.
  void rest(std::size_t i) {
    const Event& g = domain_.arguments[i];
    const State at = moved_to(g, all_.t, all_.x, 0);
    for (Boundary& other : boundaries_) other.is_passed = false;
    Boundary& here = boundaries_[i];
    here = {.rests = true, .is_passed = false, .margin = margin_of(i), .from = all_.t};
    if (all_.t != t0_ && i >= domain_.corners && !is_near(all_.t, t1_) &&
        stays_or_leaves(g, all_.t, at, here.margin, direction_)) {
      here.rests = false;
      all_.status =
          failed_with(Outcome::outside_validity,
                      "the argument of a root becomes zero at t = {}: the solution beyond is not unique; "
                      "end the run before",
                      time_of_zero(g, all_.t, at, rate_beside(g, at)));
    } else if (all_.t != t0_ && !may_rest(i, at)) {
      here.rests = false;
      here.is_passed = true;
    } else {
      if (has_rested_ != nullptr) *has_rested_ = true;
      all_.x = at;
    }
  }
  // May a solution stay at the zero of argument i? Not where the equations lead away or are infinite.
  [[nodiscard]] bool may_rest(std::size_t i, const State& at) const {
    State f(at.size());
    domain_.beyond->rhs(all_.t, at, f);
    const bool is_steep =
        i < domain_.corners && repels(domain_.arguments[i], all_.t, at, boundaries_[i].margin, direction_);
    return f.allFinite() && !is_steep;
  }
  // The greater rate of g at a distance from its zero that the errors of the states make: at the zero it may
  // vanish.
  [[nodiscard]] double rate_beside(const Event& g, const State& at) const {
    const double near = bounds_of(g, all_.t, at).width() / 2;
    return std::max(std::abs(rate_at(g, all_.t, moved_to(g, all_.t, at, near))),
                    std::abs(rate_at(g, all_.t, moved_to(g, all_.t, at, -near))));
  }
  // The solution leaves the domain of argument i, unless the equations are defined there too: sqrt(max(h,
  // 0)).
  void leave(std::size_t i) {
    State f(all_.x.size());
    system_.rhs(all_.t, all_.x, f);
    boundaries_[i].rests = false;
    if (f.allFinite()) return;
    const Boundary& here = boundaries_[i];
    const Event& g = domain_.beyond_arguments[i];
    const double rate = std::abs(rate_at(g, all_.t, all_.x)), since = std::abs(all_.t - here.from);
    const double back = rate > 0 ? std::min(since, 2 * here.margin / rate) : 0;
    all_.status = end_of_argument(time_of_zero(g, all_.t - direction_ * back, all_.x, rate));
  }

  bool see(const System& system, const Step& step) {
    for (std::size_t k = 0; k < domain_.sums.size(); ++k) {
      const Event& g = domain_.ends[domain_.sums[k]];
      if (passes_zero(system, g, step)) return false;
      add_fall(falls_[k], step.t1, g.value(step.t1, step.x1));
    }
    const std::size_t known = finder_->hits().size();
    const bool continues = finder_->see(system, step, limits_);
    for (std::size_t k = known; k < finder_->hits().size(); ++k) {
      const Hit& hit = finder_->hits()[k];
      const bool is_denominator = hit.event >= 2 * boundaries_.size();
      if (is_touched_corner(hit)) {
        stop_at(hit.t, hit.x, hit.event, step);
        return false;
      }
      const bool is_inside = !is_near(hit.t, t0_) && !is_near(hit.t, t1_);
      const bool is_end = is_denominator && (is_timed_argument(hit) ? leaves_domain(system, hit, step)
                                                                    : is_singular(system, hit.t, step));
      if (is_inside && is_end) return end_at(hit, step);
    }
    if (continues) return !observer_ || observer_(step) || stop_by_observer();
    if (finder_->ended()) {
      const Hit hit = finder_->hits().back();
      stop_at(hit.t, hit.x, hit.event, step);
    }
    return false;
  }
  // Times at which a function has fallen to half of its value before, since it was greater last.
  using Falls = std::vector<std::pair<double, double>>;
  static void add_fall(Falls& falls, double t, double value) {
    while (!falls.empty() && falls.back().second <= value) falls.pop_back();
    if (falls.empty() || value < falls.back().second / 2) falls.emplace_back(t, value);
  }
  // Does the step pass through a singular zero of a sum of squares? Accurate steps are not much longer than
  // the distance from it: one in which g falls to a millionth of its values at both ends passes the zero, and
  // so does one that leads to it and ends far away.
  bool passes_zero(const System& system, const Event& g, const Step& step) {
    const double before = g.value(step.t0, step.x0), after = g.value(step.t1, step.x1);
    const double span = step.t1 - step.t0;
    if (after > 25 * before && -rate_at(g, step.t0, step.x0) * span > before && is_thrown(system, step)) {
      is_infinite_ = true;
      return end_in_step(step.t0, step.x0, step);
    }
    const double half = g.value(step.t0 + span / 2, (step.x0 + step.x1) / 2);
    const double bend = 2 * (before + after - 2 * half), slope = 4 * half - 3 * before - after;
    const double least = before - slope * slope / (4 * bend), ends = std::min(before, after);
    if (!(slope < 0 && slope + 2 * bend > 0 && least < ends / 10)) return false;
    State x = step.x0;
    const double t = step.t0 + span * nearest(g, step, x);
    if (!(g.value(t, x) <= 1e-6 * ends)) return false;
    return (is_singular(system, t, step) || turns_round(system, t, step)) && end_in_step(t, x, step);
  }
  // Does a step end much farther away than its first slope leads?
  static bool is_thrown(const System& system, const Step& step) {
    State f(step.x0.size());
    system.rhs(step.t0, step.x0, f);
    return !((step.x1 - step.x0).norm() <= 4 * std::abs(step.t1 - step.t0) * f.norm());
  }
  // Do the slopes on both sides of a zero differ, as those of x' = -x/sqrt(x^2 + y^2), so that it has none
  // there?
  bool turns_round(const System& system, double zero, const Step& step) {
    State x = step.x0, before(x.size()), after(x.size());
    step.dense.at(zero + 1e-2 * (step.t0 - zero), x);
    system.rhs(zero, x, before);
    step.dense.at(zero + 1e-2 * (step.t1 - zero), x);
    system.rhs(zero, x, after);
    is_infinite_ = (after - before).norm() > (after.norm() + before.norm()) / 2;
    return is_infinite_;
  }
  // The share of the step at which g has its minimum, by golden section, and the state there.
  static double nearest(const Event& g, const Step& step, State& x) {
    const auto value = [&](double share) {
      const double t = step.t0 + share * (step.t1 - step.t0);
      step.dense.at(t, x);
      return g.value(t, x);
    };
    double low = 0, high = 1;
    constexpr int most = 80;
    constexpr double part = 0.381966011250105;
    for (int k = 0; k < most; ++k) {
      const double a = low + part * (high - low), b = high - part * (high - low);
      const bool is_left = value(a) <= value(b);
      (is_left ? high : low) = is_left ? b : a;
    }
    static_cast<void>(value(low));
    return low;
  }
  // Ends the run within a step at the zero of a denominator.
  bool end_in_step(double t, const State& x, const Step& step) {
    const bool has_tolerance = accuracy_.absolute + accuracy_.relative > 0;
    stop_at(t, x, 0, step);
    stop_->status = zero_of_denominator(has_tolerance ? with_digits(t, std::abs(step.t1 - step.t0))
                                                      : fmt::format("{:.3g}", t));
    return true;
  }
  // Is it the zero of max(g, 0) or abs(g) under a root, at which g does not change? A method passes others.
  [[nodiscard]] bool is_touched_corner(const Hit& hit) const {
    const std::size_t i = hit.event / 2;
    if (i < domain_.corners || i >= boundaries_.size() || boundaries_[i].rests) return false;
    return rate_at(domain_.arguments[i], hit.t, moved_to(domain_.arguments[i], hit.t, hit.x, 0)) == 0;
  }
  // Ends the run at the zero of a denominator.
  bool end_at(const Hit& hit, const Step& step) {
    const std::size_t i = hit.event - 2 * boundaries_.size();
    std::string time = fmt::format("{:.9g}", hit.t);
    if (i < domain_.crossings.size()) {
      const Event& g = domain_.crossings[i];
      const double rate = (g.value(step.t1, step.x1) - g.value(step.t0, step.x0)) / (step.t1 - step.t0);
      time = time_of_zero(g, hit.t, hit.x, rate);
    }
    stop_at(hit.t, hit.x, 0, step);
    stop_->status = is_timed_argument(hit) ? end_of_argument(time) : zero_of_denominator(time);
    return false;
  }
  [[nodiscard]] bool is_timed_argument(const Hit& hit) const {
    return hit.event >= 2 * boundaries_.size() + domain_.crossings.size() + domain_.timed.size();
  }
  // Are the equations not defined beyond the zero of an argument?
  static bool leaves_domain(const System& system, const Hit& hit, const Step& step) {
    State f(hit.x.size());
    system.rhs(hit.t + 1e-6 * (step.t1 - step.t0), hit.x, f);
    return !f.allFinite();
  }
  static Status end_of_argument(const std::string& time) {
    return failed_with(Outcome::outside_validity,
                       "the argument of a square root, a power with a fraction, an arc or a logarithm leaves "
                       "its domain at t = {}, and the equations do not define the solution beyond; end the "
                       "run before",
                       time);
  }
  [[nodiscard]] Status zero_of_denominator(const std::string& time) const {
    return failed_with(Outcome::outside_validity,
                       "a denominator of the equations becomes zero at t = {}: {}; end the run before", time,
                       is_infinite_ ? "the solution ends there" : "the solution beyond is not unique");
  }
  bool stop_by_observer() {
    is_stopped_ = true;
    return false;
  }
  // Passes the part of the step up to t to the observer.
  void stop_at(double t, const State& x, std::size_t event, const Step& step) {
    stop_ = Stop{event, t, x, {}};
    if (!observer_ || t == step.t0) return;
    const Nodes states = x;
    if (!observer_({step.index, step.t0, t, step.x0, stop_->x, {&t, 1}, states, step.dense}))
      stop_by_observer();
  }

  // Is the solution infinite or not unique at @p zero, where f or its derivatives are infinite?
  bool is_singular(const System& system, double zero, const Step& step) {
    const double before = zero - step.t0, after = step.t1 - zero,
                 room = std::abs(before) > std::abs(after) ? -before : after;
    double sizes[2];
    State x = step.x1, f(x.size());
    Eigen::MatrixXd j(x.size(), x.size());
    constexpr double distances[] = {1e-2, 1e-4};
    for (int k = 0; k < 2; ++k) {
      const double t = zero + distances[k] * room;
      step.dense.at(t, x);
      // Dense output with further stages may evaluate one of them at the zero.
      if (!x.allFinite()) x = step.x0 + (t - step.t0) / (step.t1 - step.t0) * (step.x1 - step.x0);
      system.rhs(t, x, f);
      system.jacobian(t, x, j);
      j *= t - zero;
      sizes[k] = f.norm();
    }
    if (!j.allFinite() || !std::isfinite(sizes[1])) return false;
    is_infinite_ = sizes[1] > 30 * sizes[0];
    return is_infinite_ || j.eigenvalues().real().maxCoeff() > 1e-2;
  }

  // The time of the zero of g beside which the run has failed; none if it has failed elsewhere.
  [[nodiscard]] std::optional<double> zero_beside(const Event& g) const {
    const double value = g.value(all_.t, all_.x), start = g.value(t0_, x0_);
    const double away = value / rate_at(g, all_.t, all_.x);  // NaN beyond the zero of a logarithm
    const bool is_at_zero = std::abs(away) <= 1e-6 * std::abs(all_.t - t0_);
    if (start == 0) return is_at_zero && !is_near(all_.t, t0_) ? std::optional(all_.t - away) : std::nullopt;
    if (!(std::abs(value) < 1e-3 * std::abs(start))) return {};  // a solution that grows without end
    if (is_at_zero) return all_.t - away;
    const bool is_beyond = value * start <= 0 && std::abs(value) < 1e-6 * std::abs(start);
    return is_beyond ? std::optional(all_.t) : std::nullopt;
  }
  // The time at the end of the run in which a sum has been within the errors of the states.
  [[nodiscard]] double time_within_errors(std::size_t sum) const {
    const double wide = bounds_of(domain_.ends[domain_.sums[sum]], all_.t, all_.x).width();
    double since = t0_;
    for (const auto& [t, value] : falls_[sum]) {
      if (value > wide) since = t;
    }
    return 2 * std::abs(all_.t - since);
  }
  // ", x = 0, y = 0": the components that the function has which becomes zero there.
  [[nodiscard]] std::string place_of_end(std::size_t i) const {
    std::string place;
    for (const int k : domain_.components[i]) {
      const double x = all_.x[k], error = tolerances_of_a_run * accuracy_.absolute;
      place += fmt::format(", {} = {:.6g}", domain_.names[static_cast<std::size_t>(k)],
                           std::abs(x) <= std::max(error, 1e-6 * std::abs(x0_[k])) ? 0 : x);
    }
    return place;
  }
  // A run that fails close to the zero of a denominator, or of the argument of a logarithm, ends there.
  void name_end() {
    const Outcome outcome = all_.status.outcome();
    if (outcome != Outcome::step_underflow && outcome != Outcome::non_finite) return;
    if (outcome == Outcome::non_finite && all_.t == t0_) return name_start();
    for (std::size_t i = 0; i < domain_.corners; ++i) {
      const Event& g = domain_.arguments[i];
      if (const std::optional<double> t = zero_beside(g); t && !boundaries_[i].rests)
        all_.status = end_of_argument(time_of_zero(g, *t, all_.x, rate_at(g, all_.t, all_.x)));
    }
    for (const Event& g : domain_.timed_arguments) {
      if (const std::optional<double> t = zero_beside(g))
        all_.status = end_of_argument(fmt::format("{:.9g}", *t));
    }
    std::string time;
    for (const Event& g : domain_.timed) {
      if (const std::optional<double> t = zero_beside(g)) time = fmt::format("{:.9g}", *t);
    }
    for (std::size_t i = 0; i < domain_.ends.size(); ++i) {
      const Event& g = domain_.ends[i];
      const std::optional<double> t = zero_beside(g);
      if (!t) continue;
      const auto sum = static_cast<std::size_t>(std::ranges::find(domain_.sums, i) - domain_.sums.begin());
      const bool is_sum = sum < domain_.sums.size();
      time = (is_sum ? time_of_zero(*t, time_within_errors(sum))
                     : time_of_zero(g, *t, all_.x, rate_at(g, all_.t, all_.x))) +
             place_of_end(i);
    }
    if (time.empty()) return;
    all_.status = failed_with(
        Outcome::outside_validity,
        "a denominator of the equations, or the argument of a logarithm, becomes zero at t = {}, where the "
        "solution ends; end the run before",
        time);
  }

  // A run whose equations are not defined at the start.
  void name_start() {
    State f = State::Zero(x0_.size());
    system_.rhs(t0_, x0_, f);
    if (f.allFinite()) return;
    const auto name = [this](const Event& g, bool also_at_zero) {
      const double value = g.value(t0_, x0_);
      if (value < 0 || (also_at_zero && value == 0))
        all_.status =
            failed_with(Outcome::outside_validity,
                        "the argument of a root, power, arc or logarithm, or a denominator, is {:.9g} at "
                        "the start t = {:.17g}, where the equations are not defined; start elsewhere",
                        value, t0_);
    };
    for (const Event& g : domain_.timed_arguments) name(g, true);
    for (std::size_t i = 0; i < domain_.corners; ++i) name(domain_.arguments[i], false);
    const std::size_t denominators = domain_.crossings.size() + domain_.sums.size();
    for (std::size_t i = 0; i < domain_.ends.size(); ++i) {
      if (const Event& g = domain_.ends[i]; i >= denominators || g.value(t0_, x0_) == 0) name(g, true);
    }
  }

  // What has become of the zero of an argument.
  struct Boundary {
    bool rests = false;      // the solution is there
    bool is_passed = false;  // the solution went on from there
    double margin = 0;       // the solution has left when the argument exceeds this
    double from = 0;         // time since when it rests
  };
  struct Stop {
    std::size_t event;
    double t;
    State x;
    Status status;
  };

  const SmoothRun& run_;
  const Domain& domain_;
  StateAccuracy accuracy_;
  bool* has_rested_;  // may be null
  const System& system_;
  double t0_, t1_;
  State x0_;
  int direction_;
  const Observer& observer_;
  const Limits& limits_;
  Solution all_;
  std::optional<EventFinder> finder_;
  std::optional<Stop> stop_;
  std::vector<Falls> falls_ = std::vector<Falls>(domain_.sums.size());  // one per sum
  std::vector<Boundary> boundaries_;                                    // one per argument
  bool is_stopped_ = false, is_infinite_ = false;
  Stopwatch watch_;
};

}  // namespace

SmoothRun within_domain(SmoothRun run, std::shared_ptr<const Domain> domain, StateAccuracy accuracy,
                        bool* rests) {
  if (!domain || domain->empty()) return run;
  return [run = std::move(run), domain = std::move(domain), accuracy, rests](
             const System& system, const State& x0, double t0, double t1, const Observer& observer,
             const Limits& limits) {
    return Guarded(run, *domain, accuracy, rests, system, t0, t1, observer, limits).from(x0);
  };
}

}  // namespace nlmech::ivp

#include "nlmech/ivp/domain.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "nlmech/ivp/singular_start.hpp"
#include "nlmech/program/domain.hpp"
#include "nlmech/program/problem.hpp"
#include "nlmech/support/doubles.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::ivp {
namespace {

using program::Interval;

/// Placeholder state for functions of time only.
template <class T>
struct NoState {
  T operator[](int) const { return T(0); }
};

/// Bounds at a point for states with errors up to error.absolute + error.relative |x_i|.
Enclosure at_point(const Event& g, double t, const State& x, StateAccuracy error) {
  std::vector<Interval> box;
  for (const double xi : x)
    box.push_back(Interval(xi).inflated(error.absolute + error.relative * std::abs(xi)));
  return g.bounds(Interval(t), box);
}
double middle_of(const Interval& v) { return (v.low + v.high) / 2; }
/// dg/dt; zero where its bounds include zero.
double rate_at(const Event& g, double t, const State& x) {
  const Interval rate = at_point(g, t, x, {}).rate;
  return rate.has(0) ? 0 : middle_of(rate);
}

/// dg/dx by central differences.
State gradient(const Event& g, double t, const State& x) {
  State d(x.size()), at = x;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double by = 1e-6 * std::max(std::abs(x[i]), 1e-3 * std::max(x.norm(), 1e-9));
    at[i] = x[i] + by;
    const double above = g.value(t, at);
    at[i] = x[i] - by;
    d[i] = (above - g.value(t, at)) / (2 * by);
    at[i] = x[i];
  }
  return d;
}

/// The state nearest to @p x at which g is @p value, or less by rounding: at most 8 steps along the gradient.
State moved_to(const Event& g, double t, State x, double value) {
  constexpr int most = 8;
  for (int k = 0; k < most; ++k) {
    const double excess = g.value(t, x) - value;
    if (!(excess > 0 || k == 0) || excess == 0) break;
    const State slope = gradient(g, t, x);
    if (!(slope.squaredNorm() > 0)) break;
    const State before = x;
    x -= (k < 2 ? 1 : 2) * excess / slope.squaredNorm() * slope;
    if (x == before) break;
  }
  return x;
}

/// Do the equations lead away from the zero of an argument at @p x, with a rate per distance that grows
/// towards it?
bool repels(const Event& g, double t, const State& x, double near, int direction) {
  const auto slope = [&](double distance) {
    return direction * (rate_at(g, t, moved_to(g, t, x, distance)) - rate_at(g, t, x)) / distance;
  };
  const double far = slope(near);
  return far > 0 && slope(near / 1e4) > 3 * far;
}

/// Zeros of a function of time only.
class ZerosOfTime {
 public:
  explicit ZerosOfTime(const Event& g) : g_(g) {}

  /// The first zero from @p from to @p to (either order); none if there is no zero.
  [[nodiscard]] std::optional<double> first(double from, double to) {
    left_ = 10'000;
    return search(from, to, 0);
  }

 private:
  [[nodiscard]] double value(double t) const { return g_.value(t, {}); }
  [[nodiscard]] std::optional<double> search(double a, double b, int depth) {
    if (--left_ < 0) return {};
    const Enclosure g = g_.bounds({std::min(a, b), std::max(a, b)}, {});
    if (!g.value.has(0)) return {};
    const double middle = a + (b - a) / 2;
    constexpr int most_halvings = 50;
    if (!g.rate.has(0)) {
      const double at_a = value(a), at_b = value(b);
      if (at_a == 0) return a;
      if (at_b != 0 && (at_a > 0) == (at_b > 0)) return {};
      return bisect(a, b, at_a > 0);
    }
    if (depth == most_halvings || middle == a || middle == b) return middle;
    if (const std::optional<double> zero = search(a, middle, depth + 1)) return zero;
    return search(middle, b, depth + 1);
  }
  // The first double at which the sign has changed.
  [[nodiscard]] double bisect(double a, double b, bool positive) const {
    for (;;) {
      const double middle = a + (b - a) / 2;
      if (middle == a || middle == b) return b;
      ((value(middle) > 0) == positive && value(middle) != 0 ? a : b) = middle;
    }
  }

  const Event& g_;
  int left_ = 0;
};

/// Are @p t and @p of equal to 8 roundings?
bool is_near(double t, double of) {
  return std::abs(t - of) <= 8 * eps * std::max(std::abs(t), std::abs(of));
}

bool is_zero_at(const Event& g, double t) {
  const Enclosure there = g.bounds(Interval(t), {});
  return std::abs(g.value(t, {})) <= 8 * eps * std::abs(t) * there.rate.magnitude();
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
        limits_(limits) {}

  Solution from(const State& x0) {
    all_ = {t0_, x0, {}, {}};
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
    if (!all_.status.ok()) name_denominator();
    all_.statistics.seconds = watch_.seconds();
    return all_;
  }

 private:
  // Handles a singular point or a zero argument at the start.
  void begin() {
    const auto is_singular = [this](const Event& g) { return is_zero_at(g, t0_); };
    if (std::ranges::any_of(domain_.timed, is_singular)) return begin_series();
    for (std::size_t i = 0; i < domain_.arguments.size(); ++i) {
      const double value = domain_.arguments[i].value(all_.t, all_.x);
      const bool is_zero = value == 0 || (value < 0 && value >= -margin_of(i));
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

  // Integrates to the next zero of an argument, or to the end of the rest at one.
  void part() {
    stop_.reset();
    finder_.emplace(watched(),
                    accuracy_);  // dense output: a run that ends at a singular point is inaccurate
    const System& system = rests_ ? *domain_.beyond : system_;
    const Observer observer = domain_.watches()
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
    if (!rests_) {
      rest(stop_->event);
    } else if (stop_->event % 2 == 0) {
      rests_ = false;
    } else {
      leave(stop_->event / 2);
    }
  }
  // Trial steps beyond the zero of an argument are not finite, so the last accepted step may end before it.
  void rest_at_failure() {
    const Outcome outcome = all_.status.outcome();
    if (rests_ || (outcome != Outcome::non_finite && outcome != Outcome::step_underflow)) return;
    for (std::size_t i = 0; i < domain_.arguments.size(); ++i) {
      const bool is_known = is_passed_ && i == passed_;
      if (is_known || !(std::abs(domain_.arguments[i].value(all_.t, all_.x)) <= margin_of(i))) continue;
      rest(i);
      if (!rests_) continue;
      all_.status = {};
      return;
    }
  }
  // Events: arguments that become zero. While an argument rests at zero: its departure to either side.
  [[nodiscard]] std::vector<Event> watched() const {
    std::vector<Event> events;
    for (std::size_t i = 0; i < domain_.arguments.size(); ++i) {
      if (!rests_) {
        events.push_back(domain_.arguments[i]);
        events.back().ends = 1;
        if (is_passed_ && i == passed_) events.back() = never();
        continue;
      }
      const bool is_this = i == resting_;
      events.push_back(is_this ? shifted(i, -margin_, Crossing::rising) : never());
      events.push_back(shifted(i, is_this ? margin_ : margin_of(i), Crossing::falling));
    }
    events.insert(events.end(), domain_.crossings.begin(), domain_.crossings.end());
    return events;
  }
  static Event never() {
    Event event;
    event.value = [](double, const State&) { return 1.; };
    event.bounds = [](const Interval&, std::span<const Interval>) {
      return Enclosure{Interval(1), Interval(0)};
    };
    return event;
  }
  [[nodiscard]] Event shifted(std::size_t i, double by, Crossing crossing) const {
    const Event& g = domain_.beyond_arguments[i];
    Event event;
    event.value = [&g, by](double t, const State& x) { return g.value(t, x) + by; };
    event.bounds = [&g, by](const Interval& t, std::span<const Interval> x) {
      Enclosure e = g.bounds(t, x);
      e.value = e.value + by;
      return e;
    };
    event.slopes = g.slopes;
    event.crossing = crossing;
    event.ends = 1;
    return event;
  }
  // Error of an argument due to the errors of the states.
  [[nodiscard]] double margin_of(std::size_t i) const {
    constexpr double many_tolerances = 10;  // allowance for the accumulated errors of all steps
    const StateAccuracy errors{many_tolerances * accuracy_.relative, many_tolerances * accuracy_.absolute};
    const Interval there = at_point(domain_.arguments[i], all_.t, all_.x, errors).value;
    const double size = at_point(domain_.arguments[i], t0_, all_.x, {1, 0}).value.magnitude();
    const double wide = std::isfinite(there.width()) ? there.width() : 0;
    return std::max(5 * wide, 1e-12 * (std::isfinite(size) ? size : 1)) + std::numeric_limits<double>::min();
  }

  // Continues with the equations `beyond` from the zero of argument i.
  void rest(std::size_t i) {
    const Event& g = domain_.arguments[i];
    resting_ = i;
    margin_ = margin_of(i);
    const State at = moved_to(g, all_.t, all_.x, 0);
    is_passed_ = all_.t != t0_ && repels(g, all_.t, at, margin_, direction_);
    passed_ = i;
    if (is_passed_) return;
    rests_ = true;
    if (has_rested_ != nullptr) *has_rested_ = true;
    rests_from_ = all_.t;
    all_.x = at;
  }
  void leave(std::size_t i) {
    const double rate = std::abs(rate_at(domain_.beyond_arguments[i], all_.t, all_.x));
    const double since = std::abs(all_.t - rests_from_);
    const double left = all_.t - direction_ * std::min(since, rate > 0 ? 2 * margin_ / rate : 0.);
    all_.status = failed_with(Outcome::outside_validity,
                              "the argument of a square root, a power with a fraction or an arc becomes "
                              "negative at t = {:.9g}, and "
                              "the equations do not define the solution beyond; end the run before",
                              left);
  }

  bool see(const System& system, const Step& step) {
    const std::size_t known = finder_->hits().size();
    const bool continues = finder_->see(system, step, limits_);
    std::optional<double> zero = singular_time(system, step);
    for (std::size_t k = known; k < finder_->hits().size() && !zero; ++k) {
      const Hit& hit = finder_->hits()[k];
      const bool is_denominator = hit.event >= finder_->events() - domain_.crossings.size();
      if (is_denominator && !is_end(hit.t) && is_singular(system, hit.t, step)) zero = hit.t;
    }
    if (zero) {
      stop_at(*zero, step.at(*zero), 0, step);
      stop_->status =
          failed_with(Outcome::outside_validity,
                      "a denominator of the equations becomes zero at t = {:.9g}: {}; end the run before",
                      *zero, is_infinite_ ? "the solution ends there" : "the solution beyond is not unique");
      return false;
    }
    if (continues) return !observer_ || observer_(step) || stop_by_observer();
    if (finder_->ended()) {
      const Hit hit = finder_->hits().back();
      stop_at(hit.t, hit.x, hit.event, step);
    }
    return false;
  }
  [[nodiscard]] bool is_end(double t) const { return is_near(t, t0_) || is_near(t, t1_); }
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

  // First zero of a time-only denominator within a step beyond which the solution is infinite or not unique.
  // Zeros at t0 and t1 do not count.
  std::optional<double> singular_time(const System& system, const Step& step) {
    for (const Event& g : domain_.timed) {
      double from = step.t0;
      constexpr int most = 100;
      for (int k = 0; k < most && from != step.t1; ++k) {
        const std::optional<double> zero = ZerosOfTime(g).first(from, step.t1);
        if (!zero) break;
        if (!is_end(*zero) && is_singular(system, *zero, step)) return zero;
        from = *zero + (step.t1 - *zero) * 1e-6;
        if (from == *zero) break;
      }
    }
    return {};
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
      system.rhs(t, x, f);
      system.jacobian(t, x, j);
      j *= t - zero;
      sizes[k] = f.norm();
    }
    if (!j.allFinite() || !std::isfinite(sizes[1])) return false;
    is_infinite_ = sizes[1] > 30 * sizes[0];
    return is_infinite_ || j.eigenvalues().real().maxCoeff() > 1e-2;
  }

  // Names the denominator in the message of a run that fails close to a zero of it.
  void name_denominator() {
    const Outcome outcome = all_.status.outcome();
    if (outcome != Outcome::step_underflow && outcome != Outcome::non_finite) return;
    std::vector<const Event*> all;
    for (const Event& g : domain_.denominators) all.push_back(&g);
    for (const Event& g : domain_.timed) all.push_back(&g);
    for (const Event* g : all) {
      const double value = g->value(all_.t, all_.x), rate = rate_at(*g, all_.t, all_.x);
      const double away = direction_ * -value / rate;
      if (!(away >= 0 && away <= 1e-6 * std::abs(all_.t - t0_))) continue;
      const std::string sentence(all_.status.sentence());
      all_.status = failed_with(outcome,
                                "{}: a denominator of the equations becomes zero at t = {:.9g}, where the "
                                "solution ends; end the run before",
                                sentence.substr(0, sentence.find(':')), all_.t + direction_ * away);
      return;
    }
  }

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
  int direction_;
  const Observer& observer_;
  const Limits& limits_;
  Solution all_;
  std::optional<EventFinder> finder_;
  std::optional<Stop> stop_;
  bool rests_ = false, is_passed_ = false, is_stopped_ = false, is_infinite_ = false;
  std::size_t resting_ = 0, passed_ = 0;
  double margin_ = 0, rests_from_ = 0;
  Stopwatch watch_;
};

/// event_of() for an expression of time only; it does not read the state.
Event timed_event_of(program::Graph graph, program::NodeId node) {
  const program::NodeId rate = program::rates(graph, {node}, {}).front();
  const auto program = std::make_shared<const program::Program>(graph, std::vector{node, rate});
  Event event;
  event.value = [program](double t, const State&) {
    double value = 0;
    program->run(t, NoState<double>{}, 0, 1, [&value](int, double v) { value = v; });
    return value;
  };
  event.bounds = [program](const Interval& t, std::span<const Interval>) {
    Enclosure g;
    program->run(t, NoState<Interval>{}, 0, 2,
                 [&g](int i, const Interval& v) { (i == 0 ? g.value : g.rate) = v; });
    return g;
  };
  return event;
}

}  // namespace

Event event_of(program::Graph graph, program::NodeId node, const std::vector<program::NodeId>& slopes) {
  const program::NodeId rate = program::rates(graph, {node}, slopes).front();
  const auto program = std::make_shared<const program::Program>(graph, std::vector{node, rate});
  Event event;
  event.value = [program](double t, const State& x) {
    double value = 0;
    program->run(t, x, 0, 1, [&value](int, double v) { value = v; });
    return value;
  };
  event.bounds = [program](const Interval& t, std::span<const Interval> x) {
    Enclosure g;
    program->run(t, x, 0, 2, [&g](int i, const Interval& v) { (i == 0 ? g.value : g.rate) = v; });
    return g;
  };
  event.slopes = [all = std::make_shared<const program::Program>(graph, slopes)](
                     const Interval& t, std::span<const Interval> x, std::span<Interval> bounds) {
    all->run(t, x, 0, bounds.size(),
             [&bounds](int i, const Interval& v) { bounds[static_cast<std::size_t>(i)] = v; });
  };
  return event;
}

Domain::Domain(const program::Equations& equations) {
  const program::Domain domain(equations);
  const std::vector<program::NodeId>& slopes = equations.slopes();
  for (const program::NodeId id : domain.arguments) {
    arguments.push_back(event_of(domain.graph, id, slopes));
    beyond_arguments.push_back(event_of(domain.graph, id, domain.beyond));
  }
  const std::vector<Interval> anywhere(static_cast<std::size_t>(equations.size()));
  for (const program::NodeId id : domain.denominators) {
    denominators.push_back(event_of(domain.graph, id, slopes));
    if (denominators.back().bounds({}, anywhere).value.low < 0) crossings.push_back(denominators.back());
  }
  for (const program::NodeId id : domain.timed) timed.push_back(timed_event_of(domain.graph, id));
  if (!arguments.empty())
    beyond.emplace(program::Problem(equations).with_slopes(domain.graph, domain.beyond));
}

SmoothRun within_domain(SmoothRun run, std::shared_ptr<const Domain> domain, StateAccuracy accuracy,
                        bool* rests) {
  if (!domain || domain->empty()) return run;
  return [run = std::move(run), domain = std::move(domain), accuracy, rests](
             const System& system, const State& x0, double t0, double t1, const Observer& observer,
             const Limits& limits) {
    return Guarded(run, *domain, accuracy, rests, system, t0, t1, observer, limits).from(x0);
  };
}

bool several_begin(const Domain& domain, double t, const State& x, int direction) {
  for (std::size_t i = 0; i < domain.arguments.size(); ++i) {
    const Event& g = domain.arguments[i];
    const double near = 1e-6 * std::max(x.norm(), 1.);
    if (g.value(t, x) == 0 && direction * rate_at(domain.beyond_arguments[i], t, x) <= 0 &&
        repels(g, t, x, near, direction))
      return true;
  }
  return false;
}

}  // namespace nlmech::ivp

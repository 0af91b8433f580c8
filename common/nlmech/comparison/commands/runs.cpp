#include "nlmech/comparison/commands/runs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "nlmech/comparison/commands/remarks.hpp"
#include "nlmech/comparison/reference/verification.hpp"
#include "nlmech/ivp/ensemble/integrate_all.hpp"
#include "nlmech/ivp/named/named_integrators.hpp"
#include "nlmech/ivp/sensitivities.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/table.hpp"
#include "nlmech/support/doubles.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"
#include "nlmech/support/threads.hpp"

namespace nlmech::comparison {
namespace {

/// Components of the state for plotting. Derivatives belong to unknowns by their names ("x" and "x'") or, in
/// a second-order problem, by their indices.
std::vector<PlotSamples::Component> components_of(const UserProblem& problem) {
  const std::vector<std::string>& names = problem.state_names;
  const bool second_order = problem.system.second_order();
  std::vector<PlotSamples::Component> all;
  const int size = static_cast<int>(names.size()), half = size / 2;
  for (int i = 0; i < size; ++i) {
    const std::string& name = names[static_cast<std::size_t>(i)];
    const bool is_rate = second_order ? i >= half : name.ends_with('\'');
    const auto rate = second_order ? i + half : std::ranges::find(names, name + "'") - names.begin();
    auto& shown = all.emplace_back(PlotSamples::Component{name, !is_rate});
    if (rate < size) shown.rate = static_cast<int>(rate);
  }
  return all;
}

/// Work limit of a verification: about a second plus four times the work of the run.
/// @param left seconds of wall time left of the limit
WorkLimit effort_after(const Statistics& work, int components, double left) {
  // 1e7 components of right-hand sides take about a second.
  const double done =
      static_cast<double>(work.right_hand_sides + work.jacobians * components) * components / 1e7;
  // The time limit matters only on a much slower or busy machine.
  return {std::min(1 + 4 * done, 100.0), std::min(left, 10 + 20 * work.seconds)};
}

/// A method independent of @p method at a tenth of its tolerances, at least 1e-13.
ivp::NamedIntegrator other_method(const ivp::MethodInfo& method, const ivp::Settings& settings) {
  const auto finer = [](double tolerance) { return std::clamp(tolerance / 10, 1e-13, 1e-4); };
  const Tolerance tolerance = tolerance_of(settings);
  return any_method(method.name == "dop853" ? "series" : "dop853")
      .with({.tolerance = finer(tolerance.relative), .absolute_tolerance = finer(tolerance.absolute)});
}

constexpr double many_turns = 1000;  // periods of a force

/// Refuses a force that no method can resolve within the time limit: each period takes a few right-hand
/// sides.
/// @throws Failure with Outcome::time_limit
void refuse_too_many_periods(const UserProblem& problem, const RunOptions& r) {
  constexpr double most_turns = 2e6;  // periods per second
  const Wave wave = fastest_wave(problem, r.t0, r.t1);
  const double seconds = wave.turns / most_turns;
  const bool may_end = std::ranges::any_of(r.events, [](const WantedEvent& e) { return e.event.ends > 0; });
  if (r.settings.step || may_end || seconds <= r.limits.seconds) return;
  throw Failure(failed_with(Outcome::time_limit,
                            "{} from t = {:.6g} to {:.6g}, which takes at least {:.2g} s, more than the "
                            "limit of {:.6g} s; take an earlier end, or replace the force by its mean",
                            wave.text(), r.t0, r.t1, seconds, r.limits.seconds));
}

/// A run from its options to its rows: output at requested times and events, and the verification. Members
/// refer to each other, so it is neither copied nor moved.
class Run {
 public:
  /// All arguments must outlive the run. @param one integrator of a single trajectory
  /// @param other integrator whose agreement suffices as verification of one of many runs; may be null
  Run(const UserProblem& problem, const RunOptions& options, const ivp::MethodInfo& method,
      const ivp::NamedIntegrator& one, const ivp::NamedIntegrator* other = nullptr)
      : problem_(problem),
        options_(options),
        method_(method),
        other_(other),
        t1_(options.t1),
        accuracy_(accuracy_of(options)),
        one_(integrator_of(ivp::within_domain(one, problem.domain, accuracy_, &rests_), problem)),
        finder_(events_of(options), accuracy_, one_) {
    found_.rows = fmt::format("t,{}{}\n", fmt::join(printed_names(problem, options), ","),
                              options.events.empty() ? "" : ",event");
    found_.samples = {components_of(problem), SampledPath(options.t0, t1_), {}};
    if (options.t1 < options.t0) std::ranges::reverse(at_);
    if (options.every) {  // the margin keeps all rows if rounding puts their number above most_verified
      const double parts = std::abs(t1_ - options.t0) / *options.every * (1 - 1e-9);
      stride_ = std::max(std::int64_t{1}, static_cast<std::int64_t>(std::ceil(parts / most_verified)));
    }
    add(options.t0, options.x0);
    if (options.draw && t1_ != options.t0) found_.samples.path.add(options.t0, options.x0);
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  /// Input of the integrator. Refers to this.
  [[nodiscard]] ivp::Start start() {
    ivp::Start start{&problem_.system, options_.x0,      options_.t0, options_.t1, {},
                     options_.limits,  options_.deadline};
    if (options_.every || !options_.at.empty() || options_.draw || !options_.events.empty() ||
        options_.reached || alone())
      start.observer = [this](const ivp::Step& step) { return see(step); };
    return start;
  }
  /// Does an event change the state?
  [[nodiscard]] bool has_changes() const {
    return std::ranges::any_of(options_.events,
                               [](const WantedEvent& e) { return static_cast<bool>(e.event.change); });
  }
  /// Must the run be integrated alone, because its equations have a watched domain or events change its
  /// state?
  [[nodiscard]] bool needs_own_run() const {
    return has_changes() || (problem_.domain && problem_.domain->watches());
  }
  /// Integrates the run, with a restart at each change of the state.
  [[nodiscard]] ivp::Solution integrate() {
    const ivp::Start s = start();
    return ivp::integrate_past_changes(one_, problem_.system, s.x0, s.t0, s.t1, finder_, s.observer,
                                       s.limits_from_now());
  }
  /// The result of a run that has been integrated. @throws Failure if the run failed or is wrong
  [[nodiscard]] Trajectory finish(ivp::Solution end);

 private:
  struct StoredState {
    double t;
    ivp::State x;
    double speed = 0;
  };

  static std::vector<ivp::Event> events_of(const RunOptions& options) {
    std::vector<ivp::Event> events;
    for (const WantedEvent& e : options.events) events.push_back(e.event);
    return events;
  }
  static ivp::NamedIntegrator integrator_of(const ivp::NamedIntegrator& run, const UserProblem& problem) {
    return problem.scaled ? ivp::controlled_by_solution(run, *problem.scaled) : run;
  }
  // Default accuracy for a fixed step.
  static ivp::StateAccuracy accuracy_of(const RunOptions& options) {
    if (options.settings.step) return {};
    const Tolerance tolerance = tolerance_of(options.settings);
    return {tolerance.relative, tolerance.absolute};
  }
  void print(double t, const ivp::State& x, std::string_view event) {
    auto out = std::back_inserter(found_.rows);
    fmt::format_to(out, "{:.17g}", t);
    for (const int i : options_.order) fmt::format_to(out, ",{:.17g}", x[i]);
    for (const double value : columns_at(t, x)) fmt::format_to(out, ",{:.17g}", value);
    if (!options_.events.empty()) fmt::format_to(out, ",{}", scene::csv_field(event));
    found_.rows += '\n';
  }
  /// Values of the columns after the components; while a motion stays on a surface of the equations, with the
  /// shares of both sides that the equations take.
  [[nodiscard]] std::vector<double> columns_at(double t, const ivp::State& x) const;
  /// Prints a row and keeps it for the verification.
  void add(double t, const ivp::State& x) {
    if (!options_.section) print(t, x, "");
    keep(t, x);
  }
  void keep(double t, const ivp::State& x) {
    largest_ = largest_.cwiseMax(x.cwiseAbs());
    if (added_ > 2 && (added_ - 2) % stride_ != 0) {  // the last two rows are of one part
      StoredState& before = stored_[stored_.size() - 2];
      if (stored_.back().speed > before.speed) before = std::move(stored_.back());
      stored_.pop_back();
    }
    stored_.push_back({t, x, stride_ > 1 ? speed(t, x) : 0});
    ++added_;
  }
  /// Greatest rate of a component in tolerances per unit of time.
  [[nodiscard]] double speed(double t, const ivp::State& x) const {
    ivp::State f(x.size());
    problem_.system.rhs(t, x, f);
    return (f.array().abs() / (accuracy_.absolute + accuracy_.relative * x.array().abs())).maxCoeff();
  }
  /// Observes a step; false if an event ends the run in it.
  [[nodiscard]] bool see(const ivp::Step& step);
  /// Is it a single run? All steps of a single run are observed.
  [[nodiscard]] bool alone() const { return other_ == nullptr; }
  /// Remark on nonzero components that stay below the absolute tolerance: none of their digits is determined.
  [[nodiscard]] std::string small_components() const;
  /// Time of the next requested row before the end, if there is one.
  [[nodiscard]] std::optional<double> next_row() const;
  /// Adds the requested rows within a step up to @p end by dense output. @param at_event true if an event
  /// occurs at the end; its row replaces a requested one at that time
  void add_before(double end, const ivp::Step& step, bool at_event = false);
  void show(const ivp::Hit& hit, const ivp::Step& step);
  /// Remark on events whose function touches zero or cannot be distinguished from zero.
  [[nodiscard]] std::string remark_on_events() const;
  /// Rows for the verification: the last one and, of each of about most_verified equal parts, the one at
  /// which the solution moves fastest, where an error in time is greatest; times without rows if these are
  /// few.
  [[nodiscard]] Verified verified() const;
  [[nodiscard]] Status with_turns(const Status& status) const;
  [[nodiscard]] double left_after(const ivp::Solution& end) const;
  [[nodiscard]] std::vector<ivp::Event> changes_before_the_end() const;
  void verify_by_integration(const ivp::Solution& end);
  [[nodiscard]] bool agrees_with(const ivp::NamedIntegrator& other, const Verified& run,
                                 const WorkLimit& effort, const ivp::Limits& limits) const;

  const UserProblem& problem_;
  const RunOptions& options_;
  const ivp::MethodInfo& method_;
  const ivp::NamedIntegrator* other_;  // or null
  double t1_;                          // end of the run
  ivp::StateAccuracy accuracy_;        // accuracy of the states
  bool rests_ = false;                 // did the solution reach the boundary of the domain and continue?
  ivp::NamedIntegrator one_;           // integrator that respects the domain
  ivp::EventFinder finder_;
  Trajectory found_;
  std::int64_t rows_ = 1, stride_ = 1, added_ = 0;
  std::vector<double> at_ = options_.at;  // in the direction of integration
  std::size_t next_at_ = 0;
  ivp::State largest_ = options_.x0.cwiseAbs();
  std::vector<StoredState> stored_;  // rows for the verification; the last one is always the latest row
};

std::vector<double> Run::columns_at(double t, const ivp::State& x) const {
  const Columns& columns = options_.columns;
  const std::size_t count = columns.names.size();
  std::vector<double> all;
  all.reserve(count);
  const auto add = [&all](int, double value) { all.push_back(value); };
  if (columns.switches && t1_ > options_.t0) {
    constexpr double many = 10, least = 1e-10;  // tolerances; share of the largest state, without a tolerance
    const ivp::State errors =
        many * (accuracy_.absolute + accuracy_.relative * x.array().abs()) + least * largest_.array();
    const ivp::Mode mode = ivp::mode_at(problem_.system, t, x, errors);
    if (std::ranges::any_of(mode, program::stays_on_surface)) {
      const auto before = static_cast<std::size_t>(x.size()) + 2 * mode.size();
      columns.switches->in_mode(mode)->run(t, x, before, before + count, add);
      return all;
    }
  }
  columns.values.run(t, x, 0, count, add);
  return all;
}

bool Run::see(const ivp::Step& step) {
  if (options_.reached && !options_.reached(step.t1)) return false;
  largest_ = largest_.cwiseMax(step.x0.cwiseAbs());
  const std::size_t before = finder_.hits().size();
  const bool continues = finder_.see(problem_.system, step, options_.limits);
  for (std::size_t i = before; i < finder_.hits().size(); ++i) show(finder_.hits()[i], step);
  if (continues) add_before(step.t1, step);
  if (options_.draw && !options_.section)
    found_.samples.path.see(step, continues || finder_.hits().empty() ? step.t1 : finder_.hits().back().t);
  return continues;
}

void Run::show(const ivp::Hit& hit, const ivp::Step& step) {
  add_before(hit.t, step, !options_.section);
  const std::string& name = options_.events[hit.event].name;
  print(hit.t, hit.x, name);
  if (hit.after.size() > 0) print(hit.t, hit.after, name + " after");
  if (options_.draw) found_.samples.events.push_back({hit.t, {hit.x.begin(), hit.x.end()}});
}

// A row at k DT that differs from a time of --at or from the end only by rounding is not repeated.
std::optional<double> Run::next_row() const {
  const double span = t1_ - options_.t0, every = options_.every.value_or(0), near = 1e-9 * every;
  const auto is_after = [span](double a, double b) { return span > 0 ? a > b : a < b; };
  std::optional<double> next;
  if (options_.every) {
    const double t = options_.t0 + std::copysign(static_cast<double>(rows_) * every, span);
    if (is_after(t1_, t) && std::abs(t1_ - t) > near) next = t;
  }
  if (next_at_ < at_.size()) {
    const double t = at_[next_at_];
    if (is_after(t1_, t) && (!next || is_after(*next, t) || std::abs(*next - t) <= near)) next = t;
  }
  return next;
}
void Run::add_before(double end, const ivp::Step& step, bool at_event) {
  const double span = t1_ - options_.t0, every = options_.every.value_or(0);
  const auto is_after = [span](double a, double b) { return span > 0 ? a > b : a < b; };
  const double near = 1e-9 * every + 4 * eps * std::abs(end);
  for (;;) {
    const std::optional<double> t = next_row();
    const bool is_event = t && at_event && std::abs(*t - end) <= near;
    if (!t || (is_after(*t, end) && !is_event)) return;
    if (is_event)
      keep(*t, step.at(end));
    else if (*t != options_.t0)
      add(*t, step.at(*t));
    if (next_at_ < at_.size() && at_[next_at_] == *t) ++next_at_;
    if (options_.every && static_cast<double>(rows_) * every <= std::abs(*t - options_.t0) + 1e-9 * every)
      ++rows_;
  }
}

std::string Run::small_components() const {
  const double absolute = tolerance_of(options_.settings).absolute;
  std::vector<std::string> small;
  for (const int i : options_.order) {
    if (largest_[i] > 0 && largest_[i] <= absolute)
      small.push_back(problem_.state_names[static_cast<std::size_t>(i)]);
  }
  if (small.empty() || options_.settings.step || t1_ == options_.t0) return {};
  return fmt::format(
      "{} stay{} below the absolute tolerance {}: none of {} digits is certain; take a smaller "
      "--absolute-tolerance",
      fmt::join(small, ", "), small.size() > 1 ? "" : "s", absolute, small.size() > 1 ? "their" : "its");
}

std::string Run::remark_on_events() const {
  std::vector<std::string> remarks;
  for (std::size_t i = 0; i < options_.events.size(); ++i) {
    const auto touches = [i](const ivp::Hit& h) { return h.event == i && h.direction == 0; };
    const auto count = std::ranges::count_if(finder_.hits(), touches);
    if (count == 0) continue;
    const ivp::Hit& first = *std::ranges::find_if(finder_.hits(), touches);
    remarks.push_back(
        fmt::format("{} touches zero {} times to within the tolerance, first at t = {:.9g}: it may cross "
                    "zero twice there or not reach it",
                    options_.events[i].name, count, first.t));
  }
  for (const ivp::OpenEvent& open : finder_.open()) {
    if (open.rests) continue;
    remarks.push_back(fmt::format(
        "{} cannot be distinguished from zero between t = {:.9g} and {:.9g}: rows may be missing, "
        "and those there may be none",
        options_.events[open.event].name, open.t0, open.t1));
  }
  for (std::size_t i = 0; i < options_.events.size(); ++i) {
    const auto rests = [i](const ivp::OpenEvent& open) { return open.event == i && open.rests; };
    const auto count = std::ranges::count_if(finder_.open(), rests);
    if (count == 0) continue;
    const ivp::OpenEvent& first = *std::ranges::find_if(finder_.open(), rests);
    remarks.push_back(fmt::format("{} stays at zero {}from t = {:.9g} to {:.9g}", options_.events[i].name,
                                  count == 1 ? "" : fmt::format("{} times, first ", count), first.t0,
                                  first.t1));
  }
  return fmt::format("{}", fmt::join(remarks, "; "));
}

Verified Run::verified() const {
  // The first row is the initial state.
  std::vector<StoredState> all(std::next(stored_.begin()), stored_.end());
  const double span = t1_ - options_.t0, near = 1e-6 * std::abs(span);
  // At a change of the state, rounding of the time decides between the states before and after it.
  const auto changes = [&](double t) {
    return std::ranges::any_of(
        finder_.hits(), [&](const ivp::Hit& h) { return h.after.size() > 0 && std::abs(h.t - t) <= near; });
  };
  if (has_changes()) std::erase_if(all, [&](const StoredState& k) { return k.t != t1_ && changes(k.t); });
  const auto rows = static_cast<std::ptrdiff_t>(all.size());
  const ivp::State unknown_state =
      ivp::State::Constant(options_.x0.size(), std::numeric_limits<double>::quiet_NaN());
  for (const double t : times_to_check(options_.t0, t1_, 16)) {
    const auto close = [&](const StoredState& k) { return std::abs(k.t - t) <= near; };
    if (std::none_of(all.begin(), all.begin() + rows, close) && (t == t1_ || !changes(t)))
      all.push_back({t, unknown_state});
  }
  std::ranges::sort(
      all, [span](const StoredState& a, const StoredState& b) { return span > 0 ? a.t < b.t : a.t > b.t; });
  Verified run{{},
               Eigen::MatrixXd(unknown_state.size(), static_cast<Eigen::Index>(all.size())),
               tolerance_of(options_.settings)};
  for (const StoredState& k : all) {
    run.states.col(static_cast<Eigen::Index>(run.times.size())) = k.x;
    run.times.push_back(k.t);
  }
  return run;
}

// Seconds left for the verification of a run.
double Run::left_after(const ivp::Solution& end) const {
  using std::chrono::steady_clock;
  const double own = options_.limits.seconds - end.statistics.seconds;
  if (options_.deadline == steady_clock::time_point::max()) return own;
  const std::chrono::duration<double> all = options_.deadline - steady_clock::now();
  if (all.count() <= 0)
    throw Failure(failed_with(Outcome::time_limit,
                              "{}: the run is complete, but --limit ended before it could be verified; give "
                              "a larger --limit, or --no-verify",
                              method_.name));
  return std::min(own, all.count());
}

bool Run::agrees_with(const ivp::NamedIntegrator& other, const Verified& run, const WorkLimit& effort,
                      const ivp::Limits& limits) const {
  const auto within = ivp::within_domain(other, effort.domain, accuracy_);
  return agrees(problem_.system, options_.x0, options_.t0, run,
                ivp::with_changes(within, effort.changes, accuracy_), limits, effort.observer());
}

// The events that change the state, for a reference. The change of the one that ends the run comes after the
// end, also where the reference meets it a little earlier.
std::vector<ivp::Event> Run::changes_before_the_end() const {
  std::vector<ivp::Event> all;
  const double near = 1e-6 * std::abs(t1_ - options_.t0);
  for (std::size_t i = 0; i < options_.events.size(); ++i) {
    if (!options_.events[i].event.change) continue;
    ivp::Event& event = all.emplace_back(options_.events[i].event);
    event.ends = 0;
    if (!finder_.ended() || finder_.hits().back().event != i) continue;
    event.change = [change = event.change, near, end = t1_](double t, ivp::State& x) {
      if (std::abs(t - end) > near) change(t, x);
    };
  }
  return all;
}

void Run::verify_by_integration(const ivp::Solution& end) {
  const Verified run = verified();
  const scene::ProgressScope doing("verifying the run by integration");
  WorkLimit effort = effort_after(end.statistics, problem_.system.size(), left_after(end));
  effort.largest_step = reference_step_limit(options_.t0, t1_, options_.limits.largest_step);
  if (options_.reached) effort.continues = [this] { return options_.reached(t1_); };
  effort.changes = changes_before_the_end();
  const ivp::Limits limits{.steps = 1000 + 20 * end.statistics.steps,
                           .seconds = effort.seconds,
                           .largest_step = effort.largest_step};
  const ivp::System& system = problem_.system;
  effort.domain = problem_.domain;
  if (other_ != nullptr && agrees_with(*other_, run, effort, limits)) return;
  // A Taylor series in extended precision continues a root beyond its zero on the other branch.
  const auto extended =
      effort.changes.empty() && !rests_ ? problem_.extended(effort) : std::vector<Candidate>();
  const Reference reference =
      reference_of(extended, system, options_.x0, options_.t0, run.times, run.tolerance / 10, effort);
  const Verification v = verify(system, options_.x0, options_.t0, run, reference, effort);
  found_.is_open = v.verdict == Verification::Verdict::unknown;
  if (found_.is_open && other_ == nullptr) {
    const ivp::NamedIntegrator other = other_method(method_, options_.settings);
    if (agrees_with(other, run, effort, limits)) {
      found_.is_open = false;
      return;
    }
  }
  if (found_.is_open) static_cast<void>(left_after(end));  // throws if the deadline has passed
  found_.remark = remark(v, reference, method_, options_.settings, problem_.state_names, t1_);
  if (const Wave wave = fastest_wave(problem_, options_.t0, t1_); found_.is_open && wave.turns > many_turns)
    found_.remark += "; " + wave.text();
}

// Adds a fast force to the message of a run that a limit has ended.
Status Run::with_turns(const Status& status) const {
  const Outcome outcome = status.outcome();
  const Wave wave = fastest_wave(problem_, options_.t0, options_.t1);
  if ((outcome != Outcome::time_limit && outcome != Outcome::step_limit) || wave.turns < many_turns)
    return status;
  return Status::failure(outcome, fmt::format("{}; {}", status.sentence(), wave.text()));
}

// A run ended by an event is a success with its last row at the event.
Trajectory Run::finish(ivp::Solution end) {
  if (!finder_.status().ok()) {
    end.status = finder_.status();
  } else if (finder_.ended()) {
    end.t = finder_.hits().back().t;
    end.x = finder_.hits().back().x;
    end.status = {};
  }
  found_.method = method_.name;
  if (!end.status.ok()) {
    if (!options_.section && end.t != options_.t0) print(end.t, end.x, "");
    throw RunFailure(Failure(with_turns(end.status)), std::move(found_.rows),
                     end.x.lpNorm<Eigen::Infinity>());
  }
  if (rests_ && problem_.text.layout().columns > 0)
    throw Failure(failed_with(Outcome::outside_validity,
                              "{}: the argument of a root or power reaches zero, where sensitivities are not "
                              "defined; end before, or leave out --sensitivities",
                              method_.name));
  t1_ = end.t;
  // The row of an event at the end is already printed.
  if (finder_.ended() || (!finder_.hits().empty() && finder_.hits().back().t == t1_))
    keep(t1_, end.x);
  else
    add(t1_, end.x);
  if (alone()) found_.small = small_components();
  try {
    if (options_.verify && options_.t0 != options_.t1) verify_by_integration(end);
  } catch (const Failure& failure) {
    throw RunFailure(failure, std::move(found_.rows), end.x.lpNorm<Eigen::Infinity>());
  }
  if (const std::string events = remark_on_events(); !events.empty())
    found_.remark += (found_.remark.empty() ? "" : "; ") + events;
  return std::move(found_);
}

/// Distributes the processor time of many runs in proportion to their right-hand sides, because runs in SIMD
/// lanes have no times of their own. Time limits of verifications depend on it.
void share_seconds(double all, std::vector<ivp::Solution>& ends) {
  double sum = 0;
  for (const ivp::Solution& end : ends) sum += static_cast<double>(end.statistics.right_hand_sides);
  for (ivp::Solution& end : ends)
    end.statistics.seconds = all * static_cast<double>(end.statistics.right_hand_sides) / std::max(sum, 1.0);
}

/// Solutions of all runs, identical bit by bit to those of single runs. Adaptive `series` integrates several
/// runs in SIMD lanes (see ivp::integrate_all()); other methods integrate one run at a time per thread.
std::vector<ivp::Solution> solutions_of(std::span<const std::unique_ptr<Run>> runs,
                                        const ivp::MethodInfo& method, const ivp::Settings& settings,
                                        int threads) {
  if (method.name == ivp::Series::name && !settings.step && !runs.front()->needs_own_run()) {
    std::vector<ivp::Start> starts;
    for (const std::unique_ptr<Run>& run : runs) starts.push_back(run->start());
    return ivp::integrate_all(starts, ivp::named::series_of(settings), threads);
  }
  std::vector<ivp::Solution> solutions(runs.size());
  share_out(runs.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      solutions[i] = runs[i]->integrate();
      solutions[i].statistics.seconds = 0;
    }
  });
  return solutions;
}

/// Does the method have all settings that are given besides step and tolerance?
bool has_settings(const ivp::MethodInfo& method, const ivp::Settings& settings) {
  return std::ranges::none_of(
      ivp::own_settings, [&](const ivp::SettingInfo* s) { return s->value(settings) && !method.has(*s); });
}

}  // namespace

std::vector<std::string> printed_names(const UserProblem& problem, const RunOptions& options) {
  std::vector<std::string> names;
  for (const int i : options.order) names.push_back(problem.state_names[static_cast<std::size_t>(i)]);
  names.insert(names.end(), options.columns.names.begin(), options.columns.names.end());
  return names;
}

ChoiceRequest choice_request(const UserProblem& problem, const RunOptions& r) {
  const Tolerance tolerance = tolerance_of(r.settings);
  return {.system = problem.system,
          .x0 = r.x0,
          .t0 = r.t0,
          .t1 = r.t1,
          .absolute = tolerance.absolute / tolerance.relative,
          .largest_step = r.limits.largest_step};
}

const ivp::MethodInfo& default_method(const UserProblem& problem, const RunOptions& r) {
  ChoiceRequest q = choice_request(problem, r);
  for (const std::string& name : built_method_names()) {
    const ivp::MethodInfo& method = any_method(name);
    const bool exact_within = name == "series" || name == "adaptive-collocation";
    const bool within =
        r.every || !r.at.empty() || !r.events.empty();  // not for a figure, so that it changes no number
    if (has_settings(method, r.settings) && (exact_within || !within) && !method.fixed_step())
      q.methods.push_back(name);
  }
  std::string method;
  if (!r.settings.step && r.t0 != r.t1 && !q.methods.empty())
    method = method_for(q, tolerance_of(r.settings).relative);
  return any_method(method.empty() ? "series" : method);
}

Trajectory trajectory(const UserProblem& problem, const RunOptions& options, const ivp::MethodInfo& method) {
  const auto one = about("--method", [&] { return method.with(options.settings); });
  refuse_too_many_periods(problem, options);
  Run run(problem, options, method, one);
  return run.finish(about("--method", [&] { return run.integrate(); }));
}

Trajectory default_trajectory(const UserProblem& problem, const RunOptions& options,
                              const ivp::MethodInfo& first_method) {
  const Stopwatch watch;
  try {
    return trajectory(problem, options, first_method);
  } catch (const Failure& first) {
    if (!options.verify) throw;
    // Where two methods end the equations do: a third that goes on has stepped over the end. Where two
    // leave the range of numbers the solution does.
    int outside = 0, overflows = 0;
    std::exception_ptr end;                       // the first such failure after the first one
    constexpr std::int64_t most_steps = 200'000;  // one that creeps towards an end leaves time to the others
    const auto ends = [](const Failure& f) { return f.status().outcome() == Outcome::outside_validity; };
    const auto count = [&](const Failure& f) {
      outside += ends(f) ? 1 : 0;
      const auto* run = dynamic_cast<const RunFailure*>(&f);
      const bool is_huge = run != nullptr && run->size() > 1e290;
      overflows += is_huge && f.status().outcome() == Outcome::non_finite ? 1 : 0;
    };
    count(first);
    for (const std::string_view name :
         {"dop853", "series", "adaptive-collocation", "odeint-rosenbrock4", "cvode-bdf"}) {
      const ivp::MethodInfo& other = any_method(name);
      RunOptions rest = options;
      rest.limits.seconds -= watch.seconds();
      rest.limits.steps = std::min(options.limits.steps, most_steps);
      rest.limits.largest_step = reference_step_limit(options.t0, options.t1, options.limits.largest_step);
      if (!other.is_available() || !has_settings(other, options.settings)) continue;
      if (rest.limits.seconds <= 0 || outside > 1 || overflows > 1) break;
      try {
        if (Trajectory found = trajectory(problem, rest, other); !found.is_open) return found;
      } catch (const Failure& failure) {
        count(failure);
        if (!end && ends(failure)) end = std::current_exception();
      }
    }
    if (outside > 1 && !ends(first)) std::rethrow_exception(end);
    throw;  // the failure of the usual method is more informative
  }
}

std::vector<EnsembleResult> trajectories(std::span<const EnsembleMember> members,
                                         const ivp::MethodInfo& method, bool is_default, int threads) {
  if (members.empty()) return {};
  const ivp::Settings& settings = members.front().options.settings;
  const auto one = about("--method", [&] { return method.with(settings); });
  const auto each = [&](const std::function<void(std::size_t)>& work) {
    share_out(members.size(), 16, threads, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) work(i);
    });
  };
  const ivp::NamedIntegrator other = other_method(method, settings);
  std::vector<std::unique_ptr<Run>> runs(members.size());
  each([&](std::size_t i) {
    runs[i] = std::make_unique<Run>(*members[i].problem, members[i].options, method, one, &other);
  });
  const Stopwatch watch;
  auto ends = about("--method", [&] { return solutions_of(runs, method, settings, threads); });
  share_seconds(watch.seconds() * static_cast<double>(threads_for(threads)), ends);
  std::vector<EnsembleResult> all(members.size());
  each([&](std::size_t i) {
    const auto attempt = [&all, i](const auto& work) {
      try {
        all[i].trajectory = work();
        all[i].status = {};
      } catch (const Failure& failure) {
        all[i].status = failure.status().ok() ? Status::failure(Outcome::not_converged, failure.what())
                                              : failure.status();
      }
    };
    attempt([&] { return runs[i]->finish(std::move(ends[i])); });
    const Outcome outcome = all[i].status.outcome();
    if (is_default && !all[i].status.ok() && outcome != Outcome::time_limit)
      attempt([&] { return default_trajectory(*members[i].problem, members[i].options, method); });
    runs[i].reset();
  });
  return all;
}

}  // namespace nlmech::comparison

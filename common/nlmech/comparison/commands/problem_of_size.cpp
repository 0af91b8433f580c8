#include "nlmech/comparison/commands/problem_of_size.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "nlmech/comparison/choice/choice.hpp"
#include "nlmech/comparison/commands/look_out.hpp"
#include "nlmech/comparison/comparison_table.hpp"
#include "nlmech/comparison/judgement.hpp"
#include "nlmech/comparison/reference/reference_methods.hpp"
#include "nlmech/comparison/reference/verification.hpp"
#include "nlmech/comparison/rows.hpp"
#include "nlmech/ivp/named/named_ensemble.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"
#include "nlmech/support/threads.hpp"

namespace nlmech::comparison {
namespace {

/// One run, repeated if it is short: its solution, and the times without the first, which warms up.
/// @param enough seconds after which it is not repeated
std::pair<ivp::Solution, Timing> timed(const std::function<ivp::Solution()>& work, double enough) {
  constexpr int repeats = 5;
  const Stopwatch watch;
  const ivp::Solution first = work();
  std::vector<double> seconds = {first.statistics.seconds};
  while (static_cast<int>(seconds.size()) <= repeats && watch.seconds() + seconds.back() < enough)
    seconds.push_back(work().statistics.seconds);
  if (seconds.size() > 1) seconds.erase(seconds.begin());
  const auto [least, most] = std::ranges::minmax(seconds);
  return {first, {median(seconds), least, most, static_cast<int>(seconds.size())}};
}

/// What of a state a picture shows: unknowns and their derivatives, by their names ("x" and "x'") or, of a
/// problem with accelerations, by their places.
std::vector<Shown> shown_of(const std::vector<std::string>& names, bool second_order) {
  std::vector<Shown> all;
  const int size = static_cast<int>(names.size()), half = size / 2;
  for (int i = 0; i < size; ++i) {
    const std::string& name = names[static_cast<std::size_t>(i)];
    const bool is_rate = second_order ? i >= half : name.ends_with('\'');
    const auto rate = second_order ? i + half : std::ranges::find(names, name + "'") - names.begin();
    Shown& shown = all.emplace_back(Shown{name, !is_rate});
    if (rate < size) shown.rate = static_cast<int>(rate);
  }
  return all;
}

/// A method that shares nothing with @p method, at a tenth of its tolerances, but not below what doubles
/// allow.
ivp::NamedIntegrator other_method(const ivp::MethodInfo& method, const ivp::Settings& settings) {
  const auto finer = [](double tolerance) { return std::clamp(tolerance / 10, 1e-13, 1e-4); };
  const Tolerance tolerance = tolerance_of(settings);
  return any_method(method.name == "dop853" ? "series" : "dop853")
      .with({.tolerance = finer(tolerance.relative), .absolute_tolerance = finer(tolerance.absolute)});
}

/// The first of them that this build has.
void add_first(const std::vector<std::string>& names, std::vector<std::string>& to) {
  const std::vector<std::string> built = built_method_names();
  for (const std::string& name : names) {
    if (std::ranges::find(built, name) == built.end()) continue;
    to.push_back(name);
    return;
  }
}

ivp::State begin(const Request& r) {
  return Eigen::Map<const Eigen::VectorXd>(r.x0.data(), static_cast<Eigen::Index>(r.x0.size()));
}

ChoiceRequest choice_request(const ivp::System& system, const Request& r) {
  const Tolerance tolerance = tolerance_of(r.settings);
  return {.system = system,
          .x0 = begin(r),
          .t0 = r.t0,
          .t1 = r.t1,
          .absolute = tolerance.absolute / tolerance.relative,
          .largest_step = r.limits.largest_step};
}

}  // namespace

Reference ProblemOfSize::reference(const ivp::State& x0, double t0, const std::vector<double>& times,
                                   const Needed& needed, const Effort& effort) const {
  std::vector<Candidate> all = extended(effort);
  for (Candidate& c : method_candidates(system(), needed, effort)) all.push_back(std::move(c));
  return agree(all, {x0.template cast<long double>(), t0, times}, needed, effort.seconds);
}

std::string ProblemOfSize::usual_method(const Request& r) const {
  constexpr const char* usual = "series";
  ChoiceRequest q = choice_request(system(), r);
  for (const std::string& name : built_method_names()) {
    const ivp::MethodInfo info = any_method(name);
    const auto lacks = [&](const ivp::SettingInfo* s) { return s->value(r.settings) && !info.has(*s); };
    const bool exact_within = name == "series" || name == "adaptive-collocation";
    const bool within = r.every || !r.events.empty();  // not for a picture, which changes no number
    if (std::ranges::none_of(ivp::own_settings, lacks) && (exact_within || !within) && !info.fixed_step())
      q.methods.push_back(name);
  }
  if (r.settings.step || r.t0 == r.t1 || q.methods.empty()) return usual;
  const std::string method = method_for(q, tolerance_of(r.settings).relative);
  return method.empty() ? usual : method;
}

Chosen ProblemOfSize::chosen(const Request& r, double digits) const {
  ChoiceRequest q = choice_request(system(), r);
  if (r.settings.absolute_tolerance) q.absolute = *r.settings.absolute_tolerance * std::pow(10, digits);
  return choose(q, digits, examine(q));
}

std::vector<std::string> ProblemOfSize::usual_methods(const Request& r) const {
  const ivp::System system = this->system();
  if (r.settings.step) {
    std::vector<std::string> fixed = {"rk4", "rk6", "radau-coll", "series"};
    if (system.second_order()) fixed.insert(fixed.end(), {"newmark", "laier"});
    return fixed;
  }
  std::vector<std::string> names = {"adaptive-collocation"};
  const Features features = probe_problem(choice_request(system, r)).features;
  if (features.stiffness < stiff_from) {
    names.insert(names.end(), {"series", "ode45"});
    if (features.velocity_free) names.emplace_back("rkn1210");
    add_first({"odeint-fehlberg78", "gsl-rk8pd", "arkode-erk"}, names);
    add_first({"odeint-bulirsch-stoer"}, names);
    add_first({"cvode-adams", "gsl-msadams"}, names);
  }
  add_first({"cvode-bdf", "gsl-msbdf"}, names);
  add_first({"odeint-rosenbrock4", "arkode-dirk", "gsl-bsimp"}, names);
  return names;
}

/// Of the processors' time that many runs took together the share of each, by its right-hand sides: no clock
/// is read within lanes. Verifications ask for it.
void share_seconds(double all, std::vector<ivp::Solution>& ends) {
  double sum = 0;
  for (const ivp::Solution& end : ends) sum += static_cast<double>(end.statistics.right_hand_sides);
  for (ivp::Solution& end : ends)
    end.statistics.seconds = all * static_cast<double>(end.statistics.right_hand_sides) / std::max(sum, 1.0);
}

/// A run from its request to its rows. Its parts refer to each other, so it stays where it is.
class ProblemOfSize::Run {
 public:
  /// All outlive it. @param one the method, for a single trajectory
  /// @param other that suffices for its verification if it agrees; may be null
  Run(const ProblemOfSize& problem, const ivp::System& system, const Request& request,
      const ivp::MethodInfo& method, const ivp::NamedIntegrator& one,
      const ivp::NamedIntegrator* other = nullptr)
      : problem_(problem),
        system_(system),
        request_(request),
        way_(request),
        method_(method),
        other_(other),
        rows_(way_, problem.state_names()),
        seen_{shown_of(problem.state_names(), system.second_order()), Samples(request.t0, request.t1), {}},
        events_(request, one, system, rows_, seen_) {
    const ivp::State x0 = begin(request);
    rows_.add(request.t0, x0);
    if (request.draw && request.t1 != request.t0) seen_.path.add(request.t0, x0);
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  /// What is to be integrated. Refers to this.
  [[nodiscard]] ivp::Start start() {
    ivp::Start start{&system_, begin(request_), request_.t0,      request_.t1,
                     {},       request_.limits, request_.deadline};
    if (request_.every || request_.draw || !request_.events.empty())
      start.observer = [this](const ivp::Step& step) { return events_.see(step); };
    return start;
  }
  /// Its rows, once it has been integrated. @throws Failure if it failed or is wrong
  [[nodiscard]] Trajectory finish(ivp::Solution end) {
    events_.finish(end);
    if (!end.status.ok()) throw Failure(end.status);
    way_.t1 = end.t;
    if (events_.ended())
      rows_.keep(end.t, end.x);
    else
      rows_.add(end.t, end.x);
    if (!request_.verify || request_.t0 == request_.t1) return {rows_.text(), "", false, std::move(seen_)};
    const auto [word, is_open] = verified(end);
    return {rows_.text(), word, is_open, std::move(seen_)};
  }

 private:
  /// What is left of the time for the verification of a run.
  [[nodiscard]] double left_after(const ivp::Solution& end) const {
    using std::chrono::steady_clock;
    const double own = request_.limits.seconds - end.statistics.seconds;
    if (request_.deadline == steady_clock::time_point::max()) return own;
    const std::chrono::duration<double> all = request_.deadline - steady_clock::now();
    if (all.count() <= 0)
      throw Failure(
          failed_with(Outcome::time_limit,
                      "{}: the run came to its end, but the time of all was over before it could be "
                      "verified; allow more, or --no-verify",
                      method_.name));
    return std::min(own, all.count());
  }
  /// What its verification says, and whether it came to no verdict.
  [[nodiscard]] std::pair<std::string, bool> verified(const ivp::Solution& end) const {
    const Verified what = rows_.verified(tolerance_of(request_.settings));
    const scene::Doing doing("verifying the run by integration");
    Effort effort = effort_after(end.statistics, system_.size(), left_after(end));
    effort.largest_step = request_.limits.largest_step;
    const ivp::State x0 = begin(request_);
    const ivp::Limits limits{.steps = 1000 + 20 * end.statistics.steps,
                             .seconds = effort.seconds,
                             .largest_step = effort.largest_step};
    if (other_ != nullptr && agrees(system_, x0, request_.t0, what, *other_, limits)) return {"", false};
    const Reference truth =
        problem_.reference(x0, request_.t0, what.times, needed_for(what.tolerance), effort);
    const Verification found = verify(system_, x0, request_.t0, what, truth, effort);
    const bool is_open = found.verdict == Verification::Verdict::unknown;
    if (is_open) static_cast<void>(left_after(end));  // if for want of time
    return {remark(found, truth, method_, request_.settings, problem_.state_names()), is_open};
  }

  const ProblemOfSize& problem_;
  const ivp::System& system_;
  const Request& request_;
  Request way_;  // to where it has come
  const ivp::MethodInfo& method_;
  const ivp::NamedIntegrator* other_;  // or null
  Rows rows_;
  Seen seen_;
  LookOut events_;
};

Trajectory ProblemOfSize::trajectory(const Request& r, const ivp::MethodInfo& method) const {
  const auto one = about("--method", [&] { return method.with(r.settings); });
  const ivp::System system = this->system();
  Run run(*this, system, r, method, one);
  const ivp::Start start = run.start();
  return run.finish(about(
      "--method", [&] { return one(system, start.x0, start.t0, start.t1, start.observer, start.limits); }));
}

std::vector<Ended> ProblemOfSize::trajectories(std::span<const Posed> posed, const ivp::MethodInfo& method,
                                               int threads) const {
  if (posed.empty()) return {};
  const ivp::Settings& settings = posed.front().request.settings;
  const auto one = about("--method", [&] { return method.with(settings); });
  const auto each = [&](const std::function<void(std::size_t)>& work) {
    share_out(posed.size(), 16, threads, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) work(i);
    });
  };
  const ivp::NamedIntegrator other = other_method(method, settings);
  const ivp::System usual = this->system();
  std::vector<std::optional<ivp::System>> systems(posed.size());
  std::vector<std::unique_ptr<Run>> runs(posed.size());
  std::vector<ivp::Start> starts(posed.size());
  each([&](std::size_t i) {
    const auto& problem = dynamic_cast<const ProblemOfSize&>(*posed[i].problem);
    if (&problem != this) systems[i] = problem.system();
    runs[i] = std::make_unique<Run>(problem, systems[i] ? *systems[i] : usual, posed[i].request, method, one,
                                    &other);
    starts[i] = runs[i]->start();
  });
  const Stopwatch watch;
  std::vector<ivp::Solution> ends =
      about("--method", [&] { return integrate_all_by(method, settings, starts, threads); });
  share_seconds(watch.seconds() * static_cast<double>(threads_for(threads)), ends);
  std::vector<Ended> all(posed.size());
  each([&](std::size_t i) {
    try {
      all[i].trajectory = runs[i]->finish(std::move(ends[i]));
    } catch (const Failure& failure) {
      all[i].status =
          failure.status().ok() ? Status::failure(Outcome::not_converged, failure.what()) : failure.status();
    }
    runs[i].reset();
  });
  return all;
}

Comparison ProblemOfSize::comparison(const Request& r, const std::vector<Choice>& methods,
                                     std::string_view program) const {
  const Stopwatch watch;
  const auto left = [&] { return r.limits.seconds - watch.seconds(); };
  const ivp::System system = this->system();
  const ivp::State x0 = begin(r);
  constexpr double work = 6;  // seconds, or so
  std::optional<scene::Doing> doing("computing a reference");
  const Reference truth = reference(x0, r.t0, look_at(r.t0, r.t1, 64), {.relative = 1e-13, .absolute = 1e-30},
                                    {work, left() / 3, r.limits.largest_step});
  ComparisonTable table(program, truth, x0.template cast<double>());
  for (std::size_t i = 0; i < methods.size(); ++i) {
    doing.emplace(fmt::format("running {}", methods[i].method.name));
    const double share = left() / static_cast<double>(methods.size() - i);
    try {
      const auto run = methods[i].method.with(methods[i].settings);
      const std::function<ivp::Solution()> once = [&] {
        return run(system, x0, r.t0, r.t1, {}, {r.limits.steps, share, r.limits.largest_step});
      };
      const auto [end, time] = timed(once, std::min(0.5, share / 2));
      table.add(methods[i], end.status, end.statistics, Eigen::VectorXd(end.x), time);
    } catch (const std::invalid_argument& error) {
      table.add_unsuitable(methods[i], error.what());
    }
  }
  return table.take();
}

}  // namespace nlmech::comparison

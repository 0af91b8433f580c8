#include "chapters/integrators/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>

#include "nlmech/comparison/any_method.hpp"

namespace nlmech::chapters::integrators {
namespace {

constexpr double least_digits = 2;  // least expected digits for which silent_failure() is meaningful

// Limits are counts, not times, so that sweeps are reproducible. A sweep ends at a step limit.
constexpr WorkLimit full_limit = {3, 13, 2, 60'000, 60'000}, quick_limit = {4, 8, 4, 4'000, 2'000};

/// Step limit of a run: lower for fixed steps of many nodes, ten times higher for a long problem.
std::int64_t most_steps(const ivp::MethodInfo& info, int size, std::int64_t length, const WorkLimit& effort) {
  const bool many_nodes = info.has(ivp::nodes_setting) || info.has(ivp::points_setting);
  const bool fewer = info.fixed_step() && many_nodes;
  return (fewer ? std::max<std::int64_t>(100, effort.steps / (std::int64_t{10} * size * size))
                : effort.steps) *
         (length > 1 ? 10 : 1);
}

/// Median time of up to five runs within 4 ms; a run longer than 2 ms is not repeated.
/// @param first processor time of the first run, s
Timing timing_of(const std::function<void()>& run, double first) {
  constexpr double all = 0.004;
  if (first > all / 2) return {first, first, first, 1};
  return time_repeats(run, std::clamp(static_cast<int>(all / std::max(first, 1e-6)) - 1, 1, 5));
}

/// Median error at the judged times: of @p end at t1, and of runs from one judged time to the next before it.
std::optional<double> error_of(const SetProblem& p, const ivp::NamedIntegrator& run,
                               const ivp::Limits& limits, const ivp::State& end) {
  std::vector<double> errors = {p.error(end, p.times.size() - 1)};
  ivp::State x = p.x0;
  double t = p.t0;
  for (std::size_t k = 0; k + 1 < p.times.size(); ++k) {
    const ivp::Solution s = run(p.system, x, t, p.times[k], {}, limits);
    if (!s.status.ok()) break;  // the run to t1 succeeded: use the errors so far
    errors.push_back(p.error(s.x, k));
    x = s.x;
    t = p.times[k];
  }
  if (std::ranges::any_of(errors, [](double e) { return !std::isfinite(e); })) return HUGE_VAL;
  return median(errors);
}

/// First tenth of a long problem, with a tenth of the step limit: if it fails, the whole run is not started.
/// No integration for other problems, nor for fixed steps, whose number is known.
ivp::Solution first_tenth(const SetProblem& p, const ivp::Settings& settings, const ivp::NamedIntegrator& run,
                          ivp::Limits limits) {
  if (p.length == 1 || settings.step) return {p.t0, p.x0, {}, {}};
  limits.steps /= 10;
  return run(p.system, p.x0, p.t0, p.t0 + (p.t1 - p.t0) / 10, {}, limits);
}

Trial trial(const SetProblem& p, const ivp::MethodInfo& method, const ivp::Settings& settings,
            const WorkLimit& effort) {
  Trial t{settings.tolerance.value_or(0), "refused"};
  t.step = settings.step.value_or(0);
  ivp::Limits limits{.steps = most_steps(method, p.system.size(), p.length, effort)};
  try {
    const auto run = method.with(settings);
    const auto once = [&] { return run(p.system, p.x0, p.t0, p.t1, {}, limits); };
    std::clock_t begin = std::clock();
    ivp::Solution s = first_tenth(p, settings, run, limits);
    if (s.status.ok()) {
      begin = std::clock();
      s = once();
    }
    t.processor = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    t.status = to_string(s.status.outcome());
    t.work = s.statistics;
    t.time = {t.processor, t.processor, t.processor, 1};
    if (!s.status.ok()) return t;
    t.error = p.has_solution() ? error_of(p, run, limits, s.x) : HUGE_VAL;
    t.time = timing_of([&] { static_cast<void>(once()); }, t.processor);
  } catch (const std::invalid_argument&) {
    // The method does not apply to the problem: one for second-order equations, for example.
  }
  return t;
}

/// Work of a run in right-hand sides. A Jacobian or factorisation counts as one per component, a low
/// estimate.
std::int64_t work_of(const Trial& t, int size) {
  return t.work.right_hand_sides + size * std::max(t.work.jacobians, t.work.factorisations);
}

/// Exponent of the loosest tolerance for long problems: looser ones leave no correct digit.
constexpr int loosest_of_long = 7;

/// Settings of a sweep: tolerances or fixed step sizes, coarsest first.
std::vector<ivp::Settings> settings_of(const SetProblem& p, const ivp::MethodInfo& info,
                                       const WorkLimit& effort) {
  std::vector<ivp::Settings> all;
  if (info.fixed_step()) {
    const double most = static_cast<double>(most_steps(info, p.system.size(), p.length, effort));
    const double finer = std::pow(2, effort.by);
    double steps = 16.0 * static_cast<double>(p.length);
    do {
      all.push_back({.step = std::abs(p.t1 - p.t0) / steps});
      steps *= finer;
    } while (steps <= most);
    return all;
  }
  for (int power = effort.loosest; power <= effort.tightest; power += effort.by) {
    if (p.length > 1 && power < loosest_of_long) continue;
    const double tolerance = std::pow(10, -power);
    all.push_back({.tolerance = tolerance, .absolute_tolerance = tolerance * p.absolute});
  }
  return all;
}

MethodTrials trials_of(const SetProblem& problem, const std::string& name, const WorkLimit& effort) {
  const ivp::MethodInfo& method = comparison::any_method(name);
  MethodTrials all{name, method.is_peer(), !method.fixed_step(), {}};
  for (const ivp::Settings& settings : settings_of(problem, method, effort)) {
    all.trials.push_back(trial(problem, method, settings, effort));
    const Trial& last = all.trials.back();
    const bool is_last = last.status == "refused" || last.status == "step_limit";
    if (is_last || work_of(last, problem.system.size()) > effort.most_work * problem.length) break;
  }
  return all;
}

ProblemTrials trials_on(const SetProblem& problem, const std::vector<std::string>& methods,
                        const WorkLimit& effort) {
  ProblemTrials p{problem.name,
                  problem.kind,
                  problem.has_solution(),
                  problem.condition,
                  problem.tolerance_condition,
                  {},
                  static_cast<double>(problem.length)};
  for (const std::string& name : methods) p.methods.push_back(trials_of(problem, name, effort));
  return p;
}

}  // namespace

double Trial::digits() const { return error ? std::clamp(-std::log10(std::max(*error, 1e-16)), 0., 16.) : 0; }

std::string Trial::setting() const {
  return step > 0 ? fmt::format("h = {:.2g}", step) : fmt::format("{:.0e}", tolerance);
}

std::optional<double> MethodTrials::seconds_for(double digits) const {
  if (!chooses) return {};
  std::optional<double> best;
  const auto take = [&best](double seconds) { best = best ? std::min(*best, seconds) : seconds; };
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const Trial& now = trials[i];
    if (!now.success() || now.digits() < digits) continue;
    take(now.time.median);
    if (i == 0 || !trials[i - 1].success() || trials[i - 1].digits() >= digits) continue;
    const Trial& before = trials[i - 1];
    const double share = (digits - before.digits()) / (now.digits() - before.digits());
    take(before.time.median * std::pow(now.time.median / before.time.median, share));
  }
  return best;
}

double ProblemTrials::digits_to_expect(double tolerance) const {
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();  // for some hundred steps
  return std::max(0., -std::log10(length * (tolerance * tolerance_condition + rounding * condition)));
}

bool ProblemTrials::silent_failure(const Trial& trial) const {
  if (!trial.success() || (has_solution && trial.step > 0)) return false;
  const double expected = digits_to_expect(trial.tolerance);
  return !has_solution || (expected >= least_digits && trial.digits() < expected / 2);
}

scene::Result<ProblemTrials> sweep_of(const std::string& problem) {
  return {"sweep-" + problem,
          "every method and peer; tolerances 1e-3 to 1e-13 with absolute tolerances of each problem, or 16 "
          "equal steps and four times as many in each further run; error: median over 16 times in the last "
          "tenth of the interval, each reached by continuing the run to the time before; one thread, median "
          "of repeats in 4 ms; at most 60 000 steps a run (duffing-10000: 600 000, of which 60 000 for the "
          "first tenth), fewer for equal steps with many nodes; "
          "a sweep ends with its first run of more than 60 000 right-hand sides (6 000 000; a Jacobian or "
          "factorisation counts as one for each component)",
          [problem](bool quick) {
            const std::vector<SetProblem> all = problem_set();
            return trials_on(*std::ranges::find(all, problem, &SetProblem::name),
                             comparison::built_method_names(), quick ? quick_limit : full_limit);
          }};
}

scene::Result<std::vector<ProblemTrials>> sweep() {
  std::vector<scene::Result<ProblemTrials>> each;
  for (const std::string& problem : problem_names()) each.push_back(sweep_of(problem));
  return {"sweep", "all problems of the set",
          [](const std::vector<const ProblemTrials*>& trials) {
            std::vector<ProblemTrials> all;
            for (const ProblemTrials* p : trials) all.push_back(*p);
            return all;
          },
          each};
}

std::vector<const ProblemTrials*> with_solution(const std::vector<ProblemTrials>& all) {
  std::vector<const ProblemTrials*> some;
  for (const ProblemTrials& p : all) {
    if (p.has_solution) some.push_back(&p);
  }
  return some;
}

}  // namespace nlmech::chapters::integrators

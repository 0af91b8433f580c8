#include "nlmech/comparison/commands/run_options.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <utility>

#include "nlmech/comparison/commands/runs.hpp"
#include "nlmech/comparison/commands/typed_events.hpp"
#include "nlmech/scene/program/options.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::comparison {
namespace {

/// Value of an option; nothing if the option is not given.
std::optional<double> time_of(const std::string& option, const std::string& typed,
                              const UserProblem& problem) {
  if (typed.empty()) return {};
  return problem.number(option, typed);
}
std::optional<double> positive_of(const std::string& option, const std::string& typed,
                                  const UserProblem& problem) {
  const std::optional<double> value = time_of(option, typed, problem);
  if (value && !(*value > 0)) throw input_error("{} {}: must be positive", option, quoted_input(typed));
  return value;
}
/// Times of `--at`, ascending and without repetitions.
std::vector<double> times_of_rows(const std::string& typed, const UserProblem& problem) {
  std::vector<double> times;
  if (typed.empty()) return times;
  for (const std::string& piece : scene::split(typed, ',')) times.push_back(problem.number("--at", piece));
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace

void RunOptions::start_with_changes() {
  const auto changes = [](const WantedEvent& e) { return static_cast<bool>(e.event.change); };
  if (t1 < t0 && std::ranges::any_of(events, changes))
    throw input_error("--until {}: is before the start, {}; events that change the state need a later end",
                      t1, t0);
  for (const WantedEvent& e : events) {
    if (e.event.change && e.at == t0) e.event.change(t0, x0);
  }
}

void RunOptions::check_rows() const {
  if (std::min(t0, t1) < tables.first || std::max(t0, t1) > tables.second)
    throw input_error("--until {}: the run goes from {} to {}, and the tables of the equations from {} to {}",
                      t1, t0, t1, tables.first, tables.second);
  for (const double t : at) {
    if (!(t >= std::min(t0, t1) && t <= std::max(t0, t1)))
      throw input_error("--at {}: is outside the run, from {} to {}", t, t0, t1);
  }
  if (every && std::abs(t1 - t0) / *every > 1e7)
    throw input_error("--every {}: more than 10 million rows", *every);
}

MakeProblem problem_of(const TypedOptions& typed) {
  const int given = !typed.problem.empty() + !typed.equation.empty() + !typed.file.empty();
  if (given != 1) throw InputError("give one of --problem NAME, --equation TEXT and --file NAME.ode");
  const program::Settings set = settings_of(typed.set);
  MakeProblem make;
  if (typed.problem.empty()) {
    std::string text = typed.file.empty() ? typed.equation : read_equations(typed.file);
    const std::vector<EventLine> lines = take_event_lines(text);
    const program::SourceText source(typed.file.empty() ? "--equation" : typed.file, text);
    const auto tables = table_reader(std::filesystem::path(typed.file).parent_path());
    make = [source, lines, tables](const program::Settings& all) {
      UserProblem problem = typed_problem(source, all, "the equation", tables);
      problem.event_lines = lines;
      return problem;
    };
  } else {
    make = library_problem(typed.problem);
  }
  return [make, set, sensitivities = typed.sensitivities,
          controlled = typed.control_sensitivities](program::Settings values) {
    values.insert(set.begin(), set.end());  // keeps values that are there already
    UserProblem problem = make(values);
    return sensitivities.empty() ? problem : with_sensitivities(problem, sensitivities, controlled);
  };
}

RunOptions run_options(const TypedOptions& typed, const UserProblem& problem, ivp::State x0) {
  RunOptions r{
      .x0 = std::move(x0),
      .t0 = time_of("--from", typed.from, problem).value_or(problem.t0),
      .t1 = 0,
      .settings = typed.settings,
      .every = positive_of("--every", typed.every, problem),
      .tables = problem.text.times_of_tables(),
      .order = problem.printed_order(typed.initial),
      .limits = {.seconds = typed.limit.value_or(scene::Options::default_limit),
                 .largest_step = typed.largest_step.value_or(std::numeric_limits<double>::infinity())},
      .section = !typed.section.empty(),
      .verify = typed.step.empty() && !typed.no_verify,
      .draw = !typed.plot.empty()};
  if (!typed.columns.empty()) r.columns = problem.columns(typed.columns);
  r.settings.step = positive_of("--step", typed.step, problem);
  if (r.settings.step && typed.largest_step)
    throw input_error("--step {} --largest-step {}: give equal steps or a bound on adaptive steps, not both",
                      *r.settings.step, *typed.largest_step);
  const std::optional<double> until = time_of("--until", typed.until, problem),
                              end = until ? until : problem.t1;
  if (!end && typed.states.empty())
    throw input_error("--until: missing; give the time at which the run ends{}",
                      typed.problem.empty() ? ", or t <= ... in the text" : "");
  if (!until && end && *end < r.t0)
    throw input_error(
        "--until: the text ends at t = {}, before the start at {}; give --until to run backwards", *end,
        r.t0);
  r.t1 = end.value_or(r.t0);
  r.at = times_of_rows(typed.at, problem);
  if (typed.states.empty()) r.check_rows();  // with --states each row is checked
  try {
    static_cast<void>(problem.system.discontinuities(r.t0, r.t1));
  } catch (const std::invalid_argument& error) {
    throw input_error("--until {}: {}; give an earlier end, or longer periods", r.t1, error.what());
  }
  for (const std::string& text : typed.events)
    std::ranges::move(events_of("--event", text, problem), std::back_inserter(r.events));
  if (r.section && (!r.events.empty() || r.every || !r.at.empty()))
    throw InputError("--section prints only its own rows; leave out --event, --every and --at");
  if (r.section) r.events = events_of("--section", typed.section, problem);
  for (const std::string& text : typed.changes) add_change("--set-at", text, problem, r.events);
  for (const EventLine& line : problem.event_lines) add_line(line, problem, r.events);
  if (typed.states.empty()) r.start_with_changes();  // with --states each row is changed
  return r;
}

const ivp::MethodInfo& method_of(const TypedOptions& typed, const UserProblem& problem,
                                 const RunOptions& options) {
  const ivp::MethodInfo& method = about("--method", [&]() -> const ivp::MethodInfo& {
    return typed.method.empty() ? default_method(problem, options) : any_method(typed.method);
  });
  const ivp::Settings& settings = options.settings;
  if (settings.step && settings.tolerance)
    throw input_error("--step {} --tolerance {}: give a step or a tolerance, not both", *settings.step,
                      *settings.tolerance);
  if (typed.largest_step && method.fixed_step())
    throw input_error("--largest-step {}: {} takes equal steps; give --step, or a method with adaptive steps",
                      *typed.largest_step, method.name);
  return method;
}

}  // namespace nlmech::comparison

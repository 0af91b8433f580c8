#include "nlmech/comparison/commands/run_options.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "nlmech/comparison/commands/runs.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/options.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/echo.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::comparison {
namespace {

/// Takes a word off the end of a text; false if it does not end with it.
bool take_last(std::string& text, std::string_view word) {
  if (text.size() <= word.size() || !text.ends_with(word) || text[text.size() - word.size() - 1] != ' ')
    return false;
  text = scene::trimmed(text.substr(0, text.size() - word.size()));
  return true;
}

/// Takes "name:" off the start of a text; empty if there is none.
std::string take_name(std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || text.find('=') < colon) return "";
  const std::string name = scene::trimmed(text.substr(0, colon));
  text = scene::trimmed(text.substr(colon + 1));
  return name;
}

/// Takes "end" or "end after 3" off the end of a text: at which event the run ends; 0 if at none.
int take_end(const std::string& option, std::string& text) {
  if (take_last(text, "end")) return 1;
  const std::size_t after = text.rfind(" end after ");
  if (after == std::string::npos) return 0;
  const std::string typed = scene::trimmed(text.substr(after + 11));
  double count = 0;
  if (!scene::parse_number(typed, count) || count != std::floor(count) || count < 1 || count > 1e9)
    throw input_error("{} {}: end after {}: say a whole number of events, from 1 to 1e9", option,
                      echoed(text), echoed(typed));
  text = scene::trimmed(text.substr(0, after));
  return static_cast<int>(count);
}

/// The times of "t = 0:24:240": first, distance, last; nothing if it is not written so.
std::vector<double> times_of(const std::string& option, const std::string& text) {
  const std::size_t sign = text.find('=');
  if (sign == std::string::npos || text.find(':') == std::string::npos ||
      scene::trimmed(text.substr(0, sign)) != "t")
    return {};
  const auto refuse = [&](std::string_view why) {
    return input_error("{} {}: {}", option, echoed(text), why);
  };
  std::array<double, 3> range{};  // first, distance, last
  std::string rest = text.substr(sign + 1) + ":";
  for (double& number : range) {
    const std::size_t colon = rest.find(':');
    if (colon == std::string::npos || !scene::parse_number(scene::trimmed(rest.substr(0, colon)), number))
      throw refuse("say the first time, the distance and the last, as t = 0:24:240");
    rest.erase(0, colon + 1);
  }
  constexpr double most = 10'000;
  const auto [first, distance, last] = range;
  if (!rest.empty() || !(distance > 0) || !(last >= first) || !std::isfinite(last - first))
    throw refuse(
        "say the first time, a positive distance and a last time that is not earlier, as t = 0:24:240");
  if ((last - first) / distance > most) throw refuse("more than 10000 times");
  std::vector<double> times;
  // The last one by rounding of distances.
  for (int k = 0; first + k * distance <= last + 1e-9 * distance; ++k) times.push_back(first + k * distance);
  return times;
}

/// Events as typed, "bounce: x = 0 falling end after 3": one, or one for each time of a list.
std::vector<WantedEvent> events_of(const std::string& option, const std::string& typed,
                                   const UserProblem& problem) {
  std::string text = scene::trimmed(typed);
  const std::string name = take_name(text), all = text;
  ivp::Event event;
  event.ends = take_end(option, text);
  if (take_last(text, "rising"))
    event.crossing = ivp::Crossing::rising;
  else if (take_last(text, "falling"))
    event.crossing = ivp::Crossing::falling;
  std::vector<WantedEvent> events;
  const auto add = [&](const std::string& equation) {
    ivp::Event one = problem.event(option, equation);
    one.crossing = event.crossing;
    one.ends = event.ends;
    events.push_back({name.empty() ? all : name, std::move(one), {}});
  };
  const std::vector<double> times = times_of(option, text);
  if (times.empty()) add(text);
  if (!times.empty() && event.ends > 1)
    throw input_error("{} {}: a time comes once; give --until", option, echoed(typed));
  for (const double t : times) {
    add(fmt::format("t = {:.17g}", t));
    events.back().at = t;
  }
  return events;
}

/// "bounce: y' = -0.8 y'; x' = 0.9 x'" for the events of that name.
void add_change(const std::string& typed, const UserProblem& problem, std::vector<WantedEvent>& events) {
  const auto refuse = [&](std::string_view why) {
    return input_error("--set-at {}: {}", echoed(typed), why);
  };
  std::string text = scene::trimmed(typed);
  const std::string name = take_name(text);
  if (name.empty())
    throw refuse("say the name of an event, and what changes there: \"bounce: y' = -0.8 y'\"");
  std::vector<std::pair<Eigen::Index, StateFunction>> values;
  while (!text.empty()) {
    const std::string one = scene::trimmed(text.substr(0, text.find(';')));
    text.erase(0, text.find(';') == std::string::npos ? text.size() : text.find(';') + 1);
    if (one.empty()) continue;
    const std::size_t sign = one.find('=');
    const std::string component = scene::trimmed(one.substr(0, sign));
    const auto known = std::ranges::find(problem.state_names, component);
    if (sign == std::string::npos || known == problem.state_names.end())
      throw refuse(fmt::format("{}: say one of {} = its new value", echoed(one),
                               fmt::join(problem.state_names, ", ")));
    values.emplace_back(known - problem.state_names.begin(),
                        problem.expression("--set-at", one.substr(sign + 1)));
  }
  if (values.empty()) throw refuse("say what changes there: \"bounce: y' = -0.8 y'\"");
  bool found = false;
  for (WantedEvent& event : events) {
    if (event.name != name) continue;
    found = true;
    event.event.change = [values, before = std::move(event.event.change)](double t, ivp::State& x) {
      if (before) before(t, x);
      const ivp::State old = x;
      for (const auto& [i, value] : values) x[i] = value(t, old);
    };
  }
  if (!found) throw refuse(fmt::format("no --event has the name {}", echoed(name)));
}

/// A change at the start, of an event at a given time, is a part of the initial state.
void start_with_changes(RunOptions& r) {
  for (const WantedEvent& e : r.events) {
    if (e.event.change && e.at == r.t0) e.event.change(r.t0, r.x0);
  }
}

}  // namespace

void RunOptions::check_rows() const {
  if (every && std::abs(t1 - t0) / *every > 1e7)
    throw input_error("--every {}: more than 10 million rows", *every);
}

MakeProblem problem_of(const TypedOptions& typed) {
  const int given = !typed.problem.empty() + !typed.equation.empty() + !typed.file.empty();
  if (given != 1) throw InputError("give one of --problem NAME, --equation TEXT and --file NAME.ode");
  const program::Settings set = settings_of(typed.set);
  MakeProblem make;
  if (typed.problem.empty()) {
    const auto text = typed.file.empty() ? program::SourceText("--equation", typed.equation)
                                         : program::SourceText(typed.file, read_equations(typed.file));
    make = [text](const program::Settings& all) { return typed_problem(text, all); };
  } else {
    make = library_problem(typed.problem);
  }
  return [make, set](program::Settings values) {
    values.insert(set.begin(), set.end());  // if they are not there
    return make(values);
  };
}

RunOptions run_options(const TypedOptions& typed, const UserProblem& problem, ivp::State x0) {
  RunOptions r{
      .x0 = std::move(x0),
      .t0 = typed.from.value_or(problem.t0),
      .t1 = 0,
      .settings = typed.settings,
      .every = typed.every,
      .limits = {.seconds = typed.limit.value_or(scene::Options::usual_limit),
                 .largest_step = typed.largest_step.value_or(std::numeric_limits<double>::infinity())},
      .section = !typed.section.empty(),
      .verify = !typed.settings.step && !typed.no_verify,
      .draw = !typed.plot.empty()};
  if (r.settings.step && typed.largest_step)
    throw input_error("--step {} --largest-step {}: give equal steps or a bound on chosen ones, not both",
                      *r.settings.step, *typed.largest_step);
  const std::optional<double> end = typed.until ? typed.until : problem.t1;
  if (!end && typed.states.empty())
    throw input_error("--until: give the time at which it ends{}",
                      typed.problem.empty() ? ", or t <= ... in the text" : "");
  if (!typed.until && end && *end < r.t0)
    throw input_error(
        "--until: the text ends at t = {}, before the start at {}; give --until to run backwards", *end,
        r.t0);
  r.t1 = end.value_or(r.t0);
  r.check_rows();
  for (const std::string& text : typed.events)
    std::ranges::move(events_of("--event", text, problem), std::back_inserter(r.events));
  if (r.section && (!r.events.empty() || r.every))
    throw InputError("--section shows its own rows alone: give neither --event nor --every with it");
  if (r.section) r.events = events_of("--section", typed.section, problem);
  if (!typed.changes.empty() && r.t1 < r.t0)
    throw input_error("--set-at: goes forwards in time, and the run from {} to {} does not", r.t0, r.t1);
  for (const std::string& text : typed.changes) add_change(text, problem, r.events);
  start_with_changes(r);
  return r;
}

const ivp::MethodInfo& method_of(const TypedOptions& typed, const UserProblem& problem,
                                 const RunOptions& options) {
  const ivp::MethodInfo& method = about("--method", [&]() -> const ivp::MethodInfo& {
    return typed.method.empty() ? usual_method(problem, options) : any_method(typed.method);
  });
  const ivp::Settings& settings = options.settings;
  if (settings.step && settings.tolerance)
    throw input_error("--step {} --tolerance {}: give a step or a tolerance, not both", *settings.step,
                      *settings.tolerance);
  if (typed.largest_step && method.fixed_step())
    throw input_error(
        "--largest-step {}: {} takes equal steps; give --step, or a method that chooses its steps",
        *typed.largest_step, method.name);
  return method;
}

}  // namespace nlmech::comparison

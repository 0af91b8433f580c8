#include "nlmech/comparison/commands/run_options.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "nlmech/comparison/commands/runs.hpp"
#include "nlmech/scene/program/options.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::comparison {
namespace {

/// An event as typed: "x = 0 falling end".
WantedEvent event_of(const std::string& option, const std::string& typed, const UserProblem& problem) {
  std::string text = scene::trimmed(typed);
  const auto ends_with = [&text](std::string_view word) {
    if (text.size() <= word.size() || !text.ends_with(word) || text[text.size() - word.size() - 1] != ' ')
      return false;
    text = scene::trimmed(text.substr(0, text.size() - word.size()));
    return true;
  };
  ivp::Event event;
  event.ends = ends_with("end");
  if (ends_with("rising")) event.crossing = ivp::Crossing::rising;
  if (ends_with("falling")) event.crossing = ivp::Crossing::falling;
  event.value = problem.expression(option, text);
  return {text, std::move(event)};
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
  for (const std::string& text : typed.events) r.events.push_back(event_of("--event", text, problem));
  if (r.section && (!r.events.empty() || r.every))
    throw InputError("--section shows its own rows alone: give neither --event nor --every with it");
  if (r.section) r.events.push_back(event_of("--section", typed.section, problem));
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

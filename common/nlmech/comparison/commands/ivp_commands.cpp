#include "nlmech/comparison/commands/ivp_commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/comparison/commands/typed_problem.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::comparison {
namespace {

/// What was typed.
struct Words {
  std::string problem, equation, file, initial, method;
  double until = 0;
  std::optional<double> from, every;
  ivp::Settings settings;
  ivp::Limits limits{.seconds = 60};
  std::vector<std::string> set, events;
  std::string section;
  bool no_verify = false;
};

std::string trimmed(std::string text) {
  text.erase(0, text.find_first_not_of(" \t"));
  text.erase(text.find_last_not_of(" \t") + 1);
  return text;
}

/// "x = 0 falling end"
WantedEvent event_of(const std::string& option, const std::string& typed, const OwnProblem& problem) {
  WantedEvent event;
  std::string text = trimmed(typed);
  const auto ends_with = [&text](std::string_view word) {
    if (text.size() <= word.size() || !text.ends_with(word) || text[text.size() - word.size() - 1] != ' ')
      return false;
    text = trimmed(text.substr(0, text.size() - word.size()));
    return true;
  };
  event.ends = ends_with("end");
  if (ends_with("rising")) event.crossing = ivp::Crossing::rising;
  if (ends_with("falling")) event.crossing = ivp::Crossing::falling;
  event.text = text;
  event.value = problem.expression(option, text);
  return event;
}

/// The problem by name, or the equations that were typed or stand in a file.
std::unique_ptr<OwnProblem> problem_of(const Words& words, const OwnProblems& problems) {
  const int given = !words.problem.empty() + !words.equation.empty() + !words.file.empty();
  if (given != 1) throw InputError("give one of --problem NAME, --equation TEXT and --file NAME.ode");
  if (words.problem.empty()) {
    const bool typed = words.file.empty();
    return typed_problem(
        {typed ? "--equation" : words.file, typed ? words.equation : scene::read_whole(words.file)},
        settings_of(words.set));
  }
  auto problem = problem_by_name(problems, words.problem);
  apply_settings(*problem, words.set);
  return problem;
}

Request understand(const Words& words, const OwnProblem& problem) {
  Request r{.x0 = problem.initial_state(words.initial),
            .t0 = words.from.value_or(problem.initial_time()),
            .t1 = words.until,
            .settings = words.settings,
            .every = words.every,
            .limits = words.limits,
            .verify = !words.settings.step && !words.no_verify};
  if (r.settings.step && r.settings.tolerance)
    throw input_error("--step {} --tolerance {}: give a step or a tolerance, not both", *r.settings.step,
                      *r.settings.tolerance);
  if (r.every && std::abs(r.t1 - r.t0) / *r.every > 1e7)
    throw input_error("--every {}: more than 10 million rows", *r.every);
  for (const std::string& text : words.events) r.events.push_back(event_of("--event", text, problem));
  r.section = !words.section.empty();
  if (r.section && (!r.events.empty() || r.every))
    throw InputError("--section shows its own rows alone: give neither --event nor --every with it");
  if (r.section) r.events.push_back(event_of("--section", words.section, problem));
  return r;
}

std::string integrate(const Words& words, const OwnProblems& problems, const std::string& program) {
  const auto problem = problem_of(words, problems);
  const Request r = understand(words, *problem);
  const AnyMethod method = about(
      "--method", [&] { return any_method(words.method.empty() ? problem->usual_method(r) : words.method); });
  const Trajectory run = problem->trajectory(r, method);
  if (!run.remark.empty()) scene::tell(fmt::format("{}: {}", program, run.remark));
  return run.rows;
}

/// The names of a list, blanks beside its commas aside. "all": those of ours and of the peers in this build.
std::vector<std::string> names_of(const std::string& list) {
  if (trimmed(list) == "all") return built_method_names();
  std::vector<std::string> names;
  for (const std::string& name : scene::split(list, ',')) names.push_back(trimmed(name));
  return names;
}

/// The methods of a list, each with those of the settings that it has.
std::vector<Choice> choices(const std::string& list, const ivp::Settings& settings) {
  std::vector<Choice> all;
  for (const std::string& name : names_of(list)) {
    const AnyMethod method = about("--methods", [&] { return any_method(name); });
    all.push_back({method, settings});
    if (method.info.fixed_step()) all.back().settings.absolute_tolerance.reset();
    for (const ivp::SettingInfo* setting : ivp::own_settings) {
      if (!method.info.has(*setting)) setting->reset(all.back().settings);
    }
  }
  const auto some = [&all](auto has) { return std::any_of(all.begin(), all.end(), has); };
  if (settings.absolute_tolerance && !some([](const Choice& c) { return !c.method.info.fixed_step(); }))
    throw input_error("--absolute-tolerance {}: none of the methods {} chooses its steps",
                      *settings.absolute_tolerance, list);
  for (const ivp::SettingInfo* setting : ivp::own_settings) {
    const std::optional<double> value = setting->value(settings);
    if (value && !some([setting](const Choice& c) { return c.method.info.has(*setting); }))
      throw input_error("--{} {}: none of the methods {} has {} to choose", setting->name, *value, list,
                        setting->name);
  }
  return all;
}

std::string compare(const Words& words, const OwnProblems& problems, const std::string& program) {
  const auto problem = problem_of(words, problems);
  const Request r = understand(words, *problem);
  return problem->comparison(r, choices(words.method, r.settings), program);
}

void declare_common(scene::Options& options, Words& words) {
  options.add("--problem", words.problem, "one of the problems below");
  options.add("--equation", words.equation,
              "an equation, or several with ; between: \"x'' + 0.1 x' + x + a x^3 = cos(t); a = 3\"");
  options.add("--file", words.file, "a file of equations, definitions and initial values");
  options.add("--set", words.set, "name=value of a parameter; more of them with blanks between");
  options.add(
      "--initial", words.initial,
      "initial state: \"x=1, x'=0\", or numbers in the order of the columns; the problem's own without it");
  options.add("--from", words.from, "time at which it begins; the problem's own without it");
  options.add("--until", words.until, "time at which it ends; earlier runs backwards").required();
  ivp::Settings& s = words.settings;
  options.add("--step", s.step, "length of a step, for methods of fixed step and series").positive();
  options
      .add("--tolerance", s.tolerance,
           "relative and absolute; 1e-9 without it. Methods of fixed step shorten their step until two runs "
           "agree "
           "with each other and with another method")
      .positive();
  options
      .add("--absolute-tolerance", s.absolute_tolerance,
           "for components that become small; --tolerance without it. Not for fixed steps")
      .positive();
  options.limit(words.limits.seconds);
}

/// What some methods have and others have not: options for those that at least one of @p methods has.
void declare_settings(scene::Options& options, ivp::Settings& s, const std::vector<std::string>& methods) {
  for (const ivp::SettingInfo* setting : ivp::own_settings) {
    const auto has = [&](const std::string& name) { return any_method(name).info.has(*setting); };
    if (std::none_of(methods.begin(), methods.end(), has)) continue;
    scene::Option& option = std::visit(
        [&](auto member) -> scene::Option& {
          return options.add(fmt::format("--{}", setting->name), s.*member, std::string(setting->meaning));
        },
        setting->member);
    if (setting->most > 0)
      option.range(setting->least, setting->most);
    else
      option.positive();
  }
}

std::string describe_all(const OwnProblems& problems) {
  return fmt::format("{}Methods: {}", describe_problems(problems), fmt::join(any_method_names(), " "));
}

}  // namespace

void add_integrate_command(scene::Commands& commands, const OwnProblems& problems,
                           const std::string& method) {
  const auto declare = [&](scene::Options& options, Words& words) {
    declare_common(options, words);
    words.method = method;
    options.add("--method", words.method,
                method.empty()
                    ? "one of the methods below; without it adaptive-collocation for what decays fast, and "
                      "series for all else"
                    : "one of the methods below");
    declare_settings(options, words.settings, any_method_names());
    options.add("--every", words.every, "rows at this distance in time; without it the first and the last")
        .positive();
    options.add("--event", words.events,
                "a row where this becomes zero, as \"x=0\", \"x=0 falling\", \"x'=0 rising end\" (the run "
                "ends there)");
    options.add("--section", words.section, "Poincare section: rows there alone, as \"x=0 rising\"");
    options.add("--no-verify", words.no_verify,
                "print the run without holding it to an independent one, which every run by a tolerance is");
    options.footer(describe_all(problems));
  };
  commands.add<Words>("integrate", "An equation from begin to end, as CSV: t,x,x',...", declare,
                      [problems, program = commands.program()](const Words& words) {
                        return integrate(words, problems, program);
                      });
}

void add_compare_command(scene::Commands& commands, const OwnProblems& problems) {
  const auto declare = [&](scene::Options& options, Words& words) {
    declare_common(options, words);
    options
        .add("--methods", words.method,
             "methods with commas between: rbf-coll,ode45,cvode-adams; or all; they "
             "share the limit")
        .required();
    declare_settings(options, words.settings, any_method_names());
    options.footer(describe_all(problems));
  };
  commands.add<Words>(
      "compare",
      "Methods side by side: method,setting,status,digits,seconds,rhs_evaluations,controlled,note as CSV",
      declare, [problems, program = commands.program()](const Words& words) {
        return compare(words, problems, program);
      });
}

}  // namespace nlmech::comparison

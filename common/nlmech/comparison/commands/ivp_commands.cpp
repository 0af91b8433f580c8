#include "nlmech/comparison/commands/ivp_commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/comparison/choice/choice_rows.hpp"
#include "nlmech/comparison/commands/catalogue_run.hpp"
#include "nlmech/comparison/commands/choices.hpp"
#include "nlmech/comparison/commands/run_figure.hpp"
#include "nlmech/comparison/commands/typed_problem.hpp"
#include "nlmech/scene/catalogue/shard.hpp"
#include "nlmech/scene/picture.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/echo.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::comparison {
namespace {

/// What was typed.
struct Words {
  std::string problem, equation, file, initial, method, tolerances, plot;
  std::optional<double> until, from, every;
  ivp::Settings settings;
  std::optional<double> limit, largest_step;
  std::vector<std::string> set, events;
  std::string section, states, shard;
  std::optional<int> threads;
  bool no_verify = false;
  int digits = 9;
};

/// The problem by name, or the equations that were typed or stand in a file.
/// @param equations what was typed or read @param values of parameters, in place of those that were typed
std::unique_ptr<OwnProblem> problem_of(const Words& words, const OwnProblems& problems,
                                       const program::SourceText& equations,
                                       const CatalogueRuns::Values& values) {
  if (words.problem.empty()) {
    auto settings = settings_of(words.set);
    for (const auto& [name, value] : values) settings[name] = value;
    return typed_problem(equations, settings);
  }
  auto problem = problem_by_name(problems, words.problem);
  apply_settings(*problem, words.set);
  for (const auto& [name, value] : values) problem->set_parameter(name, value);
  return problem;
}

/// The equations, if they were typed or stand in a file.
program::SourceText equations_of(const Words& words) {
  const int given = !words.problem.empty() + !words.equation.empty() + !words.file.empty();
  if (given != 1) throw InputError("give one of --problem NAME, --equation TEXT and --file NAME.ode");
  if (words.file.empty()) return {"--equation", words.equation};
  return {words.file, read_equations(words.file)};
}

std::unique_ptr<OwnProblem> problem_of(const Words& words, const OwnProblems& problems) {
  return problem_of(words, problems, equations_of(words), {});
}

Request understand(const Words& words, const OwnProblem& problem, std::vector<double> x0) {
  Request r{.x0 = std::move(x0),
            .t0 = words.from.value_or(problem.initial_time()),
            .t1 = 0,
            .settings = words.settings,
            .every = words.every,
            .limits = {.seconds = words.limit.value_or(scene::Options::usual_limit),
                       .largest_step = words.largest_step.value_or(std::numeric_limits<double>::infinity())},
            .verify = !words.settings.step && !words.no_verify};
  if (r.settings.step && words.largest_step)
    throw input_error("--step {} --largest-step {}: give equal steps or a bound on chosen ones, not both",
                      *r.settings.step, *words.largest_step);
  const std::optional<double> end = words.until ? words.until : problem.final_time();
  if (!end && words.states.empty())
    throw InputError(words.problem.empty()
                         ? "--until: give the time at which it ends, or t <= ... in the text"
                         : "--until: give the time at which it ends");
  if (!words.until && end && *end < r.t0)
    throw input_error(
        "--until: the text ends at t = {}, before the start at {}; give --until to run backwards", *end,
        r.t0);
  r.t1 = end.value_or(r.t0);
  check_rows(r);
  for (const std::string& text : words.events) r.events.push_back(event_of("--event", text, problem));
  r.section = !words.section.empty();
  if (r.section && (!r.events.empty() || r.every))
    throw InputError("--section shows its own rows alone: give neither --event nor --every with it");
  if (r.section) r.events.push_back(event_of("--section", words.section, problem));
  r.draw = !words.plot.empty();
  return r;
}

Request understand(const Words& words, const OwnProblem& problem) {
  return understand(words, problem, problem.initial_state(words.initial));
}

/// The one that was typed, or else the usual one.
ivp::MethodInfo method_of(const Words& words, const OwnProblem& problem, const Request& r) {
  ivp::MethodInfo method = about(
      "--method", [&] { return any_method(words.method.empty() ? problem.usual_method(r) : words.method); });
  if (r.settings.step && r.settings.tolerance)
    throw input_error("--step {} --tolerance {}: give a step or a tolerance, not both", *r.settings.step,
                      *r.settings.tolerance);
  if (words.largest_step && method.fixed_step())
    throw input_error(
        "--largest-step {}: {} takes equal steps; give --step, or a method that chooses its steps",
        *words.largest_step, method.name);
  return method;
}

/// Above a picture: what was typed, if it fits.
std::string heading_of(const Words& words) {
  constexpr std::size_t most = 60;
  std::string text = words.equation;
  if (!words.problem.empty()) text = words.problem;
  if (!words.file.empty()) text = std::filesystem::path(words.file).filename().string();
  return echoed(text, most);
}

/// A run for each row of a file.
int integrate_all(const Words& words, const OwnProblems& problems, const std::string& program) {
  if (!words.plot.empty()) throw input_error("--plot {}: --states draws none", words.plot);
  const program::SourceText equations = equations_of(words);
  CatalogueRuns runs;
  runs.program = program;
  runs.file = words.states;
  runs.shard = words.shard;
  runs.threads = words.threads.value_or(0);
  runs.seconds = words.limit.value_or(runs.seconds);
  runs.until = words.until;
  runs.problem = [&](const CatalogueRuns::Values& values) {
    return problem_of(words, problems, equations, values);
  };
  runs.initial_state = [&](const OwnProblem& problem) { return problem.initial_state(words.initial); };
  runs.is_initial_given = !words.initial.empty();
  runs.request = [&](const OwnProblem& problem, std::vector<double> x0) {
    return understand(words, problem, std::move(x0));
  };
  runs.method = [&](const OwnProblem& problem, const Request& r) { return method_of(words, problem, r); };
  const double from = words.from.value_or(runs.problem({})->initial_time());
  runs.typed = fmt::format("{} {} {} {} {} {} {} {} {} {} {}", words.problem, equations.text(),
                           fmt::join(words.set, " "), words.initial, from, words.until.value_or(from),
                           words.no_verify, words.every.value_or(0), fmt::join(words.events, " "),
                           words.section, words.largest_step.value_or(0));
  return print_runs(runs);
}

int integrate(const Words& words, const OwnProblems& problems, const std::string& program) {
  if (!words.states.empty()) return integrate_all(words, problems, program);
  if (words.threads) throw input_error("--threads {}: is about --states", *words.threads);
  if (!words.shard.empty()) throw input_error("--shard {}: is about --states", words.shard);
  const auto problem = problem_of(words, problems);
  const scene::Picture picture(words.plot);
  const Request r = understand(words, *problem);
  const ivp::MethodInfo& method = method_of(words, *problem, r);
  const Trajectory run = problem->trajectory(r, method);
  if (!run.remark.empty()) scene::tell(fmt::format("{}: {}", program, run.remark));
  scene::print_result(run.rows);
  if (picture.wanted())
    picture.draw([&] {
      return r.section ? section_figure(run.seen, heading_of(words))
                       : run_figure(run.seen, heading_of(words));
    });
  return 0;
}

void compare(const Words& words, const OwnProblems& problems, const std::string& program) {
  const auto problem = problem_of(words, problems);
  const scene::Picture picture(words.plot);
  if (!words.tolerances.empty() && words.settings.tolerance)
    throw InputError("--tolerances: give no --tolerance with it");
  const Request r = understand(words, *problem);
  const auto methods = words.method.empty() ? problem->usual_methods(r) : method_list(words.method);
  const auto tolerances = words.tolerances.empty() ? std::vector<double>() : tolerance_list(words.tolerances);
  if (words.largest_step &&
      std::ranges::all_of(methods, [](const std::string& name) { return any_method(name).fixed_step(); }))
    throw input_error("--largest-step {}: none of the methods {} chooses its steps; give --step",
                      *words.largest_step, fmt::join(methods, ","));
  const Comparison found = problem->comparison(r, choices(methods, r.settings, tolerances), program);
  scene::print_result(found.rows);
  if (picture.wanted()) picture.draw([&] { return comparison_figure(found, heading_of(words)); });
}

/// The words of a command that runs the first of a choice.
std::vector<std::string> run_of(const Words& words, double until, const Ranked& first,
                                const std::string& program) {
  std::vector<std::string> all = {program, "integrate"};
  const auto add = [&all](const char* option, const std::string& text) {
    if (!text.empty()) all.insert(all.end(), {option, text});
  };
  add("--problem", words.problem);
  add("--equation", words.equation);
  add("--file", words.file);
  if (!words.set.empty()) all.emplace_back("--set");
  all.insert(all.end(), words.set.begin(), words.set.end());
  add("--initial", words.initial);
  if (words.from) add("--from", fmt::format("{}", *words.from));
  add("--until", fmt::format("{}", until));
  add("--method", first.method);
  add("--tolerance", fmt::format("{:.1e}", first.tolerance));
  if (words.settings.absolute_tolerance)
    add("--absolute-tolerance", fmt::format("{}", *words.settings.absolute_tolerance));
  if (words.largest_step) add("--largest-step", fmt::format("{}", *words.largest_step));
  return all;
}

void choose(const Words& words, const OwnProblems& problems, const std::string& program) {
  const auto problem = problem_of(words, problems);
  const Request r = understand(words, *problem);
  if (r.t0 == r.t1) throw input_error("--until {}: is where it begins; there is nothing to choose for", r.t1);
  const Chosen found = problem->chosen(r, words.digits);
  const std::string rows = choice_rows(found), remark = choice_remark(found);
  if (!remark.empty()) scene::tell(fmt::format("{}: {}", program, remark));
  scene::print_last_result(rows);
  scene::tell(shell_line(run_of(words, r.t1, found.ranked.front(), program)));
}

/// @param many the option with which it may take as long as it takes, and ends may stand in a file; or empty
void declare_problem(scene::Options& options, Words& words, const std::string& many = {}) {
  options.add("--problem", words.problem, "one of the problems below");
  options.add("--equation", words.equation,
              "an equation, or several with ; between: \"x'' + 0.1 x' + x + a x^3 = cos(t); a = 3\"");
  options.add("--file", words.file, "a file of equations, definitions and initial values");
  options.add("--set", words.set, "name=value of a parameter; more of them with blanks between");
  options.add("--initial", words.initial,
              "initial state: \"x=1, x'=0\", or numbers in the order of the columns, in which the text first "
              "names the "
              "unknowns; the problem's own without it");
  options.add("--from", words.from, "time at which it begins; the problem's own without it");
  options.add(
      "--until", words.until,
      fmt::format("time at which it ends; earlier runs backwards. Required but where the text says t <= "
                  "...{}",
                  many.empty() ? "" : fmt::format(", or {} has a column until", many)));
}

void declare_largest_step(scene::Options& options, Words& words) {
  options
      .add("--largest-step", words.largest_step,
           "longest step of methods that choose their steps; no bound without it. For a short pulse after a "
           "long rest: half of the pulse's length")
      .positive();
}

void declare_common(scene::Options& options, Words& words, const std::string& many = {}) {
  declare_problem(options, words, many);
  ivp::Settings& s = words.settings;
  options.add("--step", s.step, "length of a step, for methods of fixed step and series").positive();
  options
      .add("--tolerance", s.tolerance,
           "relative and absolute, of the error of a step; 1e-9 without it. For methods that choose their "
           "steps")
      .positive();
  options
      .add("--absolute-tolerance", s.absolute_tolerance,
           "for components that become small; --tolerance without it")
      .positive();
  declare_largest_step(options, words);
  options.limit(words.limit, many);
}

/// What some methods have and others have not: options for those that at least one of @p methods has.
void declare_settings(scene::Options& options, ivp::Settings& s, const std::vector<std::string>& methods) {
  for (const ivp::SettingInfo* setting : ivp::own_settings) {
    const auto has = [&](const std::string& name) { return any_method(name).has(*setting); };
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

/// `merge`
struct Parts {
  std::vector<std::string> files;
};

void declare_parts(scene::Options& options, Parts& parts) {
  options.add("parts", parts.files, "files written by integrate --shard").required();
}

int merge(const Parts& parts) {
  scene::print_merged(parts.files);
  return 0;
}

}  // namespace

void add_integrate_command(scene::Commands& commands, const OwnProblems& problems) {
  const auto declare = [&](scene::Options& options, Words& words) {
    declare_common(options, words, "--states");
    options.add("--method", words.method,
                "one of the methods below; without it the first that choose would list for the digits of the "
                "tolerance");
    declare_settings(options, words.settings, any_method_names());
    options.add("--every", words.every, "rows at this distance in time; without it the first and the last")
        .positive();
    options.add("--event", words.events,
                "a row where this becomes zero, as \"x=0\", \"x=0 falling\", \"x'=0 rising end\" (the run "
                "ends there)");
    options.add("--section", words.section, "Poincare section: rows there alone, as \"x=0 rising\"");
    options.add("--no-verify", words.no_verify,
                "print the run without holding it to an independent one, which every run by a tolerance is");
    options.add(
        "--plot", words.plot,
        "draws the unknowns against time, or the section: a name.svg, over an older such picture alone");
    options.add(
        "--states", words.states,
        "CSV with a run a row: columns are unknowns and parameters, named exactly as in the equations; "
        "others are handed on; - is standard input");
    options.add("--threads", words.threads, "of --states, how many; without it one a processor")
        .range(1, 1024);
    options.add("--shard", words.shard,
                "of --states, i/n: the i-th of n disjoint parts, for merge of integrators");
    options.footer(describe_all(problems));
  };
  commands.add<Words>(
      "integrate",
      "An equation from begin to end, as CSV: t,x,x',...; of many rows of a file: row,t,x,x',...,status",
      declare, [problems, program = commands.program()](const Words& words) {
        return integrate(words, problems, program);
      });
}

void add_merge_command(scene::Commands& commands) {
  commands.add("merge",
               "Joins all shards of one run over --states, given in any order, to what one run writes",
               declare_parts, merge);
}

void add_choose_command(scene::Commands& commands, const OwnProblems& problems) {
  const auto declare = [&](scene::Options& options, Words& words) {
    declare_problem(options, words);
    options.add("--digits", words.digits, "correct digits at the end").range(1, 14);
    options
        .add("--absolute-tolerance", words.settings.absolute_tolerance,
             "error that does not count in components that become small; as for 1 without it")
        .positive();
    declare_largest_step(options, words);
    options.footer(describe_all(problems));
  };
  commands.add<Words>(
      "choose",
      "Methods for an equation by a list of rules: rank,method,tolerance,seconds,reason as CSV; on standard "
      "error the command that runs the first",
      declare, [problems, program = commands.program()](const Words& words) {
        return choose(words, problems, program);
      });
}

void add_compare_command(scene::Commands& commands, const OwnProblems& problems) {
  const auto declare = [&](scene::Options& options, Words& words) {
    declare_common(options, words);
    options.add(
        "--methods", words.method,
        "methods with commas between: rbf-coll,ode45,cvode-adams; or all. They share the limit. Without "
        "it those that suit the problem, and the best peer of each kind");
    options.add("--tolerances", words.tolerances,
                "a sweep instead of one tolerance: 1e-3:1e-12 by decades, or 1e-3,1e-6");
    declare_settings(options, words.settings, any_method_names());
    options.add("--plot", words.plot,
                "draws digits against run time: a name.svg, over an older such picture alone");
    options.footer(describe_all(problems));
  };
  commands.add<Words>(
      "compare", "Methods side by side: method,setting,status,digits,seconds,right_hand_sides,note as CSV",
      declare, [problems, program = commands.program()](const Words& words) {
        return compare(words, problems, program);
      });
}

}  // namespace nlmech::comparison

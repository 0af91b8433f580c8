#include "nlmech/comparison/commands/ivp_commands.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "nlmech/comparison/commands/compare.hpp"
#include "nlmech/comparison/commands/remarks.hpp"
#include "nlmech/comparison/commands/run_figure.hpp"
#include "nlmech/comparison/commands/runs.hpp"
#include "nlmech/scene/picture.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::comparison {
namespace {

/// Heading of a figure: the problem, file or equation as typed, shortened to 60 characters.
std::string heading_of(const TypedOptions& typed) {
  constexpr std::size_t most = 60;
  std::string text = typed.equation;
  if (!typed.problem.empty()) text = typed.problem;
  if (!typed.file.empty()) text = std::filesystem::path(typed.file).filename().string();
  return quoted_input(text, most);
}

int integrate(const TypedOptions& typed, const std::string& program) {
  if (!typed.sensitivities.empty() && !typed.states.empty())
    throw input_error("--sensitivities {}: belongs to a single run; leave out --states",
                      quoted_input(typed.sensitivities));
  if (typed.control_sensitivities && typed.sensitivities.empty())
    throw InputError("--control-sensitivities: needs --sensitivities");
  if (!typed.states.empty()) return print_runs(typed, program);
  if (typed.threads)
    throw input_error("--threads {}: applies to --states only; leave it out", *typed.threads);
  const UserProblem problem = problem_of(typed)({});
  const scene::Picture picture(typed.plot);
  const RunOptions options = run_options(typed, problem, problem.initial_state(typed.initial));
  const ivp::MethodInfo& method = method_of(typed, problem, options);
  const Trajectory run = typed.method.empty() ? default_trajectory(problem, options, method)
                                              : trajectory(problem, options, method);
  std::vector<std::string> remarks = remarks_on(problem, options);
  remarks.insert(remarks.end(), {run.remark, run.small});
  for (const std::string& remark : remarks) {
    if (!remark.empty()) scene::print_message(fmt::format("{}: {}", program, remark));
  }
  scene::print_result(run.rows);
  if (picture.wanted())
    picture.draw([&] {
      return options.section ? section_figure(run.samples, heading_of(typed))
                             : run_figure(run.samples, heading_of(typed));
    });
  return 0;
}

/// The typed problem. @throws InputError if its text has events, which @p command does not support
UserProblem without_events(const TypedOptions& typed, std::string_view command) {
  UserProblem problem = problem_of(typed)({});
  if (!problem.event_lines.empty())
    throw input_error("when {}: {} does not support events; take integrate, or remove them",
                      problem.event_lines.front().event, command);
  return problem;
}

void compare(const TypedOptions& typed, const std::string& program) {
  const UserProblem problem = without_events(typed, "compare");
  const scene::Picture picture(typed.plot);
  if (!typed.tolerances.empty() && typed.settings.tolerance)
    throw InputError("--tolerances: excludes --tolerance; give one of them");
  const RunOptions options = run_options(typed, problem, problem.initial_state(typed.initial));
  const auto say = [&program](const std::string& message) {
    scene::print_message(fmt::format("{}: {}", program, message));
  };
  const Comparison found = comparison(problem, options, choices(typed, problem, options), say);
  scene::print_result(found.rows);
  if (picture.wanted()) picture.draw([&] { return comparison_figure(found.lines, heading_of(typed)); });
}

/// Command line that runs the first method of a ranking.
std::vector<std::string> run_of(const TypedOptions& typed, double until, const Ranked& first,
                                const std::string& program) {
  std::vector<std::string> all = {program, "integrate"};
  const auto add = [&all](const char* option, const std::string& text) {
    if (!text.empty()) all.insert(all.end(), {option, text});
  };
  add("--problem", typed.problem);
  add("--equation", typed.equation);
  add("--file", typed.file);
  if (!typed.set.empty()) all.emplace_back("--set");
  all.insert(all.end(), typed.set.begin(), typed.set.end());
  add("--initial", typed.initial);
  add("--from", typed.from);
  add("--until", fmt::format("{}", until));
  add("--method", first.method);
  add("--tolerance", fmt::format("{:.1e}", first.tolerance));
  if (typed.settings.absolute_tolerance)
    add("--absolute-tolerance", fmt::format("{}", *typed.settings.absolute_tolerance));
  if (typed.largest_step) add("--largest-step", fmt::format("{}", *typed.largest_step));
  return all;
}

void choose(const TypedOptions& typed, const std::string& program) {
  const UserProblem problem = without_events(typed, "choose");
  const RunOptions r = run_options(typed, problem, problem.initial_state(typed.initial));
  if (r.t0 == r.t1) throw input_error("--until {}: is the start time; give another end", r.t1);
  ChoiceRequest q = choice_request(problem, r);
  if (r.settings.absolute_tolerance)  // absolute error, independent of the digits
    q.absolute = *r.settings.absolute_tolerance * std::pow(10, typed.digits);
  const MethodChoice found = choose(q, typed.digits, examine(q));
  const std::string rows = choice_rows(found), remark = choice_remark(found);
  if (!remark.empty()) scene::print_message(fmt::format("{}: {}", program, remark));
  scene::print_last_result(rows);
  scene::print_message(shell_line(run_of(typed, r.t1, found.ranked.front(), program)));
}

/// @param many option of a file of many runs, which may have a column of end times; or empty
void declare_problem(scene::Options& options, TypedOptions& typed, const std::string& many = {}) {
  options.add("--problem", typed.problem, "one of the problems below");
  options.add("--equation", typed.equation,
              "equations, separated by ;, as \"x'' + 0.1 x' + x + a x^3 = cos(t); a = 3\"");
  options.add("--file", typed.file, "file of equations, definitions and initial values");
  options.add("--set", typed.set, "parameters: name=value, several separated by blanks");
  options.add("--initial", typed.initial,
              "initial state: \"x=1, x'=0\", or numbers in the order in which the equations first name the "
              "unknowns (default that of the problem). If all are named, the columns follow this order");
  options.add("--from", typed.from,
              "start time, a number or an expression of definitions and pi (default that of the problem)");
  options.add("--until", typed.until,
              fmt::format("end time, as 10 or \"2 pi/w\"; before the start the run goes backwards. Required "
                          "unless the equations contain t <= ...{}",
                          many.empty() ? "" : fmt::format(" or {} has a column until", many)));
}

void declare_largest_step(scene::Options& options, TypedOptions& typed) {
  options
      .add("--largest-step", typed.largest_step,
           "largest step of adaptive methods (default unlimited). For a short pulse after a long rest: half "
           "of the duration of the pulse")
      .positive();
}

void declare_common(scene::Options& options, TypedOptions& typed, const std::string& many = {}) {
  declare_problem(options, typed, many);
  ivp::Settings& s = typed.settings;
  options.add("--step", typed.step, "step size, for methods with fixed steps and series");
  options
      .add("--tolerance", s.tolerance,
           "relative and absolute tolerance for the error of a step, for adaptive methods (default 1e-9)")
      .positive();
  options
      .add("--absolute-tolerance", s.absolute_tolerance,
           "absolute tolerance, for components that become small (default --tolerance)")
      .positive();
  declare_largest_step(options, typed);
  options.limit(typed.limit, many);
}

/// Declares the settings that only some methods have.
void declare_settings(scene::Options& options, ivp::Settings& s) {
  for (const ivp::SettingInfo* setting : ivp::own_settings) {
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

std::string describe_all() {
  return fmt::format("{}Methods: {}", describe_problems(), fmt::join(any_method_names(), " "));
}

void add_integrate(scene::Commands& commands) {
  const auto declare = [&](scene::Options& options, TypedOptions& typed) {
    declare_common(options, typed, "--states");
    options.add("--method", typed.method,
                "one of the methods below (default the first one that choose lists for the digits of the "
                "tolerance, or another one if its run fails or is wrong)");
    declare_settings(options, typed.settings);
    options.add("--every", typed.every, "interval between the times of rows (default only start and end)");
    options.add("--at", typed.at, "further times of rows, separated by commas: 1,2.5,3 pi");
    options.add("--columns", typed.columns,
                "further columns: \"E = x'^2/2 + x^2/2; r; x''\", new definitions, names of definitions, "
                "highest derivatives");
    options.add("--sensitivities", typed.sensitivities,
                "further columns dx/da: derivatives of the solution at fixed time by initial values (named "
                "as x; all for all) and parameters: \"x,x',a\"");
    options.add("--control-sensitivities", typed.control_sensitivities,
                "let the tolerance also bound the errors of the sensitivities in each step (default only "
                "those of the solution)");
    options.add(
        "--event", typed.events,
        "print a row at each zero: \"x=0\", \"apex: x'=0 falling\" (with a name), \"x=0 rising end\" (end "
        "the run there), \"x=0 end after 3\", \"dose: t = 0:24:240\" (first time, interval, last time)");
    options.add("--set-at", typed.changes,
                "change the state at the events of a name: \"bounce: y' = -0.8 y'\"; several changes "
                "separated by ;. Two rows are printed at each, before and after");
    options.add("--section", typed.section, "Poincare section, as \"x=0 rising\": print only the rows on it");
    options.add("--no-verify", typed.no_verify,
                "print the run without verifying it by an independent one (runs with a tolerance are "
                "verified by default)");
    options.add("--plot", typed.plot,
                "draw the unknowns over time, or the section, to a file NAME.svg; only a figure drawn by "
                "nlmech is overwritten");
    options.add("--states", typed.states,
                "CSV file with one run per row: columns are unknowns and parameters, named as in the "
                "equations; other columns are passed through; - is standard input");
    options.add("--threads", typed.threads, "threads for --states (default one per processor)")
        .range(1, 1024);
    options.footer(describe_all());
  };
  commands.add<TypedOptions>(
      "integrate", "Integrate an equation and print t,x,x',... as CSV (with --states: row,t,x,x',...,status)",
      declare,
      [program = commands.program()](const TypedOptions& typed) { return integrate(typed, program); });
}

void add_choose(scene::Commands& commands) {
  const auto declare = [&](scene::Options& options, TypedOptions& typed) {
    declare_problem(options, typed);
    options.add("--digits", typed.digits, "correct digits wanted at the end").range(1, 14);
    options
        .add("--absolute-tolerance", typed.settings.absolute_tolerance,
             "absolute error allowed, for components that become small (default that of a component of size "
             "1)")
        .positive();
    declare_largest_step(options, typed);
    options.footer(describe_all());
  };
  commands.add<TypedOptions>(
      "choose",
      "Choose methods for an equation by a list of rules and print rank,method,tolerance,seconds,reason as "
      "CSV; on standard error the command that runs the first",
      declare, [program = commands.program()](const TypedOptions& typed) { return choose(typed, program); });
}

void add_compare(scene::Commands& commands) {
  const auto declare = [&](scene::Options& options, TypedOptions& typed) {
    declare_common(options, typed);
    options.add("--methods", typed.method,
                "methods, separated by commas: rbf-coll,ode45,cvode-adams; or all (default those that suit "
                "the problem and the best peer of each kind). The time limit is for all together");
    options.add("--tolerances", typed.tolerances,
                "several tolerances instead of one: 1e-3:1e-12 by decades, or 1e-3,1e-6");
    declare_settings(options, typed.settings);
    options.add("--plot", typed.plot,
                "draw digits over run time to a file NAME.svg; only a figure drawn by nlmech is overwritten");
    options.footer(describe_all());
  };
  commands.add<TypedOptions>(
      "compare",
      "Compare methods and print method,setting,status,digits,seconds,right_hand_sides,note as CSV", declare,
      [program = commands.program()](const TypedOptions& typed) { return compare(typed, program); });
}

}  // namespace

void add_ivp_commands(scene::Commands& commands) {
  add_integrate(commands);
  add_compare(commands);
  add_choose(commands);
}

}  // namespace nlmech::comparison

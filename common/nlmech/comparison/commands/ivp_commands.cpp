#include "nlmech/comparison/commands/ivp_commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/scene/program/command.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::comparison {
namespace {

/// What was typed.
struct Words {
  std::string problem, initial, until, from, method, step, tolerance, absolute, nodes, shape, order, points,
      every, limit = scene::usual_limit;
  std::vector<std::string> set;
  bool no_verify = false;
};

std::optional<double> positive(const char* option, const std::string& text) {
  if (text.empty()) return {};
  return scene::typed_positive(option, text);
}

std::optional<int> whole(const char* option, const std::string& text, int least, int most) {
  if (text.empty()) return {};
  return scene::typed_whole(option, text, least, most);
}

Request understand(const Words& words, OwnProblem& problem) {
  apply_settings(problem, words.set);
  Request r;
  r.x0 = initial_state(problem, words.initial);
  r.t0 = words.from.empty() ? problem.initial_time() : scene::typed_number("--from", words.from);
  r.t1 = scene::typed_number("--until", words.until);
  if (!words.step.empty() && !words.tolerance.empty())
    throw InputError(fmt::format("--step {} --tolerance {}: give a step or a tolerance, not both", words.step,
                                 words.tolerance));
  r.settings = {.step = positive("--step", words.step),
                .tolerance = positive("--tolerance", words.tolerance),
                .absolute_tolerance = positive("--absolute-tolerance", words.absolute),
                .nodes = whole("--nodes", words.nodes, 2, 200),
                .shape = positive("--shape", words.shape),
                .order = whole("--order", words.order, 2, 100),
                .points = whole("--points", words.points, 1, 8)};
  r.every = positive("--every", words.every);
  if (r.every && std::abs(r.t1 - r.t0) / *r.every > 1e7)
    throw InputError(fmt::format("--every {}: more than 10 million rows", words.every));
  r.limits.seconds = *positive("--limit", words.limit);
  r.verify = !r.settings.step && !words.no_verify;
  return r;
}

void integrate(const Words& words, const OwnProblems& problems, const std::string& program) {
  const auto problem = problem_by_name(problems, words.problem);
  const Request r = understand(words, *problem);
  const AnyMethod method = about("--method", [&] { return any_method(words.method); });
  const Trajectory run = problem->trajectory(r, method);
  if (!run.remark.empty()) scene::tell(fmt::format("{}: {}", program, run.remark));
  scene::print_result(run.rows);
}

std::string trimmed(std::string text) {
  text.erase(0, text.find_first_not_of(" \t"));
  text.erase(text.find_last_not_of(" \t") + 1);
  return text;
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
    if (method.fixed_step) all.back().settings.absolute_tolerance.reset();
    if (!method.has_nodes) all.back().settings.nodes.reset();
    if (!method.has_shape) all.back().settings.shape.reset();
    if (!method.has_order) all.back().settings.order.reset();
    if (!method.has_points) all.back().settings.points.reset();
  }
  const auto some = [&all](auto has) { return std::any_of(all.begin(), all.end(), has); };
  if (settings.absolute_tolerance && !some([](const Choice& c) { return !c.method.fixed_step; }))
    throw InputError(fmt::format("--absolute-tolerance {}: none of the methods {} chooses its steps",
                                 *settings.absolute_tolerance, list));
  if (settings.nodes && !some([](const Choice& c) { return c.method.has_nodes; }))
    throw InputError(fmt::format("--nodes {}: none of the methods {} has nodes", *settings.nodes, list));
  if (settings.shape && !some([](const Choice& c) { return c.method.has_shape; }))
    throw InputError(fmt::format("--shape {}: none of the methods {} has a shape", *settings.shape, list));
  if (settings.order && !some([](const Choice& c) { return c.method.has_order; }))
    throw InputError(fmt::format("--order {}: none of the methods {} has an order", *settings.order, list));
  if (settings.points && !some([](const Choice& c) { return c.method.has_points; }))
    throw InputError(fmt::format("--points {}: none of the methods {} has points", *settings.points, list));
  return all;
}

void compare(const Words& words, const OwnProblems& problems, const std::string& program) {
  const auto problem = problem_by_name(problems, words.problem);
  const Request r = understand(words, *problem);
  scene::print_result(problem->comparison(r, choices(words.method, r.settings), program));
}

void add_common(CLI::App& command, Words& words) {
  command.add_option("--problem", words.problem, "which equation: see below")->required();
  command.add_option("--set", words.set, "name=value of a parameter; more of them with blanks between");
  command.add_option("--initial", words.initial,
                     "initial state: positions, then velocities, as in 1,-0.5; the problem's own without it");
  command.add_option("--from", words.from, "time at which it begins; the problem's own without it");
  command.add_option("--until", words.until, "time at which it ends; earlier runs backwards")->required();
  command.add_option("--step", words.step, "length of a step, for methods of fixed step and series");
  command.add_option("--tolerance", words.tolerance,
                     "relative and absolute; 1e-9 without it. Methods of fixed step shorten their step until "
                     "two runs agree with each other and with another method");
  command.add_option("--absolute-tolerance", words.absolute,
                     "for components that become small; --tolerance without it. Not for fixed steps");
}

/// What some methods have and others have not: options for those that at least one of @p methods has.
void add_method_settings(CLI::App& command, Words& words, const std::vector<std::string>& methods) {
  const auto some = [&](bool AnyMethod::*has) {
    return std::any_of(methods.begin(), methods.end(),
                       [&](const auto& name) { return any_method(name).*has; });
  };
  if (some(&AnyMethod::has_nodes))
    command.add_option("--nodes", words.nodes, "nodes a step of a collocation, 2 to 200");
  if (some(&AnyMethod::has_shape))
    command.add_option("--shape", words.shape, "c of rbf-coll, 1/time; (N - 1)/(4 step) without it");
  if (some(&AnyMethod::has_order))
    command.add_option("--order", words.order,
                       "N of series, 2 to 100; by the tolerance without it, 20 with a step");
  if (some(&AnyMethod::has_points))
    command.add_option("--points", words.points, "p of mtl, steps solved at once, 1 to 8; 3 without it");
}

std::string describe_all(const OwnProblems& problems) {
  return fmt::format("{}Methods: {}", describe_problems(problems), fmt::join(any_method_names(), " "));
}

}  // namespace

void add_integrate_command(CLI::App& app, const OwnProblems& problems,
                           const std::vector<std::string>& methods) {
  const auto words = std::make_shared<Words>();  // lives as long as the callback
  CLI::App* command = app.add_subcommand("integrate", "A problem from begin to end, as CSV: t,x1,...,v1,...");
  add_common(*command, *words);
  if (methods.empty()) {
    command->add_option("--method", words->method, "one of the methods below")->required();
  } else {
    words->method = methods.front();
    if (methods.size() > 1)
      command->add_option("--method", words->method, fmt::format("{}", fmt::join(methods, ", ")))
          ->capture_default_str();
  }
  add_method_settings(*command, *words, methods.empty() ? any_method_names() : methods);
  command->footer(methods.empty() ? describe_all(problems) : describe_problems(problems));
  command->add_option("--every", words->every,
                      "rows at this distance in time; without it the first and the last");
  command->add_flag(
      "--no-verify", words->no_verify,
      "print the run without holding it to an independent one, which every run by a tolerance is");
  command->add_option("--limit", words->limit, "wall time in seconds, at most")->capture_default_str();
  const std::string program = app.get_name();
  command->callback([words, problems, methods, program] {
    if (!methods.empty() && std::find(methods.begin(), methods.end(), words->method) == methods.end())
      throw InputError(fmt::format("--method {}: there is no such method here; there is {}", words->method,
                                   fmt::join(methods, ", ")));
    integrate(*words, problems, program);
  });
}

void add_compare_command(CLI::App& app, const OwnProblems& problems, const std::string& program) {
  const auto words = std::make_shared<Words>();
  CLI::App* command = app.add_subcommand(
      "compare",
      "Methods side by side: method,setting,status,digits,seconds,rhs_evaluations,controlled,note as CSV");
  add_common(*command, *words);
  command
      ->add_option("--methods", words->method,
                   "methods with commas between: rbf-coll,ode45,cvode-adams; or all")
      ->required();
  command
      ->add_option("--limit", words->limit,
                   "wall time in seconds, at most; each method gets its share of what those before it leave")
      ->capture_default_str();
  add_method_settings(*command, *words, any_method_names());
  command->footer(describe_all(problems));
  command->callback([words, problems, program] { compare(*words, problems, program); });
}

}  // namespace nlmech::comparison

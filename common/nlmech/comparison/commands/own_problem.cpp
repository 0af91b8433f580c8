#include "nlmech/comparison/commands/own_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "nlmech/program/program.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/echo.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::comparison {

std::string Choice::setting() const {
  std::string text = settings.step
                         ? fmt::format("step {}", *settings.step)
                         : fmt::format("tolerance {}", settings.tolerance.value_or(ivp::default_tolerance));
  if (settings.absolute_tolerance) text += fmt::format(" absolute {}", *settings.absolute_tolerance);
  if (settings.nodes) text += fmt::format(" nodes {}", *settings.nodes);
  if (settings.shape) text += fmt::format(" shape {}", *settings.shape);
  if (settings.order) text += fmt::format(" order {}", *settings.order);
  if (settings.points) text += fmt::format(" points {}", *settings.points);
  return text;
}

void check_rows(const Request& r) {
  if (r.every && std::abs(r.t1 - r.t0) / *r.every > 1e7)
    throw input_error("--every {}: more than 10 million rows", *r.every);
}

std::unique_ptr<OwnProblem> problem_by_name(const OwnProblems& all, const std::string& name) {
  std::vector<std::string> known;
  for (const auto& make : all) {
    auto problem = make();
    if (problem->name() == name) return problem;
    known.emplace_back(problem->name());
  }
  throw input_error("--problem {}: there is no such problem; there is {}", name, fmt::join(known, ", "));
}

std::map<std::string, double> settings_of(const std::vector<std::string>& assignments) {
  std::map<std::string, double> values;
  std::map<std::string, std::string> seen;
  for (const std::string& assignment : assignments) {
    const auto refuse = [&](std::string_view why) {
      return InputError(fmt::format("--set {}: {}", echoed(assignment), why));
    };
    const auto sign = assignment.find('=');
    if (sign == std::string::npos) throw refuse("say name=value");
    const std::string name = assignment.substr(0, sign);
    const auto [before, is_new] = seen.emplace(name, assignment);
    if (!is_new)
      throw refuse(fmt::format("{} is set twice, by {} too", echoed(name), echoed(before->second)));
    double value = 0;
    if (!scene::parse_number(assignment.substr(sign + 1), value)) throw refuse("the value is not a number");
    values[name] = value;
  }
  return values;
}

void apply_settings(OwnProblem& problem, const std::vector<std::string>& assignments) {
  for (const auto& [name, value] : settings_of(assignments)) {
    try {
      problem.set_parameter(name, value);
    } catch (const std::invalid_argument& error) {
      throw input_error("--set {}={:.6g}: {}", echoed(name), value, error.what());
    }
  }
}

namespace {

/// Equations whose unknowns are the components of a problem, with its initial state.
program::Equations components_of(const OwnProblem& problem) {
  std::string text;
  const std::vector<std::string> names = problem.state_names();
  const std::vector<double> x0 = problem.initial_state();
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format("{0}' = 0; {0}(0) = {1:.17g};", names[i], x0[i]);
  return program::Equations(program::SourceText(std::string(problem.name()), text));
}

}  // namespace

StateFunction state_function(program::Equations equations, const std::string& option,
                             const std::string& text) {
  const program::NodeId node = equations.expression(option, text);
  return [program = program::Program(equations.graph(), {node})](double t, const double* x) {
    double value = 0;
    program.run(t, x, 0, 1, [&value](int, double v) { value = v; });
    return value;
  };
}

StateFunction OwnProblem::expression(const std::string& option, const std::string& text) const {
  return state_function(components_of(*this), option, text);
}

std::vector<double> OwnProblem::initial_state(const std::string& text) const {
  if (text.empty()) return initial_state();
  if (text.find('=') != std::string::npos) return components_of(*this).initial_state("--initial", text);
  const std::vector<std::string> names = state_names();
  std::vector<double> x = scene::typed_numbers("--initial", text);
  if (x.size() != names.size())
    throw input_error("--initial {}: {} numbers for the {} components {} of {}: {}", echoed(text), x.size(),
                      names.size(), fmt::join(names, ","), name(), equation());
  return x;
}

std::string describe_problems(const OwnProblems& all) {
  std::string text = "Problems, and their parameters for --set:\n";
  for (const auto& make : all) {
    const auto problem = make();
    std::vector<std::string> settings;
    for (const auto& [name, value] : problem->parameters())
      settings.push_back(fmt::format("{}={:.6g}", name, value));
    constexpr std::size_t most = 300;
    text += fmt::format("  {}: {}\n    {}; state {}\n", problem->name(), echoed(problem->equation(), most),
                        fmt::join(settings, " "), fmt::join(problem->state_names(), ","));
  }
  return text;
}

}  // namespace nlmech::comparison

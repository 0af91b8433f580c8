#include "nlmech/comparison/commands/own_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/echo.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::comparison {

std::string Choice::setting() const {
  std::string text =
      settings.step ? fmt::format("step {:.6g}", *settings.step)
                    : fmt::format("tolerance {:.6g}", settings.tolerance.value_or(ivp::default_tolerance));
  if (settings.absolute_tolerance) text += fmt::format(" absolute {:.6g}", *settings.absolute_tolerance);
  if (settings.nodes) text += fmt::format(" nodes {}", *settings.nodes);
  if (settings.shape) text += fmt::format(" shape {:.6g}", *settings.shape);
  if (settings.order) text += fmt::format(" order {}", *settings.order);
  if (settings.points) text += fmt::format(" points {}", *settings.points);
  return text;
}

std::unique_ptr<OwnProblem> problem_by_name(const OwnProblems& all, const std::string& name) {
  std::vector<std::string> known;
  for (const auto make : all) {
    auto problem = make();
    if (problem->name() == name) return problem;
    known.emplace_back(problem->name());
  }
  throw input_error("--problem {}: there is no such problem; there is {}", name, fmt::join(known, ", "));
}

void apply_settings(OwnProblem& problem, const std::vector<std::string>& assignments) {
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
    try {
      problem.set_parameter(name, value);
    } catch (const std::invalid_argument& error) {
      throw refuse(error.what());
    }
  }
}

std::vector<double> initial_state(const OwnProblem& problem, const std::string& text) {
  if (text.empty()) return problem.initial_state();
  const std::vector<std::string> names = problem.state_names();
  std::vector<double> x = scene::typed_numbers("--initial", text);
  if (x.size() != names.size())
    throw input_error("--initial {}: {} numbers for the {} components {} of {}: {}", echoed(text), x.size(),
                      names.size(), fmt::join(names, ","), problem.name(), problem.equation());
  return x;
}

std::string describe_problems(const OwnProblems& all) {
  std::string text = "Problems, and their parameters for --set:\n";
  for (const auto make : all) {
    const auto problem = make();
    std::vector<std::string> settings;
    for (const auto& [name, value] : problem->parameters())
      settings.push_back(fmt::format("{}={:.6g}", name, value));
    text += fmt::format("  {}: {}\n    {}; state {}\n", problem->name(), problem->equation(),
                        fmt::join(settings, " "), fmt::join(problem->state_names(), ","));
  }
  return text;
}

}  // namespace nlmech::comparison

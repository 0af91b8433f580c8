#include "nlmech/comparison/own_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "nlmech/scene/csv.hpp"
#include "nlmech/scene/typed.hpp"
#include "nlmech/support/errors.hpp"

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
  throw InputError(
      fmt::format("--problem {}: there is no such problem; there is {}", name, fmt::join(known, ", ")));
}

void apply_setting(OwnProblem& problem, const std::string& assignment) {
  const auto refuse = [&](std::string_view why) {
    return InputError(fmt::format("--set {}: {}", assignment, why));
  };
  const auto sign = assignment.find('=');
  if (sign == std::string::npos) throw refuse("say name=value");
  double value = 0;
  if (!scene::parse_number(assignment.substr(sign + 1), value)) throw refuse("the value is not a number");
  try {
    problem.set_parameter(assignment.substr(0, sign), value);
  } catch (const std::invalid_argument& error) {
    throw refuse(error.what());
  }
}

std::vector<double> initial_state(const OwnProblem& problem, const std::string& text) {
  if (text.empty()) return problem.initial_state();
  const std::vector<std::string> names = problem.state_names();
  std::vector<double> x = scene::typed_numbers("--initial", text);
  if (x.size() != names.size())
    throw InputError(fmt::format("--initial {}: {} numbers for the {} components {} of {}", text, x.size(),
                                 names.size(), fmt::join(names, ","), problem.name()));
  return x;
}

std::string describe_problems(const OwnProblems& all) {
  std::string text = "Problems, and their parameters for --set:\n";
  for (const auto make : all) {
    const auto problem = make();
    std::vector<std::string> settings;
    for (const auto& [name, value] : problem->parameters())
      settings.push_back(fmt::format("{}={:.6g}", name, value));
    text += fmt::format("  {}: {}; state {}\n", problem->name(), fmt::join(settings, " "),
                        fmt::join(problem->state_names(), ","));
  }
  return text;
}

}  // namespace nlmech::comparison

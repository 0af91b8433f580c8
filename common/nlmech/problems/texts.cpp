#include "nlmech/problems/texts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/support/sentences.hpp"

namespace nlmech::problems {
namespace {

program::Equations equations_of(std::string_view name, const program::Settings& settings) {
  const std::span<const ProblemText> all = problem_texts();
  const auto found = std::ranges::find(all, name, &ProblemText::name);
  if (found == all.end()) {
    std::vector<std::string_view> names;
    for (const ProblemText& known : all) names.push_back(known.name);
    throw invalid_argument("there is no problem '{}'; there is {}", name, fmt::join(names, ", "));
  }
  program::Equations equations({fmt::format("{}.ode", name), std::string(found->text)}, settings);
  if (!equations.initial_time() || !equations.final_time())
    throw invalid_argument("{}.ode: says neither where it begins nor where it ends: x(0) = 1, t <= 10", name);
  return equations;
}

}  // namespace

TextProblem::TextProblem(std::string_view name, const program::Settings& settings)
    : TextProblem(equations_of(name, settings)) {}

TextProblem::TextProblem(program::Equations equations)
    : Problem(equations),
      initial_time(equations.initial_time().value()),
      final_time(equations.final_time().value()) {
  const std::vector<double> x0 = equations.initial_state("initial state", "");
  x0_ = Eigen::Map<const Eigen::VectorXd>(x0.data(), size());
}

}  // namespace nlmech::problems

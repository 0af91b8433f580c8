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
    throw invalid_argument("there is no problem '{}'; choose one of {}", name, fmt::join(names, ", "));
  }
  program::Equations equations({fmt::format("{}.ode", name), std::string(found->text)}, settings);
  if (!equations.initial_time() || !equations.final_time())
    throw invalid_argument("{}.ode: has no initial values or no end; add them, as x(0) = 1, t <= 10", name);
  return equations;
}

}  // namespace

TextProblem::TextProblem(std::string_view of_text, const program::Settings& settings)
    : TextProblem(equations_of(of_text, settings), of_text) {}

TextProblem::TextProblem(program::Equations equations, std::string_view of_text)
    : Problem(equations),
      name(of_text),
      initial_time(equations.initial_time().value()),
      final_time(equations.final_time().value()),
      parameters_(equations.parameters()) {
  const std::vector<double> x0 = equations.initial_state("initial state", "");
  x0_ = Eigen::Map<const Eigen::VectorXd>(x0.data(), size());
}

double TextProblem::parameter(std::string_view definition) const {
  const auto found = std::ranges::find(parameters_, definition, &std::pair<std::string, double>::first);
  if (found == parameters_.end())
    throw invalid_argument("{}.ode: no number is called '{}'", name, definition);
  return found->second;
}

}  // namespace nlmech::problems

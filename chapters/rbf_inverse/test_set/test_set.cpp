#include "chapters/rbf_inverse/test_set/test_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "nlmech/bvp/typed/follow_parameter.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"

namespace nlmech::chapters::rbf_inverse {

std::span<const TestProblem> test_problems() {
  constexpr bool linear = true;
  static constexpr TestProblem all[] = {{1, 1e-3, 1e-6, "eps", 0.1, "", linear},
                                        {2, 1e-3, 1e-6, "eps", 0.1, "", linear},
                                        {3, 1e-3, 1e-6, "eps", 0.1, "", linear},
                                        {4, 1e-2, 1e-6, "eps", 0.1, "", linear},
                                        {5, 1e-1, 1e-6, "eps", 0.1, "", linear},
                                        {6, 1e-3, 1e-6, "eps", 0.1, "", linear},
                                        {7, 5e-4, 1e-6, "eps", 0.1, "", linear},
                                        {8, 1e-2, 1e-6, "eps", 0.1, "", linear},
                                        {9, 1e-2, 1e-6, "eps", 0.1, "", linear},
                                        {10, 1e-2, 1e-6, "eps", 0.1, "", linear},
                                        {11, 1e-1, 1e-6, "eps", 0.1, "", linear},
                                        {12, 1e-4, 1e-6, "eps", 0.1, "", linear},
                                        {13, 1e-4, 1e-6, "eps", 0.1, "", linear},
                                        {14, 1e-4, 1e-6, "eps", 0.1, "", linear},
                                        {15, 3e-3, 1e-6, "eps", 0.1, "", linear},
                                        {16, 0.11, 8e-3, "eps", 0.11, "", linear},
                                        {17, 1e-4, 1e-7, "eps", 0.1, "", linear},
                                        {18, 1e-2, 1e-6, "eps", 0.1, "", linear},
                                        {19, 5e-3, 1e-3},
                                        {20, 1e-2, 1e-3},
                                        {21, 1e-2, 1e-5},
                                        {22, 1e-2, 1e-3},
                                        {23, 9, 20, "n", 2},
                                        {24, 1e-2, 1e-3, "eps", 0.1, "y = 0.9129 - 0.5379 t"},
                                        {25, 1e-3, 1e-4},
                                        {26, 5e-3, 1e-3},
                                        {27, 5e-3, 1e-3},
                                        {28, 5e-3, 1e-3},
                                        {29, 5e-3, 1e-3},
                                        {30, 1e-2, 1e-3},
                                        {31, 1e-2, 1e-3},
                                        {32, 500, 1e4, "R", 1},
                                        {33, 1e-3, 1e-4},
                                        {34, 1, 3.5, "lambda", 1},
                                        {35, 0.05, 0.01, "eps", 0.1, "", linear}};
  return all;
}

namespace {

bvp::ProblemText text_of(const TestProblem& test, double value) {
  const problems::ProblemText& text = problems::boundary_texts()[static_cast<std::size_t>(test.number - 1)];
  return {.name = fmt::format("{}.ode", text.name),
          .equations = std::string(text.text),
          .settings = {{test.parameter, value}}};
}

}  // namespace

bvp::TypedProblem typed(const TestProblem& test, double value) {
  return bvp::read_problem(text_of(test, value), test.guess);
}

bvp::Solution solve_test(const TestProblem& test, double value, double tolerance) {
  bvp::TypedProblem problem = typed(test, value);
  bvp::Solution direct = solve_typed(problem, problem.guess(), tolerance);
  if (direct.status.ok() || test.is_linear || value == test.easy) return direct;
  bvp::TypedProblem easy = typed(test, test.easy);
  bvp::Solution first = solve_typed(easy, easy.guess(), tolerance);
  if (!first.status.ok()) return direct;
  bvp::Continuation found =
      follow_parameter(text_of(test, test.easy), test.guess,
                       {.name = test.parameter, .from = test.easy, .to = value}, std::move(first), tolerance);
  if (!found.solutions.empty()) return std::move(found.solutions.front());
  direct.status = found.status;
  return direct;
}

std::vector<ReferenceValue> references(const TestProblem& test, double value) {
  static const std::vector<scene::CsvRecord> table = [] {
    const auto file = scene::data_folder() / "tables" / "reference" / "bvp_test_set.csv";
    return scene::parse_csv(scene::read_whole(file.string()), file.string());
  }();
  const std::string name = fmt::format("bvpT{}", test.number);
  std::vector<ReferenceValue> found;
  for (const scene::CsvRecord& row : table) {
    // problem, parameter, value, t, component, number; below the range of doubles a number is 0
    if (row.cells[0] == name && std::stod(row.cells[2]) == value)
      found.push_back({std::stod(row.cells[3]), row.cells[4], std::strtod(row.cells[5].c_str(), nullptr)});
  }
  return found;
}

double error_against(std::span<const ReferenceValue> references, const std::vector<std::string>& names,
                     const std::function<Eigen::VectorXd(double)>& state, const Eigen::VectorXd& sizes) {
  double worst = 0;
  for (const ReferenceValue& known : references) {
    const auto i = std::ranges::find(names, known.component) - names.begin();
    const double error = std::abs(state(known.t)[i] - known.number) / sizes[i];
    worst = error <= worst ? worst : error;  // keeps a NaN
  }
  return worst;
}

double error_of(std::span<const ReferenceValue> references, const bvp::TypedProblem& problem,
                const bvp::Solution& solution) {
  const Eigen::VectorXd sizes = solution.node_values().cwiseAbs().rowwise().maxCoeff();
  return error_against(
      references, problem.names(), [&](double t) { return problem.components_at(solution, t); },
      problem.components(sizes, solution.parameters()));
}

}  // namespace nlmech::chapters::rbf_inverse

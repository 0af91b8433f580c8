#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "common/python/module.hpp"
#include "nlmech/bvp/typed/follow_parameter.hpp"
#include "nlmech/bvp/typed/typed_solve.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::python {
namespace {

using bvp::TypedProblem;

/// A solution with its problem.
struct Solved {
  TypedProblem problem;
  bvp::Solution solution;
};

/// All components at the times @p t, a row for each component.
Rows<> values_at(const Solved& solved, const Eigen::VectorXd& t) {
  Rows<> values(static_cast<Eigen::Index>(solved.problem.names().size()), t.size());
  for (Eigen::Index k = 0; k < t.size(); ++k)
    values.col(k) = solved.problem.components_at(solved.solution, t[k]);
  return values;
}

/// Times of the nodes.
std::vector<double> times_of(const Solved& solved) {
  std::vector<double> all = solved.solution.node_times();
  for (double& t : all) t = solved.problem.time(t, solved.solution.parameters());
  return all;
}

/// Solutions from @p starts starts, or without a number the first one found as the command does; with @p
/// range, a parameter with its first and last value, that at the last value.
/// @param guess functions of time as text, or empty
/// @param times, values a guess as rows of values, one for each component, or empty
std::vector<Solved> solve(bvp::ProblemText text, const std::string& guess, const std::vector<double>& times,
                          const Rows<>& values, std::optional<int> starts,
                          const std::optional<std::tuple<std::string, double, double>>& range,
                          double tolerance) {
  if (range && !text.settings.emplace(std::get<0>(*range), std::get<1>(*range)).second)
    throw input_error("from_parameter: set gives {} too", std::get<0>(*range));
  TypedProblem problem = bvp::read_problem(text, guess);
  constexpr int random_starts = 20;
  const bool is_guessed = !times.empty() || problem.has_guess_of_states();
  const int count = starts.value_or(is_guessed ? 1 : 1 + random_starts);
  bvp::Search search =
      find_solutions(problem, times.empty() ? problem.guess() : problem.guess_from(times, values), count,
                     starts ? static_cast<std::size_t>(count) : 1, tolerance);
  if (search.found.empty())
    throw Failure(failed_with(search.first.outcome(), "{}; give another guess", search.first.sentence()));
  std::vector<bvp::Solution> solutions;
  for (bvp::FoundSolution& found : search.found) solutions.push_back(std::move(found.solution));
  if (range) {
    const auto& [name, from, to] = *range;
    bvp::Continuation followed =
        follow_parameter(text, guess, {name, from, to}, std::move(solutions.front()), tolerance);
    if (followed.solutions.empty())
      throw Failure(failed_with(followed.status.outcome(), "{} = {:.9g} was reached in {} steps; {}", name,
                                followed.reached, followed.steps, followed.status.sentence()));
    solutions = std::move(followed.solutions);
    text.settings[name] = to;
    problem = bvp::read_problem(text, guess);
  }
  std::vector<Solved> all;
  for (bvp::Solution& solution : solutions) {
    if (problem.is_infinite()) problem.truncate(solution.end());
    all.push_back({problem, std::move(solution)});
  }
  return all;
}

}  // namespace

void add_bvp(py::module_& module) {
  py::class_<Solved>(module, "Solved")
      .def("at", &values_at)
      .def_property_readonly("times", &times_of)
      .def_property_readonly("names", [](const Solved& s) { return s.problem.names(); })
      .def_property_readonly("residual", [](const Solved& s) { return s.solution.residual; });
  module.def("bvp_names", [](const bvp::ProblemText& text) { return bvp::read_problem(text).names(); });
  module.def("bvp", &solve, Unlocked());
  py::class_<bvp::ProblemText>(module, "BoundaryText")
      .def(py::init<std::string, std::string, program::Settings, std::string, std::string, std::string,
                    std::string, std::string>());  // members in their order
}

}  // namespace nlmech::python

#include <Eigen/Core>
#include <optional>
#include <tuple>
#include <utility>

#include "common/python/module.hpp"
#include "nlmech/bvp/typed/follow_parameter.hpp"
#include "nlmech/bvp/typed/typed_solve.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::python {
namespace {

using bvp::TypedProblem;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A solution with its problem.
struct Solved {
  TypedProblem problem;
  bvp::Solution solution;

  /// All components at the times @p t, a row for each component.
  [[nodiscard]] py::array_t<double> at(const Doubles& t) const {
    const auto n = static_cast<py::ssize_t>(problem.names().size());
    py::array_t<double> values({n, t.size()});
    auto value = values.mutable_unchecked<2>();
    for (py::ssize_t k = 0; k < t.size(); ++k) {
      const Eigen::VectorXd x = problem.components_at(solution, t.data()[k]);
      for (py::ssize_t i = 0; i < n; ++i) value(i, k) = x[i];
    }
    return values;
  }
  /// Times of the nodes.
  [[nodiscard]] std::vector<double> times() const {
    std::vector<double> all = solution.node_times();
    for (double& t : all) t = problem.time(t, solution.parameters());
    return all;
  }
};

/// A start for Newton's iteration: functions of time as text, or rows of values.
struct Guess {
  std::string text;
  std::vector<double> times;
  RowMajor values;  ///< one row for each component
};

/// A parameter with its first and last value.
using Range = std::tuple<std::string, double, double>;

/// Solutions from @p starts starts, or without a number the first one found as the command does; with @p
/// range that at the last value of the parameter.
std::vector<Solved> solve(bvp::ProblemText text, const Guess& guess, std::optional<int> starts,
                          const std::optional<Range>& range, double tolerance) {
  if (range && !text.settings.emplace(std::get<0>(*range), std::get<1>(*range)).second)
    throw input_error("from_parameter: set gives {} too", std::get<0>(*range));
  TypedProblem problem = bvp::read_problem(text, guess.text);
  constexpr int random_starts = 20;
  const bool is_guessed = !guess.times.empty() || problem.has_guess_of_states();
  const int count = starts.value_or(is_guessed ? 1 : 1 + random_starts);
  bvp::Search search = find_solutions(
      problem, guess.times.empty() ? problem.guess() : problem.guess_from(guess.times, guess.values), count,
      starts ? static_cast<std::size_t>(count) : 1, tolerance);
  if (search.found.empty())
    throw Failure(failed_with(search.first.outcome(), "{}; give another guess", search.first.sentence()));
  std::vector<bvp::Solution> solutions;
  for (bvp::FoundSolution& found : search.found) solutions.push_back(std::move(found.solution));
  if (range) {
    const auto& [name, from, to] = *range;
    bvp::Continuation followed =
        follow_parameter(text, guess.text, {name, from, to}, std::move(solutions.front()), tolerance);
    if (followed.solutions.empty())
      throw Failure(failed_with(followed.status.outcome(), "{} = {:.9g} was reached in {} steps; {}", name,
                                followed.reached, followed.steps, followed.status.sentence()));
    solutions = std::move(followed.solutions);
    text.settings[name] = to;
    problem = bvp::read_problem(text, guess.text);
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
      .def("at", &Solved::at)
      .def_property_readonly("times", &Solved::times)
      .def_property_readonly("names", [](const Solved& s) { return s.problem.names(); })
      .def_property_readonly("residual", [](const Solved& s) { return s.solution.residual; });
  module.def("bvp_names", [](const bvp::ProblemText& text) { return bvp::read_problem(text).names(); });
  module.def("bvp", [](const bvp::ProblemText& text, const std::string& guess,
                       const std::vector<double>& times, const Doubles& values, std::optional<int> starts,
                       const std::optional<Range>& range, double tolerance) {
    Guess from{guess, times, {}};
    if (!times.empty())
      from.values = Eigen::Map<const RowMajor>(values.data(), values.shape(0), values.shape(1));
    return unlocked([&] { return solve(text, from, starts, range, tolerance); });
  });
  py::class_<bvp::ProblemText>(module, "BoundaryText")
      .def(py::init<>())
      .def_readwrite("name", &bvp::ProblemText::name)
      .def_readwrite("equations", &bvp::ProblemText::equations)
      .def_readwrite("settings", &bvp::ProblemText::settings)
      .def_readwrite("conditions", &bvp::ProblemText::conditions)
      .def_readwrite("unknowns", &bvp::ProblemText::unknowns)
      .def_readwrite("start", &bvp::ProblemText::from)
      .def_readwrite("until", &bvp::ProblemText::until);
}

}  // namespace nlmech::python

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "chapters/rbf_inverse/commands/commands.hpp"
#include "nlmech/bvp/typed/follow_parameter.hpp"
#include "nlmech/bvp/typed/typed_solve.hpp"
#include "nlmech/comparison/commands/run_figure.hpp"
#include "nlmech/comparison/commands/user_problem.hpp"
#include "nlmech/scene/picture.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/scene/table.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::chapters::rbf_inverse {
namespace {

using bvp::TypedProblem;

struct BvpOptions {
  std::string equation, file, conditions, unknown, from, until, guess, from_parameter, plot;
  std::vector<std::string> set;
  double tolerance = 1e-9;
  std::optional<int> starts;
  std::optional<double> every;
  bool all_solutions = false;

  /// Do rows have the number of their solution?
  [[nodiscard]] bool has_several() const { return starts || all_solutions; }
};

void declare(scene::Options& options, BvpOptions& typed) {
  options.add("--equation", typed.equation,
              "equations, definitions and conditions separated by ;: \"x'' + a exp(x) = 0; a = 1; x(0) = 0; "
              "x(1) = 0\"");
  options.add("--file", typed.file, "a file of equations, definitions and conditions");
  options.add("--set", typed.set, "name=value of a parameter; separate several by blanks");
  options.add(
      "--conditions", typed.conditions,
      "further conditions, separated by ; or commas: \"x(0) = x(1); x'(0.3) = 7; integral(x^2) = 1\". "
      "One for each component of the state and each unknown constant");
  options.add("--unknown", typed.unknown, "names of unknown constants, separated by commas: \"k, T\"");
  options.add("--from", typed.from, "start of the interval (default: the first time of a condition)");
  options.add("--until", typed.until,
              "end of the interval: a number, a name for an unknown end, or inf (default: the last time of a "
              "condition)");
  options.add("--guess", typed.guess,
              "initial guess as functions of t: \"x = sin(pi t), k = 10\". A component without a function is "
              "the derivative of a given one, or 0. Or NAME.csv with columns t,x,..., as printed. Default: "
              "zeros, then random cubics, the same in each run");
  options
      .add("--starts", typed.starts,
           "solve from so many starts, the guess, random cubics and multiples of a solution, and print every "
           "different solution, with "
           "a column solution")
      .range(1, 10'000);
  options.add(
      "--from-parameter", typed.from_parameter,
      "follow the solution in a parameter from one value to another, through folds: \"eps = 1 : 1e-4\"");
  options.add(
      "--all-solutions", typed.all_solutions,
      "with --from-parameter: follow the branch beyond its first solution at the last value, and print "
      "every one, with a column solution");
  options.add("--tolerance", typed.tolerance, "tolerance on x' - f, relative to the size of f and of x")
      .range(1e-13, 0.1);
  options.add("--every", typed.every, "time between rows (default: rows at the nodes of the collocation)")
      .positive();
  options.add("--plot", typed.plot,
              "NAME.svg: plot of the unknowns against time; replaces only an older such picture");
}

bool names_file(const std::string& guess) { return guess.ends_with(".csv"); }

/// The problem as typed.
bvp::ProblemText text_of(const BvpOptions& typed) {
  return {.name = typed.file.empty() ? "--equation" : typed.file,
          .equations = typed.file.empty() ? typed.equation : comparison::read_equations(typed.file),
          .settings = comparison::settings_of(typed.set),
          .conditions = typed.conditions,
          .unknowns = typed.unknown,
          .from = typed.from,
          .until = typed.until};
}

TypedProblem problem_of(const BvpOptions& typed, const bvp::ProblemText& text) {
  return bvp::read_problem(text, names_file(typed.guess) ? "" : typed.guess);
}

/// Guess from rows of a file; components without a column are 0.
bvp::Start guess_of_file(const TypedProblem& problem, const std::string& name) {
  const std::vector<scene::CsvRecord> records = scene::parse_csv(scene::read_whole(name), name);
  if (records.size() < 3) throw input_error("--guess {}: needs a header and two rows", echoed_path(name));
  const std::vector<std::string>& header = records.front().cells;
  const auto column = [&](const std::string& wanted) {
    return static_cast<std::size_t>(std::ranges::find(header, wanted) - header.begin());
  };
  const std::size_t time = column("t");
  if (time == header.size()) throw input_error("--guess {}: has no column t", echoed_path(name));
  std::vector<double> times;
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(problem.names().size()),
                                                 static_cast<Eigen::Index>(records.size()) - 1);
  for (std::size_t row = 1; row < records.size(); ++row) {
    const std::string place = fmt::format("--guess {}:{}", echoed_path(name), records[row].line);
    if (records[row].cells.size() != header.size())
      throw input_error("{}: has {} cells, the header {}", place, records[row].cells.size(), header.size());
    times.push_back(scene::typed_number(place, records[row].cells[time]));
    if (row > 1 && !(times[row - 1] > times[row - 2]))
      throw input_error("{}: t = {} is not after the row before", place, times.back());
    for (std::size_t i = 0; i < problem.names().size(); ++i) {
      const std::size_t at = column(problem.names()[i]);
      if (at < header.size())
        values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(row) - 1) =
            scene::typed_number(place, records[row].cells[at]);
    }
  }
  return problem.guess_from(times, values);
}

/// "eps = 1 : 1e-4"
bvp::ParameterRange range_of(const BvpOptions& typed) {
  const std::string& text = typed.from_parameter;
  const std::size_t equals = text.find('='), colon = text.find(':');
  if (equals == std::string::npos || colon == std::string::npos || colon < equals)
    throw input_error("--from-parameter {}: must be NAME = FIRST : LAST", quoted_input(text));
  const auto number = [&](std::size_t begin, std::size_t end) {
    return scene::typed_number("--from-parameter", scene::trimmed(text.substr(begin, end - begin)));
  };
  return {scene::trimmed(text.substr(0, equals)), number(equals + 1, colon), number(colon + 1, text.size()),
          typed.all_solutions};
}

/// A problem with its solutions.
struct Solved {
  TypedProblem problem;
  std::vector<bvp::Solution> solutions;
  std::vector<std::string> remarks;
};

/// Solves from the guess, or without one from zeros and then from random cubics.
Solved solve_from_guesses(TypedProblem problem, const BvpOptions& typed) {
  const bvp::Start guess = names_file(typed.guess) ? guess_of_file(problem, typed.guess) : problem.guess();
  constexpr int random_starts = 20;
  const bool is_guessed = names_file(typed.guess) || problem.has_guess_of_states();
  const int starts = typed.starts.value_or(is_guessed ? 1 : 1 + random_starts);
  bvp::Search search = bvp::find_solutions(
      problem, guess, starts, typed.starts ? static_cast<std::size_t>(starts) : 1, typed.tolerance);
  if (search.found.empty())
    throw Failure(Status::failure(
        search.first.outcome(),
        fmt::format("{}; {}", search.first.sentence(),
                    starts == 1 ? "give another --guess"
                                : fmt::format("no solution from {} random cubics either; give a --guess",
                                              starts - 1))));
  Solved solved{std::move(problem), {}, {}};
  const bvp::FoundSolution& first = search.found.front();
  if (!typed.starts && first.start > 0)
    solved.remarks.push_back(
        fmt::format("no solution was found from zeros; this one is from random cubic {} of size {}; for "
                    "another one give a --guess",
                    first.start, first.size));
  if (typed.starts)
    solved.remarks.push_back(
        fmt::format("{} different solutions from {} starts; there may be more", search.found.size(), starts));
  for (bvp::FoundSolution& found : search.found) solved.solutions.push_back(std::move(found.solution));
  return solved;
}

/// Solves with the first value of the parameter and follows that solution to the last one.
Solved solve_by_continuation(const BvpOptions& typed) {
  const bvp::ParameterRange range = range_of(typed);
  if (typed.starts) throw InputError("--starts: cannot be combined with --from-parameter");
  bvp::ProblemText text = text_of(typed);
  if (!text.settings.emplace(range.name, range.from).second)
    throw input_error("--from-parameter {}: --set gives it too", quoted_input(range.name));
  Solved solved = solve_from_guesses(problem_of(typed, text), typed);
  bvp::Continuation followed = follow_parameter(text, names_file(typed.guess) ? "" : typed.guess, range,
                                                std::move(solved.solutions.front()), typed.tolerance);
  const std::string turns = followed.folds.empty() ? ""
                                                   : fmt::format("; the branch turns back at {:.10g}",
                                                                 fmt::join(followed.folds, ", "));
  const std::string place = fmt::format("{} = {:.9g} was reached in {} steps{}", range.name, followed.reached,
                                        followed.steps, turns);
  if (followed.solutions.empty())
    throw Failure(
        Status::failure(followed.status.outcome(), fmt::format("{}; {}", place, followed.status.sentence())));
  if (range.all)
    solved.remarks.push_back(fmt::format("{} different solutions at {} = {:.9g} on the branch; {}; {}",
                                         followed.solutions.size(), range.name, range.to, place,
                                         followed.status.sentence()));
  else if (!turns.empty())
    solved.remarks.push_back(place);
  text.settings[range.name] = range.to;
  return {problem_of(typed, text), std::move(followed.solutions), std::move(solved.remarks)};
}

Solved solve_as_typed(const BvpOptions& typed) {
  if (typed.equation.empty() == typed.file.empty())
    throw InputError("give one of --equation TEXT and --file NAME.ode");
  if (!typed.from_parameter.empty()) return solve_by_continuation(typed);
  if (typed.all_solutions) throw InputError("--all-solutions: needs --from-parameter");
  return solve_from_guesses(problem_of(typed, text_of(typed)), typed);
}

/// Result of an integration from the initial values to the end: empty if it agrees with the solution, else a
/// message with the deviation.
std::string check_whole_integration(const TypedProblem& problem, const BvpOptions& typed,
                                    const bvp::Solution& solution) {
  bvp::Options options;
  options.verification = bvp::Verification::whole;
  options.verification_tolerance = std::max(1e-10, 100 * typed.tolerance);
  bvp::Solution copy = solution;
  verify_by_integration(problem, options, copy);
  if (copy.status.ok()) return {};
  const double off = copy.integration_error;
  return fmt::format(
      "verified by integration over each of {} intervals; an integration from the start alone leaves it{}, "
      "because rounding errors grow: the solution is determined by both ends",
      solution.mesh().size() - 1, std::isfinite(off) ? fmt::format(" ({:.1g} off)", off) : "");
}

std::vector<double> times_of(const TypedProblem& problem, const BvpOptions& typed,
                             const bvp::Solution& solution) {
  std::vector<double> times;
  if (!typed.every) {
    for (const double s : solution.node_times()) times.push_back(problem.time(s, solution.parameters()));
    return times;
  }
  const double from = problem.time(solution.begin(), solution.parameters()),
               until = problem.time(solution.end(), solution.parameters());
  const double count = std::ceil((until - from) / *typed.every - 1e-9);
  if (count > 1e6) throw input_error("--every {}: more than a million rows", *typed.every);
  for (int i = 0; i < static_cast<int>(count); ++i) times.push_back(from + i * *typed.every);
  times.push_back(until);
  return times;
}

comparison::PlotSamples samples_of(const TypedProblem& problem, const bvp::Solution& solution) {
  comparison::PlotSamples samples;
  for (const std::string& name : problem.names()) samples.components.push_back({name, !name.ends_with('\'')});
  const double from = problem.time(solution.begin(), solution.parameters()),
               until = problem.time(solution.end(), solution.parameters());
  samples.path = comparison::SampledPath(from, until);
  constexpr int count = 1000;
  for (int i = 0; i <= count; ++i) {
    const double t = from + (until - from) * i / count;
    samples.path.add(t, problem.components_at(solution, t));
  }
  return samples;
}

/// Rows t,x,x',...; with @p prefix before each.
std::string rows_of(const TypedProblem& problem, const BvpOptions& typed, const bvp::Solution& solution,
                    const std::string& prefix) {
  const Eigen::VectorXd sizes =
      problem.components(solution.node_values().cwiseAbs().rowwise().maxCoeff(), solution.parameters());
  std::string text;
  for (const double t : times_of(problem, typed, solution)) {
    text += fmt::format("{}{:.17g}", prefix, t);
    const Eigen::VectorXd x = problem.components_at(solution, t);
    // A value prescribed as 0 has the rounding error of the solve.
    for (Eigen::Index i = 0; i < x.size(); ++i)
      text += fmt::format(",{:.17g}", std::abs(x[i]) < 1e-18 * sizes[i] ? 0 : x[i]);
    text += "\n";
  }
  return text;
}

void boundary_values(const BvpOptions& typed) {
  const scene::Picture picture(typed.plot);
  Solved solved = solve_as_typed(typed);
  std::string text = typed.has_several() ? "solution,t" : "t";
  for (const std::string& name : solved.problem.names()) text.append(",").append(scene::csv_field(name));
  text += "\n";
  for (std::size_t i = 0; i < solved.solutions.size(); ++i) {
    const bvp::Solution& solution = solved.solutions[i];
    if (solved.problem.is_infinite()) solved.problem.truncate(solution.end());
    if (std::string said = check_whole_integration(solved.problem, typed, solution); !said.empty())
      solved.remarks.push_back(std::move(said));
    text += rows_of(solved.problem, typed, solution, typed.has_several() ? fmt::format("{},", i + 1) : "");
  }
  for (const std::string& said : solved.remarks) scene::print_message("rbf_inverse: " + said);
  scene::print_result(text);
  if (picture.wanted())
    picture.draw([&] {
      return run_figure(
          samples_of(solved.problem, solved.solutions.front()),
          quoted_input(
              typed.file.empty() ? typed.equation : std::filesystem::path(typed.file).filename().string(),
              60));
    });
}

}  // namespace

void add_bvp_command(scene::Commands& all) {
  all.add("bvp",
          "Solve a boundary value problem, equations with conditions at any times, by collocation on a mesh "
          "adapted to the residual; prints t,x,x',... as CSV, verified by integration",
          declare, boundary_values);
}

}  // namespace nlmech::chapters::rbf_inverse

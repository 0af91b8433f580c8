#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/control/shooting_methods.hpp"
#include "chapters/rbf_inverse/test_set/test_set.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::rbf_inverse::bvp_test_set {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Least time in ms in which a method has 6 and 9 digits; NaN if it has not.
struct Times {
  double six = nan, nine = nan;

  void add(double error, double seconds) {
    if (error <= 1e-6) six = std::fmin(six, 1e3 * seconds);
    if (error <= 1e-9) nine = std::fmin(nine, 1e3 * seconds);
  }
};

/// A problem with one value of its parameter.
struct Row {
  const TestProblem* test;
  double value;
  std::string outcome = {};  ///< of collocation with the tolerance 1e-9
  double digits = nan;       ///< at the times of the references
  std::size_t intervals = 0;
  bool is_followed = false;  ///< found by continuation in the parameter
  Times collocation = {}, multiple = {}, single = {};

  [[nodiscard]] int number() const { return test->number; }
  [[nodiscard]] std::string parameter() const { return fmt::format("{} = {:g}", test->parameter, value); }
  [[nodiscard]] bool is_hard() const { return value == test->hard; }
};

/// Times of one method over its tolerances, which end at the first failure after a success, and at once after
/// a failure that took long. @param solve error of a solution; nothing if it failed
Times measure(std::initializer_list<double> tolerances, bool quick,
              const std::function<std::optional<double>(double)>& solve) {
  Times times;
  for (const double tolerance : tolerances) {
    const Stopwatch watch;
    const std::optional<double> error = solve(tolerance);
    const double first = watch.seconds();
    if (!error && (first > 0.2 || !std::isnan(times.six))) break;
    if (!error || *error > 1e-6) continue;
    const auto repeat = [&] { static_cast<void>(solve(tolerance)); };
    times.add(*error, repeated_timing(repeat, first, quick).median);
    if (!std::isnan(times.nine)) break;
  }
  return times;
}

/// Error of an initial state against that of collocation with the tolerance 1e-11, relative to the largest
/// values.
struct Initial {
  Eigen::VectorXd state, sizes;

  [[nodiscard]] std::optional<double> error(const ShootingResult& shot) const {
    if (!shot.status.ok()) return {};
    return (shot.first - state).cwiseQuotient(sizes).lpNorm<Eigen::Infinity>();
  }
};

void add_shooting(const bvp::TypedProblem& problem, const Initial& known, bool quick, Row& row) {
  const bvp::Start start = problem.guess();
  Eigen::VectorXd first(problem.states());
  start.states(problem.points().front(), first);
  row.single = measure({1e-8, 1e-11, 1e-13}, quick, [&](double tolerance) {
    return known.error(shoot_once(problem, first, {.tolerance = tolerance, .iterations = 30}));
  });
  if (!multiple_shooting_available()) return;
  constexpr int segments = 40;
  row.multiple = measure({1e-8, 1e-10, 1e-12}, quick, [&](double tolerance) {
    return known.error(
        shoot(problem, start, {.segments = segments, .tolerance = tolerance, .iterations = 30}));
  });
}

Row solve_row(const TestProblem& test, double value, bool quick) {
  Row row{.test = &test, .value = value};
  bvp::TypedProblem problem = typed(test, value);
  const std::vector<ReferenceValue> known = references(test, value);
  const bvp::Solution solution = solve_test(test, value, 1e-9);
  row.outcome = to_string(solution.status.outcome());
  row.intervals = solution.unknowns.intervals.size();
  if (!solution.status.ok()) return row;
  row.is_followed = !test.is_linear && !solve_typed(problem, problem.guess(), 1e-9).status.ok();
  row.digits = std::clamp(-std::log10(error_of(known, problem, solution)), 0., 14.);
  row.collocation = measure({1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10}, quick,
                            [&](double tolerance) -> std::optional<double> {
                              const bvp::Solution s = solve_test(test, value, tolerance);
                              if (!s.status.ok()) return {};
                              return error_of(known, problem, s);
                            });
  if (row.is_hard()) return row;
  const bvp::Solution best = solve_test(test, value, 1e-11);
  const bvp::Solution& initial = best.status.ok() ? best : solution;
  add_shooting(problem, {initial.first(), initial.node_values().cwiseAbs().rowwise().maxCoeff()}, quick, row);
  return row;
}

std::vector<Row> compute(bool quick) {
  std::vector<Row> rows;
  for (const TestProblem& test : test_problems()) {
    if (quick && test.number % 6 != 1) continue;
    rows.push_back(solve_row(test, test.moderate, quick));
    rows.push_back(solve_row(test, test.hard, quick));
  }
  return rows;
}

void plot(const std::vector<Row>& rows, scene::Show& show) {
  scene::Panel& panel = show.plot("Nine digits of the test set: time by problem", "problem", "run time (ms)");
  show.figure().columns({"curve", "problem", "time_ms"});
  panel.log_y().key("below").x_range(0, 36);
  const auto curve = [&](const char* name, bool is_hard, Times Row::*times) {
    std::vector<double> x, y;
    for (const Row& row : rows) {
      if (row.is_hard() != is_hard) continue;
      x.push_back(row.number());
      y.push_back((row.*times).nine);
    }
    if (std::ranges::any_of(y, [](double v) { return !std::isnan(v); }))
      panel.curve(name, x, y, scene::points());
  };
  curve("collocation", false, &Row::collocation);
  curve("collocation, smaller eps", true, &Row::collocation);
  curve("multiple shooting, CVODE", false, &Row::multiple);
  curve("single shooting, ode45", false, &Row::single);
}

/// Number of problems that collocation solves to so many digits before all peers, at their moderate values or
/// also at the hard ones, by the stored times, which include those of SciPy's solve_bvp.
double stored_ahead(const std::string& digits, bool also_hard) {
  const auto file = scene::data_folder() / "tables" / "reference" / "bvp_test_set_times.csv";
  const std::vector<scene::CsvRecord> table = scene::parse_csv(scene::read_whole(file), file.string());
  const auto time = [](const std::string& cell) { return cell.empty() ? HUGE_VAL : std::stod(cell); };
  return static_cast<double>(std::ranges::count_if(test_problems(), [&](const TestProblem& test) {
    return std::ranges::none_of(table, [&](const scene::CsvRecord& row) {
      // problem, value, digits, collocation, multiple shooting, single shooting, solve_bvp
      const std::vector<std::string>& c = row.cells;
      const bool counts = c[0] == fmt::format("bvpT{}", test.number) && c[2] == digits &&
                          (also_hard || std::stod(c[1]) == test.moderate);
      return counts && !(time(c[3]) < std::min({time(c[4]), time(c[5]), time(c[6])}));
    });
  }));
}

void put(const std::vector<Row>& rows, scene::Show& show) {
  plot(rows, show);
  const auto ms = [](Times Row::*times, double Times::*digits) {
    return [=](const Row& row) -> scene::Cell {
      const double value = (row.*times).*digits;
      return std::isnan(value) ? scene::Cell() : scene::Cell(value);
    };
  };
  show.table(rows,
             {{"problem", &Row::number},
              {"parameter", &Row::parameter},
              {"outcome", &Row::outcome},
              {"digits", [](const Row& row) { return std::isnan(row.digits) ? scene::Cell() : row.digits; }},
              {"intervals", [](const Row& row) { return static_cast<double>(row.intervals); }},
              {"time to 6 digits (ms)", ms(&Row::collocation, &Times::six)},
              {"time to 9 digits (ms)", ms(&Row::collocation, &Times::nine)},
              {"multiple shooting, 6 digits (ms)", ms(&Row::multiple, &Times::six)},
              {"multiple shooting, 9 digits (ms)", ms(&Row::multiple, &Times::nine)},
              {"single shooting, 6 digits (ms)", ms(&Row::single, &Times::six)},
              {"single shooting, 9 digits (ms)", ms(&Row::single, &Times::nine)}});
  double solved = 0, least = 14;
  for (const Row& row : rows) {
    if (row.outcome != "success") continue;
    ++solved;
    least = std::min(least, row.digits);
  }
  const double all = static_cast<double>(rows.size());
  show.between("cases solved", solved, all - 1, all,
               "problem 35 multiplies errors by 5e21 at eps = 0.01 and is refused");
  const auto followed = static_cast<double>(std::ranges::count(rows, true, &Row::is_followed));
  show.between("cases solved by continuation", followed, 0, solved, "those that the guess does not lead to");
  show.between("least digits of a solved case", least, 8, 14,
               "a tolerance of 1e-9; closed forms, and multiple shooting in 24 digits");
  const auto all_problems = static_cast<double>(test_problems().size());
  for (const std::string& digits : {std::string("6"), std::string("9")}) {
    for (const bool also_hard : {false, true}) {
      show.between(fmt::format("problems with {} digits before all peers{}, stored times", digits,
                               also_hard ? " at both parameters" : ""),
                   stored_ahead(digits, also_hard), 0, all_problems,
                   "tables/reference/bvp_test_set_times.csv");
    }
  }
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result rows("bvp-test-set",
                           "tolerances 1e-4 to 1e-10; errors at the times of "
                           "tables/reference/bvp_test_set.csv, of shooting in the "
                           "initial state; multiple shooting with 40 segments; one thread, median of repeats",
                           compute);
  return {{.name = "bvp-test-set",
           .title = "Mazzia and Cash's test set: digits, and time beside shooting",
           .content = scene::Content(put, rows)}};
}

}  // namespace nlmech::chapters::rbf_inverse::bvp_test_set

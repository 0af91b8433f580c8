#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/scenes.hpp"
#include "chapters/rbf_ivp/solvers/solvers.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

using collocation::Basis;
using collocation::NodeFamily;
using scene::Workshop;

constexpr auto lobatto = NodeFamily::legendre_gauss_lobatto, radau = NodeFamily::left_end_and_radau;

/// A row of the table: trial functions on a row of intervals, and what each solver took.
struct Row {
  std::string problem, functions;
  int nodes;
  double h;
  int count;                ///< intervals asked for
  std::vector<Cost> costs;  ///< by solver, summed over the row
  std::vector<int> done;    ///< intervals that converged
};

template <int n>
void add_rows(std::vector<Row>& rows, const Case<n>& c, int nodes, double h, double shape, int count,
              const Effort& effort) {
  const std::array<std::pair<std::string, Basis>, 3> all = {
      {{"Gaussians LGL", Basis::radial(lobatto, nodes, collocation::Kernel::gaussian, shape * h)},
       {"polynomials LGL", Basis::polynomial(lobatto, nodes)},
       {"polynomials Radau", Basis::polynomial(radau, nodes)}}};
  for (const auto& [name, basis] : all) {
    Row row{c.name, name, nodes, h, count, {}, {}};
    for (const Solver solver : all_solvers) {
      auto [cost, done] = solve_row(solver, c, basis, h, count, effort);
      row.costs.push_back(std::move(cost));
      row.done.push_back(done);
    }
    rows.push_back(std::move(row));
  }
}

/// Steps and shapes of the dissertation's runs; the impact ends its row where the force ends.
std::vector<Row> rows_of(bool quick) {
  const double P = duffing_period();
  const Effort effort = {.steps = quick ? 500 : 10'000};
  const int many = quick ? 3 : 10;  // intervals
  std::vector<Row> rows;
  add_rows(rows, free_duffing_case(), 7, P / 10, 0.77, many, effort);
  add_rows(rows, free_duffing_case(), 35, P, 34 / (4 * P), many, effort);
  add_rows(rows, impact_case(), 7, 0.1, 2.5, many, effort);
  add_rows(rows, impact_case(), 35, 0.5, 34 / (4 * 0.5), 2, effort);
  add_rows(rows, three_mass_case(), 7, 0.625, 0.35, many, effort);
  add_rows(rows, three_mass_case(), 35, 20, 0.39, many, effort);
  return rows;
}

/// One interval of the free Duffing oscillator from its maximum.
struct Trial {
  double abscissa = 0;
  Solver solver = Solver::newton;
  Cost cost;
  double error = 0;  ///< at the nodes
  Eigen::VectorXd x;
};

Trial trial(double abscissa, Solver solver, const Basis& basis, double h, const Effort& effort) {
  const Case<2>& c = free_duffing_case();
  Interval<2> interval(c, basis);
  interval.begin(0, h, c.x0);
  Trial t{abscissa, solver, {}, 0, {}};
  t.cost = solve(solver, interval, t.x, effort);
  t.error = error_at_nodes(c, interval.printed, t.x);
  return t;
}

/// All trials of the figure's panels.
struct Trials {
  std::vector<Trial> history;  ///< 7 nodes, P/10
  std::vector<Trial> nodes;    ///< against N, P/2
  std::vector<Trial> length;   ///< against the length in periods, 60 Radau nodes
  std::vector<Trial> step;     ///< against the step of fictitious time, 7 nodes, P/10
  std::vector<Trial> chosen;   ///< the same with chosen steps
};

Trials trials_of(bool quick) {
  const double P = duffing_period();
  const Basis seven = Basis::polynomial(lobatto, 7), sixty = Basis::polynomial(radau, 60);
  const std::int64_t many = quick ? 3000 : 200'000;
  Trials all;
  for (const Solver s : all_solvers) all.history.push_back(trial(0, s, seven, P / 10, {}));
  for (const int N : {7, 10, 14, 20, 28, 35}) {
    for (const Solver s : all_solvers)
      all.nodes.push_back(trial(N, s, Basis::polynomial(radau, N), P / 2, {.steps = many}));
  }
  for (int k = quick ? 5 : 1; k <= 80; k += quick ? 5 : 1) {
    const double periods = 0.05 * k;
    for (const Solver s : {Solver::newton, Solver::damped_newton, Solver::picard})
      all.length.push_back(trial(periods, s, sixty, periods * P, {}));
    for (const Solver s : {Solver::fixed_point_integrated, Solver::newton_flow_integrated}) {
      if (k % 10 == 0 || k == 5)
        all.length.push_back(trial(periods, s, sixty, periods * P, {.steps = many, .step = 1.9}));
    }
  }
  for (const Solver s : all_solvers) {
    if (!is_flow(s)) continue;
    for (const double dt : {0.1, 0.2, 0.5, 1.0, 1.5, 1.9, 2.0, 2.5, 3.0, 3.5})
      all.step.push_back(trial(dt, s, seven, P / 10, {.steps = many, .step = dt}));
    all.chosen.push_back(trial(0, s, seven, P / 10, {.steps = many, .turn = 0.25}));
  }
  return all;
}

/// Updates an interval, or why there are none.
scene::Cell iterations_cell(const Row& row, std::size_t solver, std::int64_t limit) {
  const Cost& cost = row.costs[solver];
  if (cost.converged) return static_cast<double>(cost.iterations) / row.count;
  std::string why = cost.diverged                  ? std::string("diverges")
                    : is_flow(all_solvers[solver]) ? fmt::format("> {}", limit)
                                                   : std::string("no end");
  if (row.done[solver] > 0) why += fmt::format(" in interval {}", row.done[solver] + 1);
  return why;
}

scene::Table table_of(const std::vector<Row>& rows, bool quick) {
  std::vector<scene::Column> columns = {{"problem"}, {"N"}, {"trial functions"}, {"h (s)"}, {"intervals"}};
  for (const Solver s : all_solvers) columns.push_back({std::string(to_string(s))});
  constexpr std::array timed = {Solver::newton, Solver::picard, Solver::newton_flow_printed,
                                Solver::newton_flow_integrated};
  for (const Solver s : timed) columns.push_back({fmt::format("time_ms {}", to_string(s))});
  scene::Table table(columns);
  for (const Row& row : rows) {
    std::vector<scene::Cell> cells = {row.problem, std::int64_t(row.nodes), row.functions, row.h,
                                      std::int64_t(row.count)};
    for (std::size_t i = 0; i < all_solvers.size(); ++i)
      cells.push_back(iterations_cell(row, i, quick ? 500 : 10'000));
    for (const Solver s : timed) {
      const Cost& cost = row.costs[static_cast<std::size_t>(s)];
      cells.push_back(
          scene::to_cell(cost.converged ? std::optional(1e3 * cost.seconds / row.count) : std::nullopt));
    }
    table.add(std::move(cells));
  }
  return table;
}

void add_trials(scene::Table& data, const std::string& panel, const std::vector<Trial>& trials) {
  for (const Solver s : all_solvers) {
    for (const Trial& t : trials) {
      if (t.solver != s) continue;
      const bool found = t.cost.converged && t.error < 0.01;
      const scene::Cell iterations = found ? scene::Cell(static_cast<double>(t.cost.iterations)) : "nan";
      data.add({panel, std::string(to_string(s)), t.abscissa, iterations, t.cost.seconds});
    }
  }
}

scene::Table data_of(const Trials& trials) {
  scene::Table data({{"panel"}, {"solver", 3, true}, {"abscissa"}, {"ordinate"}, {"time_s"}});
  for (const Trial& t : trials.history) {
    const std::vector<double>& norms = t.cost.history;
    for (std::size_t k = 0; k < norms.size(); k = std::max(k + 1, k * 21 / 20))
      data.add({"history", std::string(to_string(t.solver)), static_cast<double>(k + 1), norms[k], {}});
  }
  add_trials(data, "nodes", trials.nodes);
  add_trials(data, "length", trials.length);
  add_trials(data, "step", trials.step);
  add_trials(data, "chosen", trials.chosen);
  return data;
}

/// The trial of a solver at an abscissa.
const Trial& at(const std::vector<Trial>& trials, Solver solver, double abscissa) {
  return *std::find_if(trials.begin(), trials.end(), [&](const Trial& t) {
    return t.solver == solver && std::abs(t.abscissa - abscissa) < 1e-9;
  });
}

/// The length up to which every one converges to the solution.
double largest_length(const Trials& trials, Solver solver) {
  double largest = 0;
  for (const Trial& t : trials.length) {
    if (t.solver != solver) continue;
    if (!t.cost.converged || t.error > 0.01) break;
    largest = t.abscissa;
  }
  return largest;
}

/// Gradient descent with Polyak's step for linear equations: |e|^2 falls by 1 - (3/4)/cond^2 or more a step,
/// and |F| is between the least and the largest singular value times |e|.
double most_iterations(int nodes) {
  const Case<2>& c = free_duffing_case();
  CollocationEquations<2> equations(c.system, Basis::polynomial(radau, nodes), Form::printed);
  equations.begin(0, duffing_period() / 2, c.x0);
  equations.linearise(equations.start());
  Eigen::MatrixXd b;
  equations.matrix(b);
  const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(b).singularValues();
  const double condition = values[0] / values[values.size() - 1];
  return 8.0 / 3 * condition * condition * std::log(condition * 1e10);
}

std::vector<scene::Quantity> quantities(const std::vector<Row>& rows, const Trials& trials, bool quick) {
  std::vector<scene::Quantity> list;
  list.push_back({"largest length for Newton", "P", largest_length(trials, Solver::newton), 2, 2.45,
                  "recorded: 2 P converges, 2.5 P does not, for any number of nodes"});
  list.push_back(
      {"largest length for Picard", "P", largest_length(trials, Solver::picard), 0.5, 0.6,
       "0.55 P from the maximum by Chebyshev nodes, scene mcpi-limit; a step of the grid either way"});
  list.push_back(scene::near("length at which damped Newton still converges", "P",
                             largest_length(trials, Solver::damped_newton), 4, 1e-9,
                             "its residual falls with every step; the last length tried"));
  list.push_back({"iterations of Newton, Duffing, N = 7, P/10", "1",
                  static_cast<double>(rows[0].costs[0].iterations) / rows[0].count, 3, 4,
                  "recorded: 3 to 4"});
  list.push_back({"iterations of Newton, three masses, N = 35, 20 s", "1",
                  static_cast<double>(rows.back().costs[0].iterations) / rows.back().count, 3, 5,
                  "recorded: 4 to 5, with another test for the end"});
  if (quick) return list;
  for (const int N : {7, 35}) {
    const Trial& t = at(trials.nodes, Solver::newton_flow_printed, N);
    list.push_back(scene::at_most(fmt::format("iterations of the Newton homotopy, N = {}, P/2", N), "1",
                                  t.cost.converged ? static_cast<double>(t.cost.iterations) : HUGE_VAL,
                                  most_iterations(N),
                                  "bound for linear equations, 8/3 cond^2 log(cond/tol)"));
  }
  const auto integrated = [&](double N) {
    return static_cast<double>(at(trials.nodes, Solver::newton_flow_integrated, N).cost.iterations);
  };
  list.push_back(
      {"iterations with 35 nodes to those with 10, integrated equations", "1",
       integrated(35) / integrated(10), 0.5, 1.5,
       "the spectrum of the integrated equations does not depend on the nodes once they resolve it"});
  for (const double periods : {2.5, 4.0}) {
    const Trial &flow = at(trials.length, Solver::fixed_point_integrated, periods),
                &newton = at(trials.length, Solver::damped_newton, periods);
    list.push_back({fmt::format("iterations of the fixed-point homotopy at {} P, integrated", periods), "1",
                    flow.cost.converged ? static_cast<double>(flow.cost.iterations) : HUGE_VAL, 1e4, 2e5,
                    "thousands of steps, within the 200 000 allowed"});
    list.push_back(scene::at_most(fmt::format("distance to the root of damped Newton at {} P", periods), "1",
                                  (flow.x - newton.x).cwiseAbs().maxCoeff(), 1e-5,
                                  "|F| of 1e-9 over the least singular value, of the order of 1e-4"));
  }
  return list;
}

scene::Showing show(const std::vector<Row>& rows, const Trials& trials, bool quick) {
  scene::Showing showing;
  showing.table = table_of(rows, quick);
  showing.figure = {
      data_of(trials),
      "rbf_ivp-solver-study",
      {{"heading", "Homotopies: tens to thousands of times Newton's iterations"}, {"height", "720"}}};
  showing.quantities = quantities(rows, trials, quick);
  return showing;
}

}  // namespace

void add_solver_study(scene::Chapter& chapter) {
  const auto& rows = chapter.add_run<std::vector<Row>>(
      "solvers-on-rows",
      "rows of intervals with the steps and shapes of Tables 4.2, 4.4 and 4.6, from the constant state of "
      "each "
      "interval, until |F| is 1e-10 of the start; homotopies by Euler's rule with steps of 1, at most 10 000",
      {}, [](Workshop& w) { return rows_of(w.quick()); });
  const auto& trials = chapter.add_run<Trials>(
      "solvers-on-one-interval",
      "free Duffing from its maximum, polynomials; against the iteration, the number of nodes, the length of "
      "the interval (60 Radau nodes, homotopies with steps of 1.9) and the step of fictitious time",
      {}, [](Workshop& w) { return trials_of(w.quick()); });
  chapter.add(
      {.name = "solver-study",
       .title = "Scalar homotopies, Picard and Newton on the equations of an interval",
       .place = "our own",
       .needs = {&rows, &trials},
       .show = [&rows, &trials](Workshop& w) { return show(w.result(rows), w.result(trials), w.quick()); }});
}

}  // namespace nlmech::chapters::rbf_ivp

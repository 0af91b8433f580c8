#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/solvers/solvers.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_ivp::solver_study {
namespace {

using collocation::Basis;
using collocation::NodeFamily;

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

void add_rows(std::vector<Row>& rows, const Case& c, int nodes, double h, double shape, int count,
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
  const Case& c = free_duffing_case();
  Interval interval(c, basis);
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

/// Two lines a row: iterations, and for some solvers the time of an interval.
scene::Table table_of(const std::vector<Row>& rows, bool quick) {
  std::vector<scene::Column> columns = {{"problem"}, {"nodes, functions"}, {"h (s), intervals"}, {"what"}};
  for (const Solver s : all_solvers) columns.push_back({std::string(to_string(s))});
  constexpr std::array timed = {Solver::newton, Solver::picard, Solver::newton_flow_printed,
                                Solver::newton_flow_integrated};
  scene::Table table(columns);
  for (const Row& row : rows) {
    const std::vector<scene::Cell> begin = {row.problem, fmt::format("{} {}", row.nodes, row.functions),
                                            fmt::format("{}, {}", scene::format_number(row.h, 3), row.count)};
    std::vector<scene::Cell> counts = begin, times = begin;
    counts.push_back("iterations");
    times.push_back("time (ms)");
    for (std::size_t i = 0; i < all_solvers.size(); ++i) {
      counts.push_back(iterations_cell(row, i, quick ? 500 : 10'000));
      const bool shown =
          std::ranges::find(timed, all_solvers.at(i)) != timed.end() && row.costs.at(i).converged;
      std::optional<double> milliseconds;
      if (shown) milliseconds = 1e3 * row.costs.at(i).seconds / row.count;
      times.emplace_back(milliseconds);
    }
    table.add(std::move(counts));
    table.add(std::move(times));
  }
  return table;
}

/// How the figure draws a solver, and its name in the key.
int style_of(Solver solver) {
  constexpr std::array styles = {3, 8, 4, 5, 1, 2, 6};
  return styles.at(static_cast<std::size_t>(solver));
}
std::string title_of(Solver solver) {
  if (solver == Solver::fixed_point_integrated) return "fixed point, integrated F";
  return solver == Solver::newton_flow_integrated ? "Newton hom., integrated F"
                                                  : std::string(to_string(solver));
}

/// A panel of the figure: its rows of the data, and which solvers it shows.
struct Shown {
  const char* name;
  const std::vector<Trial>& trials;
  scene::Panel& panel;
  const char* look;
};

/// Rows and curves of a panel, a block of the data for each solver.
void add_trials(const Shown& shown, scene::Table& data, int& block) {
  for (const Solver s : all_solvers) {
    const auto rows = data.rows().size();
    for (const Trial& t : shown.trials) {
      if (t.solver != s) continue;
      const bool found = t.cost.converged && t.error < 0.01;
      data.add({shown.name, to_string(s), t.abscissa, found ? static_cast<double>(t.cost.iterations) : NAN,
                t.cost.seconds});
    }
    if (data.rows().size() == rows) continue;
    const bool drawn_as_lines = shown.name == std::string("length") && !is_flow(s);
    shown.panel.columns("", "abscissa:ordinate", {drawn_as_lines ? "lines" : shown.look, style_of(s)},
                        block++);
  }
}

void draw(const Trials& trials, scene::Show& show) {
  scene::Plot& plot = show.plots("Homotopies: tens to thousands of times Newton's iterations");
  scene::Table data({{"panel"}, {"solver", 3, true}, {"abscissa"}, {"ordinate"}, {"time_s"}});
  scene::Panel& history = plot.panel("iteration", "|F|, relative").place(0.115, 0.475, 0.545, 0.785);
  history.caption("N = 7, h = P/10").log_x(1, 3000).set("format x '%g'").log_y(1e-12, 30).set("ytics 1e3");
  history.key("at screen 0.5, screen 0.96 center top maxrows 4 samplen 4 spacing 1.05");
  int block = 0;
  for (const Trial& t : trials.history) {
    const std::vector<double>& norms = t.cost.history;
    for (std::size_t k = 0; k < norms.size(); k = std::max(k + 1, k * 21 / 20))
      data.add({"history", to_string(t.solver), k + 1, norms[k], {}});
    history.columns(title_of(t.solver), "abscissa:ordinate", scene::lines(style_of(t.solver)), block++);
  }
  const auto counts = [&](const char* caption, const char* x_label, double left, double bottom,
                          double top) -> scene::Panel& {
    scene::Panel& panel = plot.panel(x_label, "iterations").place(left, left + 0.36, bottom, top);
    return panel.caption(caption).log_y(1, 1e6).set("ytics 10").key("off");
  };
  scene::Panel& nodes = counts("h = P/2, Radau nodes", "number of nodes N", 0.615, 0.545, 0.785);
  nodes.log_x(6.3, 40).set("xtics (7, 10, 14, 20, 28, 35)").set("format x '%g'");
  add_trials({"nodes", trials.nodes, nodes, "linespoints"}, data, block);
  scene::Panel& length = counts("60 Radau nodes; no line: no solution found",
                                "length of the interval (periods)", 0.115, 0.105, 0.385);
  length.x_range(0, 4.1).set("xtics 1");
  add_trials({"length", trials.length, length, "linespoints"}, data, block);
  scene::Panel& step =
      counts("N = 7, h = P/10; at 0: chosen steps", "step of fictitious time", 0.615, 0.105, 0.385);
  step.x_range(-0.2, 3.7).set("xtics 1");
  add_trials({"step", trials.step, step, "linespoints"}, data, block);
  add_trials({"chosen", trials.chosen, step, "points"}, data, block);
  plot.size(760, 720).data(std::move(data));
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
  const Case& c = free_duffing_case();
  CollocationEquations equations(c.system, Basis::polynomial(radau, nodes), Form::printed);
  equations.begin(0, duffing_period() / 2, c.x0);
  equations.linearise(equations.start());
  Eigen::MatrixXd b;
  equations.matrix(b);
  const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(b).singularValues();
  const double condition = values[0] / values[values.size() - 1];
  return 8.0 / 3 * condition * condition * std::log(condition * 1e10);
}

void check_newton(const std::vector<Row>& rows, const Trials& trials, scene::Show& show) {
  show.between("largest length for Newton", {largest_length(trials, Solver::newton), "P"}, 2, 2.45,
               "recorded: 2 P converges, 2.5 P does not, for any number of nodes");
  show.between("largest length for Picard", {largest_length(trials, Solver::picard), "P"}, 0.5, 0.6,
               "0.55 P from the maximum by Chebyshev nodes, scene mcpi-limit; a step of the grid either way");
  show.near("length at which damped Newton still converges",
            {largest_length(trials, Solver::damped_newton), "P"}, 4, 1e-9,
            "its residual falls with every step; the last length tried");
  const auto iterations = [](const Row& row) {
    return static_cast<double>(row.costs[0].iterations) / row.count;
  };
  show.between("iterations of Newton, Duffing, N = 7, P/10", iterations(rows[0]), 3, 4, "recorded: 3 to 4");
  show.between("iterations of Newton, three masses, N = 35, 20 s", iterations(rows.back()), 3, 5,
               "recorded: 4 to 5, with another test for the end");
}

void check_flows(const Trials& trials, scene::Show& show) {
  for (const int N : {7, 35}) {
    const Trial& t = at(trials.nodes, Solver::newton_flow_printed, N);
    show.at_most(fmt::format("iterations of the Newton homotopy, N = {}, P/2", N),
                 t.cost.converged ? static_cast<double>(t.cost.iterations) : HUGE_VAL, most_iterations(N),
                 "bound for linear equations, 8/3 cond^2 log(cond/tol)");
  }
  const auto integrated = [&](double N) {
    return static_cast<double>(at(trials.nodes, Solver::newton_flow_integrated, N).cost.iterations);
  };
  show.between("iterations with 35 nodes to those with 10, integrated equations",
               integrated(35) / integrated(10), 0.5, 1.5,
               "the spectrum of the integrated equations does not depend on the nodes once they resolve it");
  for (const double periods : {2.5, 4.0}) {
    const Trial &flow = at(trials.length, Solver::fixed_point_integrated, periods),
                &newton = at(trials.length, Solver::damped_newton, periods);
    show.between(fmt::format("iterations of the fixed-point homotopy at {} P, integrated", periods),
                 flow.cost.converged ? static_cast<double>(flow.cost.iterations) : HUGE_VAL, 1e4, 2e5,
                 "thousands of steps, within the 200 000 allowed");
    show.at_most(fmt::format("distance to the root of damped Newton at {} P", periods),
                 (flow.x - newton.x).cwiseAbs().maxCoeff(), 1e-5,
                 "|F| of 1e-9 over the least singular value, of the order of 1e-4");
  }
}

void put(const std::vector<Row>& rows, const Trials& trials, scene::Show& show) {
  draw(trials, show);
  show.table(table_of(rows, show.quick()));
  check_newton(rows, trials, show);
  if (!show.quick()) check_flows(trials, show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result rows(
      "solvers-on-rows",
      "rows of intervals with the steps and shapes of Tables 4.2, 4.4 and 4.6, from the constant state of "
      "each interval, until |F| is 1e-10 of the start; homotopies by Euler's rule with steps of 1, at most "
      "10 000",
      rows_of);
  const scene::Result trials(
      "solvers-on-one-interval",
      "free Duffing from its maximum, polynomials; against the iteration, the number of nodes, the length of "
      "the interval (60 Radau nodes, homotopies with steps of 1.9) and the step of fictitious time",
      trials_of);
  return {{.name = "solver-study",
           .title = "Scalar homotopies, Picard and Newton on the equations of an interval",
           .content = scene::Content(put, rows, trials)}};
}

}  // namespace nlmech::chapters::rbf_ivp::solver_study

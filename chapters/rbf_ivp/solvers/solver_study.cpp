/// Future work: the dissertation solves Eq. 4.16 by Newton's iteration and states that methods without the
/// inverse of the Jacobian could be used. This study compares the scalar homotopies of chapter 2 and Picard
/// iteration.
#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/examples/cases.hpp"
#include "chapters/rbf_ivp/solvers/collocation_equations.hpp"
#include "nlmech/algebraic/homotopies/scalar_homotopy.hpp"
#include "nlmech/collocation/basis.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::rbf_ivp::solver_study {
namespace {

using algebraic::ScalarHomotopy;
using collocation::Basis;
using collocation::NodeFamily;
using Eigen::VectorXd;

constexpr auto lobatto = NodeFamily::legendre_gauss_lobatto, radau = NodeFamily::left_end_and_radau;
constexpr double reduction = 1e-10, too_much = 1e10;  // relative to |F| at the start: converged; diverged

enum class Solver { newton, damped_newton, picard, fixed_point, newton_homotopy };
using enum Solver;

/// Interval of the free Duffing oscillator starting at a maximum.
Interval interval_of(const Basis& basis, double periods) {
  const Case& c = free_duffing_case();
  return {c.system, 0, periods * duffing_period(), c.x0, basis.nodes(), basis.derivative()};
}

/// Result of a solver on an interval.
struct Solve {
  VectorXd x;                   ///< states at all nodes except the first
  std::int64_t iterations = 0;  ///< updates of x
  bool converged = false;       ///< was |F| reduced by `reduction`?
  bool diverged = false;        ///< |F| above `too_much` or non-finite; else the iteration limit
  bool is_solution = false;     ///< converged, with errors below 0.01 of the amplitudes at all nodes
  std::vector<double> scattered =
      {};  ///< iterations from 16 starts that differ by rounding; infinite without convergence
};

/// Settings of the homotopies.
struct Flow {
  std::int64_t most = 200'000;  ///< maximum number of steps
  double step = 1;              ///< step size of fictitious time
};

bool solves(const VectorXd& x, const Interval& interval) {
  const Case& c = free_duffing_case();
  double error = 0;
  for (Eigen::Index k = 0; k + 1 < interval.nodes.size(); ++k) {
    const ivp::State state = x.segment(2 * k, 2);
    const ivp::State e = error_at(c, interval.h * interval.nodes[k + 1], state);
    error = std::max(error, e.cwiseQuotient(c.amplitude).cwiseAbs().maxCoeff());
  }
  return error < 0.01;
}

/// Solves from the constant state until |F| is reduced by `reduction`. @param roundings multiples of eps by
/// which the start is enlarged
Solve solve(Solver solver, Form form, const Interval& interval, const Flow& flow = {}, int roundings = 0) {
  algebraic::DenseEquations equations = collocation_equations(interval, form);
  Solve found{.x = interval.start() * (1 + roundings * std::numeric_limits<double>::epsilon())};
  double first = 0;
  VectorXd latest = found.x;
  const auto watch = [&](std::int64_t index, const VectorXd& x, double norm) {
    if (index == 0) first = norm;
    latest = x;
    found.iterations = index;
    found.converged = norm <= reduction * first;
    found.diverged = !(norm <= too_much * first);
    return !found.converged && !found.diverged;
  };
  // Newton's methods stop by their updates; the observer stops all solvers by |F|.
  const auto observer = [&](const algebraic::Iterate& i) { return watch(i.index, i.x, i.norm); };
  if (solver == picard) {
    VectorXd f(found.x.size());
    for (int k = 0; k < 1000; ++k, found.x -= f) {
      equations.residual(found.x, f);
      if (!watch(k, found.x, f.norm())) break;
    }
  } else if (solver == newton) {
    static_cast<void>(
        find_root(algebraic::Newton{.tolerance = 0, .iterations = 100}, equations, found.x, observer));
  } else if (solver == damped_newton) {
    static_cast<void>(
        find_root(algebraic::DampedNewton{.tolerance = 0, .iterations = 100}, equations, found.x, observer));
  } else {
    const auto function =
        solver == fixed_point ? ScalarHomotopy::Function::fixed_point : ScalarHomotopy::Function::newton;
    const ScalarHomotopy method{.function = function, .step = flow.step, .tolerance = 0, .steps = flow.most};
    static_cast<void>(find_root(method, equations, found.x, observer));
  }
  found.x = latest;
  found.is_solution = found.converged && solves(found.x, interval);
  return found;
}

/// Solves, and repeats short runs from 16 more starts that differ by rounding.
Solve solve_scattered(Solver solver, Form form, const Interval& interval, const Flow& flow) {
  Solve found = solve(solver, form, interval, flow);
  if (!found.converged || found.iterations > 5000) return found;
  for (int k = 1; k <= 16; ++k) {
    const Solve one = solve(solver, form, interval, flow, k);
    found.scattered.push_back(one.converged ? static_cast<double>(one.iterations) : HUGE_VAL);
  }
  return found;
}

/// A table column: a solver and a form of the equations.
struct Column {
  const char* name;
  Solver solver;
  Form form;
};
constexpr std::array columns = {Column{"Newton", newton, Form::printed},
                                Column{"damped Newton", damped_newton, Form::printed},
                                Column{"Picard", picard, Form::integrated},
                                Column{"fixed-point homotopy", fixed_point, Form::printed},
                                Column{"Newton homotopy", newton_homotopy, Form::printed},
                                Column{"fixed-point homotopy, integrated", fixed_point, Form::integrated},
                                Column{"Newton homotopy, integrated", newton_homotopy, Form::integrated}};

/// A table row: trial functions, interval length, and the results of all solvers.
struct Row {
  std::string functions;
  Basis basis;
  double periods;
  Flow flow = {};
  std::vector<Solve> solves = {};  ///< one per column

  /// Iterations: median over the starts if there are several; infinite without convergence.
  [[nodiscard]] double iterations(std::size_t column) const {
    const Solve& s = solves[column];
    if (!s.scattered.empty()) return median(s.scattered);
    return s.converged ? static_cast<double>(s.iterations) : HUGE_VAL;
  }
};

/// All rows, and the longest intervals on which solvers converge.
struct Study {
  std::vector<Row> rows;
  double longest_newton, longest_picard;  ///< longest interval with convergence to the solution, periods
};

/// Longest interval with convergence, in increments of P/20, with 60 Radau nodes.
double longest(Solver solver, Form form) {
  const Basis basis = Basis::polynomial(radau, 60);
  int k = 1;
  while (k <= 80 && solve(solver, form, interval_of(basis, 0.05 * k)).is_solution) ++k;
  return 0.05 * (k - 1);
}

Study compute(bool quick) {
  const double P = duffing_period();
  const auto gaussians = [](int nodes, double shape) {
    return Basis::radial(lobatto, nodes, collocation::Kernel::gaussian, shape);
  };
  Study study{{{"7 Gaussians, Table 4.2", gaussians(7, 0.77 * P / 10), 0.1, {.most = 10'000}},
               {"35 Gaussians, Table 4.2", gaussians(35, 8.5), 1, {.most = 10'000}}},
              longest(newton, Form::printed),
              longest(picard, Form::integrated)};
  for (const int nodes : {7, 10, 35})
    study.rows.push_back({fmt::format("{} Radau polynomials", nodes), Basis::polynomial(radau, nodes), 0.5});
  for (const double periods : {2.5, 4.0})
    study.rows.push_back({"60 Radau polynomials", Basis::polynomial(radau, 60), periods, {.step = 1.9}});
  for (Row& row : study.rows) {
    if (quick) row.flow.most = 500;
    for (const Column& c : columns)
      row.solves.push_back(solve_scattered(c.solver, c.form, interval_of(row.basis, row.periods), row.flow));
  }
  return study;
}

scene::Cell iterations_cell(const Row& row, std::size_t column) {
  const Solve& s = row.solves[column];
  if (s.is_solution && s.scattered.empty())
    return fmt::format("{}, one run", scene::format_number(double(s.iterations), 2));
  if (s.is_solution) {
    const auto [least, most] = std::ranges::minmax(s.scattered);
    if (least == most && most == static_cast<double>(s.iterations)) return s.iterations;
    return fmt::format("{:g} ({:g} to {:g})", row.iterations(column), least, most);
  }
  if (s.converged) return "another root";
  return s.diverged ? "diverges" : fmt::format("> {}", s.iterations);
}

/// Bound for gradient descent with Polyak's step on linear equations: each step multiplies |e|^2 by at most 1
/// - (3/4)/cond^2, and |F| is between the least and the largest singular value times |e|.
double most_iterations(const Row& row) {
  const Interval interval = interval_of(row.basis, row.periods);
  algebraic::DenseEquations equations = collocation_equations(interval, Form::printed);
  equations.linearise(interval.start());
  Eigen::MatrixXd b;
  equations.matrix(b);
  const VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(b).singularValues();
  const double condition = values[0] / values[values.size() - 1];
  return 8.0 / 3 * condition * condition * std::log(condition * 1e10);
}

void check_flows(const std::vector<Row>& rows, scene::Show& show) {
  for (const auto& [row, nodes] : {std::pair<std::size_t, int>(2, 7), {4, 35}}) {
    show.at_most(fmt::format("iterations of the Newton homotopy, N = {}, P/2", nodes),
                 rows[row].iterations(4), most_iterations(rows[row]),
                 "bound for linear equations, 8/3 cond^2 log(cond/tol)");
  }
  show.between("iterations with 35 nodes to those with 10, integrated equations",
               rows[4].iterations(6) / rows[3].iterations(6), 0.5, 1.5,
               "the spectrum of the integrated equations does not depend on the nodes once they resolve it");
  for (const auto& [row, periods] : {std::pair<std::size_t, double>(5, 2.5), {6, 4.0}}) {
    show.between(fmt::format("iterations of the fixed-point homotopy at {} P, integrated", periods),
                 rows[row].iterations(5), 1e4, 2e5, "thousands of steps, within the 200 000 allowed");
    show.at_most(fmt::format("distance to the root of damped Newton at {} P", periods),
                 (rows[row].solves[5].x - rows[row].solves[1].x).cwiseAbs().maxCoeff(), 1e-5,
                 "|F| of 1e-9 over the least singular value, of the order of 1e-4");
  }
}

void put(const Study& study, scene::Show& show) {
  scene::ColumnsOf<std::vector<Row>> table = {{"trial functions", &Row::functions},
                                              {"h (P)", &Row::periods, 2}};
  for (std::size_t i = 0; i < columns.size(); ++i)
    table.push_back({columns.at(i).name, [i](const Row& r) { return iterations_cell(r, i); }});
  show.table(study.rows, table);
  show.between("largest length for Newton", {study.longest_newton, "P"}, 2, 2.45,
               "regression value: 2 P converges, 2.5 P does not, for any number of nodes");
  show.between("largest length for Picard", {study.longest_picard, "P"}, 0.5, 0.6,
               "0.55 P from the maximum by Chebyshev nodes, scene mcpi-limit; a step of the grid either way");
  show.equals("does damped Newton converge at 4 P?", study.rows[6].solves[1].is_solution, 1,
              "its residual falls with every step");
  show.between("iterations of Newton, N = 7, P/10", study.rows[0].iterations(0), 3, 4,
               "regression value: 3 to 4");
  if (!show.quick()) check_flows(study.rows, show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result study(
      "solvers-on-one-interval",
      "free Duffing from its maximum, from the constant state until |F| is 1e-10 of the start; homotopies by "
      "Euler's rule with steps of 1, at most 10 000 with Gaussians, else 200 000; of 1.9 on the longest "
      "intervals",
      compute);
  return {{.name = "solver-study",
           .title = "Iterations of Newton, Picard and the scalar homotopies for the equations of an interval",
           .place = "our own, for future work: solvers without the inverse of the Jacobian",
           .content = scene::Content(put, study)}};
}

}  // namespace nlmech::chapters::rbf_ivp::solver_study

#include "nlmech/bvp/typed/typed_solve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "nlmech/program/switches.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::bvp {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Options options_for(double tolerance) {
  Options options;
  options.tolerance = tolerance;
  options.most_intervals = 20'000;
  options.verification = Verification::pieces;
  options.verification_tolerance = std::max(1e-10, 100 * tolerance);
  return options;
}

/// Each interval divided into four.
std::vector<double> quartered(const std::vector<double>& times) {
  std::vector<double> finer;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    for (int k = 0; k < 4; ++k) finer.push_back(times[i] + (times[i + 1] - times[i]) * k / 4);
  }
  finer.push_back(times.back());
  return finer;
}

/// An unknown end must lie beyond the known points and before any jump that is no point.
void check_end(const TypedProblem& problem, Solution& solution) {
  if (!problem.end_parameter()) return;
  const std::vector<double> points = problem.points();
  const double last = points[points.size() - 2], end = solution.parameters()[*problem.end_parameter()];
  if (!(end > last)) {
    solution.status =
        failed_with(Outcome::outside_validity,
                    "the end {:.9g} that was found is not after {:.9g}, the last known point", end, last);
    return;
  }
  const program::Equations& equations = problem.equations();
  const std::vector<double> jumps = program::Switches(equations.graph(), equations.slopes()).times(last, end);
  if (!jumps.empty() && jumps.size() <= TypedProblem::most_jumps)
    solution.status = failed_with(Outcome::outside_validity,
                                  "the equations jump at {:.9g}, before the end {:.9g} that was found; give "
                                  "a guess of the end between them and beyond",
                                  jumps.front(), end);
}

Solution solve_finite(const TypedProblem& problem, Start start, double tolerance) {
  if (start.mesh.empty()) start.mesh = problem.mesh();
  Options options = options_for(tolerance);
  Solution solution = solve(problem, start, options);
  options.refine = false;
  for (int i = 0; i < 5 && solution.status.outcome() == Outcome::spurious_root; ++i) {
    Start finer = start_from(solution);
    finer.mesh = quartered(solution.mesh());
    if (finer.mesh.size() > static_cast<std::size_t>(options.most_intervals)) break;
    solution = solve(problem, finer, options);
  }
  if (solution.status.ok()) check_end(problem, solution);
  return solution;
}

/// The solution up to its end, continued linearly to the end of @p problem. Values that are rounding are 0: a
/// negative one may have no root.
Start extended(const TypedProblem& problem, const Solution& solution) {
  const auto copy = std::make_shared<const Solution>(solution);
  const double last = copy->end();
  const VectorXd least = 1e-14 * copy->node_values().cwiseAbs().rowwise().maxCoeff();
  Start start = start_from(solution);
  start.states = [copy, last, least](double t, VectorXd& x) {
    x = copy->at(std::clamp(t, copy->begin(), last));
    for (Index i = 0; i < x.size(); ++i) {
      if (std::abs(x[i]) <= least[i]) x[i] = 0;
    }
    if (t > last) x += (t - last) * copy->unknowns.intervals.back().slopes.rightCols(1);
  };
  constexpr int parts = 8;
  const double end = problem.points().back();
  for (int k = 1; k <= parts; ++k) start.mesh.push_back(last + (end - last) * k / parts);
  for (const double t : problem.mesh()) {
    if (t > last && t < end) start.mesh.push_back(t);
  }
  std::ranges::sort(start.mesh);
  return start;
}

/// Largest difference of two solutions up to @p end, relative to the size of each state.
double difference(const Solution& a, const Solution& b, double end) {
  const VectorXd sizes = b.node_values().cwiseAbs().rowwise().maxCoeff();
  double worst = 0;
  for (const double t : a.mesh()) {
    if (t > end) break;
    const VectorXd off = (a.at(t) - b.at(t)).cwiseAbs();
    for (Index i = 0; i < off.size(); ++i) {
      if (off[i] > 0) worst = std::max(worst, off[i] / sizes[i]);
    }
  }
  return worst;
}

/// Largest change after @p s of the components with a condition at infinity, relative to their sizes.
double change_after(const TypedProblem& problem, const Solution& solution, double s) {
  const auto at = [&](double place) { return problem.components(solution.at(place), solution.parameters()); };
  const VectorXd a = at(s), b = at(solution.end());
  double worst = 0;
  for (const int i : problem.components_at_infinity()) {
    double size = 0;
    for (const double node : solution.node_times()) size = std::max(size, std::abs(at(node)[i]));
    if (size > 0) worst = std::max(worst, std::abs(a[i] - b[i]) / size);
  }
  return worst;
}

Solution solve_infinite(TypedProblem& problem, const Start& start, double tolerance) {
  constexpr int least_doublings = 6, most_doublings = 40;
  const double from = problem.points().front();
  const double near = std::max(1e-9, 10 * tolerance), pulse = problem.last_pulse();
  double end = problem.points().back();
  Solution before = solve_finite(problem, start, tolerance);
  double change = 0;
  for (int k = 0; k < most_doublings; ++k) {
    const double middle = end;
    end = from + 2 * (end - from);
    problem.truncate(end);
    Solution next = solve_finite(problem, before.status.ok() ? extended(problem, before) : start, tolerance);
    const bool has_all = middle >= pulse;
    if (!next.status.ok() && has_all && (before.status.ok() || k > 2)) return next;
    if (has_all && before.status.ok() && next.status.ok()) {
      change = change_after(problem, next, middle);
      if (change <= near && difference(before, next, from + (middle - from) / 2) <= near) return next;
    }
    before = std::move(next);
    if (has_all && k >= least_doublings && change > 0.1) break;
  }
  before.status = failed_with(Outcome::not_converged,
                              "the solution does not approach its values at infinity: up to t = {:.3g} they "
                              "still change by {:.2g} of their size over the last half",
                              problem.time(end, before.parameters()), change);
  return before;
}

/// The states of a solution times @p factor.
Start scaled(const Solution& solution, double factor) {
  Start start = start_from(solution);
  start.states = [states = start.states, factor](double t, VectorXd& x) {
    states(t, x);
    x *= factor;
  };
  return start;
}

}  // namespace

Solution solve_typed(TypedProblem& problem, const Start& start, double tolerance) {
  return problem.is_infinite() ? solve_infinite(problem, start, tolerance)
                               : solve_finite(problem, start, tolerance);
}

Search find_solutions(TypedProblem& problem, const Start& guess, int starts, std::size_t most,
                      double tolerance) {
  constexpr int sizes = 8;
  constexpr std::array factors = {-1., 3., 10., 30., -3., -10., 100., -30., 300.};
  Search search;
  for (int k = 0; k < starts && search.found.size() < most; ++k) {
    const double size = k == 0 ? 0 : 0.1 * std::pow(3, (k - 1) % sizes);
    const bool scales = k > 0 && k % 2 == 0 && !search.found.empty();
    const Start start = k == 0   ? guess
                        : scales ? scaled(search.found.front().solution,
                                          factors[static_cast<std::size_t>(k / 2 - 1) % factors.size()])
                                 : problem.random_guess(size, static_cast<unsigned>(k));
    Solution solution = solve_typed(problem, start, tolerance);
    if (k == 0) search.first = solution.status;
    const auto is_it = [&](const FoundSolution& other) { return are_same(other.solution, solution); };
    if (solution.status.ok() && std::ranges::none_of(search.found, is_it))
      search.found.push_back({std::move(solution), k, size});
  }
  return search;
}

bool are_same(const Solution& a, const Solution& b) {
  constexpr double same = 1e-5;
  const VectorXd &p = a.parameters(), &q = b.parameters();
  for (Index i = 0; i < p.size(); ++i) {
    if (!(std::abs(p[i] - q[i]) <= same * std::max(std::abs(p[i]), std::abs(q[i])))) return false;
  }
  return difference(a, b, b.end()) <= same;
}

}  // namespace nlmech::bvp

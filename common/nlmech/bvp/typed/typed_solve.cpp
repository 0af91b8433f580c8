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

/// The solution up to its end, continued linearly to @p end.
Start extended(const Solution& solution, double end) {
  const auto copy = std::make_shared<const Solution>(solution);
  const double last = copy->end();
  Start start = start_from(solution);
  start.states = [copy, last](double t, VectorXd& x) {
    x = copy->at(std::clamp(t, copy->begin(), last));
    if (t > last) x += (t - last) * copy->unknowns.intervals.back().slopes.rightCols(1);
  };
  constexpr int parts = 8;
  for (int k = 1; k <= parts; ++k) start.mesh.push_back(last + (end - last) * k / parts);
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

/// Largest change after @p t of the components with a condition at infinity, relative to their sizes.
double change_after(const TypedProblem& problem, const Solution& solution, double t) {
  const VectorXd a = problem.components_at(solution, t), b = problem.components_at(solution, solution.end());
  double worst = 0;
  for (const int i : problem.components_at_infinity()) {
    double size = 0;
    for (const double at : solution.node_times())
      size = std::max(size, std::abs(problem.components_at(solution, at)[i]));
    if (size > 0) worst = std::max(worst, std::abs(a[i] - b[i]) / size);
  }
  return worst;
}

Solution solve_infinite(TypedProblem& problem, const Start& start, double tolerance) {
  constexpr int least_doublings = 6, most_doublings = 40;
  const double from = problem.points().front();
  const double near = std::max(1e-9, 10 * tolerance);
  double end = problem.points().back();
  Solution before = solve_finite(problem, start, tolerance);
  double change = 0;
  for (int k = 0; k < most_doublings; ++k) {
    const double middle = end;
    end = from + 2 * (end - from);
    problem.truncate(end);
    Solution next = solve_finite(problem, before.status.ok() ? extended(before, end) : start, tolerance);
    if (!next.status.ok() && (before.status.ok() || k > 2)) return next;
    if (before.status.ok() && next.status.ok()) {
      change = change_after(problem, next, middle);
      if (change <= near && difference(before, next, from + (middle - from) / 2) <= near) return next;
    }
    before = std::move(next);
    if (k >= least_doublings && change > 0.1) break;
  }
  before.status = failed_with(Outcome::not_converged,
                              "the solution does not approach its values at infinity: up to t = {:.3g} they "
                              "still change by {:.2g} of their size over the last half",
                              end, change);
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

bool is_known(const std::vector<FoundSolution>& known, const Solution& solution) {
  constexpr double same = 1e-5;
  return std::ranges::any_of(known, [&](const FoundSolution& other) {
    const VectorXd &p = other.solution.parameters(), &q = solution.parameters();
    for (Index i = 0; i < p.size(); ++i) {
      if (!(std::abs(p[i] - q[i]) <= same * std::max(std::abs(p[i]), std::abs(q[i])))) return false;
    }
    return difference(other.solution, solution, solution.end()) <= same;
  });
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
    if (solution.status.ok() && !is_known(search.found, solution))
      search.found.push_back({std::move(solution), k, size});
  }
  return search;
}

Continuation follow_parameter(const std::function<TypedProblem(double)>& make, double from, double to,
                              Solution solution, double tolerance) {
  constexpr double least_step = 1e-4, first_step = 0.1, growth = 1.7;
  constexpr int most_rejected = 4;  // damped Newton steps: more may lead to another branch
  Continuation result{std::move(solution), from, 0};
  Options options = options_for(std::max(tolerance, 1e-6));
  options.verification = Verification::none;
  const auto value = [&](double share) {
    if (share >= 1) return to;
    return from * to > 0 ? from * std::pow(to / from, share) : from + (to - from) * share;
  };
  double share = 0, step = first_step;
  while (share < 1) {
    if (1 - share < 1.5 * step) step = 1 - share;
    TypedProblem problem = make(value(share + step));
    Solution next = solve(problem, start_from(result.solution), options);
    const bool is_close = next.status.ok() && next.statistics.rejected <= most_rejected;
    if (!is_close && step <= least_step) {
      if (next.status.ok())
        next.status = Status::failure(Outcome::newton_diverged, "the steps are too short");
      result.solution.status = next.status;
      return result;
    }
    if (!is_close) {
      step = std::max(step / 3, least_step);
      continue;
    }
    share += step;
    step *= growth;
    ++result.steps;
    result.reached = value(share);
    result.solution = std::move(next);
  }
  TypedProblem problem = make(to);
  result.solution = solve_typed(problem, start_from(result.solution), tolerance);
  return result;
}

}  // namespace nlmech::bvp

#include "nlmech/bvp/solve.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "nlmech/bvp/newton/newton_iteration.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::bvp {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void check_options(const Options& o) {
  const auto require = [](bool good, const char* name, double value) {
    if (!good) throw invalid_argument("bvp: the option {} = {} is out of range", name, value);
  };
  require(o.intervals >= 1, "intervals", o.intervals);
  require(o.tolerance > 0, "tolerance", o.tolerance);
  require(o.meshes >= 1, "meshes", o.meshes);
  require(o.most_intervals >= 1, "most_intervals", o.most_intervals);
  require(o.newton_tolerance > 0, "newton_tolerance", o.newton_tolerance);
  require(o.newton_iterations >= 1, "newton_iterations", o.newton_iterations);
  require(o.least_damping > 0 && o.least_damping <= 1, "least_damping", o.least_damping);
  require(o.verification_tolerance > 0, "verification_tolerance", o.verification_tolerance);
}

/// The times of the start's mesh, mapped to the problem's ends, with its points among them; or equal ones.
std::vector<double> first_mesh(const std::vector<double>& points, const Start& start, int intervals) {
  std::vector<double> times = points;
  if (start.mesh.size() > 1) {
    const double from = start.mesh.front(),
                 scale = (points.back() - points.front()) / (start.mesh.back() - from);
    for (const double t : start.mesh) times.push_back(points.front() + (t - from) * scale);
  } else {
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      for (int i = 1; i < intervals; ++i) {
        times.push_back(points[k] + (points[k + 1] - points[k]) * i / intervals);
      }
    }
  }
  std::sort(times.begin(), times.end());
  // Neighbours that differ by rounding are one; a point of the problem wins.
  const double least = 1e-10 * (points.back() - points.front());
  std::vector<double> result;
  for (const double t : times) {
    const bool is_point = std::find(points.begin(), points.end(), t) != points.end();
    if (result.empty() || t - result.back() > least) {
      result.push_back(t);
    } else if (is_point) {
      result.back() = t;
    }
  }
  return result;
}

Unknowns on_mesh(const std::vector<double>& mesh, const std::vector<double>& points, const Scheme& scheme,
                 int states) {
  Unknowns y;
  int phase = 0;
  for (std::size_t k = 0; k + 1 < mesh.size(); ++k) {
    if (mesh[k] >= points[static_cast<std::size_t>(phase) + 1]) ++phase;
    const MatrixXd zero = MatrixXd::Zero(states, scheme.nodes.size());
    y.intervals.push_back({mesh[k], mesh[k + 1] - mesh[k], phase, zero, zero});
  }
  return y;
}

void fill(const Start& start, double from, double scale, const Scheme& scheme, Unknowns& y) {
  VectorXd x(y.intervals.front().values.rows());
  for (Interval& interval : y.intervals) {
    for (Index j = 0; j < scheme.nodes.size(); ++j) {
      const double t = interval.t0 + scheme.nodes[j] * interval.h;
      start.states(from + (t - y.intervals.front().t0) * scale, x);
      interval.values.col(j) = x;
    }
  }
  y.parameters = start.parameters;
}

/// The same piecewise polynomial on another mesh, which has the phases' ends in common.
Unknowns transfer(const Solution& old, const std::vector<double>& mesh, const std::vector<double>& points) {
  const Scheme& scheme = *old.scheme;
  Unknowns y = on_mesh(mesh, points, scheme, static_cast<int>(old.unknowns.intervals.front().values.rows()));
  for (Interval& interval : y.intervals) {
    const Index last = scheme.nodes.size() - 1;
    for (Index j = 0; j <= last; ++j) {
      const double t = interval.t0 + scheme.nodes[j] * interval.h;
      interval.values.col(j) = old.at(t, j == last ? Side::before : Side::after);
    }
  }
  y.parameters = old.parameters();
  return y;
}

/// max |u' - f(t, u)| / (1 + max |f|) of each interval, between its nodes.
std::vector<double> residuals(const Problem& problem, const Solution& solution) {
  const auto& all = solution.unknowns.intervals;
  const Scheme& s = *solution.scheme;
  VectorXd scale = VectorXd::Ones(problem.states()), f(problem.states()), u(problem.states());
  for (const Interval& i : all) {
    scale = scale.cwiseMax((i.slopes.cwiseAbs().rowwise().maxCoeff().array() + 1).matrix());
  }
  std::vector<double> result;
  for (const Interval& i : all) {
    const MatrixXd at = i.values * s.probe_value.transpose() + i.h * (i.slopes * s.probe_slope.transpose());
    const MatrixXd dot =
        i.values * s.probe_value_dot.transpose() / i.h + i.slopes * s.probe_slope_dot.transpose();
    double largest = 0;
    for (Index j = 0; j < s.probes.size(); ++j) {
      u = at.col(j);
      problem.rhs(i.t0 + s.probes[j] * i.h, u, solution.parameters(), f);
      const double part = (dot.col(j) - f).cwiseQuotient(scale).lpNorm<Eigen::Infinity>();
      largest = part <= largest ? largest : part;  // keeps a NaN
    }
    result.push_back(largest);
  }
  return result;
}

/// Divides and joins intervals by their residuals.
std::vector<double> next_mesh(const Solution& solution, const std::vector<double>& residual,
                              double tolerance) {
  const auto& all = solution.unknowns.intervals;
  const auto order = static_cast<double>(solution.scheme->order);
  const auto ratio = [&](std::size_t k) { return std::pow(residual[k] / tolerance, 1 / order); };
  std::vector<double> mesh;
  for (std::size_t k = 0; k < all.size(); ++k) {
    mesh.push_back(all[k].t0);
    const double r = std::isfinite(residual[k]) ? ratio(k) : 2;
    const bool joins =
        k + 1 < all.size() && all[k].phase == all[k + 1].phase && r < 0.4 && ratio(k + 1) < 0.4;
    if (joins) {
      ++k;
    } else if (r > 1) {
      const int parts = std::clamp(static_cast<int>(std::ceil(1.1 * r)), 2, 4);
      for (int i = 1; i < parts; ++i) mesh.push_back(all[k].t0 + all[k].h * i / parts);
    }
  }
  mesh.push_back(solution.end());
  return mesh;
}

Status mesh_limit(const Options& options, const Solution& solution) {
  return failed_with(Outcome::step_limit,
                     "bvp: on {} intervals the residual is {:.3g}, above the tolerance {:.3g}, and the {} "
                     "meshes or {} intervals allowed are used up; allow more, or ask for less",
                     solution.unknowns.intervals.size(), solution.residual, options.tolerance, options.meshes,
                     options.most_intervals);
}

/// Solves on one mesh after the other.
Status refine(const Problem& problem, const Options& options, Solution& solution) {
  const std::vector<double> points = problem.points();
  for (int k = 1;; ++k) {
    NewtonSystem system(problem, *solution.scheme);
    Status status = iterate(system, solution.unknowns, options, solution.statistics, solution.pivot_ratio);
    ++solution.statistics.steps;
    if (!status.ok()) return status;
    const std::vector<double> residual = residuals(problem, solution);
    solution.residual = *std::max_element(residual.begin(), residual.end());
    if (solution.residual <= options.tolerance || !options.refine) return {};
    const std::vector<double> mesh = next_mesh(solution, residual, options.tolerance);
    if (k == options.meshes || static_cast<int>(mesh.size()) - 1 > options.most_intervals) {
      return mesh_limit(options, solution);
    }
    solution.unknowns = transfer(solution, mesh, points);
  }
}

Status spurious(double t, double error, const Options& options) {
  return failed_with(Outcome::spurious_root,
                     "bvp: the root of the collocation equations is no solution: integrated from its own "
                     "initial values the trajectory is {:.3g} off (relative, at t = {:.6g}; allowed {:.2g}); "
                     "refine the mesh, or start elsewhere",
                     error, t, options.verification_tolerance);
}

}  // namespace

void verify_by_integration(const Problem& problem, const Options& options, Solution& solution) {
  const auto& all = solution.unknowns.intervals;
  VectorXd scale = VectorXd::Ones(problem.states());
  for (const Interval& i : all) {
    scale = scale.cwiseMax((i.values.cwiseAbs().rowwise().maxCoeff().array() + 1).matrix());
  }
  VectorXd x = solution.first();
  double worst = 0, where = solution.begin();
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (options.verification == Verification::pieces) {
      x = all[k].values.col(0);
    } else if (k > 0 && all[k].phase != all[k - 1].phase) {
      x += all[k].values.col(0) - all[k - 1].values.rightCols(1);
    }
    const double end = k + 1 < all.size() ? all[k + 1].t0 : all[k].t0 + all[k].h;
    const std::vector<double> times{all[k].t0, end};
    const Integration arc = integrate_at(problem, x, solution.parameters(), times);
    if (!arc.status.ok()) {
      solution.integration_error = std::numeric_limits<double>::infinity();
      solution.status = failed_with(Outcome::spurious_root,
                                    "bvp: the root cannot be integrated from its own initial values ({}); "
                                    "refine the mesh, or start elsewhere",
                                    arc.status.sentence());
      return;
    }
    x = arc.states.col(1);
    const VectorXd difference = x - all[k].values.rightCols(1);
    const double error = difference.cwiseQuotient(scale).lpNorm<Eigen::Infinity>();
    if (!(error <= worst)) {
      worst = error;
      where = end;
    }
  }
  solution.integration_error = worst;
  solution.integrated_end = x;
  if (!(worst <= options.verification_tolerance)) solution.status = spurious(where, worst, options);
}

Solution solve(const Problem& problem, const Start& start, const Options& options) {
  check_problem(problem);
  check_options(options);
  if (!start.states) throw std::invalid_argument("bvp: the start has no states");
  if (start.parameters.size() != problem.parameters()) {
    throw invalid_argument("bvp: the start has {} parameters, the problem {}", start.parameters.size(),
                           problem.parameters());
  }
  const Stopwatch watch;
  Solution solution;
  SchemeOrStatus made =
      make_scheme(options.family, options.nodes, options.relative_shape, options.keep_ill_conditioned);
  solution.status = std::move(made.status);
  if (!solution.status.ok()) return solution;
  solution.scheme = std::make_shared<const Scheme>(std::move(made.scheme));
  const std::vector<double> points = problem.points();
  const std::vector<double> mesh = first_mesh(points, start, options.intervals);
  solution.unknowns = on_mesh(mesh, points, *solution.scheme, problem.states());
  const bool mapped = start.mesh.size() > 1;
  const double length = points.back() - points.front();
  fill(start, mapped ? start.mesh.front() : points.front(),
       mapped ? (start.mesh.back() - start.mesh.front()) / length : 1, *solution.scheme, solution.unknowns);
  solution.status = refine(problem, options, solution);
  if (solution.status.ok() && options.verification != Verification::none)
    verify_by_integration(problem, options, solution);
  solution.statistics.seconds = watch.seconds();
  return solution;
}

}  // namespace nlmech::bvp

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "nlmech/bvp/solve.hpp"
#include "nlmech/ivp/collocation/adaptive_collocation.hpp"
#include "nlmech/ivp/runge_kutta/dop853.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::bvp {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double integration_tolerance = 1e-13;  // of integrations that verify a solution

/// How a piece of a solution is integrated: by an implicit method where it is stiff.
struct Integrator {
  bool is_implicit = true;
  double tolerance = integration_tolerance;
};

Status spurious(double t, double error, const Options& options) {
  return failed_with(Outcome::spurious_root,
                     "bvp: the root of the collocation equations is no solution: integrated from its own "
                     "initial values the trajectory is {:.3g} off (relative, at t = {:.6g}; allowed {:.2g}); "
                     "refine the mesh, or start elsewhere",
                     error, t, options.verification_tolerance);
}

/// Right-hand side for the integrators, with fixed parameters and states in units of `scale`.
struct WithParameters {
  static constexpr int dimension = Eigen::Dynamic;
  const Problem* problem;
  Eigen::VectorXd parameters, scale;
  mutable Eigen::VectorXd state = {};  // of one evaluation

  [[nodiscard]] int size() const { return problem->states(); }
  void operator()(const double& t, const Eigen::VectorXd& x, Eigen::VectorXd& dxdt) const {
    state = scale.cwiseProduct(x);
    problem->rhs(t, state, parameters, dxdt);
    dxdt = dxdt.cwiseQuotient(scale);
  }
  void jacobian(double t, const Eigen::VectorXd& x, Eigen::MatrixXd& j) const {
    Eigen::MatrixXd by_parameter(size(), problem->parameters());
    state = scale.cwiseProduct(x);
    problem->jacobian(t, state, parameters, j, by_parameter);
    j = scale.cwiseInverse().asDiagonal() * j * scale.asDiagonal();
  }
};

/// integrate_at() with states in units of @p scale.
Integration integrate_scaled(const Problem& problem, const Eigen::VectorXd& x0, const Eigen::VectorXd& p,
                             std::span<const double> times, const Eigen::VectorXd& scale,
                             const Integrator& by = {}) {
  if (x0.size() != problem.states() || p.size() != problem.parameters()) {
    throw invalid_argument("integrate_at: {} states and {} parameters for a problem of {} and {}", x0.size(),
                           p.size(), problem.states(), problem.parameters());
  }
  const ivp::System system(WithParameters{&problem, p, scale});
  const ivp::AdaptiveCollocation implicit{.relative_tolerance = by.tolerance,
                                          .absolute_tolerance = by.tolerance};
  const ivp::Dop853 explicit_pair{.relative_tolerance = by.tolerance, .absolute_tolerance = by.tolerance};
  // A trajectory that needs more steps between two times cannot have been resolved by the mesh.
  const ivp::Limits limits{.steps = 20'000};
  Integration result;
  result.states.resize(x0.size(), static_cast<Eigen::Index>(times.size()));
  Eigen::VectorXd x = x0.cwiseQuotient(scale);
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (k > 0) {
      const ivp::Solution arc =
          by.is_implicit ? ivp::integrate(system, x, times[k - 1], times[k], implicit, {}, limits)
                         : ivp::integrate(system, x, times[k - 1], times[k], explicit_pair, {}, limits);
      result.statistics += arc.statistics;
      if (!arc.status.ok()) {
        result.status = arc.status;
        result.states.conservativeResize(Eigen::NoChange, static_cast<Eigen::Index>(k));
        return result;
      }
      x = arc.x;
    }
    result.states.col(static_cast<Eigen::Index>(k)) = scale.cwiseProduct(x);
  }
  return result;
}

}  // namespace

Integration integrate_at(const Problem& problem, const Eigen::VectorXd& x0, const Eigen::VectorXd& p,
                         std::span<const double> times) {
  return integrate_scaled(problem, x0, p, times, VectorXd::Ones(x0.size()));
}

namespace {

/// Integration over one piece.
struct Piece {
  Status status;          ///< of the integrator
  double error = 0;       ///< deviation from the solution at the other end, relative to the scale
  double where = 0;       ///< time of that end
  VectorXd reached = {};  ///< integrated state there
};

Piece integrate_piece(const Problem& problem, const VectorXd& p, const std::vector<double>& times,
                      const VectorXd& from, const VectorXd& to, const VectorXd& scale,
                      const Integrator& by = {}) {
  const Integration arc = integrate_scaled(problem, from, p, times, scale, by);
  if (!arc.status.ok()) return {arc.status, std::numeric_limits<double>::infinity(), times.back()};
  const VectorXd end = arc.states.col(1);
  return {arc.status, (end - to).cwiseQuotient(scale).lpNorm<Eigen::Infinity>(), times.back(), end};
}

/// Scale of deviations: sizes of the states, and what errors of integration in the others make of each over
/// the time @p length.
VectorXd scale_of(const VectorXd& sizes, const Solution& solution, const Options& options,
                  const Integrator& by, double length) {
  VectorXd scale = sizes;
  if (solution.terms.size() > 0)
    scale = scale.cwiseMax(10 * by.tolerance / options.verification_tolerance * length * solution.terms);
  return scale.unaryExpr([](double s) { return s > 0 ? s : 1; });
}

/// Nodes between which an interval is verified, and their times.
struct Span {
  Index first, last;
  double begin, end;
};

/// Exponents by which adjacent trajectories part over an interval, forwards and backwards: real parts of
/// eigenvalues of df/dx at three nodes.
std::pair<double, double> growth_over(const Problem& problem, const Solution& solution,
                                      const Interval& interval, const Span& span) {
  MatrixXd by_state(problem.states(), problem.states()), by_parameter(problem.states(), problem.parameters());
  double forward = 0, backward = 0;
  for (const Index j : {span.first, (span.first + span.last) / 2, span.last}) {
    problem.jacobian(interval.t0 + solution.scheme->nodes[j] * interval.h, interval.values.col(j),
                     solution.parameters(), by_state, by_parameter);
    if (!by_state.allFinite()) continue;
    const VectorXd rates = by_state.eigenvalues().real();
    forward = std::max(forward, rates.maxCoeff() * interval.h);
    backward = std::max(backward, -rates.minCoeff() * interval.h);
  }
  return {forward, backward};
}

/// Integrates over an interval in the direction in which adjacent trajectories part less. Where they part in
/// both, as in a layer between growing and decaying solutions, each part of it that is short enough is
/// integrated from the solution.
Piece verify_interval(const Problem& problem, const Options& options, const Solution& solution,
                      const Interval& interval, const Span& span, const VectorXd& sizes) {
  const auto [forward, backward] = growth_over(problem, solution, interval, span);
  constexpr double growth = 4;          // exponent of a part
  constexpr double most_explicit = 30;  // exponent of a part that an explicit method integrates in few steps
  int parts = static_cast<int>(std::clamp(std::ceil(std::min(forward, backward) / growth), 1., 1000.));
  Piece worst;
  for (int attempt = 0; attempt < 2; ++attempt, parts *= 8) {
    worst = {};
    // Over a part that is not stiff errors of integration stay far below the tolerance of the verification.
    const bool is_stiff = std::max(forward, backward) > most_explicit * parts;
    const Integrator by = is_stiff ? Integrator{}
                                   : Integrator{false, std::clamp(1e-5 * options.verification_tolerance,
                                                                  integration_tolerance, 1e-9)};
    const VectorXd scale = scale_of(sizes, solution, options, by, is_stiff ? interval.h : interval.h / parts);
    const auto time = [&](int k) {
      return k == parts ? span.end : span.begin + (span.end - span.begin) * k / parts;
    };
    const auto state = [&](int i) -> VectorXd {
      return i == 0       ? VectorXd(interval.values.col(span.first))
             : i == parts ? VectorXd(interval.values.col(span.last))
                          : solution.at(time(i));
    };
    for (int i = 0; i < parts && worst.error <= options.verification_tolerance; ++i) {
      const int a = backward < forward ? i + 1 : i, b = backward < forward ? i : i + 1;
      Piece piece =
          integrate_piece(problem, solution.parameters(), {time(a), time(b)}, state(a), state(b), scale, by);
      if (!(piece.error <= worst.error)) worst = std::move(piece);
    }
    if (worst.error <= options.verification_tolerance) break;
  }
  worst.reached = interval.values.col(span.last);
  return worst;
}

}  // namespace

void verify_by_integration(const Problem& problem, const Options& options, Solution& solution) {
  const auto& all = solution.unknowns.intervals;
  VectorXd sizes = solution.node_values().cwiseAbs().rowwise().maxCoeff();
  // A state that is 0 has rounding errors of the others.
  sizes = sizes.cwiseMax(1e-12 * sizes.maxCoeff());
  if (const VectorXd least = problem.least_sizes(); least.size() > 0)
    sizes = sizes.cwiseMax(least.head(problem.states()));
  VectorXd x = solution.first();
  double worst = 0, where = solution.begin();
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (k > 0 && all[k].phase != all[k - 1].phase) {
      x += all[k].values.col(0) - all[k - 1].values.rightCols(1);
    }
    // At singular ends from and to the nodes beside them.
    const Scheme& scheme = *solution.scheme;
    const Index last_node = scheme.nodes.size() - 1 - (k + 1 == all.size() ? scheme.skipped : 0);
    if (k == 0) x = all[k].values.col(scheme.skipped);
    Span span{k == 0 ? scheme.skipped : 0, last_node,
              all[k].t0 + (k == 0 ? scheme.nodes[scheme.skipped] * all[k].h : 0),
              k + 1 < all.size() ? all[k + 1].t0 : all[k].t0 + scheme.nodes[last_node] * all[k].h};
    // f may jump between phases, and rhs() is then the limit from the right.
    if (k + 1 < all.size() && all[k + 1].phase != all[k].phase)
      span.end = std::nextafter(span.end, span.begin);
    const bool is_piece = options.verification == Verification::pieces;
    const Piece piece =
        is_piece ? verify_interval(problem, options, solution, all[k], span, sizes)
                 : integrate_piece(problem, solution.parameters(), {span.begin, span.end}, x,
                                   all[k].values.col(last_node),
                                   scale_of(sizes, solution, options, {}, span.end - solution.begin()));
    if (!piece.status.ok()) {
      solution.integration_error = std::numeric_limits<double>::infinity();
      solution.status = failed_with(Outcome::spurious_root,
                                    "bvp: the root cannot be integrated from its own initial values ({}); "
                                    "refine the mesh, or start elsewhere",
                                    piece.status.sentence());
      return;
    }
    x = piece.reached;
    if (!(piece.error <= worst)) {
      worst = piece.error;
      where = piece.where;
    }
  }
  solution.integration_error = worst;
  solution.integrated_end = x;
  if (!(worst <= options.verification_tolerance)) solution.status = spurious(where, worst, options);
}

}  // namespace nlmech::bvp

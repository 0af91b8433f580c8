#include "chapters/rbf_ivp/nodes/node_variants.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <boost/multiprecision/eigen.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

#include "chapters/rbf_ivp/solvers/collocation_equations.hpp"
#include "nlmech/algebraic/newton/newton.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::chapters::rbf_ivp {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

TrialSpace gaussians(const VectorXd& nodes, const VectorXd& shapes) {
  using Digits50 = ExtendedReal<50>;
  using Square = collocation::Matrix<Digits50>;
  if (nodes.size() < 2 || nodes.size() != shapes.size())
    throw std::invalid_argument(
        fmt::format("gaussians: {} nodes and {} shapes; as many of both are needed, at least 2", nodes.size(),
                    shapes.size()));
  const VectorXd checks = check_points(nodes.size());
  const Index n = nodes.size(), m = checks.size();
  Square phi(n, n), dphi(n, n), at(m, n), dat(m, n);
  const auto fill = [&](const VectorXd& times, Square& value, Square& slope) {
    for (Index i = 0; i < times.size(); ++i) {
      for (Index k = 0; k < n; ++k) {
        const Digits50 r = Digits50(times[i]) - nodes[k], c2 = Digits50(shapes[k]) * shapes[k];
        value(i, k) = exp(Digits50(-c2 * r * r));
        slope(i, k) = -2 * c2 * r * value(i, k);
      }
    }
  };
  fill(nodes, phi, dphi);
  fill(checks, at, dat);
  // Solves A Phi = B for all three matrices at once, stacked.
  Square right(n, n + 2 * m);
  right << dphi.transpose(), at.transpose(), dat.transpose();
  const Square rows = Square(phi.transpose()).partialPivLu().solve(right);
  const MatrixXd all = rows.transpose().cast<double>();
  return {nodes, all.topRows(n), checks, all.middleRows(n, m), all.bottomRows(m)};
}

VectorXd check_points(Index nodes) {
  return (collocation::legendre_gauss(static_cast<int>(3 * (nodes - 1))).array() + 1) / 2;
}

VectorXd gauss_weights(Index m) {
  VectorXd w(m);
  const VectorXd nodes = collocation::legendre_gauss(static_cast<int>(m));
  for (Index i = 0; i < m; ++i) {
    const double slope = collocation::jacobi(static_cast<int>(m), 0, 0, nodes[i]).derivative;
    w[i] = 1 / ((1 - nodes[i] * nodes[i]) * slope * slope);
  }
  return w;
}

VectorXd family_nodes(collocation::NodeFamily family, int n) {
  return (collocation::nodes(family, n).array() + 1) / 2;
}

VectorXd own_shapes(const VectorXd& nodes, double c) {
  const Index n = nodes.size();
  VectorXd shapes(n);
  for (Index k = 0; k < n; ++k) {
    const Index left = std::max<Index>(k - 1, 0), right = std::min(k + 1, n - 1);
    const double spacing = (nodes[right] - nodes[left]) / static_cast<double>(right - left);
    shapes[k] = c / static_cast<double>(n - 1) / spacing;
  }
  return shapes;
}

VectorXd placed_nodes(const VectorXd& nodes, const VectorXd& checks, const VectorXd& residuals) {
  const Index m = checks.size();
  VectorXd monitor(m);
  for (Index i = 0; i < m; ++i) {
    const Index first = std::max<Index>(i - 2, 0), last = std::min(i + 2, m - 1);
    monitor[i] = std::sqrt(residuals.segment(first, last - first + 1).maxCoeff());
  }
  // The density is piecewise linear through the check points and constant beyond them; integral by the
  // trapezoidal rule.
  std::vector<double> times = {0}, density;
  const double mean = gauss_weights(m).dot(monitor);
  const auto at = [&](Index i) { return mean > 0 ? 0.5 + 0.5 * monitor[i] / mean : 1; };
  density.push_back(at(0));
  for (Index i = 0; i < m; ++i) {
    times.push_back(checks[i]);
    density.push_back(at(i));
  }
  times.push_back(1);
  density.push_back(at(m - 1));
  std::vector<double> sum = {0};
  for (std::size_t i = 1; i < times.size(); ++i)
    sum.push_back(sum.back() + (times[i] - times[i - 1]) * (density[i] + density[i - 1]) / 2);
  VectorXd placed = nodes;
  std::size_t i = 1;
  for (Index k = 1; k + 1 < nodes.size(); ++k) {
    const double target = nodes[k] * sum.back();
    while (sum[i] < target) ++i;
    // Linear interpolation of the integral within a piece.
    placed[k] = times[i - 1] + (times[i] - times[i - 1]) * (target - sum[i - 1]) / (sum[i] - sum[i - 1]);
  }
  return placed;
}

VectorXd with_inserted(const VectorXd& nodes, const VectorXd& checks, const VectorXd& residuals, int count) {
  struct Candidate {
    double residual = -1, time = 0;
  };
  std::vector<Candidate> gaps(static_cast<std::size_t>(nodes.size() - 1));
  for (Index i = 0; i < checks.size(); ++i) {
    const Index right = std::upper_bound(nodes.begin(), nodes.end(), checks[i]) - nodes.begin();
    const double from_left = checks[i] - nodes[right - 1], to_right = nodes[right] - checks[i];
    Candidate& gap = gaps[static_cast<std::size_t>(right - 1)];
    if (std::min(from_left, to_right) < (from_left + to_right) / 4 || residuals[i] <= gap.residual) continue;
    gap = {residuals[i], checks[i]};
  }
  std::sort(gaps.begin(), gaps.end(),
            [](const Candidate& a, const Candidate& b) { return a.residual > b.residual; });
  std::vector<double> all(nodes.begin(), nodes.end());
  for (const Candidate& c : gaps) {
    if (count-- <= 0 || c.residual < 0) break;
    all.push_back(c.time);
  }
  std::sort(all.begin(), all.end());
  return Eigen::Map<const VectorXd>(all.data(), static_cast<Index>(all.size()));
}

MatrixXd residual_columns(const Arc& arc, const TrialSpace& space, const MatrixXd& states) {
  MatrixXd r = (space.slopes * states).transpose();
  const MatrixXd x = (space.values * states).transpose();
  ivp::State f = arc.example->x0;
  for (Index i = 0; i < r.cols(); ++i) {
    arc.example->system.rhs(arc.t0 + arc.h * space.checks[i], ivp::State(x.col(i)), f);
    r.col(i) -= arc.h * f;
  }
  return r;
}

namespace {

ivp::State reference_state(const Arc& arc, double tau) {
  return arc.example->reference(arc.t0 + arc.h * tau).cast<double>();
}

/// Computes errors and residuals of a solution. @param states one row per node
Fit judged(const Arc& arc, const TrialSpace& space, MatrixXd states) {
  Fit fit;
  const auto size = [&](const ivp::State& x) {
    return x.cwiseQuotient(arc.example->amplitude).cwiseAbs().maxCoeff();
  };
  const auto error = [&](double tau, const Eigen::RowVectorXd& x) {
    return size(ivp::State(x.transpose()) - reference_state(arc, tau));
  };
  const MatrixXd x = space.values * states, r = residual_columns(arc, space, states);
  fit.largest_error = 0;
  fit.residuals.resize(x.rows());
  for (Index k = 0; k < states.rows(); ++k)
    fit.largest_error = std::max(fit.largest_error, error(space.nodes[k], states.row(k)));
  for (Index i = 0; i < x.rows(); ++i) {
    fit.largest_error = std::max(fit.largest_error, error(space.checks[i], x.row(i)));
    fit.residuals[i] = size(r.col(i));
  }
  fit.end_error = error(1, states.row(states.rows() - 1));
  fit.states = std::move(states);
  fit.converged = true;
  return fit;
}

}  // namespace

Fit collocate(const Arc& arc, const TrialSpace& space) {
  const ivp::State x0 = reference_state(arc, 0);
  const Interval interval{arc.example->system, arc.t0, arc.h, x0, space.nodes, space.derivative};
  algebraic::DenseEquations equations = collocation_equations(interval, Form::printed);
  VectorXd x = interval.start();
  const auto report = find_root(algebraic::DampedNewton{.tolerance = 1e-13, .noise = 1e-8}, equations, x);
  if (!report.status.ok()) return {};
  MatrixXd states(space.nodes.size(), x0.size());
  states.row(0) = x0.transpose();
  states.bottomRows(states.rows() - 1) =
      Eigen::Map<const MatrixXd>(x.data(), x0.size(), states.rows() - 1).transpose();
  return judged(arc, space, std::move(states));
}

Fit least_squares(const Arc& arc, const TrialSpace& space) {
  Fit start = collocate(arc, space);
  if (!start.converged) return start;
  const Index m = space.checks.size(), s = space.nodes.size() - 1, d = arc.example->x0.size();
  const VectorXd root_weights = gauss_weights(m).cwiseSqrt();
  MatrixXd states = start.states, b(m * d, s * d);
  ivp::Jacobian j = ivp::Jacobian::Zero(d, d);
  for (int k = 0; k < 20; ++k) {
    MatrixXd r = residual_columns(arc, space, states);
    for (Index i = 0; i < m; ++i) {
      const ivp::State x = (space.values.row(i) * states).transpose();
      arc.example->system.jacobian(arc.t0 + arc.h * space.checks[i], x, j);
      for (Index c = 0; c < s; ++c) {
        auto block = b.block(i * d, c * d, d, d);
        block = -arc.h * space.values(i, c + 1) * j;
        block.diagonal().array() += space.slopes(i, c + 1);
        block *= root_weights[i];
      }
      r.col(i) *= root_weights[i];
    }
    const VectorXd update = b.householderQr().solve(Eigen::Map<const VectorXd>(r.data(), r.size()));
    states.bottomRows(s) -= Eigen::Map<const MatrixXd>(update.data(), d, s).transpose();
    if (!update.allFinite()) return {};
    if (update.cwiseAbs().maxCoeff() < 1e-12) return judged(arc, space, std::move(states));
  }
  return {};
}

}  // namespace nlmech::chapters::rbf_ivp

#include <Eigen/QR>
#include <algorithm>
#include <utility>

#include "chapters/rbf_ivp/nodes/node_variants.hpp"
#include "chapters/rbf_ivp/solvers/collocation_equations.hpp"
#include "nlmech/algebraic/newton/newton.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

ivp::State reference_state(const Arc& arc, double tau) {
  return arc.example->reference(arc.t0 + arc.h * tau).template cast<double>();
}

}  // namespace

Eigen::MatrixXd residual_columns(const Arc& arc, const TrialSpace& space, const Eigen::MatrixXd& states) {
  Eigen::MatrixXd r = (space.slopes * states).transpose();
  const Eigen::MatrixXd x = (space.values * states).transpose();
  ivp::State f = arc.example->x0;
  for (Eigen::Index i = 0; i < r.cols(); ++i) {
    arc.example->system.rhs(arc.t0 + arc.h * space.checks[i], ivp::State(x.col(i)), f);
    r.col(i) -= arc.h * f;
  }
  return r;
}

namespace {

/// Errors, residuals and curvature of a solution. @param states a row for each node
Fit judged(const Arc& arc, const TrialSpace& space, Eigen::MatrixXd states) {
  Fit fit;
  const auto size = [&](const ivp::State& x) {
    return x.cwiseQuotient(arc.example->amplitude).cwiseAbs().maxCoeff();
  };
  const auto error = [&](double tau, const Eigen::RowVectorXd& x) {
    return size(ivp::State(x.transpose()) - reference_state(arc, tau));
  };
  const Eigen::MatrixXd x = space.values * states, r = residual_columns(arc, space, states),
                        bend = space.slopes * (space.derivative * states);
  fit.largest_error = 0;
  fit.residuals.resize(x.rows());
  fit.curvature.resize(x.rows());
  for (Eigen::Index k = 0; k < states.rows(); ++k)
    fit.largest_error = std::max(fit.largest_error, error(space.nodes[k], states.row(k)));
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    fit.largest_error = std::max(fit.largest_error, error(space.checks[i], x.row(i)));
    fit.residuals[i] = size(r.col(i));
    fit.curvature[i] = size(bend.row(i).transpose());
  }
  fit.end_error = error(1, states.row(states.rows() - 1));
  fit.states = std::move(states);
  fit.converged = true;
  return fit;
}

}  // namespace

Fit collocate(const Arc& arc, const TrialSpace& space) {
  CollocationEquations equations(arc.example->system, space.nodes, space.derivative, Form::printed);
  const ivp::State x0 = reference_state(arc, 0);
  equations.begin(arc.t0, arc.h, x0);
  Eigen::VectorXd x = equations.start();
  const auto report = find_root(algebraic::DampedNewton{.tolerance = 1e-13, .noise = 1e-8}, equations, x);
  if (!report.status.ok()) return {};
  Eigen::MatrixXd states(space.nodes.size(), x0.size());
  states.row(0) = x0.transpose();
  states.bottomRows(states.rows() - 1) =
      Eigen::Map<const Eigen::MatrixXd>(x.data(), x0.size(), states.rows() - 1).transpose();
  return judged(arc, space, std::move(states));
}

Fit least_squares(const Arc& arc, const TrialSpace& space) {
  Fit start = collocate(arc, space);
  if (!start.converged) return start;
  const Eigen::Index m = space.checks.size(), s = space.nodes.size() - 1, d = arc.example->x0.size();
  const Eigen::VectorXd root_weights = gauss_weights(m).cwiseSqrt();
  Eigen::MatrixXd states = start.states, b(m * d, s * d);
  ivp::Jacobian j = ivp::Jacobian::Zero(d, d);
  for (int k = 0; k < 20; ++k) {
    Eigen::MatrixXd r = residual_columns(arc, space, states);
    for (Eigen::Index i = 0; i < m; ++i) {
      const ivp::State x = (space.values.row(i) * states).transpose();
      arc.example->system.jacobian(arc.t0 + arc.h * space.checks[i], x, j);
      for (Eigen::Index c = 0; c < s; ++c) {
        auto block = b.block(i * d, c * d, d, d);
        block = -arc.h * space.values(i, c + 1) * j;
        block.diagonal().array() += space.slopes(i, c + 1);
        block *= root_weights[i];
      }
      r.col(i) *= root_weights[i];
    }
    const Eigen::VectorXd update =
        b.householderQr().solve(Eigen::Map<const Eigen::VectorXd>(r.data(), r.size()));
    states.bottomRows(s) -= Eigen::Map<const Eigen::MatrixXd>(update.data(), d, s).transpose();
    if (!update.allFinite()) return {};
    if (update.cwiseAbs().maxCoeff() < 1e-12) return judged(arc, space, std::move(states));
  }
  return {};
}

}  // namespace nlmech::chapters::rbf_ivp

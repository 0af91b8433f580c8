/// @file
/// What the dissertation's last paragraph leaves for further study: nodes placed by the solution, a shape for
/// each node, redundant points with least squares, and refinement guided by residuals.
#pragma once

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "chapters/rbf_ivp/cases.hpp"
#include "chapters/rbf_ivp/collocation_equations.hpp"

namespace nlmech::chapters {

/// Trial functions on the unit interval, one for each node, by what they do to values at the nodes: the
/// derivative there, and value and derivative at check points between. For Gaussians all three come from
/// algebra of 50 digits and are rounded afterwards: what is seen of their errors is truncation.
struct TrialSpace {
  Eigen::VectorXd nodes;       ///< ascending; the first 0, the last 1
  Eigen::MatrixXd derivative;  ///< at the nodes
  Eigen::VectorXd checks;      ///< Gauss points of the unit interval: see check_points()
  Eigen::MatrixXd values;      ///< a row for each check point
  Eigen::MatrixXd slopes;      ///< a row for each check point
};

/// Gaussians exp(-c_k^2 (t - t_k)^2) centred at the nodes.
/// @param shapes c_k > 0, one for each node, for the unit interval
/// @throws std::invalid_argument unless there are as many shapes as nodes, and at least 2
[[nodiscard]] TrialSpace gaussians(const Eigen::VectorXd& nodes, const Eigen::VectorXd& shapes);
/// Polynomials of degree N - 1.
[[nodiscard]] TrialSpace polynomials(const Eigen::VectorXd& nodes);

/// The 3 (N - 1) Gauss points of the unit interval, at which residuals are seen.
[[nodiscard]] Eigen::VectorXd check_points(Eigen::Index nodes);
/// The weights of m Gauss points on the unit interval.
[[nodiscard]] Eigen::VectorXd gauss_weights(Eigen::Index m);
/// Legendre-Gauss-Lobatto nodes on the unit interval, or those of Radau with the left end.
[[nodiscard]] Eigen::VectorXd family_nodes(collocation::NodeFamily family, int n);

/// c_k = c (spacing of N equidistant nodes)/(distance of the neighbours of node k, halved; at an end, to its
/// one neighbour): equal overlap everywhere.
[[nodiscard]] Eigen::VectorXd own_shapes(const Eigen::VectorXd& nodes, double c);

/// Nodes moved so that a density is shared out among them as the given nodes share out the interval.
/// The density is the monitor over its mean, half and half with 1, so that no part is laid bare.
/// @param nodes of the unit interval, for the monitor 1
/// @param checks points of the unit interval, ascending
/// @param monitor not negative, one for each check point
[[nodiscard]] Eigen::VectorXd placed_nodes(const Eigen::VectorXd& nodes, const Eigen::VectorXd& checks,
                                           const Eigen::VectorXd& monitor);
/// The greatest of five neighbours, square root: residuals vanish at nodes, their envelope does not.
[[nodiscard]] Eigen::VectorXd envelope(const Eigen::VectorXd& residuals);

/// @p count more nodes, at the check points of the greatest residuals, at most one in a gap of the old nodes
/// and none closer to one than a quarter of the gap. Fewer, if there are not so many gaps.
[[nodiscard]] Eigen::VectorXd with_inserted(const Eigen::VectorXd& nodes, const Eigen::VectorXd& checks,
                                            const Eigen::VectorXd& residuals, int count);

/// An interval of an example, from a state of its reference.
template <int n>
struct Arc {
  const Case<n>* example;  ///< with its reference
  double t0;               ///< begin
  double h;                ///< length
};

/// A discrete solution and how wrong it is. Components are divided by their amplitudes.
struct Fit {
  bool converged = false;
  double end_error = HUGE_VAL;      ///< largest of a component at the end
  double largest_error = HUGE_VAL;  ///< over nodes and check points too
  Eigen::MatrixXd states;           ///< a row for each node
  Eigen::VectorXd residuals;        ///< h |x' - f(t, x)|, largest component, at the check points
  Eigen::VectorXd curvature;        ///< h^2 |x''| there
};

namespace detail {

template <int n>
ivp::State<n> reference_state(const Arc<n>& arc, double tau) {
  return arc.example->reference(arc.t0 + arc.h * tau).template cast<double>();
}

/// x' - f at the check points, by column, times h.
template <int n>
Eigen::MatrixXd residual_columns(const Arc<n>& arc, const TrialSpace& space, const Eigen::MatrixXd& states) {
  Eigen::MatrixXd r = (space.slopes * states).transpose();
  const Eigen::MatrixXd x = (space.values * states).transpose();
  ivp::State<n> f = arc.example->x0;
  for (Eigen::Index i = 0; i < r.cols(); ++i) {
    arc.example->system.rhs(arc.t0 + arc.h * space.checks[i], ivp::State<n>(x.col(i)), f);
    r.col(i) -= arc.h * f;
  }
  return r;
}

/// Errors, residuals and curvature of a solution.
template <int n>
Fit judged(const Arc<n>& arc, const TrialSpace& space, Eigen::MatrixXd states) {
  Fit fit;
  const auto size = [&](const ivp::State<n>& x) {
    return x.cwiseQuotient(arc.example->amplitude).cwiseAbs().maxCoeff();
  };
  const auto error = [&](double tau, const Eigen::RowVectorXd& x) {
    return size(ivp::State<n>(x.transpose()) - reference_state(arc, tau));
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

}  // namespace detail

/// Collocation (Eq. 4.16) at the nodes but the first, by damped Newton iteration from the constant state.
template <int n>
[[nodiscard]] Fit collocate(const Arc<n>& arc, const TrialSpace& space) {
  CollocationEquations<n> equations(arc.example->system, space.nodes, space.derivative, Form::printed);
  const ivp::State<n> x0 = detail::reference_state(arc, 0);
  equations.begin(arc.t0, arc.h, x0);
  Eigen::VectorXd x = equations.start();
  const auto report = find_root(algebraic::DampedNewton{.tolerance = 1e-13, .noise = 1e-8}, equations, x);
  if (!report.status.ok()) return {};
  Eigen::MatrixXd states(space.nodes.size(), x0.size());
  states.row(0) = x0.transpose();
  states.bottomRows(states.rows() - 1) =
      Eigen::Map<const Eigen::MatrixXd>(x.data(), x0.size(), states.rows() - 1).transpose();
  return detail::judged(arc, space, std::move(states));
}

/// The same unknowns, but the equations hold at all check points in the sense of least squares, with the
/// weights of Gauss quadrature: the integral of |x' - f|^2 is least. Gauss-Newton from the collocated
/// solution, Householder QR.
template <int n>
[[nodiscard]] Fit least_squares(const Arc<n>& arc, const TrialSpace& space) {
  Fit start = collocate(arc, space);
  if (!start.converged) return start;
  const Eigen::Index m = space.checks.size(), s = space.nodes.size() - 1, d = arc.example->x0.size();
  const Eigen::VectorXd root_weights = gauss_weights(m).cwiseSqrt();
  Eigen::MatrixXd states = start.states, b(m * d, s * d);
  ivp::Jacobian<n> j = ivp::Jacobian<n>::Zero(d, d);
  for (int k = 0; k < 20; ++k) {
    Eigen::MatrixXd r = detail::residual_columns(arc, space, states);
    for (Eigen::Index i = 0; i < m; ++i) {
      const ivp::State<n> x = (space.values.row(i) * states).transpose();
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
    if (update.cwiseAbs().maxCoeff() < 1e-12) return detail::judged(arc, space, std::move(states));
  }
  return {};
}

}  // namespace nlmech::chapters

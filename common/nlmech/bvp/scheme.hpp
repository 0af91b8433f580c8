/// @file
/// One interval of a collocation method for boundary value problems, as matrices on [0, 1].
#pragma once

#include <Eigen/Core>

namespace nlmech::bvp {

/// The Lobatto IIIA method: N Legendre-Gauss-Lobatto nodes on [0, 1], both ends among them, and N - 1
/// equations
///     x_i - x_0 = h sum_j slope_ij f(t_j, x_j),      i = 1..N-1.
/// Order 2N - 2 at the ends of intervals.
struct Scheme {
  Eigen::VectorXd nodes;            ///< ascending from 0 to 1
  Eigen::MatrixXd slope;            ///< N - 1 by N
  Eigen::RowVectorXd weights;       ///< of the quadrature over [0, 1] with values at the nodes
  int order = 0;                    ///< q of the residual between nodes, O(h^q)
  Eigen::VectorXd probes;           ///< where the residual is measured, between the nodes
  Eigen::MatrixXd probe_slope;      ///< u(probes) = x_0 + h probe_slope F
  Eigen::MatrixXd probe_slope_dot;  ///< u'(probes) = probe_slope_dot F
  bool is_through_values = false;  ///< the interpolant: the polynomial through the values, else that of which
                                   ///< the derivative has the slopes
  Eigen::VectorXd barycentric;     ///< weights of the polynomial through the nodes
  Eigen::VectorXd gauss;           ///< nodes on [0, 1] of the Gauss rule that integrates it exactly
  Eigen::VectorXd gauss_weights;   ///< of that rule

  /// Rows of the interpolant: u(t_0 + tau h) = of_value X + h of_slope F for values X and slopes F at nodes.
  /// @param tau in [0, 1]
  void row(double tau, Eigen::RowVectorXd& of_value, Eigen::RowVectorXd& of_slope) const;
};

/// @param nodes N, both ends included: 3 to 200
/// @throws std::invalid_argument for numbers out of range
[[nodiscard]] Scheme lobatto_scheme(int nodes);

/// Nodes, quadrature and interpolant of values at N nodes, without equations.
/// @param nodes N, both ends included: 2 to 200
/// @throws std::invalid_argument for numbers out of range
[[nodiscard]] Scheme interpolation_scheme(int nodes);

}  // namespace nlmech::bvp

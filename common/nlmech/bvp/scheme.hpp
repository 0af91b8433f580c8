/// @file
/// Matrices of a collocation method for boundary value problems on the unit interval.
#pragma once

#include <Eigen/Core>

namespace nlmech::bvp {

/// Lobatto IIIA method: N Legendre-Gauss-Lobatto nodes on [0, 1], including both ends, and N - 1 equations
///     x_i - x_0 = h sum_j slope_ij f(t_j, x_j),      i = 1..N-1.
/// Order 2N - 2 at the ends of intervals.
///
/// Or Gauss' method, for problems that are singular at an end: N - 2 Legendre-Gauss nodes and both ends,
/// where f is not evaluated. Order 2N - 4.
struct Scheme {
  /// First node at which f is evaluated, and number of last nodes at which it is not: 0 or 1. Columns of
  /// slopes at the others are 0.
  Eigen::Index skipped = 0;
  Eigen::VectorXd nodes;            ///< ascending from 0 to 1
  Eigen::MatrixXd slope;            ///< N - 1 by N
  Eigen::RowVectorXd weights;       ///< quadrature weights at the nodes for the integral over [0, 1]
  int order = 0;                    ///< order q of the residual between nodes, O(h^q)
  Eigen::VectorXd probes;           ///< points between the nodes at which the residual is evaluated
  Eigen::MatrixXd probe_slope;      ///< u(probes) = x_0 + h probe_slope F
  Eigen::MatrixXd probe_slope_dot;  ///< u'(probes) = probe_slope_dot F
  bool is_through_values = false;  ///< true: the interpolant is the polynomial through the values; false: the
                                   ///< polynomial whose derivative interpolates the slopes
  Eigen::VectorXd barycentric;     ///< barycentric weights of the nodes that are not skipped
  Eigen::VectorXd gauss;           ///< nodes on [0, 1] of a Gauss rule, exact for cardinal polynomials
  Eigen::VectorXd gauss_weights;   ///< weights of that rule

  /// Rows of the interpolant: u(t_0 + tau h) = of_value X + h of_slope F for values X and slopes F at the
  /// nodes.
  /// @param tau in [0, 1]
  void row(double tau, Eigen::RowVectorXd& of_value, Eigen::RowVectorXd& of_slope) const;
};

/// @param nodes N, including both ends: 3 to 200
/// @throws std::invalid_argument for numbers out of range
[[nodiscard]] Scheme lobatto_scheme(int nodes);

/// Gauss' method. @param nodes N, including both ends: 4 to 200
/// @throws std::invalid_argument for numbers out of range
[[nodiscard]] Scheme gauss_scheme(int nodes);

/// Nodes, quadrature and interpolant of values at N nodes, without collocation equations.
/// @param nodes N, including both ends: 2 to 200
/// @throws std::invalid_argument for numbers out of range
[[nodiscard]] Scheme interpolation_scheme(int nodes);

}  // namespace nlmech::bvp

/// @file
/// Future work of the dissertation's last paragraph: nodes adapted to the solution, a shape per node,
/// redundant points with least squares, and refinement by residuals.
#pragma once

#include <cmath>

#include "chapters/rbf_ivp/examples/cases.hpp"
#include "nlmech/collocation/nodes.hpp"

namespace nlmech::chapters::rbf_ivp {

/// Trial functions on the unit interval, one per node, as matrices on the nodal values: derivative at the
/// nodes, value and derivative at check points. For Gaussians all three are computed with 50 digits and then
/// rounded, so their errors are truncation errors.
struct TrialSpace {
  Eigen::VectorXd nodes;       ///< ascending; the first 0, the last 1
  Eigen::MatrixXd derivative;  ///< derivative at the nodes
  Eigen::VectorXd checks;      ///< Gauss points of the unit interval: see check_points()
  Eigen::MatrixXd values;      ///< value at check points, one row each
  Eigen::MatrixXd slopes;      ///< derivative at check points, one row each
};

/// Trial space of the Gaussians exp(-c_k^2 (t - t_k)^2) centred at the nodes.
/// @param shapes c_k > 0, one per node, for the unit interval
/// @throws std::invalid_argument unless there are as many shapes as nodes, and at least 2
[[nodiscard]] TrialSpace gaussians(const Eigen::VectorXd& nodes, const Eigen::VectorXd& shapes);

/// The 3 (N - 1) Gauss points of the unit interval, at which residuals are evaluated.
[[nodiscard]] Eigen::VectorXd check_points(Eigen::Index nodes);
/// The weights of m Gauss points on the unit interval.
[[nodiscard]] Eigen::VectorXd gauss_weights(Eigen::Index m);
/// Nodes of a family mapped to the unit interval.
[[nodiscard]] Eigen::VectorXd family_nodes(collocation::NodeFamily family, int n);

/// Shapes of equal overlap: c_k = c (spacing of N equidistant nodes)/(half the distance between the
/// neighbours of node k; at an end the distance to its neighbour).
[[nodiscard]] Eigen::VectorXd own_shapes(const Eigen::VectorXd& nodes, double c);

/// Redistributes nodes by a density: the integral of the density up to node k is the fraction nodes[k] of the
/// whole. Density = 1/2 + (monitor/mean)/2, so that no part loses all nodes. Monitor = square root of the
/// largest of five neighbouring residuals, because residuals vanish at nodes.
/// @param nodes of the unit interval; the result for equal residuals
/// @param checks points of the unit interval, ascending
/// @param residuals one per check point, not negative
[[nodiscard]] Eigen::VectorXd placed_nodes(const Eigen::VectorXd& nodes, const Eigen::VectorXd& checks,
                                           const Eigen::VectorXd& residuals);

/// Inserts up to @p count nodes at the check points of the largest residuals: at most one per gap of the old
/// nodes, and at least a quarter of the gap from both ends of it.
[[nodiscard]] Eigen::VectorXd with_inserted(const Eigen::VectorXd& nodes, const Eigen::VectorXd& checks,
                                            const Eigen::VectorXd& residuals, int count);

/// An interval of an example that starts from the reference state.
struct Arc {
  const Case* example;  ///< example with reference
  double t0;            ///< start of the interval
  double h;             ///< length of the interval
};

/// A discrete solution with its errors. Components are divided by their amplitudes.
struct Fit {
  bool converged = false;
  double end_error = HUGE_VAL;      ///< largest error of a component at the end
  double largest_error = HUGE_VAL;  ///< largest error over nodes and check points
  Eigen::MatrixXd states;           ///< one row per node
  Eigen::VectorXd residuals;        ///< largest component of h |x' - f(t, x)| at the check points
};

/// Residuals h (x' - f), one column per check point. @param states one row per node
[[nodiscard]] Eigen::MatrixXd residual_columns(const Arc& arc, const TrialSpace& space,
                                               const Eigen::MatrixXd& states);

/// Collocation (Eq. 4.16) at all nodes except the first, by damped Newton iteration from the constant state.
[[nodiscard]] Fit collocate(const Arc& arc, const TrialSpace& space);

/// Minimises the integral of |x' - f|^2 over the nodal states, by Gauss quadrature at the check points.
/// Gauss-Newton iteration with Householder QR from the collocated solution.
[[nodiscard]] Fit least_squares(const Arc& arc, const TrialSpace& space);

}  // namespace nlmech::chapters::rbf_ivp

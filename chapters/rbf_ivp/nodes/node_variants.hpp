/// @file
/// Future work of the dissertation's last paragraph: nodes placed by the solution, a shape for each node,
/// redundant points with least squares, and refinement guided by residuals.
#pragma once

#include <cmath>

#include "chapters/rbf_ivp/examples/cases.hpp"
#include "nlmech/collocation/nodes.hpp"

namespace nlmech::chapters::rbf_ivp {

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

/// The 3 (N - 1) Gauss points of the unit interval, at which residuals are seen.
[[nodiscard]] Eigen::VectorXd check_points(Eigen::Index nodes);
/// The weights of m Gauss points on the unit interval.
[[nodiscard]] Eigen::VectorXd gauss_weights(Eigen::Index m);
/// Legendre-Gauss-Lobatto nodes on the unit interval, or those of Radau with the left end.
[[nodiscard]] Eigen::VectorXd family_nodes(collocation::NodeFamily family, int n);

/// c_k = c (spacing of N equidistant nodes)/(distance of the neighbours of node k, halved; at an end, to its
/// one neighbour): equal overlap everywhere.
[[nodiscard]] Eigen::VectorXd own_shapes(const Eigen::VectorXd& nodes, double c);

/// Nodes moved so that a density is shared out among them as the given nodes share out the interval. The
/// density is a monitor over its mean, half and half with 1, so that no part is laid bare; the monitor is the
/// square root of the greatest of five neighbouring residuals, since residuals vanish at nodes.
/// @param nodes of the unit interval, for equal residuals
/// @param checks points of the unit interval, ascending
/// @param residuals not negative, one for each check point
[[nodiscard]] Eigen::VectorXd placed_nodes(const Eigen::VectorXd& nodes, const Eigen::VectorXd& checks,
                                           const Eigen::VectorXd& residuals);

/// @p count more nodes, at the check points of the greatest residuals, at most one in a gap of the old nodes
/// and none closer to one than a quarter of the gap. Fewer, if there are not so many gaps.
[[nodiscard]] Eigen::VectorXd with_inserted(const Eigen::VectorXd& nodes, const Eigen::VectorXd& checks,
                                            const Eigen::VectorXd& residuals, int count);

/// An interval of an example, from a state of its reference.
struct Arc {
  const Case* example;  ///< with its reference
  double t0;            ///< start
  double h;             ///< length
};

/// A discrete solution and how wrong it is. Components are divided by their amplitudes.
struct Fit {
  bool converged = false;
  double end_error = HUGE_VAL;      ///< largest of a component at the end
  double largest_error = HUGE_VAL;  ///< over nodes and check points too
  Eigen::MatrixXd states;           ///< a row for each node
  Eigen::VectorXd residuals;        ///< h |x' - f(t, x)|, largest component, at the check points
};

/// x' - f at the check points, by column, times h. @param states a row for each node
[[nodiscard]] Eigen::MatrixXd residual_columns(const Arc& arc, const TrialSpace& space,
                                               const Eigen::MatrixXd& states);

/// Collocation (Eq. 4.16) at the nodes but the first, by damped Newton iteration from the constant state.
[[nodiscard]] Fit collocate(const Arc& arc, const TrialSpace& space);

/// The same unknowns, but the equations hold at all check points in the sense of least squares, with the
/// weights of Gauss quadrature: the integral of |x' - f|^2 is least. Gauss-Newton from the collocated
/// solution, Householder QR.
[[nodiscard]] Fit least_squares(const Arc& arc, const TrialSpace& space);

}  // namespace nlmech::chapters::rbf_ivp

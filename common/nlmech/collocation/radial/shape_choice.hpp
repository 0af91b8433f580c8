/// @file
/// Choice of the shape parameter of radial functions: a rule of thumb, the cost of leave-one-out
/// cross-validation with and without loss of digits, and the least error for a given function.
#pragma once

#include "nlmech/collocation/matrix.hpp"
#include "nlmech/collocation/radial/kernels.hpp"

namespace nlmech::collocation {

/// c = (n - 1)/(4 h): the setting of the dissertation for runs with 35 nodes. The shape relative to the
/// distance of the nodes, c h/n, is then nearly constant; increasing n at a fixed h does not converge.
/// @param n number of nodes on the interval, at least 2
/// @param h length of the interval, > 0
/// @return 1/time
/// @throws std::invalid_argument if @p n or @p h is out of range
[[nodiscard]] double rule_of_thumb_shape(int n, double h);

/// Cost that Algorithm 1 minimises over the shape: the Frobenius norm of the error matrix
///     E_ij = D_ji/(Phi^-1)_ii     (Eq. 4.20),
/// each entry being the leave-one-out error at node i of the interpolant of column i of Phi'^T.
///
/// It does not depend on the function to be differentiated. It is degenerate at both ends: at the level of
/// rounding for c -> 0, and 0 for c -> infinity, where D -> 0; a minimiser needs a bracket between them.
/// @param times  nodes, ascending, 2 to max_nodes of them
/// @param kernel radial function
/// @param shape  c of Eq. 4.8, 1/time; > 0
/// @return 1/time; infinity if Phi cannot be inverted
/// @throws std::invalid_argument as radial_differentiation
[[nodiscard]] double leave_one_out_cost(const Eigen::VectorXd& times, Kernel kernel, double shape);

/// Values and derivatives of a function at the nodes of an interval. For a differential equation x' = g(x, t)
/// any available solution (of the previous step, or of polynomials on more nodes) gives values and the slopes
/// g.
struct Sampled {
  Eigen::VectorXd times;   ///< nodes, ascending, 2 to max_nodes of them
  Eigen::VectorXd values;  ///< there
  Eigen::VectorXd slopes;  ///< there; values/time
};

/// Shape with its error.
struct ShapeChoice {
  double shape = 0;  ///< c, 1/time; 0: polynomials
  double error = 0;  ///< the largest |D(c) X - X'|, in units of the slopes
};

/// Largest |D X - X'| at the nodes, with D of StableGaussian.
/// @param sampled the function; its three vectors must have the same size
/// @param shape   c, as for StableGaussian
/// @throws std::invalid_argument as StableGaussian; if the sizes differ or a value or slope is not finite
[[nodiscard]] double slope_error(const Sampled& sampled, double shape);

/// Shape with the least slope_error among c = 0 and c = least to largest: uniform samples in log c, then
/// golden-section search around the best sample. With D of StableGaussian rounding causes no spurious minima,
/// unlike in leave_one_out_cost.
/// @param sampled the function to be differentiated
/// @param least   smallest nonzero shape, 1/time, > 0
/// @param largest largest shape, 1/time, > least; times the interval at most StableGaussian::largest_shape
/// @param samples number of samples, at least 3
/// @throws std::invalid_argument as slope_error, and if a bound or the number is out of range
[[nodiscard]] ShapeChoice choose_shape(const Sampled& sampled, double least, double largest,
                                       int samples = 40);

/// Cost of Algorithm 1, leave_one_out_cost for Gaussians, without loss of digits: relative accuracy 1e-9. It
/// has no interior minimum: it tends to 0 for c -> 0, as c^(2n - 2), and for c -> infinity.
/// @param times nodes, ascending, 2 to max_nodes of them
/// @param shape c > 0, 1/time; times the interval at most StableGaussian::largest_shape
/// @return 1/time; 0 if it is below the range of doubles
/// @throws std::invalid_argument as StableGaussian, and if the shape is not positive
[[nodiscard]] double exact_leave_one_out_cost(const Eigen::VectorXd& times, double shape);

}  // namespace nlmech::collocation

/// @file
/// The choice of the shape parameter of radial functions: a rule of thumb, and the cost of leave-one-out
/// cross-validation.
#pragma once

#include "nlmech/collocation/matrix.hpp"
#include "nlmech/collocation/radial/kernels.hpp"

namespace nlmech::collocation {

/// c = (n - 1)/(4 h): the setting of the dissertation's runs with 35 nodes. It keeps c h/n and thus the shape
/// relative to the distance of the nodes; raising n at a fixed h then does not converge.
/// @param n nodes on the interval, at least 2
/// @param h length of the interval, > 0
/// @return 1/time
/// @throws std::invalid_argument if @p n or @p h is outside these bounds
[[nodiscard]] double rule_of_thumb_shape(int n, double h);

/// The cost that Algorithm 1 minimises over the shape: the Frobenius norm of the matrix of errors
///     E_ij = D_ji/(Phi^-1)_ii     (Eq. 4.20),
/// each the error at node i of the interpolant to column i of Phi'^T with that node left out.
///
/// It does not see the function to be differentiated. It is degenerate at both ends: at the level of rounding
/// for c -> 0, and 0 for c -> infinity, where D -> 0; a minimiser needs a bracket between them.
/// @param times  nodes, ascending, 2 to max_nodes of them
/// @param kernel which radial function
/// @param shape  c of Eq. 4.8, 1/time; > 0
/// @return 1/time; infinity where Phi cannot be inverted
/// @throws std::invalid_argument as radial_differentiation
[[nodiscard]] double leave_one_out_cost(const Eigen::VectorXd& times, Kernel kernel, double shape);

}  // namespace nlmech::collocation

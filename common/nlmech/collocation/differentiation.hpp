/// @file
/// Differentiation matrix of radial functions in double precision, with error measures.
#pragma once

#include "nlmech/collocation/radial/radial_basis.hpp"

namespace nlmech::collocation {

/// D = Phi' Phi^-1 (Eqs 4.15 and 4.19) with error measures.
///
/// Wide functions (c h small against n) are nearly linearly dependent: Phi becomes singular to working
/// precision, and the rounding error of D is proportional to the condition number. Narrow functions (c times
/// the distance of the nodes large against 1) do not overlap: D is accurate to rounding but does not
/// approximate the derivative. The status reports both cases. The matrix is returned in both cases if it is
/// finite.
struct Differentiation {
  /// D, n by n, 1/time; empty if it is not finite.
  Eigen::MatrixXd matrix;
  /// Condition number of Phi in the 2-norm, from its eigenvalues (Phi is symmetric). Its reciprocal has an
  /// error of 4e-16; so values above 1e15 are inaccurate, and above 1e16 only lower bounds. May be infinite.
  /// Entries of D have errors of condition * 1e-15 times the largest entry.
  double condition = 0;
  /// Numerical rank: number of eigenvalues of Phi above 2.2e-16 times the largest.
  int rank = 0;
  /// Largest error of D at a node for the straight lines of slope 1 that are zero at one end of the interval.
  double slope_error = 0;
  /// success; singular_matrix if Phi has no inverse, if the rank is at most (n + 1)/2, or if slope_error is
  /// at least 1/2 at a condition above 1e12; outside_validity if slope_error is at least 1/2 at a smaller
  /// condition: the functions are too narrow; non_finite if a number overflows.
  Status status;
};

/// Differentiation matrix of radial functions at given nodes.
/// @param times     nodes, ascending, 2 to max_nodes of them, for example h (tau + 1)/2
/// @param kernel    radial function
/// @param shape     c of Eq. 4.8, 1/time; > 0
/// @param inversion computation of Phi' Phi^-1
/// @throws std::invalid_argument if the times are too few, too many, not finite or not ascending, or the
/// shape is not positive and finite
[[nodiscard]] Differentiation radial_differentiation(const Eigen::VectorXd& times, Kernel kernel,
                                                     double shape, Inversion inversion = Inversion::solve);

}  // namespace nlmech::collocation

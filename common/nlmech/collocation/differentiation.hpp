/// @file
/// The differentiation matrix of radial functions in double precision, and how far it can be trusted.
#pragma once

#include "nlmech/collocation/radial/radial_basis.hpp"

namespace nlmech::collocation {

/// D = Phi' Phi^-1 (Eqs 4.15 and 4.19) with what is known of its errors.
///
/// Wide functions (c h small against n) resemble each other: Phi becomes singular to working precision, and D
/// loses digits by rounding, in proportion to the condition number. Narrow functions (c times the distance of
/// the nodes large against 1) do not overlap: D is computed to all digits and differentiates nothing. The
/// status reports both ends. The matrix is there in either case, as long as it is finite, for who wants to
/// study it.
struct Differentiation {
  /// D, n by n, 1/time; empty if it is not finite.
  Eigen::MatrixXd matrix;
  /// Condition number of Phi in the 2-norm, from its eigenvalues (Phi is symmetric). Its reciprocal is within
  /// 4e-16 of the true one: beyond 1e15 the number is lost to rounding, beyond 1e16 it says nothing but that.
  /// May be infinite. Entries of D are within condition * 1e-15 times the largest one.
  double condition = 0;
  /// How many of the functions can be told apart: eigenvalues of Phi above 2.2e-16 times the largest.
  int rank = 0;
  /// The largest error of D at a node for straight lines of slope 1 that are zero at one end of the interval.
  double slope_error = 0;
  /// success;
  /// singular_matrix if Phi has no inverse, if only (n + 1)/2 of the functions or fewer can be told apart, or
  /// if a slope is wrong by half or more at a condition above 1e12;
  /// outside_validity if a slope is wrong by half or more at a smaller one: the functions are too narrow;
  /// non_finite if a number overflows.
  Status status;
};

/// The differentiation matrix of radial functions at given nodes.
/// @param times     nodes, ascending, 2 to max_nodes of them, for example h (tau + 1)/2
/// @param kernel    which radial function
/// @param shape     c of Eq. 4.8, 1/time; > 0
/// @param inversion how Phi is inverted
/// @throws std::invalid_argument if the times are too few, too many, not finite or not ascending, or the
/// shape is not positive and finite
[[nodiscard]] Differentiation radial_differentiation(const Eigen::VectorXd& times, Kernel kernel,
                                                     double shape, Inversion inversion = Inversion::solve);

}  // namespace nlmech::collocation

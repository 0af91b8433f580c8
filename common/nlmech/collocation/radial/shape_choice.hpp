/// @file
/// Shapes of Gaussian functions chosen by what they do to a given function, and what leave-one-out
/// cross-validation would choose without rounding.
#pragma once

#include "nlmech/collocation/matrix.hpp"

namespace nlmech::collocation {

/// Values and derivatives of a function at the nodes of an interval. For a differential equation x' = g(x, t)
/// the values of any solution at hand (of the previous step, or of polynomials on more nodes) have the
/// slopes g.
struct Sampled {
  Eigen::VectorXd times;   ///< nodes, ascending, 2 to max_nodes of them
  Eigen::VectorXd values;  ///< there
  Eigen::VectorXd slopes;  ///< there; values/time
};

/// A shape and what it does.
struct ShapeChoice {
  double shape = 0;  ///< c, 1/time; 0: polynomials
  double error = 0;  ///< the largest |D(c) X - X'|, in units of the slopes
};

/// The largest |D X - X'| at the nodes, where D is that of StableGaussian.
/// @param sampled the function; all three vectors of the same size
/// @param shape   c, as for StableGaussian
/// @throws std::invalid_argument as StableGaussian; if the sizes differ or a value or slope is not finite
[[nodiscard]] double slope_error(const Sampled& sampled, double shape);

/// The shape with the least slope_error among c = 0 and c = least to largest, sampled evenly in log c, then
/// refined around the best sample by sections of the golden ratio. As D comes from StableGaussian, rounding
/// draws no minima of its own, unlike in leave_one_out_cost.
/// @param sampled the function to be differentiated
/// @param least   smallest shape but 0, 1/time, > 0
/// @param largest largest shape, 1/time, > least; times the interval at most StableGaussian::largest_shape
/// @param samples how many between, at least 3
/// @throws std::invalid_argument as slope_error, and if a bound or the number is out of range
[[nodiscard]] ShapeChoice choose_shape(const Sampled& sampled, double least, double largest,
                                       int samples = 40);

/// The cost of Algorithm 1, leave_one_out_cost for Gaussians, without its loss of digits: relatively within
/// 1e-9. It has no minimum in between: it tends to 0 for c -> 0, as c^(2n - 2), and for c -> infinity.
/// @param times nodes, ascending, 2 to max_nodes of them
/// @param shape c > 0, 1/time; times the interval at most StableGaussian::largest_shape
/// @return 1/time; 0 if it is below the range of doubles
/// @throws std::invalid_argument as StableGaussian, and if the shape is not positive
[[nodiscard]] double exact_leave_one_out_cost(const Eigen::VectorXd& times, double shape);

}  // namespace nlmech::collocation

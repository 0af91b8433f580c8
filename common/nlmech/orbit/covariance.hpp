/// @file
/// Square roots of covariances of position and velocity.
#pragma once

#include <optional>
#include <string>

#include "nlmech/program/vector.hpp"

namespace nlmech::orbit {

/// Entry of a matrix that is no covariance.
struct CovarianceFault {
  int row = 0;      ///< of the entry, from 0
  int column = 0;   ///< of the entry, from 0
  std::string why;  ///< what is wrong, with the value
};

/// Cholesky's factor: lower triangular @p root with root root^T = @p covariance. A covariance is propagated
/// by its root, P(t) = (Phi root)(Phi root)^T, which stays symmetric and positive semi-definite.
/// @param covariance of x, y, z, vx, vy, vz; entries finite; symmetric to 1e-9 of the product of the
/// standard deviations, and positive semi-definite to 1e-12 of the variances; singular ones are allowed
/// @return the first faulty entry, if any
[[nodiscard]] std::optional<CovarianceFault> root_of_covariance(const Matrix<double, 6>& covariance,
                                                                Matrix<double, 6>& root);

}  // namespace nlmech::orbit

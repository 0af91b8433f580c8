/// @file
/// The sign of a second variation on the directions that keep what is prescribed.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "nlmech/bvp/optimal_control/extremal.hpp"

namespace nlmech::bvp {

/// By the eigenvalues of a Hessian on the directions v with r v = 0 for every row r.
/// @param hessian of the cost, symmetric
/// @param held the rows, linearly independent; may be empty
[[nodiscard]] SecondOrder classify(const Eigen::MatrixXd& hessian,
                                   const std::vector<Eigen::RowVectorXd>& held);

}  // namespace nlmech::bvp

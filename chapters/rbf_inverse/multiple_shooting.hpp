/// @file
/// Multiple shooting with an integrator of other authors: the way to which collocation is compared.
#pragma once

#include "nlmech/algebraic/equations.hpp"
#include "nlmech/bvp/problem.hpp"

namespace nlmech::chapters::rbf_inverse {

/// Its settings.
struct MultipleShooting {
  int segments = 10;  ///< equal ones
  double tolerance =
      1e-9;             ///< of the integrator, relative and absolute; Newton's update ends at ten times that
  int iterations = 60;  ///< of damped Newton
};

/// How it ended.
struct ShotSolution {
  Status status;             ///< of Newton's iteration
  Eigen::VectorXd first;     ///< x(t_0)
  std::int64_t newton = 0;   ///< iterations
  std::int64_t flights = 0;  ///< evaluations of all segments, with their derivatives
};

/// Is CVODE in this build?
[[nodiscard]] bool multiple_shooting_available();

/// States at the begins of the segments are the unknowns, each segment is flown by CVODE's Adams formulas
/// with its variational equations, and damped Newton's iteration joins the segments. One phase, no
/// parameters.
/// @throws std::logic_error if the build has no CVODE
[[nodiscard]] ShotSolution shoot(const bvp::Problem& problem, const bvp::Start& start,
                                 const MultipleShooting& method);

}  // namespace nlmech::chapters::rbf_inverse

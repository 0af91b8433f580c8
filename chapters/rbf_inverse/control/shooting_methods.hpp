/// @file
/// Shooting, the way to which collocation is compared: segments are integrated with their
/// variational equations, and Newton's iteration joins them. Problems of one phase, without parameters.
#pragma once

#include "nlmech/bvp/problem.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::chapters::rbf_inverse {

/// How it ended.
struct Shot {
  Status status;            ///< of Newton's iteration
  Eigen::VectorXd first;    ///< x(t_0); of no use after a failure
  double miss = 0;          ///< single: largest residual of the end conditions, NaN if the end is not reached
  double reach = 0;         ///< single: norm of the largest iterate
  std::int64_t newton = 0;  ///< iterations
};

/// All initial values are unknown, one solution leads to the end.
struct SingleShooting {
  double tolerance = 1e-8;  ///< of ode45, relative and absolute
  int iterations = 60;      ///< of Newton at most
};
/// Newton's iteration on x(t_0), integrated by ode45. Success means a root whose end conditions hold to 1e-6
/// of 1 + |x(t_0)|.
///
/// Tests hold it to the closed form of a linear oscillator (1e-6), its roots to another integrator
/// (1e-5), and iterations that are cut off to a failure.
/// @param first where it begins
[[nodiscard]] Shot shoot_once(const bvp::Problem& problem, const Eigen::VectorXd& first,
                              const SingleShooting& method = {});

/// The states at the begins of all segments are unknown.
struct MultipleShooting {
  int segments = 10;  ///< equal ones
  double tolerance =
      1e-9;             ///< of the integrator, relative and absolute; Newton's update ends at ten times that
  int iterations = 60;  ///< of damped Newton
};
/// Damped Newton's iteration, integrated by CVODE's Adams formulas.
/// @throws std::logic_error if the build has no CVODE
[[nodiscard]] Shot shoot(const bvp::Problem& problem, const bvp::Start& start,
                         const MultipleShooting& method);
/// Is CVODE in this build?
[[nodiscard]] bool multiple_shooting_available();

}  // namespace nlmech::chapters::rbf_inverse

/// @file
/// Single and multiple shooting, for comparison with collocation: segments are integrated with their
/// variational equations, and Newton's iteration solves the continuity and end conditions. For problems with
/// one phase and no parameters.
#pragma once

#include "nlmech/bvp/problem.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::chapters::rbf_inverse {

/// Result of single or multiple shooting.
struct ShootingResult {
  Status status;            ///< status of Newton's iteration
  Eigen::VectorXd first;    ///< x(t_0); not meaningful after a failure
  double miss = 0;          ///< single: largest residual of the end conditions; NaN if the end is not reached
  double reach = 0;         ///< single: norm of the largest iterate
  std::int64_t newton = 0;  ///< number of Newton iterations
};

/// Options of single shooting: all initial values are unknown, one integration to the end.
struct SingleShooting {
  double tolerance = 1e-8;  ///< tolerance of ode45, relative and absolute
  int iterations = 60;      ///< largest number of Newton iterations
};
/// Single shooting: Newton's iteration for x(t_0), with integration by ode45. Success means a root with
/// residuals of the end conditions below 1e-6 (1 + |x(t_0)|).
///
/// Tests compare it with the closed form of a linear oscillator (1e-6), its roots with another integrator
/// (1e-5), and check that a limit of iterations ends with a failure.
/// @param first initial guess of x(t_0)
[[nodiscard]] ShootingResult shoot_once(const bvp::Problem& problem, const Eigen::VectorXd& first,
                                        const SingleShooting& method = {});

/// Options of multiple shooting: the states at the starts of all segments are unknown.
struct MultipleShooting {
  int segments = 10;        ///< number of segments of equal length
  double tolerance = 1e-9;  ///< tolerance of the integrator, relative and absolute; Newton's iteration ends
                            ///< at updates of ten times this
  int iterations = 60;      ///< largest number of damped Newton iterations
};
/// Multiple shooting: damped Newton iteration, with integration by CVODE's Adams methods.
/// @throws std::logic_error if the build has no CVODE
[[nodiscard]] ShootingResult shoot(const bvp::Problem& problem, const bvp::Start& start,
                                   const MultipleShooting& method);
/// Whether this build includes CVODE.
[[nodiscard]] bool multiple_shooting_available();

}  // namespace nlmech::chapters::rbf_inverse

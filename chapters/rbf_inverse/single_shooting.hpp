/// @file
/// Single shooting: all initial values are unknown, one flight leads to the end.
#pragma once

#include "nlmech/bvp/problem.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::chapters::rbf_inverse {

/// Its settings.
struct SingleShooting {
  double tolerance = 1e-8;  ///< of ode45, relative and absolute
  int iterations = 60;      ///< of Newton at most
  bool damped = false;      ///< the step shortened until the residual falls
  double largest = 1e12;    ///< an iterate beyond this, Euclidean, has diverged
};

/// How it ended.
struct SingleShot {
  Status status;            ///< of Newton's iteration
  Eigen::VectorXd first;    ///< x(t_0); of no use after a failure
  double miss = 0;          ///< largest residual of the end conditions, NaN if it was not flown
  double reach = 0;         ///< |x(t_0)| of the largest iterate, Euclidean
  std::int64_t newton = 0;  ///< iterations
};

/// Newton's iteration on x(t_0), flown by ode45 with its variational equations. One phase, no parameters.
/// Success means a root whose end conditions hold to 1e-6 of 1 + |x(t_0)|.
///
/// Tests hold it to the closed form of a linear oscillator (1e-6), its roots to a flight by another method
/// (1e-5), and iterations that are cut off to a failure.
/// @param problem what is to be solved
/// @param first where it begins
[[nodiscard]] SingleShot shoot_once(const bvp::Problem& problem, const Eigen::VectorXd& first,
                                    const SingleShooting& method = {});

}  // namespace nlmech::chapters::rbf_inverse

/// @file
/// The initial value problem from a boundary value problem's own initial values: the judge of its solutions.
#pragma once

#include <span>

#include "nlmech/bvp/problem.hpp"
#include "nlmech/support/statistics.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::bvp {

/// States of an integration at the times asked for.
struct Integration {
  Eigen::MatrixXd states;  ///< n by the number of times reached
  Status status;           ///< of the integrator
  Statistics statistics;   ///< of the integrator
};

/// Integrates x' = f(t, x, p) by `adaptive-collocation` at a tolerance of 1e-13, relative and absolute.
/// @param problem whose right-hand side is integrated
/// @param x0 state at times[0]
/// @param p its parameters
/// @param times in the order of travel, forwards or backwards; the first is where x0 holds
/// @throws std::invalid_argument for wrong sizes
[[nodiscard]] Integration integrate_at(const Problem& problem, const Eigen::VectorXd& x0,
                                       const Eigen::VectorXd& p, std::span<const double> times);

}  // namespace nlmech::bvp

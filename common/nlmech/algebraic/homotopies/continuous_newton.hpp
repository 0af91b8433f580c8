/// @file
/// Continuous Newton method, and the fictitious time integration method, which needs no dF/dx.
#pragma once

#include <cstdint>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// Integrates dx/dt = -B^-1 F (Elgohary 2015, Eq. 2.3; Davidenko) by Euler's method; needs the matrix. The
/// exact flow satisfies F(x(t)) = F(x(0)) e^-t and ends where B is singular. Step size 1 is Newton's
/// iteration; a smaller one is damped Newton without line search, which reduces |F| by the factor 1 - step
/// near the root.
///
/// Tests check first-order convergence to the exact flow (ratio of errors within 0.05 of 2), and that steps
/// of size 1 are Newton's.
struct ContinuousNewton {
  double step = 0.5;                 ///< step size in fictitious time, positive
  double tolerance = 1e-10;          ///< converged when |F|, Euclidean, is at most this; not negative
  std::int64_t iterations = 10'000;  ///< limit of steps
};

/// Runs the flow. Outcomes besides success: `singular_matrix`; `non_finite`; `step_limit`; `interrupted`.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations,
/// std::logic_error if they have no matrix
[[nodiscard]] Report find_root(const ContinuousNewton& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

/// Integrates dx/dt = -nu F(x)/q(t), q = (1 + t)^m, by Euler's method (Elgohary 2015, Eq. 2.7; Liu and Atluri
/// 2008). B is not used. It converges only where all eigenvalues of nu B have positive real parts, at the
/// rate of the smallest of them; with m = 1 like a power of t. Euler's method is stable only for nu step
/// |eigenvalue| < 2.
///
/// Tests compare it with Euler's product for diagonal equations, within 200 eps.
struct FictitiousTime {
  double nu = 1;                      ///< any finite number but 0
  double power = 0;                   ///< m, from 0 to 1
  double step = 0.1;                  ///< step size in fictitious time, positive
  double tolerance = 1e-10;           ///< converged when |F|, Euclidean, is at most this; not negative
  std::int64_t iterations = 100'000;  ///< limit of steps
};

/// Runs the flow. Outcomes besides success: `non_finite` when F is no longer finite, as when the flow
/// diverges; `step_limit`; `interrupted`.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations
[[nodiscard]] Report find_root(const FictitiousTime& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

}  // namespace nlmech::algebraic

/// @file
/// The continuous Newton method, a flow to the root, and fictitious time integration, a flow without dF/dx.
#pragma once

#include <cstdint>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// Follows dx/dt = -B^-1 F (Elgohary 2015, Eq. 2.3; Davidenko) by Euler's rule; needs the matrix. The exact
/// flow has F(x(t)) = F(x(0)) e^-t: it goes straight to the root in the space of F, and ends where B is
/// singular. A step of 1 is Newton's, a shorter one damped Newton without a line search: |F| then shrinks by
/// 1 - step near the root.
///
/// Tests hold the flow to the exact one at first order (ratio of errors within 0.05 of 2), and steps of 1 to
/// Newton's.
struct ContinuousNewton {
  double step = 0.5;                 ///< of fictitious time, positive
  double tolerance = 1e-10;          ///< done when |F|, Euclidean, is no greater; not negative
  std::int64_t iterations = 10'000;  ///< at most so many steps
};

/// Runs the flow. Outcomes besides success: `singular_matrix`; `non_finite`; `step_limit`; `interrupted`.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations,
/// std::logic_error if they have no matrix
[[nodiscard]] Report find_root(const ContinuousNewton& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

/// Follows dx/dt = -nu F(x)/q(t), q = (1 + t)^m, by Euler's rule (Elgohary 2015, Eq. 2.7; Liu and Atluri
/// 2008). B is never asked for. It converges only where all eigenvalues of nu B have positive real parts, and
/// then as slowly as the smallest of them says; with m = 1 like a power of t; and Euler's rule is stable for
/// nu step |eigenvalue| < 2 only.
///
/// Tests hold it to Euler's product for diagonal equations, to 200 eps.
struct FictitiousTime {
  double nu = 1;                      ///< any finite number but 0
  double power = 0;                   ///< m, from 0 to 1
  double step = 0.1;                  ///< of fictitious time, positive
  double tolerance = 1e-10;           ///< done when |F|, Euclidean, is no greater; not negative
  std::int64_t iterations = 100'000;  ///< at most so many steps
};

/// Runs the flow. Outcomes besides success: `non_finite` when F is no longer finite, as when the flow
/// diverges; `step_limit`; `interrupted`.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations
[[nodiscard]] Report find_root(const FictitiousTime& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

}  // namespace nlmech::algebraic

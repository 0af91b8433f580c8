/// @file
/// Methods that use products with dF/dx and its transpose only: steepest descent and the optimal iterative
/// algorithm over span{F, B^T F}.
#pragma once

#include <cstdint>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// x <- x - alpha B^T F, steepest descent for J = |F|^2/2 (Elgohary 2015, Eq. 2.6, with grad J for the
/// printed grad F). Each alpha is halved until Armijo's rule J_new <= J - 1e-4 alpha |B^T F|^2 holds.
///
/// With Cauchy's first alpha, the minimiser |g|^2/|B g|^2 of the linearised |F|, J falls at every step, and
/// the number of steps grows like cond(B)^2. With Barzilai and Borwein's, s.s/s.y of the step before, J may
/// rise now and then: J in Armijo's rule is the greatest of the latest ten (Raydan 1997).
///
/// Tests hold Cauchy's step to Kantorovich's bound on linear equations.
struct SteepestDescent {
  /// First alpha of a step.
  enum class Length : std::uint8_t {
    cauchy,           ///< least linearised |F|
    barzilai_borwein  ///< from the latest two iterates; Cauchy's at the start and where s.y is not positive
  };
  Length length = Length::barzilai_borwein;  ///< of the first alpha
  double tolerance = 1e-10;                  ///< done when |F|, Euclidean, is no greater; not negative
  std::int64_t iterations = 100'000;         ///< at most so many steps
};

/// Outcomes besides success: `singular_matrix` where B^T F is 0; `not_converged` where it is, to rounding,
/// normal to the range of B or no alpha is short enough: |F| has a minimum there; `non_finite` at the start
/// or if B^T F is not finite; `step_limit`; `interrupted`. Where F is not finite at a trial point alpha is
/// halved; halvings count as rejected.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations
[[nodiscard]] Report find_root(const SteepestDescent& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

/// The globally optimal vector-driven algorithm of Liu and Atluri (2012): x <- x - (1 - gamma) u (F.v)/|v|^2,
/// v = B u, with the u of span{F, B^T F} that minimises a_0 = |F|^2 |v|^2/(F.v)^2. That u is the one whose v
/// is the projection of F on span{B F, B B^T F}, so that a_0 >= 1 is the secant squared of the angle between
/// F and that plane. In one variable it is damped Newton of the factor 1 - gamma; for linear F of at most two
/// unknowns and gamma = 0 one step ends it.
///
/// Tests hold it to the least residual of the span on linear equations, and to one step for two of them.
struct OptimalIterative {
  double gamma = 0.05;                ///< relaxation, from 0 to below 1
  double tolerance = 1e-10;           ///< done when |F|, Euclidean, is no greater; not negative
  std::int64_t iterations = 100'000;  ///< at most so many steps
};

/// Outcomes as for SteepestDescent; steps are not shortened unless F is not finite.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations
[[nodiscard]] Report find_root(const OptimalIterative& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

}  // namespace nlmech::algebraic

/// @file
/// Methods that need only products with dF/dx and its transpose: steepest descent and the optimal iterative
/// algorithm over span{F, B^T F}.
#pragma once

#include <cstdint>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// Steepest descent x <- x - alpha B^T F for J = |F|^2/2 (Elgohary 2015, Eq. 2.6, with grad J for the printed
/// grad F). alpha is halved until Armijo's rule J_new <= J - 1e-4 alpha |B^T F|^2 holds.
///
/// With Cauchy's first alpha |g|^2/|B g|^2, which minimises the linearised |F|, J decreases at every step and
/// the number of steps grows like cond(B)^2. With that of Barzilai and Borwein, s.s/s.y of the previous step,
/// J may increase; Armijo's rule then uses the greatest of the latest ten J (Raydan 1997).
///
/// Tests check Cauchy's step against Kantorovich's bound on linear equations.
struct SteepestDescent {
  /// Choice of the first alpha of a step.
  enum class Length : std::uint8_t {
    cauchy,           ///< minimiser of the linearised |F|
    barzilai_borwein  ///< from the latest two iterates; Cauchy's at the start and where s.y is not positive
  };
  Length length = Length::barzilai_borwein;  ///< choice of the first alpha
  double tolerance = 1e-10;                  ///< converged when |F|, Euclidean, is at most this; not negative
  std::int64_t iterations = 100'000;         ///< limit of steps
};

/// Outcomes besides success: `singular_matrix` where B^T F is 0; `not_converged` at a minimum of |F|: F is
/// normal to the range of B to rounding, or no alpha meets Armijo's rule; `non_finite` at the start or if B^T
/// F is not finite; `step_limit`; `interrupted`. alpha is also halved where F is not finite; halvings count
/// as rejected steps.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations
[[nodiscard]] Report find_root(const SteepestDescent& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

/// The globally optimal vector-driven algorithm of Liu and Atluri (2012): x <- x - (1 - gamma) u (F.v)/|v|^2,
/// v = B u, with the u of span{F, B^T F} that minimises a_0 = |F|^2 |v|^2/(F.v)^2. Its v is the projection of
/// F on span{B F, B B^T F}; a_0 >= 1 is the squared secant of the angle between F and that plane. In one
/// variable the method is damped Newton with the factor 1 - gamma. For linear F, at most two unknowns and
/// gamma = 0 it converges in one step.
///
/// Tests check that the residual is the least in the span on linear equations, and that two linear equations
/// take one step.
struct OptimalIterative {
  double gamma = 0.05;                ///< relaxation, from 0 to below 1
  double tolerance = 1e-10;           ///< converged when |F|, Euclidean, is at most this; not negative
  std::int64_t iterations = 100'000;  ///< limit of steps
};

/// Outcomes as for SteepestDescent; a step is halved only where F is not finite.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations
[[nodiscard]] Report find_root(const OptimalIterative& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

}  // namespace nlmech::algebraic

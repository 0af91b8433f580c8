/// @file
/// Broyden's good method: a secant method with few factorisations of dF/dx.
#pragma once

#include <cstdint>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// Broyden (1965): dx = -A^-1 F. A starts as B and gets a rank-one update after every step so that A dx = dF.
/// Convergence is superlinear near a regular root, with one evaluation of F and no derivative per step. The
/// updates are applied to A^-1 and stored as pairs of vectors on top of the factors of B.
///
/// A restarts as B of the latest iterate when `memory` updates are stored, and when a step did not reduce
/// |F|. A step with F not finite or above `growth` |F| is halved, at most thirty times.
///
/// Tests compare it with the secant method in one variable, within a few rounding errors.
struct Broyden {
  int memory = 20;                 ///< updates before A restarts; at least 1
  double growth = 10;              ///< largest accepted factor of |F| in a step; at least 1
  double tolerance = 1e-10;        ///< converged when |F|, Euclidean, is at most this; not negative
  std::int64_t iterations = 1000;  ///< limit of steps, including halvings
};

/// Needs the matrix. Outcomes besides success: `singular_matrix` if B is singular at a restart;
/// `not_converged` if thirty halvings are not enough; `non_finite` if F at the start or B is not finite;
/// `step_limit`; `interrupted`. statistics: each restart of A counts as a factorisation.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations,
/// std::logic_error if they have no matrix
[[nodiscard]] Report find_root(const Broyden& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

}  // namespace nlmech::algebraic

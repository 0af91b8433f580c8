/// @file
/// Broyden's good method, a secant method that factorises dF/dx seldom.
#pragma once

#include <cstdint>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// Broyden (1965): dx = -A^-1 F with an A that starts as B and is changed by a matrix of rank one after every
/// step so that A dx = dF: superlinear near a regular root, at one evaluation of F and no derivative a step.
/// The changes are applied to A^-1 and kept as pairs of vectors on top of the factors of B.
///
/// A starts anew, as B of the latest iterate, when `memory` changes are kept and when a step did not shorten
/// F. A step for which F is not finite, or longer than `growth` |F|, is halved, thirty times at most.
///
/// Tests hold it to the secant method in one variable, to some roundings.
struct Broyden {
  int memory = 20;                 ///< changes before A starts anew; at least 1
  double growth = 10;              ///< a step may lengthen F by this factor; at least 1
  double tolerance = 1e-10;        ///< done when |F|, Euclidean, is no greater; not negative
  std::int64_t iterations = 1000;  ///< at most so many steps, halvings included
};

/// Needs the matrix. Outcomes besides success: `singular_matrix` where B is, when A starts anew;
/// `not_converged` if no half is short enough; `non_finite` at the start, or if B is; `step_limit`;
/// `interrupted`. statistics: a new start of A counts as a factorisation.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations,
/// std::logic_error if they have no matrix
[[nodiscard]] Report find_root(const Broyden& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

}  // namespace nlmech::algebraic

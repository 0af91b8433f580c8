/// @file
/// Powell's dogleg: Newton's step within a trust region, bent towards steepest descent.
#pragma once

#include <cstdint>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// Powell's hybrid method (1970) with the exact derivative: the step goes to Newton's point if that is within
/// the radius, else along the path from here over Cauchy's point (least linearised |F| along -B^T F) to
/// Newton's point up to the radius. Where B is singular, Cauchy's part alone is taken. Past a limit point it
/// ends in a minimum of |F| that is no root.
///
/// Tests hold it to Newton's step within the radius, and no step to be longer than that.
struct Dogleg {
  double radius = 1;                 ///< first radius, a length in the space of x; positive
  double tolerance = 1e-10;          ///< done when |F|, Euclidean, is no greater; not negative
  std::int64_t iterations = 10'000;  ///< at most so many steps, rejected ones included
};

/// Needs the matrix. Outcomes besides success: `singular_matrix` where B^T F is 0; `not_converged` where F
/// is, to rounding, normal to the range of B or the radius no longer moves x; `non_finite` at the start or if
/// B is, else the radius shrinks; `step_limit`; `interrupted`. A step by a singular B counts as a fallback.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations,
/// std::logic_error if they have no matrix
[[nodiscard]] Report find_root(const Dogleg& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

}  // namespace nlmech::algebraic

/// @file
/// F(x) = 0 as the end of a path: solvers by arc length.
#pragma once

#include "nlmech/algebraic/equations.hpp"
#include "nlmech/algebraic/paths/path.hpp"

namespace nlmech::algebraic {

/// Follows the path of F(x) = (1 - load) F(x0) from the start x0, at load 0, to load 1, through all limit
/// points on the way, and ends with Newton's iteration there. For a structure under dead load, from rest,
/// that is the path of its equilibria under a growing load, and what is found is the first equilibrium on it
/// that carries the whole load; it may be unstable, if the path begins so.
///
/// A finite step may pass over a limit point and back below the load without showing that the load was
/// reached in between. So every limit point that a step has passed is computed to rounding, and decides.
struct ArcLength {
  /// How to step; `first` is a part of the whole load.
  PathMethod path = {};
  std::int64_t steps = 2000;  ///< at most so many, rejected ones included; else `step_limit`
};

/// Solves. The observer sees the points of the path, `time` being their load. Outcomes besides success:
/// `step_underflow`, `step_limit`, `non_finite`, `singular_matrix`, `not_converged`, `wrong_branch` if the
/// equations say so of the point found, `interrupted`; x is then the last point of the path. `Report::time`
/// is its load.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations,
/// std::logic_error if they have no matrix
[[nodiscard]] Report find_root(const ArcLength& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

}  // namespace nlmech::algebraic

/// @file
/// Arc-length solvers for F(x) = 0.
#pragma once

#include "nlmech/algebraic/equations.hpp"
#include "nlmech/algebraic/paths/path.hpp"

namespace nlmech::algebraic {

/// Follows the path of F(x) = (1 - load) F(x0) from x0 at load 0 to load 1, through all limit points, and
/// ends with Newton's iteration there. For a structure at rest under dead load this is the equilibrium path
/// under a growing load. The result is the first equilibrium on the path that carries the full load; it may
/// be unstable.
///
/// A finite step may pass a limit point and return below the load, although the load was reached in between.
/// Every limit point that a step passes is therefore computed to rounding and compared with the load.
struct ArcLength {
  /// Options of path following; `first` is a fraction of the full load.
  PathMethod path = {};
  std::int64_t steps = 2000;  ///< limit of steps, including rejected ones; then `step_limit`
};

/// Solves. The observer receives the points of the path; `time` is the load. Outcomes besides success:
/// `step_underflow`, `step_limit`, `non_finite`, `singular_matrix`, `not_converged`, `wrong_branch` if the
/// equations report it for the result, `interrupted`; x is then the last point of the path. `Report::time` is
/// its load.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations,
/// std::logic_error if they have no matrix
[[nodiscard]] Report find_root(const ArcLength& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

}  // namespace nlmech::algebraic

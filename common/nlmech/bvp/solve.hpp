/// @file
/// Solves boundary value problems: damped Newton, a mesh that follows the residual, and verification by
/// integration.
#pragma once

#include "nlmech/bvp/solution.hpp"
#include "nlmech/bvp/verification.hpp"

namespace nlmech::bvp {

/// How a solution is verified by an integrator.
enum class Verification : std::uint8_t {
  none,   ///< not at all
  whole,  ///< from its initial values to the end; at a point between phases its own jump is added
  pieces  ///< each interval from the solution's value at its begin: for problems whose solutions grow so fast
          ///< that nothing can be integrated through
};

/// Options of solve(); the defaults give the states to 10 digits and more.
struct Options {
  Family family = Family::lobatto;    ///< trial functions and nodes
  int nodes = 8;                      ///< N on an interval, both ends included
  double relative_shape = 4;          ///< c h of Gaussians; see make_scheme
  bool keep_ill_conditioned = false;  ///< see make_scheme
  int intervals = 10;                 ///< of each phase at the begin, if the start brings no mesh; >= 1
  bool refine = true;                 ///< follow the residual; else the first mesh is the last
  double tolerance = 1e-9;            ///< of Solution::residual, > 0
  int meshes = 20;                    ///< at most so many
  int most_intervals = 2000;          ///< in all
  double newton_tolerance = 1e-10;    ///< of the last update, root mean square of |dx_i| / (1 + max |x_i|)
  int newton_iterations = 100;        ///< on each mesh
  double least_damping = 1e-6;        ///< a shorter fraction of Newton's step ends with newton_diverged
  Verification verification = Verification::whole;  ///< how the solution is judged
  double verification_tolerance = 1e-6;  ///< of Solution::integration_error; a root beyond it is spurious
};

/// Solves a boundary value problem.
///
/// Newton's direction is damped by the natural monotonicity test (P. Deuflhard, Newton Methods for Nonlinear
/// Problems, 2004, section 3.3), which does not depend on the scaling of the equations. Then each interval
/// whose residual is above the tolerance is divided, by as much as the order of the scheme says, and pairs
/// with far smaller ones are joined, until all are below.
///
/// Outcomes besides success:
///  - `infeasible`: conditions contradict each other, whatever the solution;
///  - `singular_matrix`: conditions repeat each other, or the differential equation makes them dependent;
///  - `newton_diverged`, `not_converged`: no root from this start;
///  - `non_finite`: f or a condition is not finite at the start;
///  - `step_limit`: meshes or intervals are used up with the residual above the tolerance;
///  - `spurious_root`: integration from its initial values does not follow the solution;
///  - that of the Gaussians' matrix.
/// Unless the sentence says that nothing could be evaluated, the last iterate is in the solution.
///
/// Tests hold both solutions of Bratu's problem to 1e-8 of the closed form, its schemes to their orders 2N -
/// 2 and 2N - 3, an eigenvalue to 1e-12, and linear problems to 1e-11.
/// @throws std::invalid_argument for sizes that do not fit and options out of range
[[nodiscard]] Solution solve(const Problem& problem, const Start& start, const Options& options = {});

/// Integrates from the initial values of a solution: sets integration_error, and status if it fails. solve()
/// calls it.
void verify_by_integration(const Problem& problem, const Options& options, Solution& solution);

}  // namespace nlmech::bvp

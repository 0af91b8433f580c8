/// @file
/// Boundary value problems: damped Newton iteration, mesh refinement by the residual, verification by
/// integration.
#pragma once

#include <span>

#include "nlmech/bvp/solution.hpp"

namespace nlmech::bvp {

/// How a solution is verified by an integrator.
enum class Verification : std::uint8_t {
  none,   ///< not at all
  whole,  ///< from its initial values to the end; at a point between phases its own jump is added
  pieces  ///< each interval from the solution's value at its start: for problems whose solutions grow too
          ///< fast to be integrated over the whole time
};

/// Options of solve(); the defaults give the states to 10 digits and more.
struct Options {
  int nodes = 8;                    ///< N on an interval, both ends included; 3 to 200
  int intervals = 10;               ///< of each phase on the first mesh, if the start brings none; >= 1
  bool refine = true;               ///< refine the mesh by the residual
  double tolerance = 1e-9;          ///< of Solution::residual, > 0
  int most_intervals = 2000;        ///< in all
  double newton_tolerance = 1e-10;  ///< of the last update, root mean square of |dx_i| / (1 + max |x_i|)
  Verification verification = Verification::whole;  ///< by an integrator
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
///  - `spurious_root`: integration from its initial values does not follow the solution.
/// Unless the sentence says that nothing could be evaluated, the last iterate is in the solution.
///
/// Tests compare both solutions of Bratu's problem with the closed form (1e-8), an eigenvalue (1e-12) and
/// linear problems (1e-11), and measure the order 2N - 2.
/// @throws std::invalid_argument for sizes that do not fit and options out of range
[[nodiscard]] Solution solve(const Problem& problem, const Start& start, const Options& options = {});

/// Integrates from the initial values of a solution: sets integration_error, and status if it fails. solve()
/// calls it.
void verify_by_integration(const Problem& problem, const Options& options, Solution& solution);

/// States of an integration at the times asked for.
struct Integration {
  Eigen::MatrixXd states;  ///< n by the number of times reached
  Status status;           ///< of the integrator
  Statistics statistics;   ///< of the integrator
};

/// Integrates x' = f(t, x, p) by `adaptive-collocation` at a tolerance of 1e-13, relative and absolute.
/// @param problem whose right-hand side is integrated
/// @param x0 state at times[0]
/// @param p its parameters
/// @param times in the order of travel, forwards or backwards; the first is where x0 holds
/// @throws std::invalid_argument for wrong sizes
[[nodiscard]] Integration integrate_at(const Problem& problem, const Eigen::VectorXd& x0,
                                       const Eigen::VectorXd& p, std::span<const double> times);

}  // namespace nlmech::bvp

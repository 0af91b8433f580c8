/// @file
/// Solver for boundary value problems: damped Newton iteration, mesh refinement by the residual, verification
/// by integration.
#pragma once

#include <span>

#include "nlmech/bvp/solution.hpp"

namespace nlmech::bvp {

/// Verification of a solution by an integrator.
enum class Verification : std::uint8_t {
  none,   ///< no verification
  whole,  ///< one integration from the initial values to the end; the solution's jumps between phases are
          ///< added
  pieces  ///< each interval is integrated by itself, forwards or backwards, as adjacent trajectories
          ///< converge, and in parts where they diverge both ways: for problems whose solutions grow too fast
          ///< for one integration over all intervals
};

/// Options of solve(); with the defaults the states have at least 10 digits.
struct Options {
  int nodes = 8;              ///< N per interval, including both ends; 3 to 200
  int intervals = 10;         ///< intervals per phase of the first mesh, if the start has no mesh; >= 1
  bool refine = true;         ///< whether to refine the mesh by the residual
  double tolerance = 1e-9;    ///< bound of Solution::residual, > 0
  int most_intervals = 2000;  ///< largest number of intervals in all phases; >= 1
  /// Bound of the last update, > 0: rms of |dx_i| / max |x_i| and |dp_j| / |p_j|. Sizes are at least ten
  /// times the effect of rounding errors over this bound.
  double newton_tolerance = 1e-10;
  Verification verification = Verification::whole;  ///< kind of verification
  double verification_tolerance = 1e-6;  ///< bound of Solution::integration_error, > 0; else spurious
};

/// Solves a boundary value problem.
///
/// The Newton step is damped by the natural monotonicity test (P. Deuflhard, Newton Methods for Nonlinear
/// Problems, 2004, section 3.3), which is invariant under scaling of the equations. Then intervals with a
/// residual above the tolerance are divided, into a number of parts from the order of the scheme, and pairs
/// of intervals with far smaller residuals are joined, until all residuals are below the tolerance, or no
/// larger than those of states changed by a hundredth of the tolerance, relatively: with large |df/dx| the
/// rounding of the states alone makes residuals above the tolerance.
///
/// Outcomes besides success:
///  - `infeasible`: conditions contradict each other;
///  - `singular_matrix`: conditions are redundant, or dependent through the differential equation; or nothing
///    determines a state or parameter at the result, which the message names;
///  - `newton_diverged`, `not_converged`: no root was found from this start;
///  - `non_finite`: f or a condition is not finite at the start;
///  - `step_limit`: limit of meshes or intervals reached with the residual above the tolerance;
///  - `spurious_root`: the integration from the initial values deviates from the solution, or the solution is
///    not regular at a singular end.
/// Unless nothing could be evaluated, the solution contains the last iterate.
///
/// Tests compare both solutions of Bratu's problem with the closed form (1e-8), an eigenvalue (1e-12) and
/// linear problems (1e-11), and measure the order 2N - 2.
/// @throws std::invalid_argument for inconsistent sizes and options out of range
[[nodiscard]] Solution solve(const Problem& problem, const Start& start, const Options& options = {});

/// Integrates from the initial values of a solution; sets integration_error, and status on failure. Called by
/// solve(). By adaptive collocation; with Verification::pieces by `dop853` where an interval is not stiff.
void verify_by_integration(const Problem& problem, const Options& options, Solution& solution);

/// States of an integration at given times.
struct Integration {
  Eigen::MatrixXd states;  ///< n rows, one column per time reached
  Status status;           ///< of the integrator
  Statistics statistics;   ///< of the integrator
};

/// Integrates x' = f(t, x, p) by `adaptive-collocation` at a tolerance of 1e-13, relative and absolute.
/// @param problem problem with the right-hand side f
/// @param x0 state at times[0]
/// @param p parameters p
/// @param times monotonic, forwards or backwards; times[0] is the initial time
/// @throws std::invalid_argument for wrong sizes
[[nodiscard]] Integration integrate_at(const Problem& problem, const Eigen::VectorXd& x0,
                                       const Eigen::VectorXd& p, std::span<const double> times);

}  // namespace nlmech::bvp

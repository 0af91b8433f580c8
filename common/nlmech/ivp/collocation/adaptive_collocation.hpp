/// @file
/// adaptive-collocation: collocation at Radau nodes with control of step size and error.
#pragma once

#include <string_view>

#include "nlmech/ivp/integrate.hpp"

namespace nlmech::ivp {

/// Collocation with polynomials at the left end and Radau nodes (Radau IIA of high order) with an error
/// estimate in each step; in second-order form if the problem gives accelerations.
///
/// The error of a step is controlled: |e_i| <= atol + rtol |x_i|. The accumulated error depends on the
/// problem: a few tolerances for a stable stiff problem, about one tolerance per period for an oscillation.
///
/// Dense output of sweeps solves the equations of the step again up to the requested time and is as accurate
/// as the steps. The statistics do not include its cost.
///
/// Tests assert an error of one tolerance in every step of sweeps at the orders that the method chooses, of 3
/// tolerances in Newton's steps through transients and the jumps of van der Pol's oscillator, of 30
/// tolerances at the end of stiff problems (HIRES, Robertson, van der Pol to mu = 1e4, linear systems with
/// known solutions), and of 16 eps for polynomials of degree 2 s - 2 in time.
struct AdaptiveCollocation {
  static constexpr std::string_view name = "adaptive-collocation";  ///< on command lines and in tables
  double relative_tolerance = 1e-9;                                 ///< rtol, from 0 to 0.1
  double absolute_tolerance = 1e-9;                                 ///< atol, positive
  int nodes = 0;            ///< N of sweeps including the left end: 9, 13 or 17; 0: adaptive
  double largest_step = 0;  ///< 0: the interval
  double shape = 0;  ///< c of Gaussians at the nodes, 1/time; 0: polynomials. For comparison only: each step
                     ///< size needs its own tables, and the estimate cannot use superconvergence
};

/// @throws std::invalid_argument naming an option out of range and its value
void check_options(const AdaptiveCollocation& method);

/// See integrate().
[[nodiscard]] Solution run(const InitialValueProblem& problem, const AdaptiveCollocation& method);

}  // namespace nlmech::ivp

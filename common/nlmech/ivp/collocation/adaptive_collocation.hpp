/// @file
/// The project's own integrator: collocation at Radau nodes with control of step and error.
#pragma once

#include <string_view>

#include "nlmech/ivp/integrate.hpp"

namespace nlmech::ivp {

/// Collocation with polynomials at the left end and Radau nodes, the method Radau IIA of high order, step by
/// step under an error estimate; in the form for accelerations where the problem has them.
///
/// Controlled is the error of a step, |e_i| <= atol + rtol |x_i|. What steps add up to is the problem's: the
/// end of a stable stiff problem is right to a few tolerances, that of an oscillation off by about as many as
/// there are periods.
///
/// Dense output of sweeps solves the equations of the step anew up to the asked time: as accurate as the
/// steps are. What it costs is not in the statistics.
///
/// Tests hold sweeps to the tolerance in every step at the orders that the method chooses, Newton's steps
/// through transients and the jumps of van der Pol's oscillator to 3 tolerances, ends of stiff problems to 30
/// (HIRES, Robertson, van der Pol to mu = 1e4, linear systems with known solutions), and polynomials of
/// degree 2 s - 2 in time to 16 eps.
struct AdaptiveCollocation {
  static constexpr std::string_view name = "adaptive-collocation";  ///< on command lines and in tables
  double relative_tolerance = 1e-9;                                 ///< rtol, from 0 to 0.1
  double absolute_tolerance = 1e-9;                                 ///< atol, positive
  int nodes = 0;            ///< N of sweeps, the left end among them: 9, 13 or 17; 0: as is best
  double largest_step = 0;  ///< 0: the interval
  double shape = 0;  ///< c of Gaussians at the nodes, 1/time; 0: polynomials. For comparison: each length of
                     ///< a step has its own tables, and the estimate cannot count on superconvergence
};

/// @throws std::invalid_argument naming an option out of range and its value
void check_options(const AdaptiveCollocation& method);

/// See integrate().
[[nodiscard]] Solution run(const InitialValueProblem& problem, const AdaptiveCollocation& method);

}  // namespace nlmech::ivp

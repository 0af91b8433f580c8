/// @file
/// Systems that are smooth between switching surfaces: friction, impacts, saturations.
///
/// Between two surfaces a method integrates smooth equations, and may continue them beyond the surface to
/// locate the switch. The time of the switch is located on the dense output and then refined by steps of the
/// method, so it is as accurate as they are. Where the slopes on both sides of a surface lead to it, the
/// motion stays on it (sticking friction) until one of them leads away.
#pragma once

#include <functional>

#include "nlmech/ivp/solution.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::ivp {

/// integrate() of smooth equations by some method.
using SmoothRun = std::function<Solution(const System&, const State& x0, double t0, double t1,
                                         const Observer&, const Limits&)>;

/// Integrates a switching system from (t0, x0) to t1.
///
/// Steps passed to the observer end at switches. The status is that of the method; `outside_validity` if a
/// motion backwards in time would have to stay on a surface, or if switches accumulate; `non_finite` if a
/// switching function is NaN.
/// @param system switches() > 0; on a surface, surfaces() gives the share of the upper side in the slopes, 0
/// to 1
/// @param run integrates smooth equations
[[nodiscard]] Solution integrate_switching(const System& system, const State& x0, double t0, double t1,
                                           const SmoothRun& run, const Observer& observer,
                                           const Limits& limits);

/// The mode of a solution through (t, x) that is integrated forwards: for each switching function 1 where it
/// is positive or zero, -1 where it is negative, and 0 where it is zero to within the errors of the state and
/// both sides lead to its surface.
/// @param errors bound on the error of each component of @p x
[[nodiscard]] Mode mode_at(const System& system, double t, const State& x, const State& errors);

}  // namespace nlmech::ivp

/// @file
/// Systems that are smooth but for switching surfaces: friction, impacts, saturations.
///
/// Between two surfaces every method sees smooth equations, whose solution it may carry beyond the surface
/// while it looks for the time of the switch. That time is found on its dense output and then made exact by
/// steps of the method itself, so that it is as accurate as they are. Where both sides of a surface lead back
/// to it, the motion stays there (friction that sticks) until one of them leads away.
#pragma once

#include <functional>

#include "nlmech/ivp/solution.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::ivp {

/// integrate() of smooth equations by some method.
using SmoothRun = std::function<Solution(const System&, const State& x0, double t0, double t1,
                                         const Observer&, const Limits&)>;

/// Integrates a system that switches from (t0, x0) to t1.
///
/// The observer sees steps that end at switches. Statuses as of the method; `outside_validity` where a motion
/// backwards would have to stay on a surface, or switches accumulate; `non_finite` where a function is none.
/// @param system switches() > 0; on a surface, surfaces() gives the upper side's share of the slopes, 0 to 1
/// @param run one integration of smooth equations
[[nodiscard]] Solution integrate_switching(const System& system, const State& x0, double t0, double t1,
                                           const SmoothRun& run, const Observer& observer,
                                           const Limits& limits);

}  // namespace nlmech::ivp

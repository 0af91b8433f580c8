/// @file
/// Systems that are smooth between switching surfaces: friction, impacts, saturations, phases that wrap.
///
/// Between two surfaces a method integrates smooth equations, and may continue them beyond the surface to
/// locate the switch. The time of the switch is located on the dense output and then refined by steps of the
/// method, so it is as accurate as they are. Where the slopes on both sides of a surface lead to it, the
/// motion stays on it (sticking friction) until one of them leads away.
///
/// The cells of a function that switches at zero are its two sides; those of a rounded one, the argument of
/// floor, lie between neighbouring integers.
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
/// motion backwards in time would have to stay on a surface, if switches accumulate, or if the argument of
/// floor is beyond 1e9; `non_finite` if a switching function is NaN.
/// @param system switches() > 0; on a surface, surfaces() gives the share of the upper side in the slopes, 0
/// to 1
/// @param run integrates smooth equations
[[nodiscard]] Solution integrate_switching(const System& system, const State& x0, double t0, double t1,
                                           const SmoothRun& run, const Observer& observer,
                                           const Limits& limits);

/// A state and the cells of its switching functions, of which each may depend on those before it.
struct Cells {
  Mode mode;                   ///< of a function on a surface: the upper side
  std::vector<double> values;  ///< of the functions
};
/// The cells of the state @p x at time @p t. A NaN, and a rounded function beyond 1e9, have the cell 1.
[[nodiscard]] Cells cells_at(const System& system, double t, const State& x);

/// Is a switching function with the value @p value on a surface?
/// @param rounded are its surfaces the integers, or only zero?
[[nodiscard]] bool is_on_surface(bool rounded, double value);

/// The mode of a solution through (t, x) that is integrated forwards: the cell of each switching function, or
/// its surface where it is there to within the errors of the state and both sides lead to it.
/// @param errors bound on the error of each component of @p x
[[nodiscard]] Mode mode_at(const System& system, double t, const State& x, const State& errors);

}  // namespace nlmech::ivp

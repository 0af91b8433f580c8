/// @file
/// Integration of equations with sensitivities by steps that see the solution alone.
#pragma once

#include "nlmech/ivp/switching.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::ivp {

/// Scale of sensitivities that no tolerance sees: a power of two, so that every product with it is exact, far
/// below absolute tolerances and far above the smallest doubles.
inline constexpr double unseen_scale = 0x1p-200;

/// Wraps @p run so that its step-size control does not see the sensitivities of its system. Sensitivities
/// enter their equations linearly: @p scaled, the same equations with the scale unseen_scale, has the same
/// solution with sensitivities of that scale, whose errors are far below each method's absolute tolerance.
/// Steps and errors of x are then those of a method that knows x alone, but for methods with a root mean
/// square norm, as CVODE's, whose tolerance for x grows by the root of the ratio of the numbers of
/// components.
/// @param scaled made by program::Equations::with_sensitivities() of scale unseen_scale
/// @return a run that integrates @p scaled instead of the system it is given, in states of scale 1
[[nodiscard]] SmoothRun controlled_by_solution(SmoothRun run, System scaled);

}  // namespace nlmech::ivp

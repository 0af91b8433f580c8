/// @file
/// The explicit central difference method for accelerations.
#pragma once

#include <cstdint>
#include <string_view>

#include "nlmech/ivp/integrate.hpp"

namespace nlmech::ivp {

/// Time at which the velocities of a state are given.
enum class VelocityTime : std::uint8_t {
  of_state,         ///< at the time of the state, as in all other methods
  half_step_before  ///< half a step earlier, as in the method itself
};

/// Central differences, order 2, explicit (Elgohary 2015, Eq. 4.4): velocities are shifted by half a step
/// against positions,
///
///     v(t + h/2) = v(t - h/2) + h a(t, q, v),   q(t + h) = q(t) + h v(t + h/2).
///
/// Started with v(t0 - h/2) = v0 - h/2 a0. Where the step changes from h' to h, v(t + h/2) = v(t - h'/2) +
/// (h' + h)/2 a. States at step ends have the velocity v(t) = v(t - h/2) + h/2 a. Forces that depend on the
/// velocity use v(t) = 1.5 v(t - h/2) - 0.5 v(t - 3h/2), equal to v(t - h/2) + h/2 a(t - h), so the method
/// stays explicit and of order 2. One acceleration per step. Stable for h omega <= 2; for a damping -c v
/// alone: for h c <= 1. Dense output: the cubic Hermite interpolant.
///
/// The last two options reproduce an error of the source. The rows "Explicit" of Table 4.4 are reproduced if
/// a run with the step h ends with v(t1 - h/2) and the next one, with another step h', uses it as v(t1 -
/// h'/2): an error of first order, (h' - h)/2 a in the velocity. That is
/// `CentralDifference{.step = h, .reported = VelocityTime::half_step_before}` followed by
/// ``CentralDifference{.step = h', .initial = VelocityTime::half_step_before}``.
///
/// Tests assert the rotation by 2 arcsin(h/2) on the linear oscillator (16 eps per step, h omega up to 1.9),
/// order 2 (observed within 0.1), growth beyond h omega = 2, and the errors of
/// tools/oracles/rbf_ivp_methods.py for Tables 4.2, 4.4 and 4.6.
struct CentralDifference {
  static constexpr std::string_view name = "explicit";  ///< on command lines and in tables
  double step = 0.01;                                   ///< step size, positive
  /// half_step_before: the initial velocities are v(t0 - h/2), not v(t0).
  VelocityTime initial = VelocityTime::of_state;
  /// half_step_before: reported states (end of steps and of the run) have the velocity v(t - h/2). Dense
  /// output has the velocity at the requested time.
  VelocityTime reported = VelocityTime::of_state;
};

/// See integrate(). @throws std::invalid_argument also for a problem without accelerations
[[nodiscard]] Solution run(const InitialValueProblem& problem, const CentralDifference& method);

}  // namespace nlmech::ivp

/// @file
/// The explicit central difference method for accelerations.
#pragma once

#include <cstdint>
#include <string_view>

#include "nlmech/ivp/integrate.hpp"

namespace nlmech::ivp {

/// To which time the velocities of a state belong.
enum class VelocityTime : std::uint8_t {
  of_state,         ///< to the time of the state, as everywhere else
  half_step_before  ///< half a step earlier, where the method itself has them
};

/// Central differences, order 2, explicit (Elgohary 2015, Eq. 4.4): velocities live half a step beside
/// positions,
///
///     v(t + h/2) = v(t - h/2) + h a(t, q, v),   q(t + h) = q(t) + h v(t + h/2).
///
/// Started with v(t0 - h/2) = v0 - h/2 a0. Where the step changes from h' to h,
/// v(t + h/2) = v(t - h'/2) + (h' + h)/2 a. States at step ends have the velocity v(t) = v(t - h/2) + h/2 a.
/// Forces that depend on the velocity get v(t) = 1.5 v(t - h/2) - 0.5 v(t - 3h/2), the same as
/// v(t - h/2) + h/2 a(t - h), which keeps the method explicit and its order 2. One acceleration a step.
/// Stable for h omega <= 2; a damping -c v alone: for h c <= 1. Dense output: the cubic Hermite interpolant.
///
/// The two last options exist to reproduce a fault. The rows "Explicit" of Table 4.4 come out as printed if a
/// run with the step h ends with v(t1 - h/2) and the next one, with another step h', takes that number for
/// v(t1 - h'/2): an error of first order, (h' - h)/2 a in the velocity. That is
/// `CentralDifference{.step = h, .reported = VelocityTime::half_step_before}` followed by
/// ``CentralDifference{.step = h', .initial = VelocityTime::half_step_before}``.
///
/// Tests hold it to the rotation by 2 arcsin(h/2) on the linear oscillator (16 eps a step, h omega up to
/// 1.9), to order 2 (observed within 0.1), to growth beyond h omega = 2, and to the errors that
/// tools/oracles/rbf_ivp_methods.py has for Tables 4.2, 4.4 and 4.6.
struct CentralDifference {
  static constexpr std::string_view name = "explicit";  ///< on command lines and in tables
  double step = 0.01;                                   ///< step size, positive
  /// half_step_before: the initial velocities are taken for v(t0 - h/2), not for v(t0).
  VelocityTime initial = VelocityTime::of_state;
  /// half_step_before: states that are given out (end of steps and of the run) have the velocity v(t - h/2).
  /// Dense output keeps velocities of the time that it is asked for.
  VelocityTime reported = VelocityTime::of_state;
};

/// See integrate(). @throws std::invalid_argument also for a problem without accelerations
[[nodiscard]] Solution run(const InitialValueProblem& problem, const CentralDifference& method);

}  // namespace nlmech::ivp

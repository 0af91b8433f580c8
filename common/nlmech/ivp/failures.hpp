/// @file
/// Failure messages of integrations, shared by all methods.
#pragma once

#include <cstdint>
#include <string_view>

#include "nlmech/support/status.hpp"

namespace nlmech::ivp {

/// The state after a step has a NaN or an infinity.
[[nodiscard]] Status non_finite_state(std::string_view method, double t, double step);
/// The right-hand side has a NaN or an infinity at a finite state.
[[nodiscard]] Status non_finite_rhs(std::string_view method, double t);
/// A Taylor coefficient of the solution is not finite.
[[nodiscard]] Status non_finite_coefficients(std::string_view method, double t, int order);
/// t + step == t.
[[nodiscard]] Status step_underflow(std::string_view method, double t, double step);
/// The fixed step is too small for the spacing of doubles near @p t: step_underflow.
/// @param shortest smallest step size that is accepted
[[nodiscard]] Status time_too_coarse(std::string_view method, double t, double step, double shortest);
/// The error exceeds the tolerance at the smallest step size: step_underflow.
[[nodiscard]] Status tolerance_missed(std::string_view method, double t, double step);
/// The limit of steps is reached.
[[nodiscard]] Status step_limit(std::string_view method, double t, std::int64_t steps);
/// The limit of wall time is reached.
[[nodiscard]] Status time_limit(std::string_view method, double t, double seconds);
/// The function of an event is NaN.
[[nodiscard]] Status event_undefined(double t);
/// A component violates its bound. @param component from 1
[[nodiscard]] Status bound_left(std::string_view method, int component, double t, double value, double bound);
/// An invariant has changed. @param which from 1
[[nodiscard]] Status invariant_lost(std::string_view method, int which, double t, double value,
                                    double before);
/// The observer stopped the run.
[[nodiscard]] Status interrupted(std::string_view method, double t);
/// The nonlinear equations of a step were not solved. @p outcome as from algebraic::newton
[[nodiscard]] Status step_not_solved(std::string_view method, Outcome outcome, double t, double step,
                                     int iterations);
/// @throws std::invalid_argument unless step is positive and finite
void require_step(std::string_view method, double step);
/// @throws std::invalid_argument naming @p option and its value unless low <= value <= high
void require_within(std::string_view method, std::string_view option, double value, double low, double high);
/// @throws std::invalid_argument unless @p second_order: the method is for problems with accelerations
void require_second_order(std::string_view method, bool second_order);
/// @throws std::invalid_argument always: the accelerations depend on velocities
[[noreturn]] void refuse_velocities(std::string_view method);
/// The same as the status `outside_validity`.
[[nodiscard]] Status depends_on_velocities(std::string_view method, double t);
/// @throws std::invalid_argument unless @p given: the method needs derivatives of the problem
void require_derivatives(std::string_view method, bool given);

}  // namespace nlmech::ivp

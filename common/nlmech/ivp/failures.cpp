#include "nlmech/ivp/failures.hpp"

#include <cmath>

#include "nlmech/support/sentences.hpp"

namespace nlmech::ivp {

Status non_finite_state(std::string_view method, double t, double step) {
  return failed_with(Outcome::non_finite,
                     "{}: the step of {:.6g} from t = {:.17g} leads to a state that is not finite; the "
                     "solution may blow up there, else take a smaller step or tolerance",
                     method, step, t);
}

Status non_finite_rhs(std::string_view method, double t) {
  return failed_with(Outcome::non_finite,
                     "{}: the right-hand side is not finite at t = {:.17g}; start from another state, or end "
                     "before that time",
                     method, t);
}

Status non_finite_coefficients(std::string_view method, double t, int order) {
  return failed_with(Outcome::non_finite,
                     "{}: the Taylor coefficients to order {} at t = {:.17g} are not finite; the solution "
                     "may be singular there, else take a lower order, or a smaller step or tolerance",
                     method, order, t);
}

Status step_underflow(std::string_view method, double t, double step) {
  return failed_with(Outcome::step_underflow,
                     "{}: a step of {:.6g} does not move t = {:.17g}; the solution may be singular there, "
                     "else loosen the tolerance, or take a longer step if it is given",
                     method, step, t);
}

Status time_too_coarse(std::string_view method, double t, double step, double shortest) {
  return failed_with(
      Outcome::step_underflow,
      "{}: at t = {:.17g} times are rounded by a noticeable part of the step of {:.6g}; take a "
      "step of at least {:.6g}, or count the time from the start",
      method, t, step, shortest);
}

Status tolerance_missed(std::string_view method, double t, double step) {
  return failed_with(Outcome::step_underflow,
                     "{}: even the shortest step, {:.6g}, from t = {:.17g} misses the tolerance; the "
                     "solution may be singular there, else loosen it",
                     method, step, t);
}

Status step_limit(std::string_view method, double t, std::int64_t steps) {
  return failed_with(Outcome::step_limit,
                     "{}: {} steps were used up at t = {:.17g}; take a larger step or tolerance, or an "
                     "earlier end (a program can allow more)",
                     method, steps, t);
}

Status time_limit(std::string_view method, double t, double seconds) {
  return failed_with(
      Outcome::time_limit,
      "{}: {:.6g} s of wall time were used up at t = {:.17g}; allow more, or take a larger step or tolerance",
      method, seconds, t);
}

Status event_undefined(double t) {
  return failed_with(Outcome::non_finite,
                     "event: its function is not a number at t = {:.17g}; define it on the whole interval",
                     t);
}

Status bound_left(std::string_view method, int component, double t, double value, double bound) {
  return failed_with(
      Outcome::spurious_root,
      "{}: component {} of the state is {:.6g} at t = {:.17g}, but solutions of this problem stay {} {:.6g}, "
      "and the tolerances do not explain it; take a smaller absolute tolerance, well below that component",
      method, component, value, t, value < bound ? "above" : "below", bound);
}

Status invariant_lost(std::string_view method, int which, double t, double value, double before) {
  return failed_with(
      Outcome::spurious_root,
      "{}: quantity {} that this problem conserves is {:.10g} at t = {:.17g} and was {:.10g} "
      "at the start, and the tolerances do not explain it; take smaller tolerances, if it is conserved",
      method, which, value, t, before);
}

Status interrupted(std::string_view method, double t) {
  return failed_with(Outcome::interrupted, "{}: the observer ended the integration at t = {:.17g}", method,
                     t);
}

Status step_not_solved(std::string_view method, Outcome outcome, double t, double step, int iterations) {
  return failed_with(outcome,
                     "{}: the equations of the step of {:.6g} from t = {:.17g} were not solved in {} "
                     "iterations ({}); take a smaller step or tolerance",
                     method, step, t, iterations, to_string(outcome));
}

void require_step(std::string_view method, double step) {
  if (!(step > 0) || !std::isfinite(step))
    throw invalid_argument("{}: the step must be positive and finite, not {}", method, step);
}

void require_within(std::string_view method, std::string_view option, double value, double low, double high) {
  if (!(value >= low && value <= high))
    throw invalid_argument("{}: {} must be between {:.6g} and {:.6g}, not {}", method, option, low, high,
                           value);
}

void require_second_order(std::string_view method, bool second_order) {
  if (!second_order)
    throw invalid_argument(
        "{}: the problem gives no acceleration(t, q, v), which this method needs; take another method",
        method);
}

void refuse_velocities(std::string_view method) {
  throw invalid_argument("{}: the accelerations of this problem depend on velocities; take another method",
                         method);
}

Status depends_on_velocities(std::string_view method, double t) {
  return Status::failure(
      Outcome::outside_validity,
      fmt::format("{}: the accelerations depend on velocities, as found at t = {:.17g}; take another method",
                  method, t));
}

void require_derivatives(std::string_view method, bool given) {
  if (!given)
    throw invalid_argument(
        "{}: this problem is written for double alone; make its call operator a template on the scalar, so "
        "that it can be differentiated",
        method);
}

}  // namespace nlmech::ivp

#include "nlmech/peers/ivp/peer_stepper.hpp"

#include <algorithm>
#include <cmath>

#include "nlmech/ivp/failures.hpp"
#include "nlmech/ivp/limits.hpp"
#include "nlmech/ivp/step_control.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::peers {
namespace {

/// Did rounding of t change the size of a very short step? Then the state no longer belongs to its time, but
/// libraries continue and return a wrong result. The last step of a segment may be as short as the remaining
/// interval, but this must not exceed the reported step size by more than an eighth.
bool is_lost_in_rounding(double t, const Attempt& attempt, double end) {
  const double length = std::abs(attempt.step);
  if (attempt.t == end) return std::abs(end - t) > 1.125 * length;
  return length < 16 * ivp::spacing(t);
}

/// Integrates one smooth segment to @p end.
Status integrate_segment(std::string_view method, PeerStepper& stepper, Run& run, double end,
                         const Stopwatch& watch, std::vector<double>& next) {
  const int size = run.equations.size();
  Statistics& done = run.statistics;
  // Near a time where f is not finite, steps are halved until they underflow. Hence a recent NaN or infinity
  // is reported as the reason of an underflow.
  std::int64_t last_non_finite = -1;
  const auto is_recent = [&] { return last_non_finite >= 0 && done.steps - last_non_finite <= 100; };
  if (Status status = stepper.begin(run.t, run.x, end); !status.ok()) return status;
  while (run.t != end) {
    if (Status status = ivp::check_limits(method, run.t, done, run.limits, watch); !status.ok())
      return status;
    const Attempt attempt = stepper.attempt(next.data(), done);
    if (run.equations.met_non_finite()) last_non_finite = done.steps;
    if (attempt.result == Attempt::Result::failed) {
      const bool too_short = attempt.failure.outcome() == Outcome::step_underflow;
      return too_short && is_recent() ? non_finite_rhs(method, run.t, attempt.step) : attempt.failure;
    }
    if (attempt.result == Attempt::Result::rejected) {
      ++done.rejected;
      continue;
    }
    if (!all_finite(next.data(), size)) return ivp::non_finite_state(method, run.t, attempt.step);
    if (attempt.t == run.t || is_lost_in_rounding(run.t, attempt, end)) {
      return is_recent() ? non_finite_rhs(method, run.t, attempt.step)
                         : ivp::step_underflow(method, run.t, attempt.step);
    }
    ++done.steps;
    const bool go_on =
        !run.observer || run.observer->step(done.steps, run.t, attempt.t, run.x, next.data(), stepper);
    std::copy(next.begin(), next.end(), run.x);
    run.t = attempt.t;
    if (!stepper.dense_output().ok()) return stepper.dense_output();
    if (!go_on) return ivp::interrupted(method, run.t);
  }
  return {};
}

}  // namespace

void PeerStepper::miss(std::string_view method, double t, double t0, double t1) {
  dense_output_ =
      failed_with(Outcome::not_converged,
                  "{}: the state at t = {:.17g}, within the step from {:.17g} to {:.17g}, was not "
                  "computed to the tolerance; loosen it, or set a largest step",
                  method, t, t0, t1);
}

void require_tolerances(std::string_view method, const Tolerances& tolerances) {
  if (!(tolerances.relative >= 0) || !std::isfinite(tolerances.relative))
    throw invalid_argument("{}: the relative tolerance must be zero or more, not {}", method,
                           tolerances.relative);
  if (!(tolerances.absolute > 0) || !std::isfinite(tolerances.absolute))
    throw invalid_argument("{}: the absolute tolerance must be positive, not {}", method,
                           tolerances.absolute);
}

double initial_step(double t, const double* x, const double* f, int size, double end,
                    const Tolerances& tolerances) {
  double state = 0, rate = 0;
  for (int i = 0; i < size; ++i) {
    const double scale = tolerances.absolute + tolerances.relative * std::abs(x[i]);
    state = std::max(state, std::abs(x[i]) / scale);
    rate = std::max(rate, std::abs(f[i]) / scale);
  }
  double length = state < 1e-5 || rate < 1e-5 ? 1e-6 : 0.01 * (state / rate);
  // The initial step must advance t; the library limits the later ones.
  length = std::max(length, 16 * ivp::spacing(t));
  return std::copysign(std::min(length, std::abs(end - t)), end - t);
}

Status non_finite_rhs(std::string_view method, double t, double step) {
  return failed_with(Outcome::non_finite,
                     "{}: the right-hand side is not finite within the step of {:.6g} from t = {:.17g}; end "
                     "the integration before, or change the equations",
                     method, step, t);
}

Status integrate_steps(std::string_view method, PeerStepper& stepper, Run& run) {
  std::vector<double> ends = run.equations.discontinuities(run.t, run.t1);
  ends.push_back(run.t1);
  std::vector<double> next(static_cast<std::size_t>(run.equations.size()));
  const Stopwatch watch;
  Status status;
  for (const double end : ends) {
    run.equations.enter(run.t, end);
    status = integrate_segment(method, stepper, run, end, watch, next);
    stepper.add_counters(run.statistics);
    if (!status.ok()) break;
  }
  run.statistics.right_hand_sides += run.equations.right_hand_sides();
  run.statistics.jacobians += run.equations.jacobians();
  return status;
}

}  // namespace nlmech::peers


#include <cmath>

#include "nlmech/ivp/named/named_evidence.hpp"
#include "nlmech/ivp/named/named_integrators.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::ivp::named {
namespace {

/// Failure if a wrong rate alone makes an error beyond the tolerance: near the end x a time wrong by
/// rate (t1 - t0) moves the state by that times f. Halving the step does not show it, if the shape follows
/// the step.
Status check_rate(std::string_view name, const System& system, double rate, double t0, double t,
                  const State& x, double t1, double tolerance) {
  State f(x.size());
  system.rhs(t, x, f);
  const double drift = rate * std::abs(t1 - t0) * (f.array().abs() / (1 + x.array().abs())).maxCoeff();
  if (drift <= tolerance) return {};
  return failed_with(Outcome::not_converged,
                     "{}: no step meets the tolerance {:.6g}: with this shape a constant rate is wrong by "
                     "{:.2g} of itself, which adds up to {:.2g} at t = {:.6g}; take another shape or more "
                     "nodes, a larger tolerance, or polynomials (lgl-coll, radau-coll)",
                     name, tolerance, rate, drift, t1);
}

}  // namespace

NamedIntegrator searching(const StepSearch& search, const OfStep& make, const RateError& rate,
                          bool rate_is_fixed) {
  return [=](const System& system, const State& x0, double t0, double t1, const Observer& observer,
             const Limits& limits) {
    const Stopwatch watch;
    double last = 1;
    const FixedStepRun run = [&](double step, const Observer& seen, const Limits& left) {
      last = step;
      return make(step)(system, x0, t0, t1, seen, left);
    };
    // Nothing to be found on an interval without length, or from a state that is not finite.
    if (t0 == t1 || !x0.allFinite() || !std::isfinite(t1 - t0)) return run(last, observer, limits);
    Solution s{t0, x0, {}, {}};
    if (rate_is_fixed) s.status = check_rate(search.name, system, rate(1), t0, t0, x0, t1, search.tolerance);
    if (s.status.ok()) {
      StepSearch asked = search;
      asked.frequency = highest_frequency(system, t0, x0);
      asked.jumps = system.discontinuities(t0, t1);
      const Evidence evidence = evidence_of(system, x0, t0, t1, search.tolerance);
      s = search_step(asked, run, evidence, t0, x0, t1, observer, limits);
    }
    if (s.status.ok() && rate)
      s.status = check_rate(search.name, system, rate(last), t0, s.t, s.x, t1, search.tolerance);
    s.statistics.seconds = watch.seconds();
    return s;
  };
}

}  // namespace nlmech::ivp::named

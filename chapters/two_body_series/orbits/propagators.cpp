#include "chapters/two_body_series/orbits/propagators.hpp"

#include <span>

#include "nlmech/orbit/kepler.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::two_body_series {
namespace {

/// Dense output of an orbit step for an ivp::Observer.
class JoinedOutput : public ivp::DenseOutput {
 public:
  explicit JoinedOutput(const BasicDenseOutput<orbit::State>& dense) : dense_(dense) {}
  void at(double t, ivp::State& x) const override {
    orbit::State s;
    dense_.at(t, s);
    x = joined(s);
  }

 private:
  const BasicDenseOutput<orbit::State>& dense_;
};

/// Dense output by Kepler's solution from the start.
class KeplerOutput : public ivp::DenseOutput {
 public:
  KeplerOutput(const orbit::State& start, double t0, double mu) : start_(start), t0_(t0), mu_(mu) {}
  void at(double t, ivp::State& x) const override {
    x = joined(orbit::propagate_kepler(start_, t - t0_, mu_).state);
  }

 private:
  orbit::State start_;
  double t0_, mu_;
};

template <class Method>
ivp::Solution run(const Method& method, double mu, const ivp::State& x0, double t0, double t1,
                  const ivp::Observer& observer, const ivp::Limits& limits) {
  orbit::Observer observe;
  ivp::Nodes states(6, 1);
  if (observer) {
    observe = [&](const orbit::Step& step) {
      const ivp::State begin = joined(step.x0), end = joined(step.x1);
      states.col(0) = end;
      const JoinedOutput dense(step.dense);
      return observer({step.index, step.t0, step.t1, begin, end, step.times, states, dense});
    };
  }
  const auto end = orbit::propagate(parted(x0), t0, t1, orbit::Gravity{.mu = mu}, method, observe, limits);
  return {end.t, joined(end.x), end.status, end.statistics};
}

ivp::Solution run_kepler(double mu, const ivp::State& x0, double t0, double t1,
                         const ivp::Observer& observer) {
  const Stopwatch watch;
  const orbit::KeplerSolution end = orbit::propagate_kepler(parted(x0), t1 - t0, mu);
  ivp::Solution solution{t1, joined(end.state), end.status, {.steps = 1, .right_hand_sides = end.iterations}};
  solution.statistics.seconds = watch.seconds();
  if (!observer || !end.status.ok()) return solution;
  const KeplerOutput dense(parted(x0), t0, mu);
  ivp::Nodes states(6, 1);
  ivp::State before = x0;
  double earlier = t0;
  constexpr int count = 16;
  for (int i = 1; i <= count; ++i) {
    const double t = t1 - (t1 - t0) / 10 * (count - i) / (count - 1);
    ivp::State x(6);
    dense.at(t, x);
    states.col(0) = x;
    if (!observer({i, earlier, t, before, x, std::span(&t, 1), states, dense})) break;
    before = x;
    earlier = t;
  }
  return solution;
}

template <class Method>
ivp::NamedIntegrator integrator_of(const Method& method, double mu) {
  return [method, mu](const ivp::System&, const ivp::State& x0, double t0, double t1,
                      const ivp::Observer& observer,
                      const ivp::Limits& limits) { return run(method, mu, x0, t0, t1, observer, limits); };
}

}  // namespace

ivp::NamedIntegrator continuation_integrator(const orbit::AnalyticContinuation& method, double mu) {
  return integrator_of(method, mu);
}

ivp::NamedIntegrator continuation_integrator(const orbit::FixedContinuation& method, double mu) {
  return integrator_of(method, mu);
}

ivp::NamedIntegrator kepler_integrator(double mu) {
  return [mu](const ivp::System&, const ivp::State& x0, double t0, double t1, const ivp::Observer& observer,
              const ivp::Limits&) { return run_kepler(mu, x0, t0, t1, observer); };
}

ivp::State joined(const orbit::State& s) {
  ivp::State x(6);
  x << s.position, s.velocity;
  return x;
}

orbit::State parted(const ivp::State& x) { return {x.head<3>(), x.tail<3>()}; }

}  // namespace nlmech::chapters::two_body_series

#include "chapters/two_body_series/orbits/published_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "chapters/two_body_series/orbits/propagators.hpp"
#include "nlmech/ivp/runge_kutta/dormand_prince.hpp"
#include "nlmech/ivp/runge_kutta/rkn1210.hpp"
#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/extended_real.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::two_body_series {
namespace {

/// Common part of the recording of all propagators.
class Recorder {
 public:
  Recorder(const Orbit& orbit, int orbits)
      : start_(orbit.start),
        before_(orbit::energy(orbit.start, earth_mu)),
        points_(orbits * orbit.steps),
        step_(period_of(orbit) / orbit.steps),
        end_(orbits * period_of(orbit)) {}

  /// Relative energy error, Eq. 3.69.
  [[nodiscard]] double error(const orbit::State& s) const {
    return std::abs((orbit::energy(s, earth_mu) - before_) / before_);
  }
  void add(double t, const orbit::State& s) {
    record.t.push_back(t);
    record.error.push_back(error(s));
  }
  [[nodiscard]] double point(int k) const { return k == points_ ? end_ : k * step_; }
  [[nodiscard]] int points() const { return points_; }
  [[nodiscard]] double step() const { return step_; }
  [[nodiscard]] double end() const { return end_; }

  /// Sets the position error of the final state against Kepler's solution in 50 digits.
  void finish(const orbit::State& s) {
    using Real = ExtendedReal<50>;
    const orbit::BasicState<Real> start{start_.position.cast<Real>(), start_.velocity.cast<Real>()};
    const auto exact = orbit::kepler_state(start, Real(end_), Real(earth_mu));
    const orbit::Vector3<Real> miss = s.position.cast<Real>() - exact.position;
    record.position_error = static_cast<double>(Real(sqrt(miss.dot(miss))));
  }

  EnergyRecord record;

 private:
  orbit::State start_;
  double before_;
  int points_;
  double step_, end_;
};

/// Returns the state at a time, computed from the start.
using Solve = std::function<orbit::State(double t)>;

/// Records a closed solution.
EnergyRecord closed(const Orbit& orbit, int orbits, const Solve& solve) {
  Recorder r(orbit, orbits);
  orbit::State s = orbit.start;
  for (int k = 1; k <= r.points(); ++k) {
    s = solve(r.point(k));
    r.add(r.point(k), s);
  }
  r.finish(s);
  r.record.steps = r.points();
  return r.record;
}

/// Records a general integrator. @param observe records a step
template <class Method>
EnergyRecord integrated(const Orbit& orbit, int orbits, const Method& method,
                        const std::function<void(Recorder&, const ivp::Step&)>& observe) {
  Recorder r(orbit, orbits);
  const ivp::System system(problems::TextProblem("two-body", {{"mu", earth_mu}}));
  const ivp::State start = joined(orbit.start);
  const auto look = [&](const ivp::Step& step) {
    observe(r, step);
    return true;
  };
  const auto end = ivp::integrate(system, start, 0, r.end(), method, look);
  if (!end.status.ok()) throw Failure(end.status);
  r.finish(parted(end.x));
  r.record.steps = end.statistics.steps;
  return r.record;
}

// Settings of the tables.
const ivp::Ode45 ode45{.relative_tolerance = 1e-6, .absolute_tolerance = 1e-6};
const ivp::Rkn1210 rkn1210{.relative_tolerance = 1e-12, .absolute_tolerance = 1e-12};
orbit::FixedContinuation series(const Orbit& orbit) {
  return {.step = period_of(orbit) / orbit.steps, .order = orbit.order};
}
Solve textbook(const Orbit& orbit) {
  return [orbit](double t) { return textbook_f_and_g(orbit.start, t, earth_mu); };
}
Solve universal(const Orbit& orbit) {
  return [orbit](double t) {
    const auto solution = orbit::propagate_kepler(orbit.start, t, earth_mu);
    if (!solution.status.ok()) throw Failure(solution.status);
    return solution.state;
  };
}

EnergyRecord by_ode45(const Orbit& orbit, int orbits) {
  int k = 1;
  return integrated(orbit, orbits, ode45, [&k](Recorder& r, const ivp::Step& step) {
    for (; k <= r.points() && r.point(k) <= step.t1; ++k) r.add(r.point(k), parted(step.at(r.point(k))));
    r.record.at_ends.push_back(r.error(parted(step.x1)));
    for (Eigen::Index i = 0; i < step.states.cols(); ++i)
      r.record.at_refined.push_back(r.error(parted(step.states.col(i))));
  });
}

EnergyRecord by_rkn1210(const Orbit& orbit, int orbits) {
  return integrated(orbit, orbits, rkn1210,
                    [](Recorder& r, const ivp::Step& step) { r.add(step.t1, parted(step.x1)); });
}

EnergyRecord by_series(const Orbit& orbit, int orbits) {
  Recorder r(orbit, orbits);
  const auto observe = [&](const orbit::Step& step) {
    r.add(step.t1, step.x1);
    return true;
  };
  const auto end =
      orbit::propagate(orbit.start, 0, r.end(), orbit::Gravity{.mu = earth_mu}, series(orbit), observe);
  if (!end.status.ok()) throw Failure(end.status);
  r.finish(end.x);
  r.record.steps = end.statistics.steps;
  return r.record;
}

/// The integration alone, for timing.
template <class Method>
std::function<void()> integration(const Orbit& orbit, int orbits, const Method& method) {
  return [system = ivp::System(problems::TextProblem("two-body", {{"mu", earth_mu}})),
          start = joined(orbit.start), end = Recorder(orbit, orbits).end(),
          method] { static_cast<void>(ivp::integrate(system, start, 0, end, method)); };
}

std::function<void()> solution(const Orbit& orbit, int orbits, const Solve& solve) {
  return [solve, points = Recorder(orbit, orbits)] {
    for (int k = 1; k <= points.points(); ++k) static_cast<void>(solve(points.point(k)));
  };
}

EnergyRecord recorded(const Orbit& orbit, int orbits, Propagator propagator) {
  switch (propagator) {
    case Propagator::f_and_g: return closed(orbit, orbits, textbook(orbit));
    case Propagator::ode45: return by_ode45(orbit, orbits);
    case Propagator::rkn1210: return by_rkn1210(orbit, orbits);
    case Propagator::series: return by_series(orbit, orbits);
    case Propagator::universal: return closed(orbit, orbits, universal(orbit));
  }
  throw std::invalid_argument("follow: no such propagator");
}

const char* word_of(Propagator propagator) {
  constexpr std::array words = {"f-and-g", "ode45", "rkn1210", "series", "universal"};
  return words[static_cast<std::size_t>(propagator)];
}

}  // namespace

std::string table_of(const Orbit& orbit) {
  return orbit.order == low_orbit().order ? "table-3.2" : "table-3.3";
}

std::string row_in_source(const Orbit& orbit, Propagator propagator, int orbits) {
  const std::string steps = propagator == Propagator::series
                                ? fmt::format(" ({} steps; order {})", orbits * orbit.steps, orbit.order)
                                : "";
  return fmt::format("{} {} orbits{}", name_of(propagator), orbits, steps);
}

std::string norm_in_source(const Orbit& orbit, Propagator propagator, int orbits) {
  return fmt::format("elgohary/{}/{}/energy error norm", table_of(orbit),
                     row_in_source(orbit, propagator, orbits));
}

double period_of(const Orbit& orbit) {
  const double alpha = orbit::reciprocal_axis(orbit.start, earth_mu);
  return 2 * std::numbers::pi / (alpha * std::sqrt(alpha * earth_mu));
}

double norm_of(const std::vector<double>& errors) {
  double sum = 0;
  for (const double e : errors) sum += e * e;
  return std::sqrt(sum);
}

const char* name_of(Propagator propagator) {
  constexpr std::array names = {"F&G", "ode45", "RKN12(10)", "Analytic-Cont", "F&G of the library"};
  return names[static_cast<std::size_t>(propagator)];
}

orbit::State textbook_f_and_g(const orbit::State& start, double time, double mu, double enough) {
  const double r0 = start.position.norm(), a = 1 / orbit::reciprocal_axis(start, mu);
  const double sigma = start.position.dot(start.velocity) / std::sqrt(mu * a), share = 1 - r0 / a;
  const double n = std::sqrt(mu / a) / a, wanted = n * time;
  double change = wanted;  // change of the eccentric anomaly
  for (int i = 0; i < 50; ++i) {
    const double s = std::sin(change), c = std::cos(change);
    const double step = (change - share * s + sigma * (1 - c) - wanted) / (1 - share * c + sigma * s);
    change -= step;
    if (std::abs(step) <= std::max(enough, 1e-15 * std::abs(change))) break;
  }
  const double s = std::sin(change), c = std::cos(change), r = a * (1 - share * c + sigma * s);
  const double f = 1 - a / r0 * (1 - c), g = time - (change - s) / n;
  const double f_rate = -std::sqrt(mu * a) / (r * r0) * s, g_rate = 1 - a / r * (1 - c);
  return {f * start.position + g * start.velocity, f_rate * start.position + g_rate * start.velocity};
}

std::function<void()> timed_work(const Orbit& orbit, int orbits, Propagator propagator) {
  switch (propagator) {
    case Propagator::f_and_g: return solution(orbit, orbits, textbook(orbit));
    case Propagator::ode45: return integration(orbit, orbits, ode45);
    case Propagator::rkn1210: return integration(orbit, orbits, rkn1210);
    case Propagator::series:
      return [start = orbit.start, end = Recorder(orbit, orbits).end(), method = series(orbit)] {
        static_cast<void>(orbit::propagate(start, 0, end, orbit::Gravity{.mu = earth_mu}, method));
      };
    case Propagator::universal: return solution(orbit, orbits, universal(orbit));
  }
  throw std::invalid_argument("timed_work: no such propagator");
}

EnergyRecord follow(const Orbit& orbit, int orbits, Propagator propagator, int repeats) {
  EnergyRecord record = recorded(orbit, orbits, propagator);
  record.milliseconds = 1e3 * time_repeats(timed_work(orbit, orbits, propagator), repeats).median;
  return record;
}

const char* reading_of(Propagator propagator) {
  switch (propagator) {
    case Propagator::f_and_g:
      return "textbook F and G, at every point from the start, time not reduced by revolutions";
    case Propagator::ode45:
      return "RelTol = AbsTol = 1e-6 in SI units; output at the points of Analytic-Cont by dense output";
    case Propagator::rkn1210: return "rtol = atol = 1e-12 in SI units (not stated); output at its own steps";
    case Propagator::series:
      return "printed order K: r to degree K, v to degree K - 1; equal steps, an orbit in 25 (LEO) or 100 "
             "(HEO)";
    case Propagator::universal: return "the library's Kepler propagator, from the start to every point";
  }
  return "";
}

scene::Result<EnergyRecord> followed(const Orbit& orbit, int orbits, Propagator propagator) {
  const char* begin = orbit.order == low_orbit().order ? "leo" : "heo";
  return {fmt::format("{}-{}-{}-orbits", begin, word_of(propagator), orbits), reading_of(propagator),
          [=](bool quick) { return follow(orbit, orbits, propagator, quick ? 1 : 9); }};
}

}  // namespace nlmech::chapters::two_body_series

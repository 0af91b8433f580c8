/// Kepler's motion, elements and analytic continuation against Kepler's classical equation in 100 digits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/convergence.hpp"
#include "nlmech/orbit/elements.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "tests/randomised/kepler_oracle.hpp"

namespace nlmech::orbit::randomised::orbit_test {
namespace {

using nlmech::randomised::Case;
using nlmech::randomised::randomised_test;

/// Kepler's motion in 100 digits.
BasicState<Real> exact(const Motion& m) { return conic<Real>(m.start, m.time, m.mu); }

double ratio_of(double error, double size, double kappa) {
  return error == 0 ? 0 : error / (size * kappa * eps);
}

/// An ellipse or hyperbola far from parabolas and straight lines, whose classical equation loses few digits.
bool is_plain(const Motion& m, const KeplerCondition& kappa) {
  const double r = m.start.position.norm(), share = m.start.velocity.squaredNorm() * r / m.mu;
  const double across = cross(m.start.position, m.start.velocity).norm();
  return share > 1e-2 && std::abs(1 - share) > 1e-2 && std::abs(2 - share) > 1e-2 && share < 100 &&
         across > 1e-2 * r * m.start.velocity.norm() && kappa.position < 1e6;
}

// Every success is within 8 kappa eps of |r| and |v| and has kappa eps < 1, for any conic.
TEST(RandomisedKepler, PropagationIsAsExactAsItsData) {
  randomised_test({.quick = 300, .full = 50'000}, [](Draw& draw) {
    const Motion m = any_motion(draw);
    const KeplerSolution found = propagate_kepler(m.start, m.time, m.mu);
    if (!found.status.ok()) return Case::refused();
    const KeplerCondition kappa = kepler_condition(m.start, m.time, m.mu);
    const std::string what =
        fmt::format("{} kappa {:.3g} {:.3g}", words(m.start, m.time, m.mu), kappa.position, kappa.velocity);
    if (!(64 * kappa.position * eps < 1)) return Case::wrong(what);
    // The second-order phase error, where the first-order term vanishes.
    const double share = m.start.velocity.squaredNorm() * m.start.position.norm() / m.mu, alpha = 2 - share;
    const double swing = alpha > 0 ? std::abs(m.time) * std::sqrt(m.mu / m.start.position.norm() * alpha) *
                                         alpha / m.start.position.norm() * (2 + 3 / alpha)
                                   : 0;
    if (swing * eps > 1e-6) return Case::undecided();
    const auto judged = [&](const auto& end) {
      const double r = static_cast<double>(length(end.position)),
                   v = static_cast<double>(length(end.velocity));
      return Case::judged(
          std::max(ratio_of(distance(found.state.position, end.position), r, kappa.position),
                   // At rest the velocity has no significant digits and is not compared.
                   kappa.velocity * eps < 1e-3
                       ? ratio_of(distance(found.state.velocity, end.velocity), v, kappa.velocity)
                       : 0),
          8, what);
    };
    return is_plain(m, kappa) ? judged(conic<Wide>(m.start, m.time, m.mu)) : judged(exact(m));
  });
}

// Near the parabola the rounding of the energy determines the distance: a success has digits there too, and a
// small number of digits shows in the condition number.
TEST(RandomisedKepler, NearTheParabolaDigitsAreCounted) {
  randomised_test({.quick = 400, .full = 20'000}, [](Draw& draw) {
    const double mu = draw.log_uniform(1e-6, 1e20), r = draw.log_uniform(1e-6, 1e12);
    const double speed = std::numbers::sqrt2 * (1 + draw.signed_log(1e-18, 1e-3));
    const State s = state_of(draw, r, mu, speed, draw.uniform(0, std::numbers::pi));
    const double time = r * std::sqrt(r / mu) * draw.signed_log(1e3, 1e30);
    const KeplerSolution found = propagate_kepler(s, time, mu);
    const std::string what = words(s, time, mu);
    const double kappa = kepler_condition(s, time, mu).position;
    if (!found.status.ok()) return Case::refused();
    if (!(kappa < no_digit)) return Case::wrong(what);
    const auto end = conic<Real>(s, time, mu);
    const double error =
        distance(found.state.position, end.position) / static_cast<double>(length(end.position));
    constexpr double few = 1e-6;
    if (error > 8 * few && large_condition(s, found.state, time, mu, few / eps) == 0)
      return Case::wrong(what);
    return Case::judged(error, 8 * kappa * eps, what);
  });
}

// A change of units by powers of two changes no digit, except for underflow.
TEST(RandomisedKepler, PowersOfTwoChangeNoDigit) {
  randomised_test({.quick = 500, .full = 300'000}, [](Draw& draw) {
    Motion m = any_motion(draw);
    const double r = m.start.position.norm();
    const int length_power = draw.whole(-900, 900) - std::ilogb(r), time_power = draw.whole(-900, 900);
    const auto scaled = [&](const Vector3<double>& x, int power) {
      return Vector3<double>(std::ldexp(x[0], power), std::ldexp(x[1], power), std::ldexp(x[2], power));
    };
    const State far{scaled(m.start.position, length_power),
                    scaled(m.start.velocity, length_power - time_power)};
    const double time = std::ldexp(m.time, time_power),
                 mu = std::ldexp(m.mu, 3 * length_power - 2 * time_power);
    const auto normal = [](double x) { return std::abs(x) > 1e-290 && std::abs(x) < 1e290; };
    if (!normal(time) || !normal(mu) || !normal(far.velocity.cwiseAbs().maxCoeff())) return Case::undecided();
    for (int i = 0; i < 3; ++i) {
      if ((m.start.velocity[i] != 0 && !normal(far.velocity[i])) ||
          (m.start.position[i] != 0 && !normal(far.position[i])))
        return Case::undecided();
    }
    const KeplerSolution found = propagate_kepler(far, time, mu),
                         near = propagate_kepler(m.start, m.time, m.mu);
    if (!near.status.ok() || !found.status.ok()) {
      if (near.status.ok() == found.status.ok()) return Case::refused();
      const double kappa = kepler_condition(m.start, m.time, m.mu).position * eps;
      const double end = near.state.position.norm() * std::ldexp(1.0, length_power);
      return (kappa > 1e-3 && kappa < 1) || !normal(end) || !normal(near.state.velocity.norm())
                 ? Case::undecided()
                 : Case::wrong(words(far, time, mu) + " " + found.status.text() + near.status.text());
    }
    const KeplerCondition kappa = kepler_condition(m.start, m.time, m.mu);
    const Vector3<double> back = scaled(found.state.position, -length_power);
    const double end = near.state.position.norm();
    if (!normal(end * std::ldexp(1.0, length_power))) return Case::undecided();
    return Case::judged(ratio_of((back - near.state.position).norm(), end, kappa.position), 16,
                        words(far, time, mu));
  });
}

/// kappa of the position by differences: sum over all data of the effect of a relative change of 1e-32.
/// Second derivatives are at most about kappa^2 < 1e24 of the first: 8 digits.
double condition_by_differences(const BasicState<Real>& start, const Real& time, const Real& mu) {
  const Real part("1e-32"), r = length(start.position), v = length(start.velocity);
  const BasicState<Real> end = conic<Real>(start, time, mu);
  Real sum = 0;
  const auto add = [&](const BasicState<Real>& s, const Real& t, const Real& m) {
    sum += length(Vector3<Real>(conic<Real>(s, t, m).position - end.position));
  };
  for (int k = 0; k < 3; ++k) {
    BasicState<Real> moved = start, faster = start;
    moved.position[k] += part * r;
    faster.velocity[k] += part * v;
    add(moved, time, mu);
    if (v != 0) add(faster, time, mu);
  }
  add(start, time * (1 + part), mu);
  add(start, time, mu * (1 + part));
  return static_cast<double>(Real(sum / length(end.position) / part));
}

// kappa is accurate to three digits, which suffices for a bound of 8 kappa eps, or equals that of a gravity
// changed by a few rounding errors, which matters after many revolutions.
TEST(RandomisedKepler, TheConditionIsThatOfDifferences) {
  randomised_test({.quick = 20, .full = 10'000}, [](Draw& draw) {
    const Motion m = any_motion(draw);
    const double kappa = kepler_condition(m.start, m.time, m.mu).position;
    if (!(kappa < 1e12)) return Case::refused();
    const auto start = as<Real>(m.start);
    const Real time = m.time, mu = m.mu;
    const double sum = condition_by_differences(start, time, mu);
    double allowed = 1e-3 * sum;
    if (!(std::abs(sum - kappa) <= allowed)) {
      for (const Real& part : {Real(1 - 8 * eps), Real(1 + 8 * eps)})
        allowed += std::abs(condition_by_differences(start, time, mu * part) - sum);
    }
    return Case::judged(
        std::abs(sum - kappa), allowed,
        words(m.start, m.time, m.mu) + fmt::format(" kappa {:.6g}, by differences {:.6g}", kappa, sum));
  });
}

// Round trips within 32 eps (times 1/(1 + e cos nu) for the true anomaly; relative to the circular speed for
// the time since periapsis); e and a by their definitions in long double.
TEST(RandomisedElements, ThereAndBack) {
  randomised_test({.quick = 1000, .full = 500'000}, [](Draw& draw) {
    const Motion m = any_motion(draw);
    const Elements e = elements_of(m.start, m.mu);
    const std::string what = words(m.start, 0, m.mu);
    for (const double x : {e.semi_latus_rectum, e.eccentricity, e.inclination, e.ascending_node,
                           e.periapsis_argument, e.true_anomaly}) {
      if (!std::isfinite(x)) return Case::wrong(what);
    }
    const auto s = as<Wide>(m.start);
    const Wide mu = m.mu, r = length(s.position), alpha = 2 / r - s.velocity.dot(s.velocity) / mu;
    const Vector3<Wide> h = cross(s.position, s.velocity);
    const Vector3<Wide> apse = cross(s.velocity, h) / mu - s.position / r;
    const Wide share = s.velocity.dot(s.velocity) * r / mu;
    const double far = 1 + e.eccentricity * std::cos(e.true_anomaly);
    double error = static_cast<double>(std::abs(length(apse) - e.eccentricity) / (8 * eps * (1 + share)));
    error = std::max(error, static_cast<double>(std::abs(alpha * r - r / Wide(e.semi_major_axis)) /
                                                (8 * eps * (2 + share))));
    const double circular = std::sqrt(m.mu / m.start.position.norm());
    const auto of = [](double angle) { return SineCosine{std::sin(angle), std::cos(angle)}; };
    State back = state_at_time({e.periapsis_distance, e.periapsis_distance / e.semi_major_axis},
                               {of(e.inclination), of(e.ascending_node), of(e.periapsis_argument)},
                               e.time_since_periapsis, m.mu);
    error = std::max({error, (back.position - m.start.position).norm() / (32 * eps * static_cast<double>(r)),
                      (back.velocity - m.start.velocity).norm() /
                          (32 * eps * std::max(circular, m.start.velocity.norm()))});
    try {
      back = state_of(e, m.mu);
    } catch (const std::invalid_argument&) {
      return Case::judged(error, 1, what);  // so far out that the true anomaly is that of the asymptote
    }
    const double amplified = 32 * eps * std::max(1.0, (1 + e.eccentricity) / far);
    error = std::max({error, (back.position - m.start.position).norm() / (amplified * static_cast<double>(r)),
                      (back.velocity - m.start.velocity).norm() / (amplified * m.start.velocity.norm())});
    return Case::judged(error, 1,
                        what + fmt::format(" e = {:.17g}, nu = {:.17g}", e.eccentricity, e.true_anomaly));
  });
}

// Finite numbers of any size give finite elements and states, or a failure with a message.
TEST(RandomisedElements, AnyFiniteNumbers) {
  randomised_test({.quick = 2000, .full = 500'000, .least_right = 0.01}, [](Draw& draw) {
    State s;
    for (int i = 0; i < 3; ++i) s.position[i] = draw.any_finite(), s.velocity[i] = draw.any_finite();
    const double mu = std::abs(draw.any_finite()), time = draw.any_finite();
    const std::string what = words(s, time, mu);
    const auto finite = [](const State& x) { return x.position.allFinite() && x.velocity.allFinite(); };
    const KeplerSolution k = propagate_kepler(s, time, mu);
    if (k.status.ok() ? !finite(k.state) : k.status.sentence().empty()) return Case::wrong("kepler " + what);
    if (std::isnan(kepler_condition(s, time, mu).position)) return Case::wrong("condition " + what);
    if (!(convergence_radius(s, mu) >= 0)) return Case::wrong("radius " + what);
    Elements e;
    try {
      e = elements_of(s, mu);
    } catch (const std::invalid_argument&) {
      e = {std::abs(draw.any_finite()),
           std::abs(draw.any_finite()),
           draw.any_finite(),
           0,
           0,
           draw.any_finite()};
      return finite(orbit::state_of(e, mu)) ? Case::judged(0, 1, "") : Case::wrong("state_of " + what);
    }
    for (const double x : {e.semi_latus_rectum, e.eccentricity, e.inclination, e.ascending_node,
                           e.periapsis_argument, e.true_anomaly}) {
      if (!std::isfinite(x)) return Case::wrong("elements " + what);
    }
    if (std::isnan(e.semi_major_axis) || std::isnan(e.period(mu))) return Case::wrong("elements " + what);
    return finite(orbit::state_of(e, mu)) ? Case::judged(0, 1, "") : Case::wrong("state_of " + what);
  });
}

// Taylor series: each step adds 2 tolerance + 9 eps, in units of |r| and of the larger of |v| and the
// circular speed, times the condition number of the remaining interval.
TEST(RandomisedContinuation, IsWithinItsTolerance) {
  randomised_test({.quick = 100, .full = 10'000}, [](Draw& draw) {
    const Motion m = any_motion(draw);
    const double tolerance = draw.log_uniform(1e-18, 1e-3);
    double allowed = 8 * eps * kepler_condition(m.start, m.time, m.mu).position;
    const Solution c =
        propagate(m.start, 0, m.time, {.mu = m.mu}, AnalyticContinuation{.tolerance = tolerance},
                  [&](const Step& step) {
                    const State& s = step.x1;
                    const double circular = std::sqrt(m.mu / s.position.norm()), v = s.velocity.norm();
                    allowed += (2 * tolerance + 9 * eps) * std::max(1.0, circular / v) *
                               kepler_condition(s, m.time - step.t1, m.mu).position;
                    return true;
                  },
                  {.steps = 3000});
    if (!c.status.ok()) return Case::refused();
    if (!(allowed < 0.1)) return Case::undecided();
    const auto end = exact(m);
    return Case::judged(distance(c.x.position, end.position) / static_cast<double>(length(end.position)),
                        allowed,
                        words(m.start, m.time, m.mu) +
                            fmt::format(" tolerance {:.3g}, {} steps", tolerance, c.statistics.steps));
  });
}

// Zonal terms: energy and axial angular momentum are conserved to the rounding of their terms.
TEST(RandomisedContinuation, ZonalInvariantsAreKept) {
  randomised_test({.quick = 100, .full = 50'000}, [](Draw& draw) {
    Gravity g{.mu = draw.log_uniform(1e-3, 1e16), .radius = draw.log_uniform(1e-3, 1e8)};
    for (double& j : g.zonal) j = draw.chance(0.3) ? 0 : draw.signed_log(1e-9, 1e-2);
    const double r = g.radius * draw.log_uniform(1, 100);
    const State s = state_of(draw, r, g.mu, draw.log_uniform(0.2, 3), draw.uniform(0.1, 3));
    const double time = r * std::sqrt(r / g.mu) * draw.signed_log(0.01, 100),
                 tolerance = draw.log_uniform(1e-17, 1e-8);
    double most = 0;
    const Solution c =
        propagate(s, 0, time, g, AnalyticContinuation{.tolerance = tolerance},
                  [&](const Step& step) {
                    const State& x = step.x1;
                    most = std::max(most, x.velocity.squaredNorm() / 2 + g.mu / x.position.norm());
                    return true;
                  },
                  {.steps = 3000});
    if (!c.status.ok()) return Case::refused();
    const auto wide = g.as<Wide>();
    const double n = static_cast<double>(c.statistics.steps);
    const double drift =
        static_cast<double>(std::abs(energy(as<Wide>(c.x), wide) - energy(as<Wide>(s), wide)));
    const auto axis = [](const State& x) {
      return Wide(x.position[0]) * x.velocity[1] - Wide(x.position[1]) * x.velocity[0];
    };
    const double scale =
        std::max(s.position.norm() * s.velocity.norm(), c.x.position.norm() * c.x.velocity.norm());
    // A step truncates at the tolerance in v, once more in r, and rounds both: 4 (tolerance + 4 eps) of v^2
    // each.
    const double allowed = 8 * n * (tolerance + 4 * eps);
    return Case::judged(std::max(drift / std::max(most, s.velocity.squaredNorm() / 2 + g.mu / r),
                                 static_cast<double>(std::abs(axis(c.x) - axis(s))) / scale),
                        allowed, words(s, time, g.mu) + fmt::format(" tolerance {:.3g}", tolerance));
  });
}

}  // namespace
}  // namespace nlmech::orbit::randomised::orbit_test

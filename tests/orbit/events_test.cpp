/// Events of orbits: times by Kepler's equation, and crossings within one step.
#include "nlmech/orbit/events.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "nlmech/orbit/elements.hpp"
#include "tests/orbit/oracle.hpp"

namespace nlmech::orbit::events_test {
namespace {

using namespace oracle;

struct Found {
  std::vector<Hit> hits;
  std::vector<ivp::OpenEvent> open;
};

Found events(const std::vector<Event>& wanted, const State& start, double until, const Gravity& gravity) {
  constexpr double tolerance = 1e-15;
  EventFinder finder(wanted, gravity, tolerance);
  const Solution end = propagate(start, 0, until, gravity, AnalyticContinuation{.tolerance = tolerance},
                                 [&](const Step& step) { return finder.see(step); });
  EXPECT_TRUE(end.status.ok()) << end.status.text();
  return {finder.hits(), finder.open()};
}

/// Times strictly between 0 and @p until at which the true anomaly is @p nu, by Kepler's equation.
std::vector<double> times_at(double nu, const Elements& e, double mu, double until) {
  const double q = e.eccentricity,
               n = std::sqrt(mu / std::abs(e.semi_major_axis)) / std::abs(e.semi_major_axis);
  const double tangent = std::sqrt(std::abs(1 - q) / (1 + q)) * std::tan(std::remainder(nu, 2 * pi) / 2);
  if (q > 1) {
    if (!(std::abs(tangent) < 1)) return {};
    const double h = 2 * std::atanh(tangent), t = (q * std::sinh(h) - h) / n - e.time_since_periapsis;
    return t * until > 0 && std::abs(t) < std::abs(until) ? std::vector{t} : std::vector<double>{};
  }
  const double anomaly = 2 * std::atan(tangent), period = 2 * pi / n;
  std::vector<double> times;
  for (int k = -9; k <= 9; ++k) {
    const double t = (anomaly - q * std::sin(anomaly)) / n - e.time_since_periapsis + k * period;
    if (t * until > 0 && std::abs(t) < std::abs(until)) times.push_back(t);
  }
  if (until < 0) std::ranges::reverse(times);
  return times;
}

// Ellipses and hyperbolas, forwards and backwards. Some fifty steps of 1e-15 and 9 eps with a growth of up to
// 20 a revolution are 1e-12.
RC_GTEST_PROP(Events, TimesByKeplersEquation, ()) {
  const double mu = 1.5;
  const State start = random_state(1, mu, *between(0.6, 1.7), *between(0.3, 2.8));
  const Elements e = elements_of(start, mu);
  const bool ellipse = e.eccentricity < 1;
  RC_PRE(std::abs(e.semi_major_axis) < 20 && e.inclination > 0.01 && e.inclination < 3.13);
  const double period = ellipse ? e.period(mu) : 20,
               far = ellipse ? 2 * e.semi_major_axis - e.periapsis_distance : 5;
  const double distance = e.periapsis_distance + *between(0.1, 0.9) * (far - e.periapsis_distance);
  const double until = *between(-2.5, 2.5) * period;
  const double nu = std::acos((e.semi_latus_rectum / distance - 1) / e.eccentricity);
  const Found found =
      events({{}, {EventKind::apsis}, {EventKind::distance, distance}}, start, until, {.mu = mu});
  struct Kind {
    std::size_t event;
    int direction;
    double nu;
  };
  for (const Kind& kind : {Kind{0, 1, -e.periapsis_argument}, Kind{0, -1, pi - e.periapsis_argument},
                           Kind{1, 1, 0}, Kind{1, -1, pi}, Kind{2, 1, nu}, Kind{2, -1, -nu}}) {
    if (!ellipse && kind.nu == pi) continue;  // beyond the asymptote
    const std::vector<double> expected = times_at(kind.nu, e, mu, until);
    std::vector<double> times;
    for (const Hit& hit : found.hits) {
      if (hit.event == kind.event && hit.direction == kind.direction) times.push_back(hit.t);
    }
    RC_ASSERT(times.size() == expected.size());
    for (std::size_t i = 0; i < times.size(); ++i)
      RC_ASSERT(std::abs(times[i] - expected[i]) <= 1e-12 * (std::abs(times[i]) + period));
  }
  RC_ASSERT(found.open.empty());
}

// A distance just below that of the apoapsis is passed twice within one step, one just above never. With r''
// = -e/(1 + e)^2 there, r = 1 + e - d is sqrt(2 d/|r''|) from the apoapsis.
TEST(Events, TwoCrossingsWithinAStep) {
  const double e = 0.5, d = 1e-9;
  const Gravity unit{};
  const Found found = events({{EventKind::distance, 1 + e - d}}, at_periapsis(e), 6, unit);
  ASSERT_EQ(found.hits.size(), 2U);
  const double half = std::sqrt(2 * d * (1 + e) * (1 + e) / e);
  EXPECT_NEAR(found.hits[0].t, pi - half, 1e-9);
  EXPECT_NEAR(found.hits[1].t, pi + half, 1e-9);
  EXPECT_TRUE(events({{EventKind::distance, 1 + e + d}}, at_periapsis(e), 6, unit).hits.empty());
}

TEST(Events, DistancesMustBePositiveAndFinite) {
  for (const double distance : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_THROW(EventFinder({{EventKind::distance, distance}}, {}, 1e-15), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::orbit::events_test

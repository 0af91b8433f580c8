/// Misprinted numbers and statements of section 3.2 against an independent oracle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "chapters/two_body_series/orbits/published_runs.hpp"
#include "chapters/two_body_series/series/raw_recursion.hpp"
#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/scene/evidence/published.hpp"
#include "nlmech/support/extended_real.hpp"
#include "tests/errata/erratum.hpp"
#include "tests/places.hpp"

namespace nlmech::chapters::two_body_series::errata_numbers_test {
namespace {

using tests::expect_erratum;
constexpr double eps = std::numeric_limits<double>::epsilon();

// (3.72) prints omega = 0 without inclination: the periapsis would be on the x axis. The state of (3.71) is
// at a turning point, r . v = 0, below the semi-major axis: its own direction is that of the periapsis.
TEST(Errata, PeriapsisOfTheLowOrbit) {
  const orbit::State s = low_orbit().start;
  const double degree = std::numbers::pi / 180;
  EXPECT_LE(std::abs(s.position.dot(s.velocity)), 16 * eps * s.position.norm() * s.velocity.norm());
  EXPECT_LT(s.position.norm() * orbit::reciprocal_axis(s, earth_mu), 1);
  const orbit::Vector3<double> e = orbit::eccentricity_vector(s, earth_mu);
  EXPECT_NEAR(std::atan2(e[1], e[0]) / degree, 75, 1e-10);  // rounding errors of terms 1 over e = 0.1
  expect_erratum("two_body_series-3.72-periapsis",
                 {.printed = 0,
                  .corrected = 75,
                  .oracle = std::atan2(s.position[1], s.position[0]) / degree,
                  .tolerance = 16 * eps});
}

// The period from Kepler's second law, T = integral of r^2/h over the angle, for the conic through the
// turning point; the sum over equal angles converges geometrically.
TEST(Numbers, PeriodOfTheLowOrbit) {
  const orbit::State s = low_orbit().start;
  const double h = orbit::angular_momentum(s).norm(), p = h * h / earth_mu, e = p / s.position.norm() - 1;
  constexpr int points = 64;
  double sum = 0;
  for (int k = 0; k < points; ++k) {
    const double r = p / (1 + e * std::cos(2 * std::numbers::pi * k / points));
    sum += r * r / h;
  }
  const double period = sum * 2 * std::numbers::pi / points;
  EXPECT_NEAR(period_of(low_orbit()), period, 1e-13 * period);
}

/// A number of Tables 3.2 and 3.3 as printed.
double printed(const std::string& place, const std::string& method, int orbits, const std::string& quantity) {
  static const auto values = scene::read_published(NLMECH_SOURCE_DIR);
  const std::string row = method + " " + std::to_string(orbits) + " orbits";
  const auto found = std::find_if(values.begin(), values.end(), [&](const scene::PublishedValue& v) {
    return v.source == "elgohary" && v.place == place && v.row.starts_with(row) && v.quantity == quantity;
  });
  if (found == values.end()) throw std::invalid_argument("no number " + place + " " + row);
  return found->value;
}

/// 2-norm of the energy error of Lagrange's F and G at the first @p points points.
double norm_of_f_and_g(const Orbit& orbit, int points) {
  const double before = orbit::energy(orbit.start, earth_mu), step = period_of(orbit) / orbit.steps;
  std::vector<double> errors;
  for (int k = 1; k <= points; ++k) {
    const orbit::State s = textbook_f_and_g(orbit.start, k * step, earth_mu);
    errors.push_back(std::abs(orbit::energy(s, earth_mu) / before - 1));
  }
  return norm_of(errors);
}

// The closed solution at a point does not depend on later points, so a norm over 20 orbits is at least that
// over 10. The digits of 1 - (second/first)^2 of the sum of squares must not be lost.
TEST(Errata, NormOverMorePointsIsNotSmaller) {
  const auto lost = [](double ten, double twenty) { return std::max(0.0, 1 - std::pow(twenty / ten, 2)); };
  const double ten = printed("table-3.3", "F&G", 10, "energy error norm"),
               twenty = printed("table-3.3", "F&G", 20, "energy error norm");
  EXPECT_EQ(twenty, printed("table-3.2", "F&G", 20, "energy error norm"));
  const Orbit orbit = high_orbit();
  expect_erratum("two_body_series-table-3.3", {.printed = lost(ten, twenty),
                                               .corrected = lost(norm_of_f_and_g(orbit, 10 * orbit.steps),
                                                                 norm_of_f_and_g(orbit, 20 * orbit.steps)),
                                               .oracle = 0,
                                               .tolerance = eps});
}

// "Millimeter accuracy": the dissertation's recursion in 50 digits, free of rounding, differs from Kepler's
// motion by metres after twenty low orbits. In double it agrees with that within 1e-4: rounding shifts the
// body by some 1e-16 a, times 60 for the effect of a velocity error over twenty orbits, times the square root
// of 500 steps.
TEST(Errata, OrderTenLosesMetres) {
  using Real = ExtendedReal<50>;
  const Orbit orbit = low_orbit();
  const double step = period_of(orbit) / orbit.steps;
  const int steps = 20 * orbit.steps;
  const orbit::BasicState<Real> start{orbit.start.position.cast<Real>(), orbit.start.velocity.cast<Real>()};
  const auto exact = orbit::kepler_state(start, Real(step) * steps, Real(earth_mu));
  orbit::BasicState<Real> s = start;
  for (int k = 0; k < steps; ++k)
    s = raw_step(raw_derivatives<Real>(s, Real(earth_mu), orbit.order), Real(step));
  const auto found = orbit::propagate(orbit.start, 0, steps * step, orbit::Gravity{.mu = earth_mu},
                                      orbit::FixedContinuation{.step = step, .order = orbit.order});
  ASSERT_TRUE(found.status.ok()) << found.status.text();
  const auto distance = [&](const orbit::Vector3<Real>& r) {
    const orbit::Vector3<Real> miss = r - exact.position;
    return static_cast<double>(Real(sqrt(miss.dot(miss))));
  };
  expect_erratum("two_body_series-3.2-millimetre", {.printed = 1e-3,
                                                    .corrected = distance(found.x.position.cast<Real>()),
                                                    .oracle = distance(s.position),
                                                    .tolerance = 1e-4});
}

}  // namespace
}  // namespace nlmech::chapters::two_body_series::errata_numbers_test

/// Elements to state and back, the conventions where angles are not defined, and the printed elements of
/// section 3.2.2.
#include "nlmech/orbit/elements.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "nlmech/orbit/convergence.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "tests/orbit/oracle.hpp"

namespace nlmech::orbit::elements_test {
namespace {

using namespace oracle;

constexpr double degree = 0.017453292519943295;

double there_and_back(const State& s, double mu) {
  const State back = state_of(elements_of(s, mu), mu);
  return std::max((back.position - s.position).norm() / s.position.norm(),
                  (back.velocity - s.velocity).norm() / s.velocity.norm()) /
         eps;
}

// 32 eps: a dozen rounded operations in each of six elements, angles of up to 2 pi in their sines. Far out on
// an open conic 1 + e cos nu amplifies that.
RC_GTEST_PROP(Elements, ThereAndBack, ()) {
  const double mu = std::pow(10, *between(-3, 20)), r = std::pow(10, *between(-3, 9));
  const State s = random_state(r, mu, *between(0.05, 3), *between(0.05, 3.1));
  const Elements e = elements_of(s, mu);
  const double far = std::min(1.0, 1 + e.eccentricity * std::cos(e.true_anomaly)) / (1 + e.eccentricity);
  RC_ASSERT(there_and_back(s, mu) * far <= 32);
}

RC_GTEST_PROP(Elements, StateHasThem, ()) {
  const Elements e = from_axis(*between(0.5, 2), *between(0.05, 0.95), *between(0.05, 3.1),
                               *between(0.1, 6.2), *between(0.1, 6.2), *between(-3, 3));
  const Elements back = elements_of(state_of(e, 1), 1);
  // Angles of an orbit that is neither round nor flat are conditioned like 1/e and 1/sin i.
  const double room = 64 * eps / 0.05 / std::sin(0.05);
  RC_ASSERT(std::abs(back.semi_major_axis / e.semi_major_axis - 1) <= room);
  RC_ASSERT(std::abs(back.semi_latus_rectum / e.semi_latus_rectum - 1) <= room);
  RC_ASSERT(std::abs(back.eccentricity - e.eccentricity) <= room);
  RC_ASSERT(std::abs(back.inclination - e.inclination) <= room);
  RC_ASSERT(std::abs(back.ascending_node - e.ascending_node) <= room);
  RC_ASSERT(std::abs(back.periapsis_argument - e.periapsis_argument) <= room);
  RC_ASSERT(std::abs(back.true_anomaly - e.true_anomaly) <= room);
}

TEST(Elements, CircleHasNoPeriapsis) {
  const Elements e = elements_of({{0, 0.5, std::sqrt(0.75)}, {-1, 0, 0}}, 1);
  EXPECT_EQ(e.periapsis_argument, 0);
  EXPECT_NEAR(e.true_anomaly, pi / 2, 4 * eps);  // a quarter of a turn after the node on the x axis
  EXPECT_NEAR(e.inclination, 60 * degree, 4 * eps);
  EXPECT_EQ(e.eccentricity, 0);
}

TEST(Elements, FlatOrbitHasNoNode) {
  const double longitude = 200 * degree;
  for (const double way : {1., -1.}) {
    const State s{{std::cos(longitude), std::sin(longitude), 0},
                  {-way * 1.1 * std::sin(longitude), way * 1.1 * std::cos(longitude), 0}};
    const Elements e = elements_of(s, 1);
    EXPECT_EQ(e.ascending_node, 0);
    EXPECT_EQ(e.inclination, way > 0 ? 0 : std::acos(-1.0));
    // In the direction of motion: 200 degrees forwards, or 160 the other way round.
    EXPECT_NEAR(e.periapsis_argument, way > 0 ? longitude : 160 * degree, 8 * eps);
    EXPECT_LE(there_and_back(s, 1), 32);
  }
  EXPECT_LE(there_and_back({{1, 0, 0}, {0, 1, 0}}, 1), 32);    // round and flat
  EXPECT_LE(there_and_back({{0, -1, 0}, {-1, 0, 0}}, 1), 32);  // and counted backwards
}

TEST(Elements, OpenConics) {
  const Elements parabola = elements_of({{0, 2, 0}, {-1, 0, 0}}, 1);
  EXPECT_EQ(parabola.eccentricity, 1);
  EXPECT_EQ(parabola.semi_latus_rectum, 4);
  EXPECT_EQ(parabola.semi_major_axis, HUGE_VAL);
  EXPECT_EQ(parabola.period(1), HUGE_VAL);
  const Elements hyperbola = from_axis(-2, 1.5, 0.3, 1, 2, 0.5);
  EXPECT_NEAR(reciprocal_axis(state_of(hyperbola, 3), 3.0), -0.5, 8 * eps);
}

TEST(Elements, WhatHasNoneIsRefused) {
  EXPECT_THROW((void)elements_of({{1, 0, 0}, {2, 0, 0}}, 1), std::invalid_argument);
  EXPECT_THROW((void)elements_of({{1, 0, 0}, {0, 0, 0}}, 1), std::invalid_argument);
  EXPECT_THROW((void)elements_of({{0, 0, 0}, {0, 1, 0}}, 1), std::invalid_argument);
  EXPECT_THROW((void)from_axis(1, 1), std::invalid_argument);
  EXPECT_THROW((void)from_axis(1, 1.1), std::invalid_argument);
  EXPECT_THROW((void)from_axis(-1, 0.5), std::invalid_argument);
  Elements beyond{.semi_latus_rectum = 1, .eccentricity = 2, .true_anomaly = 2.2};  // asymptote at 2.094
  EXPECT_THROW((void)state_of(beyond, 1), std::invalid_argument);
  beyond.true_anomaly = NAN;
  EXPECT_THROW((void)state_of(beyond, 1), std::invalid_argument);
  EXPECT_THROW((void)state_of({.semi_latus_rectum = 0}, 1), std::invalid_argument);
}

// mu = v^2 r_p/(1 + e) with the printed e, at the periapsis where both states are: the mu that was used.
constexpr double implied_mu = 3.98600433e14;

// Equation 3.72 prints omega = 0. The state of 3.71 is at its periapsis at the longitude 75 degrees, so omega
// (i = 0) is 75 degrees; and T_p = 6218.7284 s is printed as 6.21872e3, cut off.
TEST(Errata, Equation372) {
  const Elements e = elements_of(low_orbit, implied_mu);
  EXPECT_NEAR(e.true_anomaly, 0, 1e-9);  // printed digits of the state: 16
  EXPECT_NEAR(e.periapsis_argument / degree, 75, 1e-9);
  EXPECT_NEAR(e.eccentricity, 0.1, 1e-8);            // implied_mu has nine digits
  EXPECT_NEAR(e.semi_major_axis, 7309041.111, 0.1);  // the same
  EXPECT_NEAR(e.period(implied_mu), 6218.7284, 1e-4);
  // As printed: another longitude of the periapsis puts the body where it is not, by 2 sin(37.5 deg) r.
  Elements printed = from_axis(7.30904e6, 0.1);
  EXPECT_NEAR(
      (state_of(printed, implied_mu).position - low_orbit.position).norm() / low_orbit.position.norm(),
      2 * std::sin(37.5 * degree), 1e-6);
  printed.periapsis_argument = 75 * degree;
  EXPECT_LT((state_of(printed, implied_mu).position - low_orbit.position).norm(), 1.0);  // a has six digits
}

// Equation 3.74 prints Omega = 45 and omega = 30 degrees for i = 0, where only the sum has a meaning: it
// agrees.
TEST(Errata, Equation374) {
  const Elements e = elements_of(eccentric_orbit, implied_mu);
  EXPECT_NEAR((e.ascending_node + e.periapsis_argument) / degree, 45 + 30, 1e-9);
  EXPECT_NEAR(e.eccentricity, 0.7, 1e-8);
  EXPECT_NEAR(e.semi_major_axis, 2.7e7, 1);
  EXPECT_NEAR(e.period(implied_mu), 44152.6355, 2e-3);
  const State s = state_of(from_axis(2.7e7, 0.7, 0, 45 * degree, 30 * degree), implied_mu);
  EXPECT_LT((s.position - eccentric_orbit.position).norm(), 1e-3);
}

// Equation 5.38: the arc of section 5.4, the short way in 4320 s, found by Newton's iteration on the starting
// velocity. Its periapsis lies 6126 km below the surface, but not on the arc that is integrated.
TEST(Errata, Equation538PeriapsisIsInsideTheEarth) {
  const Vector3<double> from(2.87e6, 5.19e6, 2.85e6), to(2.09e6, 7.82e6, 0);
  const double mu = 3.986e14, time = 4320;
  Vector3<double> v(2700, 7300, 1700);
  for (int i = 0; i < 60; ++i) {
    const Vector3<double> miss = propagate_kepler({from, v}, time, mu).state.position - to;
    Matrix<double, 3> slope;
    for (int j = 0; j < 3; ++j) {
      Vector3<double> w = v;
      w[j] += 1e-3;
      slope.col(j) = (propagate_kepler({from, w}, time, mu).state.position - to - miss) / 1e-3;
    }
    const double det = slope.col(0).dot(cross<double>(slope.col(1), slope.col(2)));
    Vector3<double> step;
    for (int j = 0; j < 3; ++j) {
      Matrix<double, 3> changed = slope;
      changed.col(j) = miss;
      step[j] = changed.col(0).dot(cross<double>(changed.col(1), changed.col(2))) / det;
    }
    v -= step * std::min(1.0, 300 / step.norm());
  }
  const State start{from, v};
  ASSERT_LT((propagate_kepler(start, time, mu).state.position - to).norm(), 1e-2);
  const Elements e = elements_of(start, mu);
  EXPECT_NEAR(e.eccentricity, 0.963, 1e-3);
  EXPECT_NEAR(e.semi_latus_rectum / (1 + e.eccentricity), 252e3, 1e3);
  double lowest = HUGE_VAL;
  for (int i = 0; i <= 100; ++i)
    lowest = std::min(lowest, propagate_kepler(start, time * i / 100, mu).state.position.norm());
  EXPECT_NEAR(lowest, 6580e3, 5e3);
}

TEST(Convergence, RadiusAtThePeriapsis) {
  EXPECT_NEAR(convergence_radius_at_periapsis(0.1), 1.998, 5e-4);  // by hand: acosh 10 - sqrt 0.99
  EXPECT_NEAR(convergence_radius_at_periapsis(0.7), 0.18145, 1e-5);
  EXPECT_EQ(convergence_radius_at_periapsis(0), HUGE_VAL);
  EXPECT_EQ(convergence_radius_at_periapsis(1), 0);
  EXPECT_THROW((void)convergence_radius_at_periapsis(1.1), std::invalid_argument);
}

// acosh(1/e) - sqrt(1 - e^2) in 50 digits; without cancellation each e costs some roundings of 1 - e^2.
RC_GTEST_PROP(Convergence, RadiusHasAllItsDigits, ()) {
  const double e = 1 - std::pow(10, *between(-15, -0.01));
  const Real x = Real(e), exact = acosh(1 / x) - sqrt(1 - x * x);
  RC_ASSERT(std::abs(static_cast<double>(Real(convergence_radius_at_periapsis(e) / exact - 1))) <= 32 * eps);
}

// From any state of an ellipse the singularity is where its mean anomaly says; at other conics r = 0 at the
// complex time found from Kepler's equation at imaginary anomaly.
RC_GTEST_PROP(Convergence, RadiusFromAnyState, ()) {
  const double e = *between(0.05, 0.95), M = *between(-3, 3);
  const State s = propagate_kepler(at_periapsis(e), M, 1).state;
  RC_ASSERT(std::abs(convergence_radius(s, 1) / std::hypot(M, convergence_radius_at_periapsis(e)) - 1) <=
            1e3 * eps * kepler_condition(at_periapsis(e), M, 1).position);
}

TEST(Convergence, RadiusOfOpenConicsAndLines) {
  // Hyperbola with a = -1, e = 2 from its periapsis: sqrt(e^2 - 1) - acos(1/e).
  EXPECT_NEAR(convergence_radius({{1, 0, 0}, {0, std::sqrt(3), 0}}, 1), std::sqrt(3) - pi / 3, 8 * eps);
  // Parabola with p = 2: 2/3 sqrt(2 q^3/mu), q = 1.
  EXPECT_NEAR(convergence_radius({{1, 0, 0}, {0, std::sqrt(2), 0}}, 1), 2 * std::sqrt(2) / 3, 8 * eps);
  // Released at rest from 1: the fall lasts pi/(2 sqrt 2).
  EXPECT_NEAR(convergence_radius({{1, 0, 0}, {0, 0, 0}}, 1), pi / (2 * std::sqrt(2)), 8 * eps);
  EXPECT_GT(convergence_radius({{1, 0, 0}, {0, 1, 0}}, 1), 30);  // a circle, but for rounding
}

}  // namespace
}  // namespace nlmech::orbit::elements_test

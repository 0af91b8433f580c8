/// Thin ellipses over many revolutions, falls into the centre, flybys, and very large or small scales.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/convergence.hpp"
#include "nlmech/orbit/elements.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "tests/orbit/oracle.hpp"
#include "tests/thrown.hpp"

namespace nlmech::orbit::extremes_test {
namespace {

using namespace oracle;

const Gravity unit{};

// e = 0.999, 1000 orbits, some 80 000 steps from r = 0.001 to 2. With a tolerance below rounding the errors
// of the steps are random and stay within ten condition numbers; the truncation error of the default
// tolerance, 4.5 eps, is equal at every passage and adds up to slightly more.
TEST(Extremes, ThinEllipseOverAThousandOrbits) {
  const State s = at_periapsis(0.999);
  const double time = 2 * pi * 1000.4;
  const Solution c = propagate(s, 0, time, unit, AnalyticContinuation{.tolerance = 1e-17});
  ASSERT_TRUE(c.status.ok()) << c.status.text();
  const double kappa = kepler_condition(s, time, 1).position;
  EXPECT_LE(relative_distance(c.x.position, kepler(s, time, 1).position), 10 * eps * kappa);
  EXPECT_LE(relative_distance(propagate_kepler(s, time, 1).state.position, kepler(s, time, 1).position),
            8 * eps * kappa);
  const Solution plain = propagate(s, 0, time, unit);
  EXPECT_LE(relative_distance(plain.x.position, kepler(s, time, 1).position), 50 * eps * kappa);
  // |r||v| is up to 22 times |h|, so a rounding error of r or v changes h by that factor.
  const Vector3<double> h = angular_momentum(c.x), h0 = angular_momentum(s);
  EXPECT_NEAR(h[2] / h0[2], 1, 22 * std::sqrt(static_cast<double>(c.statistics.steps)) * eps);
  EXPECT_NEAR((eccentricity_vector(c.x, 1.0) - eccentricity_vector(s, 1.0)).norm(), 0,
              64 * std::sqrt(static_cast<double>(c.statistics.steps)) * eps);
}

// Released at rest, thrown inwards, or backwards in time from a throw outwards: the series fails with
// `collision` at the time at which Kepler's solution reaches the centre; Kepler's solution continues.
TEST(Extremes, FallIntoTheCentre) {
  const double fall = pi / (2 * std::sqrt(2));
  const State rest{{0.6, 0.8, 0}, {0, 0, 0}};
  const Solution c = propagate(rest, 0, 5, unit);
  EXPECT_EQ(c.status.outcome(), Outcome::collision) << c.status.text();
  // Step-size control ends where a step is eps times the interval.
  EXPECT_NEAR(c.t, fall, 1e-13);
  EXPECT_TRUE(c.x.position.allFinite() && c.x.velocity.allFinite());
  EXPECT_LT(c.x.position.norm(), 1e-8);
  EXPECT_TRUE(tests::holds(c.status.sentence(), "kepler"));
  EXPECT_TRUE(propagate_kepler(rest, 5, 1).status.ok());
  const Solution inwards = propagate(State{{0, 0, 2}, {0, 0, -3}}, 0, 5, unit);
  EXPECT_EQ(inwards.status.outcome(), Outcome::collision);
  const Solution back = propagate(State{{0, 0, 2}, {0, 0, 3}}, 0, -5, unit);
  EXPECT_EQ(back.status.outcome(), Outcome::collision);
  EXPECT_NEAR(back.t, -inwards.t, 1e-13);
  // The same in metres.
  const Solution si = propagate(State{{7e6, 0, 0}, {0, 0, 0}}, 0, 1e4, Gravity{.mu = earth_mu});
  EXPECT_EQ(si.status.outcome(), Outcome::collision);
  EXPECT_NEAR(si.t / (fall * std::sqrt(std::pow(7e6, 3) / earth_mu)), 1, 1e-12);
}

// Upwards from rest: the velocity 0 at the start does not give a step of 0; ascent and descent are symmetric.
TEST(Extremes, BodyAtRestMoves) {
  const State rest{{1, 0, 0}, {0, 0, 0}};
  const Solution c = propagate(rest, 0, 0.9, unit);
  ASSERT_TRUE(c.status.ok());
  EXPECT_LE(relative_distance(c.x.position, kepler(rest, 0.9, 1).position),
            8 * eps * kepler_condition(rest, 0.9, 1).position);
}

TEST(Extremes, HyperbolicFlyby) {
  // From a distance of 1000 inwards, past a periapsis near 0.01, and outwards again.
  const State s{{-1000, 0.2, 0}, {1, 0, 0}};
  for (const double time : {990., 1000., 2000.}) {
    const Solution c = propagate(s, 0, time, unit);
    ASSERT_TRUE(c.status.ok()) << c.status.text();
    EXPECT_LE(relative_distance(c.x.position, kepler(s, time, 1).position),
              8 * eps * kepler_condition(s, time, 1).position)
        << time;
    EXPECT_LE(relative_distance(propagate_kepler(s, time, 1).state.position, kepler(s, time, 1).position),
              8 * eps * kepler_condition(s, time, 1).position);
  }
  // Negligible gravity: a straight line in few steps.
  const State straight{{1, 0, 0}, {0, 1e6, 0}};
  const Solution fast = propagate(straight, 0, 1, unit);
  ASSERT_TRUE(fast.status.ok());
  EXPECT_LE(relative_distance(fast.x.position, kepler(straight, 1, 1).position), 16 * eps);
}

// A passage of the centre at 1e8 times the speed at which gravity matters: the series is that of a straight
// line, but is valid only within the radius of convergence. The body turns back, which the series cannot
// represent.
TEST(Extremes, AFastPassageOfTheCentreIsNotSteppedOver) {
  const State s{{0, -0.00040537635592184299, 0}, {-5.6677461237845338e-10, -9385.8193629848574, 0}};
  const double time = -8.336621895258487, mu = 1e-6;
  const Solution c = propagate(s, 0, time, Gravity{.mu = mu}, AnalyticContinuation{.tolerance = 2.72e-4});
  EXPECT_EQ(c.status.outcome(), Outcome::collision) << c.status.text();
}

// A comet from 2e4 to 1e-4 and back: time scales differ by 8e12, orders reach 100.
TEST(Extremes, TimeScalesFarApart) {
  const State s = at_periapsis(1 - 1e-8);
  for (const int order : {0, 100}) {
    const Solution c = propagate(s, 0, 2 * pi * 1.3, unit, AnalyticContinuation{.order = order});
    ASSERT_TRUE(c.status.ok()) << c.status.text();
    EXPECT_LE(relative_distance(c.x.position, kepler(s, 2 * pi * 1.3, 1).position),
              8 * eps * kepler_condition(s, 2 * pi * 1.3, 1).position)
        << order;
  }
}

// Lengths from an atom to a galaxy; mu so that times stay within doubles.
TEST(Extremes, Scales) {
  for (const double scale : {1e-100, 1e-10, 1e20, 1e100}) {
    const State s{{scale, 0, 0}, {0, 1.1, 0}};
    const double mu = scale, time = 5 * scale;
    const Solution c = propagate(s, 0, time, Gravity{.mu = mu});
    ASSERT_TRUE(c.status.ok()) << c.status.text();
    EXPECT_NEAR((propagate_kepler(s, time, mu).state.position - c.x.position).norm() / scale, 0, 200 * eps);
  }
}

// The error of the period, 1.5 eps a revolution, is a full period after 1e15 revolutions: the result would be
// meaningless and is refused. The condition number is at least that of the period.
TEST(Extremes, APhaseThatRoundingLeavesUndeterminedIsRefused) {
  const State s = at_periapsis(0.3);
  for (const double time : {1e17, -1e20, 1e100, 1e300}) {
    const KeplerSolution k = propagate_kepler(s, time, 1);
    EXPECT_EQ(k.status.outcome(), Outcome::outside_validity) << time;
    EXPECT_TRUE(tests::holds(k.status.sentence(), "undetermined"));
    EXPECT_EQ(k.state.position, s.position);
    EXPECT_GE(kepler_condition(s, time, 1).position, 1.5 * std::abs(time)) << time;
  }
  for (const double time : {1e6, 1e12}) {
    const KeplerSolution k = propagate_kepler(s, time, 1);
    ASSERT_TRUE(k.status.ok()) << k.status.text();
    EXPECT_LE(relative_distance(k.state.position, kepler(s, time, 1).position),
              8 * eps * kepler_condition(s, time, 1).position);
  }
  // A hyperbola is determined at any time, an ellipse near the parabola within its period.
  EXPECT_TRUE(propagate_kepler({{1, 0, 0}, {0, 2, 0}}, 1e200, 1).status.ok());
  EXPECT_TRUE(propagate_kepler({{1, 0, 0}, {0, std::sqrt(2) * (1 - 1e-12), 0}}, 1e3, 1).status.ok());
}

// Powers of two in the units change no digit, up to the range of double.
TEST(Extremes, UnitsFarFromOne) {
  const State s{{0.8, 0.1, -0.2}, {0.3, 0.9, 0.4}};
  const double time = 2.5;
  const KeplerSolution reference = propagate_kepler(s, time, 1);
  const Elements e = elements_of(s, 1);
  const double kappa = kepler_condition(s, time, 1).position, radius = convergence_radius(s, 1);
  for (const auto& [length, rate] :
       {std::pair{900, 0}, {-900, 0}, {0, 600}, {300, -700}, {-340, 680}, {-1000, 20}}) {
    const double r = std::ldexp(1.0, length), v = std::ldexp(1.0, length / 2 + rate / 2);
    // mu = r v^2 may exceed the range of double where r and v do not
    const int exponent = length + 2 * (length / 2 + rate / 2);
    if (exponent > 1020 || exponent < -1020) continue;
    const double mu = std::ldexp(1.0, exponent);
    const State far{s.position * r, s.velocity * v};
    const KeplerSolution k = propagate_kepler(far, time * (r / v), mu);
    ASSERT_TRUE(k.status.ok()) << k.status.text();
    EXPECT_LE((k.state.position / r - reference.state.position).norm(), 8 * eps * kappa) << length;
    EXPECT_LE((k.state.velocity / v - reference.state.velocity).norm(), 16 * eps * kappa) << length;
    EXPECT_NEAR(kepler_condition(far, time * (r / v), mu).position / kappa, 1, 1e-9);
    const Elements f = elements_of(far, mu);
    EXPECT_NEAR(f.eccentricity, e.eccentricity, 8 * eps);
    EXPECT_NEAR(f.semi_major_axis / r / e.semi_major_axis, 1, 8 * eps);
    EXPECT_NEAR(f.period(mu) / (r / v) / e.period(1), 1, 16 * eps);
    EXPECT_NEAR(convergence_radius(far, mu) / (r / v) / radius, 1, 16 * eps);
    const State back = state_of(f, mu);
    EXPECT_LE((back.position / r - s.position).norm(), 32 * eps);
    EXPECT_LE((back.velocity / v - s.velocity).norm(), 32 * eps);
  }
}

// Finite input gives finite elements and states, or a failure with a message.
TEST(Extremes, WhatDoublesCannotHoldIsSaid) {
  const State s{{7e6, 0, 0}, {0, 7500, 0}};
  EXPECT_THROW((void)elements_of(s, 1e-300), std::invalid_argument);  // e = v^2 r/mu = 4e314
  EXPECT_THROW((void)state_of({.semi_latus_rectum = 7e6, .eccentricity = 1e308}, earth_mu),
               std::invalid_argument);
  EXPECT_THROW((void)state_of({.semi_latus_rectum = 7e6, .true_anomaly = 1e17}, 1), std::invalid_argument);
  EXPECT_THROW((void)from_axis(-1e308, 1e10), std::invalid_argument);
  const KeplerSolution k = propagate_kepler(s, 1, 1e-300);
  EXPECT_EQ(k.status.outcome(), Outcome::outside_validity) << k.status.text();
  EXPECT_TRUE(tests::holds(k.status.sentence(), "mu"));
  // Straight outwards up to the range of double.
  const KeplerSolution far = propagate_kepler({{1, 0, 0}, {1e10, 0, 0}}, 1e300, 1);
  EXPECT_EQ(far.status.outcome(), Outcome::outside_validity) << far.status.text();
  EXPECT_EQ(kepler_condition(s, 1, 1e-300).position, std::numeric_limits<double>::infinity());
  // Negligible gravity: r^2 = 0 at complex times of modulus |r|/|v|.
  EXPECT_NEAR(convergence_radius({{3, 0, 4}, {0, 1e100, 0}}, 1) / 5e-100, 1, 4 * eps);
}

}  // namespace
}  // namespace nlmech::orbit::extremes_test

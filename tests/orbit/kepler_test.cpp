/// Kepler's problem: the error is at most C kappa eps against Kepler's equation in 50 digits, for every
/// conic.
#include "nlmech/orbit/kepler.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "nlmech/orbit/universal.hpp"
#include "tests/orbit/oracle.hpp"
#include "tests/thrown.hpp"

namespace nlmech::orbit::kepler_test {
namespace {

using namespace oracle;

/// The constant C of the error bound of propagate_kepler().
constexpr double promised = 8;

/// Error over kappa eps, the larger of position and velocity; 0 for a refusal where no digit is determined.
double error_in_kappa_eps(const State& s, double time, double mu) {
  const KeplerSolution k = propagate_kepler(s, time, mu);
  const KeplerCondition kappa = kepler_condition(s, time, mu);
  if (k.status.outcome() == Outcome::outside_validity && 64 * kappa.position * eps >= 1) return 0;
  EXPECT_TRUE(k.status.ok()) << k.status.text();
  const auto exact = kepler(s, time, mu);
  return std::max(relative_distance(k.state.position, exact.position) / kappa.position,
                  relative_distance(k.state.velocity, exact.velocity) / kappa.velocity) /
         eps;
}

RC_GTEST_PROP(Kepler, ErrorOfAnyOrbitIsConditionTimesEps, ()) {
  const double speed = *between(0, 3), flight = *between(0, pi);
  const double r = std::pow(10, *between(-3, 9)), mu = std::pow(10, *between(-6, 20));
  const State s = random_state(r, mu, speed, flight);
  // Up to a thousand times the time scale r^(3/2)/mu^(1/2), in both directions.
  const double time = *between(-1, 1) * std::pow(10, *between(-3, 3)) * r * std::sqrt(r / mu);
  RC_ASSERT(error_in_kappa_eps(s, time, mu) <= promised);
}

RC_GTEST_PROP(Kepler, ErrorOfThinEllipsesToo, ()) {
  const double e = 1 - std::pow(10, *between(-6, 0));
  const State s = at_periapsis(e);
  RC_ASSERT(error_in_kappa_eps(s, *between(-20, 20), 1) <= promised);
}

RC_GTEST_PROP(Kepler, ErrorNearTheParabolaToo, ()) {
  const double excess = *between(-1, 1) * std::pow(10, *between(-16, 0));
  const State s = random_state(1, 1, std::sqrt(2) * (1 + excess), *between(0.01, 3));
  RC_ASSERT(error_in_kappa_eps(s, std::pow(10, *between(-2, 4)), 1) <= promised);
}

// Hyperbolas from far away, where the terms of F and G cancel by many digits.
RC_GTEST_PROP(Kepler, ErrorOfFlybysToo, ()) {
  const double speed = std::pow(10, *between(0.16, 4)), flight = pi - std::pow(10, *between(-7, 0));
  const State s = random_state(1, 1, speed, flight);
  RC_ASSERT(error_in_kappa_eps(s, *between(0, 3) / speed, 1) <= promised);
}

// Aimed at the centre within any fraction of eps of a straight line, at any speed; also exactly along an
// axis.
RC_GTEST_PROP(Kepler, ErrorOfFlybysThatGrazeTheCentreToo, ()) {
  const double speed = std::pow(10, *between(0.3, 8)), aside = std::pow(10, *between(-18, -6));
  State s = random_state(1, 1, speed, pi - aside);
  if (*rc::gen::inRange(0, 4) == 0) s = {{1, 0, 0}, {-speed, speed * aside, 0}};
  if (*rc::gen::inRange(0, 8) == 0) s = {{1, 0, 0}, {-speed, 0, 0}};
  const double time = *between(0, 3) / speed;
  const KeplerCondition kappa = kepler_condition(s, time, 1);
  RC_ASSERT(std::isfinite(kappa.position));
  RC_ASSERT(std::isfinite(kappa.velocity));
  RC_ASSERT(error_in_kappa_eps(s, time, 1) <= promised);
}

// Far out on a hyperbola: exponentials of logarithms up to 60, each of which would have an error of 60 eps.
TEST(Kepler, HyperbolasAMillionDistancesAway) {
  const State far{{0, 0.00022011347278415964, 0},
                  {-0.077824211798445536, 0.027547907046325544, -0.4646699149428718}};
  EXPECT_LE(error_in_kappa_eps(far, 59675362221135.953, 1e-6), promised);
  const State fast{{1.3197265184357962, 1.592706089502808, 3.5045586771172013},
                   {3162589770.1155624, 3816757422.9185967, 8398316822.6075115}};
  EXPECT_LE(error_in_kappa_eps(fast, 44489392450.017395, 229230631.79470459), promised);
}

// From rest, over ten million falls and more: at a turning point the position does not determine the phase to
// first order.
TEST(Kepler, APhaseThatIsLostAtTheTurnIsRefused) {
  const State rest{{-3.9799569484664789e-06, 2.8011942580608421e-06, -3.2953923753575582e-06}, {0, 0, 0}};
  EXPECT_EQ(propagate_kepler(rest, -29.695038421702066, 2708836974137.4282).status.outcome(),
            Outcome::outside_validity);
  // Two turns of an ellipse that rounding does not tell from a parabola, to its apoapsis.
  const State near{{0, 0.00025172845880218895, 0},
                   {2641.7335618639713, -3222.4009890008992, -740.57627752238}};
  EXPECT_EQ(propagate_kepler(near, -1.3810215372885171e+17, 2254.3639759177595).status.outcome(),
            Outcome::outside_validity);
}

// Speeds so large that squares of the eccentricity overflow: a straight line, r + v t to (1/v)^2.
TEST(Kepler, FastestFlybys) {
  for (const double speed : {1e10, 1e50, 1e90, 1e149}) {
    const State s{{1, 0, 0}, {-0.5 * speed, 0.75 * speed, 0.25 * speed}};
    const KeplerSolution k = propagate_kepler(s, 1 / speed, 1);
    ASSERT_TRUE(k.status.ok());
    const KeplerCondition kappa = kepler_condition(s, 1 / speed, 1);
    const Vector3<double> end(0.5, 0.75, 0.25);
    // Of r + v t: |r|, |v| three times, and v t, over the end; of v: each of its components.
    EXPECT_NEAR(kappa.position, (3 + 4 * std::sqrt(0.875)) / end.norm(), 1e-6) << speed;
    EXPECT_NEAR(kappa.velocity, 3, 1e-6) << speed;
    EXPECT_LE((k.state.position - end).norm(), promised * eps * kappa.position * end.norm()) << speed;
    EXPECT_LE((k.state.velocity - s.velocity).norm() / speed, promised * eps * 3) << speed;
  }
}

TEST(Kepler, ParabolaWhoseSpeedIsExact) {
  const State s{{0, 2, 0}, {-1, 0, 0}};  // v.v = 2 mu/r exactly
  for (const double t : {-1e6, -3., -0.1, 0.2, 5., 1e8})
    EXPECT_LE(error_in_kappa_eps(s, t, 1), promised) << t;
}

// On a straight line: thrown upwards below and above escape speed.
TEST(Kepler, StraightLines) {
  for (const double v : {0.0, 0.7, 1.3, 1.5, 3.0}) {
    const State s{{1, 2, -2}, {v / 3, 2 * v / 3, -2 * v / 3}};  // |r| = 3
    for (const double t : {-0.5, 0.5, 2., 3.})
      EXPECT_LE(error_in_kappa_eps(s, t, 1), promised) << v << " " << t;
  }
}

// Released at rest from r = 1 with mu = 1 the body reaches the centre at pi/(2 sqrt 2) and returns, as the
// limit of thin ellipses, at twice that time.
TEST(Kepler, StraightLineReturnsFromTheCentre) {
  const State s{{1, 0, 0}, {0, 0, 0}};
  const double fall = pi / (2 * std::sqrt(2));
  const KeplerSolution back = propagate_kepler(s, 1.5 * fall, 1);
  ASSERT_TRUE(back.status.ok());
  EXPECT_LE(relative_distance(back.state.position, kepler(s, 1.5 * fall, 1).position),
            promised * eps * kepler_condition(s, 1.5 * fall, 1).position);
  EXPECT_GT(back.state.velocity[0], 0);
}

// One million revolutions of both orbits of the dissertation: the condition number grows by 2 pi 1.5 a
// revolution.
TEST(Kepler, ManyRevolutions) {
  for (const State& s : {low_orbit, eccentric_orbit}) {
    const double period = 2 * pi / std::sqrt(earth_mu) * std::pow(reciprocal_axis(s, earth_mu), -1.5);
    for (const double turns : {1., 20.25, 1e3 + 0.7, 1e6 + 0.4}) {
      EXPECT_LE(error_in_kappa_eps(s, turns * period, earth_mu), promised) << turns;
    }
    const double near = kepler_condition(s, 100.3 * period, earth_mu).position;
    EXPECT_NEAR(kepler_condition(s, 1000.3 * period, earth_mu).position / near, 10, 0.5);
  }
}

// The condition number against differences: the change of the end is at most kappa times a small relative
// change of the data.
TEST(Kepler, ConditionIsTheGrowthOfErrors) {
  const double time = 2e5, change = 1e-7;
  const auto end = kepler(eccentric_orbit, time, earth_mu);
  const KeplerCondition kappa = kepler_condition(eccentric_orbit, time, earth_mu);
  double sum = 0;
  for (int i = 0; i < 8; ++i) {
    State s = eccentric_orbit;
    double mu = earth_mu, t = time;
    if (i < 3) s.position[i] += change * s.position.norm();
    if (i >= 3 && i < 6) s.velocity[i - 3] += change * s.velocity.norm();
    if (i == 6) mu *= 1 + change;
    if (i == 7) t *= 1 + change;
    const Vector3<Real> moved_by = kepler(s, t, mu).position - end.position;
    sum += static_cast<double>(Real(length(moved_by) / length(end.position))) / change;
  }
  EXPECT_NEAR(kappa.position / sum, 1, 1e-3);  // differences of first order
}

// Before the centre a fast body moves on a straight line, whose end changes by |r| with each component of the
// position, by |v t| with each of the velocity and with the time. The shape of its hyperbola, which a change
// of 1e-16 may turn from straight to open, has no influence; gravity has less than 1e-4, 1/(v^2 (1 -
// part)^2).
TEST(Kepler, TheConditionOfAnApproachIsThatOfAStraightLine) {
  for (const double speed : {1e4, 1e7, 1e8, 1e12}) {
    for (const double aside : {0., 1e-17, 1e-16, 1e-12}) {
      const State inwards{{1, 0, 0}, {-speed, speed * aside, 0}}, outwards{{1, 0, 0}, -inwards.velocity};
      for (const double part : {1e-8, 3e-3, 0.25, 0.9, 0.99}) {
        const double expected = (3 + 4 * part) / (1 - part), time = part / speed;
        EXPECT_NEAR(kepler_condition(inwards, time, 1).position / expected, 1, 1e-4) << speed << " " << part;
        EXPECT_NEAR(kepler_condition(outwards, -time, 1).position / expected, 1, 1e-4)
            << speed << " " << part;
      }
    }
  }
}

// Universal variables in 50 digits against Kepler's equation in 50 digits.
TEST(Kepler, UniversalVariablesAgreeWithKeplersEquationInExtendedPrecision) {
  const State states[] = {
      low_orbit, eccentric_orbit, {{7e6, 0, 0}, {0, 1.2e4, 3e3}}, {{7e6, 1, 2}, {1e4, 0, 5}}};
  for (const State& s : states) {
    for (const double t : {-1e5, 321., 4e4, 1e6}) {
      const BasicState<Real> exact = kepler(s, t, earth_mu), start = as<Real>(s);
      const auto mine = moved(start, lagrange_coefficients<Real>(start, Real(t), Real(earth_mu)));
      const Vector3<Real> d = mine.position - exact.position;
      EXPECT_LT(Real(length(d) / length(exact.position)), Real(1e-44)) << t;
    }
  }
}

RC_GTEST_PROP(Kepler, LagrangesCoefficientsHaveTheirDeterminant, ()) {
  const State s = random_state(1, 1, *between(0.3, 2), *between(0.1, 3));
  const auto c = lagrange_coefficients(s, *between(-3, 3), 1.0);
  // Rounding errors of the universal functions, from F and F', and of the sums r and G.
  const double r = moved(s, c).position.norm(), sigma = s.position.dot(s.velocity);
  const double u2 = 1 - c.f, u1 = -c.f_rate * r, u0 = 1 - (2 - s.velocity.squaredNorm()) * u2;
  const double terms_of_r = std::abs(u0) + std::abs(sigma * u1) + std::abs(u2);
  const double terms_of_g = std::abs(u1) + std::abs(sigma * u2);
  const double scale = std::abs(c.f) * (1 + std::abs(u2) / r) + std::abs(c.f_rate) * terms_of_g +
                       std::abs(u2) * terms_of_r / r;
  RC_ASSERT(std::abs(c.f * c.g_rate - c.f_rate * c.g - 1) <= 8 * eps * scale);
}

// Every eighth evaluation halves the bounds, so 8 (53 + 3) suffice for any orbit; the worst case reaches the
// centre at the end. A hundred ordinary orbits need six on average.
RC_GTEST_PROP(Kepler, EverySearchEnds, ()) {
  const State s = random_state(1, 1, *between(0, 1.4), *between(0, pi));
  RC_ASSERT(propagate_kepler(s, *between(-100, 100), 1).iterations <= 448);
}

TEST(Kepler, FewEvaluationsAreTheRule) {
  int sum = 0;
  for (int i = 0; i < 100; ++i) sum += propagate_kepler(at_periapsis(0.0099 * i), 0.37 * i, 1).iterations;
  EXPECT_LE(sum, 600);
}

TEST(Kepler, NoTimeIsNoMotion) {
  const KeplerSolution k = propagate_kepler(eccentric_orbit, 0, earth_mu);
  EXPECT_EQ(k.state.position, eccentric_orbit.position);
  EXPECT_EQ(k.state.velocity, eccentric_orbit.velocity);
}

TEST(Kepler, WhatCannotBeMeantIsRefused) {
  const auto refused = [](const State& s, double t, double mu) {
    return tests::thrown<std::invalid_argument>([&] { return propagate_kepler(s, t, mu); });
  };
  EXPECT_TRUE(tests::holds(refused({{0, 0, 0}, {1, 0, 0}}, 1, 1), "the position is 0"));
  EXPECT_TRUE(tests::holds(refused({{1, NAN, 0}, {1, 0, 0}}, 1, 1), "component 2 is nan"));
  EXPECT_TRUE(tests::holds(refused({{1, 0, 0}, {0, HUGE_VAL, 0}}, 1, 1), "inf"));
  EXPECT_TRUE(tests::holds(refused({{1, 0, 0}, {0, 1, 0}}, NAN, 1), "nan"));
  EXPECT_TRUE(tests::holds(refused({{1, 0, 0}, {0, 1, 0}}, 1, 0), "mu must be positive and finite, not 0"));
  EXPECT_THROW((void)kepler_condition({{0, 0, 0}, {1, 0, 0}}, 1, 1), std::invalid_argument);
}

// Parabolas to their last bits: a success requires digits in the energy times the distance, and
// large_condition() states their number.
TEST(Kepler, NearTheParabolaTheConditionRefuses) {
  const State s{{0.8647618531675945, 0.5021821754165989, 0}, {-0.7101928432561789, 1.222957940972503, 0}};
  EXPECT_EQ(propagate_kepler(s, 4.0552922763711963e+27, 1).status.outcome(), Outcome::outside_validity);
  const State t{{1, 0, 0}, {0, 1.4142135623730951, 0}};
  const KeplerSolution far = propagate_kepler(t, 1e18, 1), farther = propagate_kepler(t, 1e24, 1);
  EXPECT_EQ(farther.status.outcome(), Outcome::outside_validity) << farther.status.text();
  ASSERT_TRUE(far.status.ok()) << far.status.text();
  const double kappa = kepler_condition(t, 1e18, 1).position;
  EXPECT_LE(relative_distance(far.state.position, kepler(t, 1e18, 1).position), 8 * eps * kappa);
  EXPECT_EQ(large_condition(t, far.state, 1e18, 1, 1e-6 / eps), kappa);
  EXPECT_EQ(large_condition(t, far.state, 1e18, 1), 0);
  EXPECT_EQ(large_condition(t, t, 0, 1, 1e3), 0);
}

// ---- Stumpff's functions against their closed forms in 50 digits.

/// Closed forms; 20 of 50 digits remain after the worst cancellation here, |psi| = 1e-10 in c_3.
Stumpff<Real> exact(double psi) {
  if (psi == 0) return {1, 1, Real(1) / 2, Real(1) / 6};
  const Real p = psi, x = sqrt(abs(p));
  const Real c = psi > 0 ? cos(x) : cosh(x), s = psi > 0 ? sin(x) : sinh(x);
  return {c, s / x, (1 - c) / p, (1 - s / x) / p};
}

double error(double mine, const Real& reference, double scale) {
  return std::abs(static_cast<double>(Real(mine - reference))) / (scale * eps);
}

RC_GTEST_PROP(Stumpff, HasNoCancellation, ()) {
  const double size = std::pow(10, *between(-10, 0.994));  // to pi^2
  const double psi = *rc::gen::element(-1.0, 1.0) * size;
  const Stumpff<double> c = stumpff(psi);
  const Stumpff<Real> e = exact(psi);
  RC_ASSERT(error(c.c2, e.c2, static_cast<double>(e.c2)) <= 8);
  RC_ASSERT(error(c.c3, e.c3, static_cast<double>(e.c3)) <= 8);
  // c_0 and c_1 have zeros: absolute errors there.
  RC_ASSERT(error(c.c0, e.c0, std::max(1.0, static_cast<double>(e.c0))) <= 8);
  RC_ASSERT(error(c.c1, e.c1, std::max(1.0, static_cast<double>(e.c1))) <= 8);
}

// Large arguments: the condition number of the hyperbolic functions is sqrt(-psi).
RC_GTEST_PROP(Stumpff, LargeArguments, ()) {
  const double psi = *between(-4e5, 200);
  const Stumpff<double> c = stumpff(psi);
  const Stumpff<Real> e = exact(psi);
  const double room = 8 + std::sqrt(std::abs(psi));
  RC_ASSERT(error(c.c3, e.c3, static_cast<double>(e.c3)) <= room);
  RC_ASSERT(error(c.c2, e.c2, std::max(1 / std::abs(psi), static_cast<double>(e.c2))) <= room);
}

TEST(Stumpff, AtNothingAndAtTheSeams) {
  EXPECT_EQ(stumpff(0.0).c0, 1);
  EXPECT_EQ(stumpff(0.0).c2, 0.5);
  for (const double seam : {-4., 4.}) {
    const double below = std::nextafter(seam, -10), above = std::nextafter(seam, 10);
    EXPECT_NEAR(stumpff(below).c3 / stumpff(above).c3, 1, 16 * eps);
    EXPECT_NEAR(stumpff(below).c2 / stumpff(above).c2, 1, 16 * eps);
  }
  EXPECT_EQ(stumpff(-1e9).c2, HUGE_VAL);
}

// The series for 50 digits is accurate to them up to its limit.
TEST(Stumpff, ExtendedPrecision) {
  for (const double psi : {-4., -1., 3., 4.}) {
    const Stumpff<Real> mine = stumpff(Real(psi)), e = exact(psi);
    EXPECT_LT(abs(Real(mine.c3 / e.c3 - 1)), Real(1e-47));
    EXPECT_LT(abs(Real(mine.c2 / e.c2 - 1)), Real(1e-47));
  }
}

}  // namespace
}  // namespace nlmech::orbit::kepler_test

/// Elements to states and back, conventions where angles are undefined, the printed elements of section
/// 3.2.2; and states on conics from each kind of anomaly.
#include "nlmech/orbit/elements.hpp"

#include <gtest/gtest.h>

#include <array>
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

// 32 eps: a dozen operations with rounding in each of six elements, and sines of angles up to 2 pi. Far out
// on an open conic 1 + e cos nu amplifies the error.
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
  // Condition numbers of the angles of a non-circular inclined orbit: 1/e and 1/sin i.
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
    // In the direction of motion: 200 degrees, or 160 degrees in the opposite direction.
    EXPECT_NEAR(e.periapsis_argument, way > 0 ? longitude : 160 * degree, 8 * eps);
    EXPECT_LE(there_and_back(s, 1), 32);
  }
  EXPECT_LE(there_and_back({{1, 0, 0}, {0, 1, 0}}, 1), 32);    // circular and equatorial
  EXPECT_LE(there_and_back({{0, -1, 0}, {-1, 0, 0}}, 1), 32);  // and retrograde
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

// Eq. 3.72 prints omega = 0. The state of 3.71 is at its periapsis at the longitude of 75 degrees, so omega
// (i = 0) is 75 degrees; T_p = 6218.7284 s is printed as 6.21872e3, truncated.
TEST(Errata, Equation372) {
  const Elements e = elements_of(low_orbit, implied_mu);
  EXPECT_NEAR(e.true_anomaly, 0, 1e-9);  // printed digits of the state: 16
  EXPECT_NEAR(e.periapsis_argument / degree, 75, 1e-9);
  EXPECT_NEAR(e.eccentricity, 0.1, 1e-8);            // implied_mu has nine digits
  EXPECT_NEAR(e.semi_major_axis, 7309041.111, 0.1);  // the same
  EXPECT_NEAR(e.period(implied_mu), 6218.7284, 1e-4);
  // As printed, another longitude of the periapsis shifts the body by 2 sin(37.5 deg) r.
  Elements printed = from_axis(7.30904e6, 0.1);
  EXPECT_NEAR(
      (state_of(printed, implied_mu).position - low_orbit.position).norm() / low_orbit.position.norm(),
      2 * std::sin(37.5 * degree), 1e-6);
  printed.periapsis_argument = 75 * degree;
  EXPECT_LT((state_of(printed, implied_mu).position - low_orbit.position).norm(), 1.0);  // a has six digits
}

// Eq. 3.74 prints Omega = 45 and omega = 30 degrees for i = 0, where only their sum is defined; it agrees.
TEST(Errata, Equation374) {
  const Elements e = elements_of(eccentric_orbit, implied_mu);
  EXPECT_NEAR((e.ascending_node + e.periapsis_argument) / degree, 45 + 30, 1e-9);
  EXPECT_NEAR(e.eccentricity, 0.7, 1e-8);
  EXPECT_NEAR(e.semi_major_axis, 2.7e7, 1);
  EXPECT_NEAR(e.period(implied_mu), 44152.6355, 2e-3);
  const State s = state_of(from_axis(2.7e7, 0.7, 0, 45 * degree, 30 * degree), implied_mu);
  EXPECT_LT((s.position - eccentric_orbit.position).norm(), 1e-3);
}

// Equation 5.38: the arc of section 5.4, the short way in 4320 s. Its periapsis lies 6126 km below the
// surface, but not on the arc that is integrated. oracle: rbf_inverse_lambert short v1 *
TEST(Errata, Equation538PeriapsisIsInsideTheEarth) {
  const State start{{2.87e6, 5.19e6, 2.85e6}, {2774.8469906025419, 7217.0230343355381, 1625.9338905977957}};
  const double mu = 3.986e14, time = 4320;
  const Vector3<double> to(2.09e6, 7.82e6, 0);
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

// For any state of an ellipse the mean anomaly gives the singularity; on other conics it is r = 0 at the
// complex time from Kepler's equation at imaginary anomaly.
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
  EXPECT_GT(convergence_radius({{1, 0, 0}, {0, 1, 0}}, 1), 30);  // a circle up to rounding
}

// ---- States on ellipses, parabolas and hyperbolas from each kind of anomaly against closed forms in 50
// digits; states to elements and back.

const Orientation plain;
constexpr std::array complements = {1., 0.5, 1e-3, 1e-8, 1e-16, 1e-24, 0., -1e-24, -1e-16, -1e-8, -0.5, -10.};

double relative_error(const Vector3<double>& x, const Real& x0, const Real& x1) {
  const Real d0 = x[0] - x0, d1 = x[1] - x1;
  return static_cast<double>(Real(sqrt((d0 * d0 + d1 * d1) / (x0 * x0 + x1 * x1)))) / eps;
}

double relative_error(const State& s, const Real& x, const Real& y, const Real& vx, const Real& vy) {
  return std::max(relative_error(s.position, x, y), relative_error(s.velocity, vx, vy));
}

Real radians(double degrees) { return Real(degrees) * acos(Real(-1)) / 180; }

// Includes angles near the apoapsis of a thin ellipse and near the asymptote of a parabola.
TEST(Conic, AtTrueAnomalies) {
  for (const double c : complements) {
    for (const double nu : {0., 1e-9, 60., 90., -120., 179., -179.99, 179.999999, 179.99999999999, 180.}) {
      const Real e = 1 - Real(c), half = radians(nu) / 2, share = 2 * cos(half) * cos(half),
                 denominator = c + e * share;
      if (!(denominator > 0) || (nu == 180 && c == 0)) continue;
      const double q = 0.7, mu = 3;
      const State s = state_at_true_anomaly({q, c}, plain, sine_cosine_of_degrees(nu / 2), mu);
      const Real r = q * (1 + e) / denominator, speed = sqrt(mu / (q * (1 + e)));
      // Where 1 - e is negative the denominator is a difference.
      const double condition = static_cast<double>(Real((abs(Real(c)) + e * share) / denominator));
      EXPECT_LE(
          relative_error(s, r * (share - 1), r * sin(2 * half), -speed * sin(2 * half), speed * (share - c)),
          16 * condition)
          << c << " " << nu;
    }
  }
}

// The anomaly is given and time and mean anomaly follow: their rounding moves the body by |t| |v|/|r| of the
// distance. At the same E or H by itself there is no such error.
TEST(Conic, AtEccentricAnomaliesAndTimes) {
  for (const double c : complements) {
    for (const double angle : {0., 1e-6, 0.3, -3., 20., -90., 150., -179.999, 180.}) {
      if (c == 0) continue;
      const double q = 1e-3, mu = 5;
      // Near the parabola, distances from q to 1e16 q.
      const double scaled =
          std::abs(c) < 0.1 && std::abs(angle) < 10 ? angle * std::sqrt(std::abs(c)) : angle;
      const Real e = 1 - Real(c), a = Real(q) / c, E = radians(scaled), n = sqrt(mu / abs(a)) / abs(a);
      const Real sine = c > 0 ? Real(sin(E / 2)) : Real(sinh(E / 2)),
                 cosine = c > 0 ? Real(cos(E / 2)) : Real(cosh(E / 2)), u2 = 2 * sine * sine / abs(Real(c));
      const Real u1 = 2 * sine * cosine / sqrt(abs(Real(c))), u0 = 1 - c * u2;
      const Real r = 1 + e * u2, unit = sqrt(mu / Real(q)), root = sqrt(1 + e);
      const auto off = [&](const State& s) {
        return relative_error(s, q * (1 - u2), q * root * u1, -unit * u1 / r, unit * root * u0 / r);
      };
      const State s = c > 0
                          ? state_at_eccentric_anomaly({q, c}, plain, sine_cosine_of_degrees(scaled / 2), mu)
                          : state_at_hyperbolic_anomaly({q, c}, plain, static_cast<double>(E), mu);
      // H in degrees, rounded to radians.
      const double rounded = c > 0 ? 16 : 16 + std::abs(scaled);
      EXPECT_LE(off(s), rounded) << c << " " << scaled;
      const Real mean = c > 0 ? Real(E - e * sin(E)) : Real(e * sinh(E) - E), time = mean / n;
      const Real speed = unit * sqrt(u1 * u1 + root * root * u0 * u0) / r;
      // Beside the apoapsis of a thin ellipse |v| is less than the circular speed, which bounds its error.
      const Real circular = unit / sqrt(r), slow = speed < circular ? Real(circular / speed) : Real(1);
      const double moved =
          static_cast<double>(Real((1 + abs(time) * std::max(speed, circular) / (q * r)) * slow));
      EXPECT_LE(off(state_at_time({q, c}, plain, static_cast<double>(time), mu)), 16 * moved)
          << c << " " << scaled;
      EXPECT_LE(off(state_at_mean_anomaly({q, c}, plain, static_cast<double>(mean), mu)), 16 * moved)
          << c << " " << scaled;
    }
  }
}

// Barker's equation: at the time (d + d^3/3) (2 q^3/mu)^(1/2) tan(nu/2) is d.
TEST(Conic, ParabolaAtTimes) {
  const double q = 2, mu = 3;
  for (const double d : {0., 1e-3, -1., 30., 1e8}) {
    const Real wide = d, r = q * (1 + wide * wide);
    const Real time = (wide + wide * wide * wide / 3) * sqrt(2 * Real(q) * q * q / mu),
               rate = sqrt(2 * mu / Real(q));
    const State s = state_at_time({q, 0}, plain, static_cast<double>(time), mu);
    EXPECT_LE(relative_error(s, q * (1 - wide * wide), 2 * q * wide, -rate * wide * q / r, rate * q / r), 32)
        << d;
  }
}

// The error of the velocity is measured in the circular speed where that is more: an angle or time near the
// apoapsis of a thin ellipse says no more.
double there_and_back_by_time(const State& s, double mu) {
  const Elements e = elements_of(s, mu);
  const auto of = [](double angle) { return SineCosine{std::sin(angle), std::cos(angle)}; };
  const State back = state_at_time({e.periapsis_distance, e.periapsis_distance / e.semi_major_axis},
                                   {of(e.inclination), of(e.ascending_node), of(e.periapsis_argument)},
                                   e.time_since_periapsis, mu);
  const double r = s.position.norm(), v = std::max(s.velocity.norm(), std::sqrt(mu / r));
  return std::max((back.position - s.position).norm() / r, (back.velocity - s.velocity).norm() / v) / eps;
}

RC_GTEST_PROP(Conic, ThereAndBackByTime, ()) {
  const double mu = std::pow(10, *between(-3, 20)), r = std::pow(10, *between(-3, 9));
  const double speed = *rc::gen::arbitrary<bool>() ? std::sqrt(2) * (1 + std::pow(10, *between(-17, -1)))
                                                   : std::pow(10, *between(-12, 4));
  const double flight = *rc::gen::arbitrary<bool>() ? std::pow(10, *between(-14, -1)) : *between(0.05, 3.1);
  RC_ASSERT(there_and_back_by_time(random_state(r, mu, speed, flight), mu) <= 32);
}

// A state near the parabola whose a and e alone lead to four times its distance, and one at 1e-12 of the
// escape speed, with e = 1 - 1e-24.
TEST(Conic, WhereEccentricityHasNoDigits) {
  const State near_parabola{{1.840044634817074, 0.35957490780779633, -1.419609631887766},
                            {0.1044560013603466, -0.8819905957380416, 0.24827633869444363}};
  EXPECT_LE(there_and_back_by_time(near_parabola, 1), 32);
  const State nearly_radial{{0.3, -0.1, 1.1}, {1e-12, 1e-12, -5e-13}};
  EXPECT_LE(there_and_back_by_time(nearly_radial, 1), 32);
  EXPECT_EQ(elements_of(nearly_radial, 1).eccentricity, 1);
}

TEST(Conic, WhatHasNoPlaceIsRefused) {
  const SineCosine half = sine_cosine_of_degrees(90);
  EXPECT_THROW((void)state_at_true_anomaly({1, 0}, plain, half, 1), std::invalid_argument);  // at infinity
  EXPECT_THROW((void)state_at_true_anomaly({1, -1}, plain, sine_cosine_of_degrees(65), 1),
               std::invalid_argument);
  EXPECT_THROW((void)state_at_true_anomaly({0, 1}, plain, half, 1), std::invalid_argument);
  EXPECT_THROW((void)state_at_true_anomaly({1, 1.1}, plain, half, 1), std::invalid_argument);
  EXPECT_THROW((void)state_at_eccentric_anomaly({1, -1}, plain, half, 1), std::invalid_argument);
  EXPECT_THROW((void)state_at_hyperbolic_anomaly({1, 1}, plain, 1, 1), std::invalid_argument);
  EXPECT_THROW((void)state_at_hyperbolic_anomaly({1, -1}, plain, 1e3, 1), std::invalid_argument);
  EXPECT_THROW((void)state_at_mean_anomaly({1, 0}, plain, 1, 1), std::invalid_argument);
  EXPECT_THROW((void)state_at_time({1, 0}, plain, NAN, 1), std::invalid_argument);
  EXPECT_THROW((void)state_at_time({1, 0}, plain, 1, 0), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::orbit::elements_test

/// States on conics from the ellipse over the parabola to the hyperbola, from each kind of anomaly, against
/// closed forms in 50 digits; and states to elements and back.
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

#include "nlmech/orbit/elements.hpp"
#include "tests/orbit/oracle.hpp"

namespace nlmech::orbit::conic_test {
namespace {

using namespace oracle;

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

// Angles near the apoapsis of a thin ellipse and near the asymptote of a parabola included.
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
}  // namespace nlmech::orbit::conic_test

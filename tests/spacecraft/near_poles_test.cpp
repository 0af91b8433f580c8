/// The step response where poles coincide, nearly coincide, lie beside s = 0 or far to the left: against
/// finite elements in time, the numerical inverse of the transform, and what it begins with.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "nlmech/spacecraft/response.hpp"
#include "tests/spacecraft/time_oracle.hpp"

namespace nlmech::spacecraft::near_poles_test {
namespace {

/// Held to finite elements at some times: within ten times what half as many elements change, and 1e-9 of the
/// largest value.
void expect_as_elements(const Parameters& p, const Gains& g, double x, std::initializer_list<double> times) {
  const std::array<double, 1> places = {x};
  const TimeResponse r = step_response(ClosedLoop(p, g), 1, places);
  ASSERT_TRUE(r.status.ok()) << g.k1 << ' ' << g.k2 << ' ' << g.k3 << ": " << r.status.text();
  const oracle::StepByElements coarse(p, g, x, 4), fine(p, g, x, 8);
  for (const double t : times) {
    const oracle::Moved a = coarse.at(t), b = fine.at(t);
    const double theta = r.theta.value(t), rate = r.theta_dot.value(t), y = r.deflection[0].value(t);
    EXPECT_NEAR(theta, b.theta, 10 * std::abs(a.theta - b.theta) + 1e-9)
        << g.k1 << ' ' << g.k3 << " at " << t;
    EXPECT_NEAR(rate, b.theta_dot, 10 * std::abs(a.theta_dot - b.theta_dot) + 1e-4 * r.theta_dot.envelope(0))
        << g.k1 << ' ' << g.k3 << " at " << t;
    EXPECT_NEAR(y, b.deflection,
                10 * std::abs(a.deflection - b.deflection) + 1e-4 * r.deflection[0].envelope(0))
        << g.k1 << ' ' << g.k3 << " at " << t;
  }
}

// A slow real pole beside s = 0 is no pair with it: theta began with 1 here.
TEST(NearPoles, ASlowRealPoleBesideZero) {
  for (const Gains& g : {Gains{5, 0, 90}, Gains{1, 0, 100}, Gains{12, 0, 150}, Gains{0.01, 0, 16}}) {
    const std::array<double, 1> places = {2};
    const TimeResponse r = step_response(ClosedLoop(table_3_1(), g), 1, places);
    // The sum of a hundred terms of order one.
    EXPECT_NEAR(r.theta.value(0), 0, 1e-13) << g.k1 << ' ' << g.k3;
    expect_as_elements(table_3_1(), g, 2, {0.3, 10});
  }
}

// However slow: with k1 tiny the angle is k1/k3 (t - J/k3 ...) and no digit of it comes from 1 - 1.
TEST(NearPoles, PolesFarSlowerThanTheModes) {
  for (const double k1 : {1e-6, 1e-12, 1e-40}) {
    const LoopPoles poles = ClosedLoop(table_3_1(), {k1, 0, 16}).poles(3);
    ASSERT_TRUE(poles.status.ok()) << poles.status.text();
    // -k1/k3 (1 + J k1/k3^2 + ...).
    EXPECT_NEAR(poles.s[0].real() / (-k1 / 16), 1, 1e-12 + 0.1 * k1) << k1;
    EXPECT_EQ(poles.s[0].imag(), 0);
  }
  // Two of them, of one size: s^2 J + k3 s + k1 = 0, (s + 1e-9)(s + 2e-9) J.
  const double j = table_3_1().total_inertia();
  const LoopPoles poles = ClosedLoop(table_3_1(), {2e-18 * j, 0, 3e-9 * j}).poles(3);
  ASSERT_TRUE(poles.status.ok()) << poles.status.text();
  EXPECT_NEAR(poles.s[0].real(), -1e-9, 1e-20);
  EXPECT_NEAR(poles.s[1].real(), -2e-9, 1e-20);
}

// A real pole near -k3/I_hub = -3125, faster than 800 modes of an appendage of 400 ft: without it the hub
// starts with a rate of 4e-5.
TEST(NearPoles, AFastRealPoleIsNotLeftOut) {
  Parameters p = table_3_1();
  p.length = 400;
  const ClosedLoop loop(p, {1, 0, 25000});
  const std::array<double, 1> places = {400};
  const TimeResponse r = step_response(loop, 1, places);
  ASSERT_TRUE(r.status.ok()) << r.status.text();
  // Of a largest rate of 4e-5 rad/s and 0.016 ft/s, what 800 pairs leave out.
  EXPECT_NEAR(r.theta_dot.value(0), 0, 4e-8);
  EXPECT_NEAR(r.deflection_dot[0].value(0), 0, 2e-5);
  const std::array<double, 2> times = {1e-4, 1e-3};
  const oracle::BromwichLine options{.half_period = 0.01, .shift = 1000, .frequency = 1e7};
  const auto theta = oracle::bromwich([&](Complex s) { return loop.response(s).theta / s; }, times, options);
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(r.theta.value(times[i]), theta[i], 1e-11);
}

// Without a hub and with strong rate feedback theta' rises from 0 to theta_f k1/k3 within 2e-16 s, 1/|p| of a
// real pole p = -5e15 1/s. The sum over the lowest modes lacks the modes of that boundary layer: its theta
// and y converge, and its theta' starts with -theta_f k1/k3.
TEST(NearPoles, ABoundaryLayerIsRefused) {
  Parameters p = table_3_1();
  p.hub_inertia = 0;
  p.mass_per_length = 0.0027187500000000002;
  p.youngs_modulus = 1584000000;
  p.length = 40;
  p.hub_radius = 0.10500192038491871;
  p.second_moment = 2.3393754031498719e-07;
  p.tip_mass = 0.69102922019098867;
  p.tip_inertia = 0.0053309941673492329;
  const ClosedLoop loop(p, {2.1928089690592794, -0.438268658879716, 92978.324489340695});
  const std::array<double, 1> places = {32};
  for (const int most : {100, 800, 1600}) {
    const TimeResponse r = step_response(loop, 1, places, {.most = most});
    EXPECT_EQ(r.status.outcome(), Outcome::not_converged) << most << r.status.text();
  }
}

// The same for gains that push it ever farther out, where the search went on for minutes or gave up, and
// without a hub, where it lies near -(k3/c)^2.
TEST(NearPoles, FastPolesHaveNoLimit) {
  for (const double k3 : {1e4, 1e7, 1e12, 1e20}) {
    const LoopPoles poles = ClosedLoop(table_3_1(), {12, 0, k3}).poles(4, PoleOrder::frequency);
    ASSERT_TRUE(poles.status.ok()) << k3 << poles.status.text();
    double fastest = 0;
    for (const Complex s : poles.s) fastest = std::min(fastest, s.real());
    // I_hub s + 2 B s + k3 = 0 with 2 B = c/sqrt(s) of the order 1e0.
    EXPECT_NEAR(fastest / (-k3 / 8), 1, 10 / std::sqrt(k3)) << k3;
  }
  Parameters light = table_3_1();
  light.hub_inertia = 0;
  const LoopPoles poles = ClosedLoop(light, {1, 0, 1e5}).poles(4, PoleOrder::frequency);
  ASSERT_TRUE(poles.status.ok()) << poles.status.text();
  double fastest = 0;
  for (const Complex s : poles.s) fastest = std::min(fastest, s.real());
  EXPECT_LT(fastest, -1e8);
}

/// s^2 B on the real axis.
double load(const Parameters& p, double s) { return s * s * Appendage(p).inertia(Complex(s)).real(); }

// A triple real pole: with P'' = 0 for kappa, P' = 0 for k3 and P = 0 for k1, and near it.
TEST(NearPoles, ThreeRealPolesCoincide) {
  const Parameters p = table_3_1();
  const std::array<double, 1> places = {2};
  for (const double at : {-3., -5.}) {
    const double h = 1e-3;
    const double curvature = (load(p, at + h) - 2 * load(p, at) + load(p, at - h)) / (h * h);
    const double kappa = -2 * p.hub_inertia / curvature;
    const auto inertia = [&](double s) { return s * s * p.hub_inertia + kappa * load(p, s); };
    const double k3 = -(inertia(at + h) - inertia(at - h)) / (2 * h), k1 = -inertia(at) - k3 * at;
    for (const double factor : {1., 1 + 1e-8, 1 + 1e-3}) {
      const ClosedLoop loop(p, {k1 * factor, kappa - 2, k3});
      const TimeResponse r = step_response(loop, 1, places);
      ASSERT_TRUE(r.status.ok()) << at << ' ' << factor << r.status.text();
      EXPECT_NEAR(r.theta.value(0), 0, 1e-9) << factor;
      EXPECT_NEAR(r.theta_dot.value(0), 0, 1e-8) << factor;
      const std::array<double, 3> times = {0.5, 3, 10};
      const auto theta =
          oracle::bromwich([&](Complex s) { return loop.response(s).theta / s; }, times, {.frequency = 2000});
      for (std::size_t i = 0; i < times.size(); ++i)
        EXPECT_NEAR(r.theta.value(times[i]), theta[i], 2e-8) << factor << " at " << times[i];
    }
  }
}

// A real pole beside two that coincide, in a fifteenth of their size: as a pole of its own it has a residue
// of 433, and 7e-9 of rounding. Truncation is within its bound, and rounding eps times the terms' sum.
TEST(NearPoles, ARealPoleBesideADoublePole) {
  Parameters p = table_3_1();
  p.hub_inertia = 1.3710700596399703, p.mass_per_length = 0.081182670798906023, p.length = 8.9743403732411409;
  p.hub_radius = 2.4914600457797231, p.second_moment = 1.7152810914248605e-08, p.tip_mass = p.tip_inertia = 0;
  const ClosedLoop loop(p, {320.03070077993152, 80.54873714825888, 1884.3912052735893});
  const std::array<double, 1> places = {6.64};
  for (const int pairs : {0, 256, 1024}) {
    const TimeResponse r = step_response(loop, 1, places, {.pairs = pairs});
    ASSERT_TRUE(r.status.ok()) << r.status.text();
    EXPECT_NEAR(r.theta.value(0), 0, r.bounds.theta + 2e-12 * r.theta.envelope(0)) << pairs;
    EXPECT_LT(r.theta.envelope(0), 200) << pairs;
  }
}

// Two pairs of complex poles that coincide, k2 = 0: the gains solve P = P' = 0 to all their
// digits; recorded.
TEST(NearPoles, TwoComplexPairsCoincide) {
  const std::array<double, 1> places = {2};
  for (const double factor : {1., 1 - 1e-8, 1 + 1e-4}) {
    const ClosedLoop loop(table_3_1(), {158.83060235789 * factor, 0, 78.86861803122});
    const TimeResponse r = step_response(loop, 1, places);
    ASSERT_TRUE(r.status.ok()) << factor << r.status.text();
    EXPECT_NEAR(r.theta.value(0), 0, 1e-11) << factor;
    EXPECT_NEAR(r.deflection_dot[0].value(0), 0, 1e-8) << factor;
    const std::array<double, 3> times = {0.5, 3, 10};
    const auto theta =
        oracle::bromwich([&](Complex s) { return loop.response(s).theta / s; }, times, {.frequency = 4000});
    for (std::size_t i = 0; i < times.size(); ++i)
      EXPECT_NEAR(r.theta.value(times[i]), theta[i], 1e-9) << factor << " at " << times[i];
  }
}

}  // namespace
}  // namespace nlmech::spacecraft::near_poles_test

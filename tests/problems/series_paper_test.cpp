/// The examples of Filipich and Rosales against reference values by extrapolation.
#include <gtest/gtest.h>

#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::problems::series_paper_test {
namespace {

using Real = ExtendedReal<50>;

Vector<double, Eigen::Dynamic> end(const TextProblem& problem, double end) {
  std::vector<Vector<Real, Eigen::Dynamic>> states;
  const std::vector<Real> times = {end};
  // 25 digits suffice for a result of sixteen: a chaotic motion of 50 units of time loses ten.
  const ReferenceOptions options{.order = 40, .tolerance = 1e-32};
  const Vector<Real, Eigen::Dynamic> x0 = problem.initial_state().cast<Real>();
  const Status status =
      reference_states<Real>(problem, x0, Real(problem.initial_time), times, states, options);
  EXPECT_TRUE(status.ok()) << status.text();
  return states.at(0).cast<double>();
}

// The printed references have 16 digits, the last of them rounded.
void expect_digits(double value, double reference) {
  EXPECT_NEAR(value, reference, 2e-15 * std::max(1.0, std::abs(reference)));
}

// oracle: algebraic_series_motions Lorenz as doubles ?(20)
TEST(SeriesPaper, Lorenz) {
  const auto x = end(TextProblem("lorenz"), 20);
  expect_digits(x[0], -1.356348984580824);
  expect_digits(x[1], -2.387300052277825);
  expect_digits(x[2], 12.38998499408630);
}

// oracle: algebraic_series_motions Duffing as doubles ?(50)
TEST(SeriesPaper, ForcedDuffing) {
  const auto x = end(TextProblem("forced-duffing"), 50);
  expect_digits(x[0], 1.221946638567542);
  expect_digits(x[1], 5.565479787665349);
}

// oracle: algebraic_series_motions oscillator as doubles x, oscillator as doubles v
TEST(SeriesPaper, StrongOscillator) {
  const TextProblem oscillator("oscillator");
  const auto x = end(oscillator, oscillator.final_time);
  expect_digits(x[0], -0.302938936512579);
  expect_digits(x[1], -0.198146428424555);
}

// oracle: algebraic_series_motions projectile highest at, projectile height, projectile lands at, projectile
// x, projectile y
TEST(SeriesPaper, ProjectileLands) {
  const auto x = end(TextProblem("projectile"), 9.84601516944855);
  EXPECT_NEAR(x[0], 38476.6981780052, 1e-9);  // as many decimals as printed: 1e-10, and the landing time's
  EXPECT_NEAR(x[1], 17355.9754745922, 1e-9);
  EXPECT_NEAR(x[2], 0, 1e-12);  // 50 m/s times the last digit of the landing time
  const auto apex = end(TextProblem("projectile"), 4.88588698119259833);
  expect_digits(apex[2], 121.165897244319719);
  EXPECT_NEAR(apex[5], 0, 1e-14);
}

TEST(SeriesPaper, WithoutWindTheProjectileStaysInItsPlane) {
  const auto x = end(TextProblem("projectile", {{"wind_x", 0}, {"wind_y", 0}}), 5);
  EXPECT_EQ(x[1], 0);
  EXPECT_EQ(x[4], 0);
}

// The initial velocities -0.00125 and 0.0005 as doubles differ by 1e-19 from the decimals; the encounters
// before t = 1000 do not amplify this beyond the last digit. Momentum and energy are conserved.
TEST(SeriesPaper, FourBodiesKeepMomentumAndEnergy) {
  const TextProblem bodies("bodies");
  const ReferenceTrajectory<long double, TextProblem> path(bodies, bodies.initial_state().cast<long double>(),
                                                           0, 3000);
  ASSERT_TRUE(path.status().ok()) << path.status().text();
  const auto kept = [&](double t) {
    return bodies.invariants(Real(t), Vector<Real, Eigen::Dynamic>(path(t).cast<Real>()));
  };
  const auto before = kept(0), after = kept(3000);
  for (int i = 0; i < 4; ++i) EXPECT_LT(abs(after[i] - before[i]), 1e-17) << i;
  // oracle: algebraic_series_motions bodies *
  const auto x = path(3000);
  // The rounding of doubles, 1e-16, is amplified by the encounters to about 1e-12 at t = 3000 (sensitivity of
  // the reference).
  const double body4[] = {-0.2510470313435667, 3.071464269641001, 0.9195961609759894};
  const double body1[] = {1.882222659858648, 2.142167279707004, 0.1432282180354737};
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(static_cast<double>(x[9 + c]), body4[c], 1e-12) << c;
    EXPECT_NEAR(static_cast<double>(x[c]), body1[c], 1e-12) << c;
  }
}

// By hand: two bodies at distance 2 attract each other with G m/4.
TEST(SeriesPaper, TwoBodiesByHand) {
  const TextProblem pair("bodies", {{"gravity", 8}, {"m1", 1}, {"m2", 3}, {"m3", 0}, {"m4", 0}});
  Vector<double, Eigen::Dynamic> x = pair.initial_state(), f(24);
  x[3] = 2;
  x[13] = 5;
  pair(0.0, x, f);
  EXPECT_EQ(f[1], 5);
  EXPECT_NEAR(f[12], 6, 4e-15);
  EXPECT_NEAR(f[15], -2, 2e-15);
  EXPECT_EQ(f[14], 0);
}

}  // namespace
}  // namespace nlmech::problems::series_paper_test

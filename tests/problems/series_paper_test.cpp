/// The examples of Filipich and Rosales against reference values by extrapolation.
#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>

#include "nlmech/problems/bodies.hpp"
#include "nlmech/problems/forced_duffing.hpp"
#include "nlmech/problems/lorenz.hpp"
#include "nlmech/problems/projectile.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/strong_oscillator.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::problems::series_paper_test {
namespace {

using Real = ExtendedReal<50>;

template <class Problem>
Vector<double, Problem::dimension> end(const Problem& problem, const Real& t0, const Real& duration) {
  constexpr int n = Problem::dimension;
  std::vector<Vector<Real, n>> states;
  const std::vector<Real> times = {t0 + duration};
  // 25 digits are enough for sixteen, with ten lost in 50 units of time of a chaotic motion.
  const ReferenceOptions options{.order = 40, .tolerance = 1e-32};
  const Vector<Real, n> x0 = Problem::initial_state().template cast<Real>();
  const Status status = reference_states<Real, Problem>(problem, x0, t0, times, states, options);
  EXPECT_TRUE(status.ok()) << status.text();
  return states.at(0).template cast<double>();
}

// The printed references have 16 digits, the last of them rounded.
void expect_digits(double value, double reference) {
  EXPECT_NEAR(value, reference, 2e-15 * std::max(1.0, std::abs(reference)));
}

// oracle: algebraic_series_motions Lorenz ?(20)
TEST(SeriesPaper, Lorenz) {
  const auto x = end(BasicLorenz<Real>{}, 0, 20);
  expect_digits(x[0], -1.356348984580380);
  expect_digits(x[1], -2.387300052277071);
  expect_digits(x[2], 12.38998499408597);
}

// oracle: algebraic_series_motions Duffing ?(50)
TEST(SeriesPaper, ForcedDuffing) {
  const auto x = end(BasicForcedDuffing<Real>{}, 0, 50);
  expect_digits(x[0], 1.221946638567542);
  expect_digits(x[1], 5.565479787665349);
}

// oracle: algebraic_series_motions oscillator x, oscillator v
TEST(SeriesPaper, StrongOscillator) {
  const auto x = end(BasicStrongOscillator<Real>{}, boost::math::constants::pi<Real>(), 375);
  expect_digits(x[0], -0.302938936512582);
  expect_digits(x[1], -0.198146428424553);
}

// oracle: algebraic_series_motions projectile highest at, projectile height, projectile lands at, projectile
// x, projectile y
TEST(SeriesPaper, ProjectileLands) {
  const auto x = end(BasicProjectile<Real>{}, 0, Real("9.84601516944855"));
  EXPECT_NEAR(x[0], 38476.6981780052, 1e-9);  // as many decimals as printed: 1e-10, and the landing time's
  EXPECT_NEAR(x[1], 17355.9754745922, 1e-9);
  EXPECT_NEAR(x[2], 0, 1e-12);  // 50 m/s times the last digit of the landing time
  const auto apex = end(BasicProjectile<Real>{}, 0, Real("4.88588698119259833"));
  expect_digits(apex[2], 121.165897244319719);
  EXPECT_NEAR(apex[5], 0, 1e-14);
}

TEST(SeriesPaper, WithoutWindTheProjectileStaysInItsPlane) {
  BasicProjectile<Real> calm;
  calm.wind_x = calm.wind_y = 0;
  const auto x = end(calm, 0, 5);
  EXPECT_EQ(x[1], 0);
  EXPECT_EQ(x[4], 0);
}

// The initial velocities -0.00125 and 0.0005 are taken as doubles: 1e-19 beside the decimals, which the
// encounters before t = 1000 do not enlarge beyond the last digit. Momentum and energy are kept.
TEST(SeriesPaper, FourBodiesKeepMomentumAndEnergy) {
  const BasicBodies<Real, 4> bodies;
  const Vector<Real, 24> x0 = BasicBodies<Real, 4>::initial_state().cast<Real>();
  const Vector<Real, 4> before = bodies.invariants(Real(0), x0);
  const ReferenceTrajectory<long double, BasicBodies<long double, 4>> path(
      BasicBodies<long double, 4>{}, FourBodies::initial_state().cast<long double>(), 0, 3000);
  ASSERT_TRUE(path.status().ok()) << path.status().text();
  const Vector<Real, 4> after = bodies.invariants(Real(0), Vector<Real, 24>(path(3000).cast<Real>()));
  for (int i = 0; i < 4; ++i) EXPECT_LT(abs(after[i] - before[i]), 1e-17) << i;
  // oracle: algebraic_series_motions bodies *
  const auto x = path(3000);
  // Double's 1e-16 grows by the encounters to t = 3000 to about 1e-12 (sensitivity of the reference).
  const double body4[] = {-0.2510470313435667, 3.071464269641001, 0.9195961609759894};
  const double body1[] = {1.882222659858648, 2.142167279707004, 0.1432282180354737};
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(static_cast<double>(x[9 + c]), body4[c], 1e-12) << c;
    EXPECT_NEAR(static_cast<double>(x[c]), body1[c], 1e-12) << c;
  }
}

// By hand: two bodies at distance 2 pull with G m/4.
TEST(SeriesPaper, TwoBodiesByHand) {
  Bodies<2> pair;
  pair.gravity = 8;
  pair.mass = {1, 3};
  Vector<double, 12> x = Vector<double, 12>::Zero(), f;
  x[3] = 2;
  x[7] = 5;
  pair(0.0, x, f);
  EXPECT_EQ(f[1], 5);
  EXPECT_NEAR(f[6], 6, 4e-15);
  EXPECT_NEAR(f[9], -2, 2e-15);
  EXPECT_EQ(f[8], 0);
}

}  // namespace
}  // namespace nlmech::problems::series_paper_test

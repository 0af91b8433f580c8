/// Misprints of the source about assumed modes and the hub (Eqs. 3.45 to 3.49), and what its closed form is
/// worth in doubles.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "nlmech/spacecraft/plant/closed_form.hpp"
#include "nlmech/spacecraft/plant/discrete_model.hpp"
#include "nlmech/spacecraft/plant/plant.hpp"
#include "nlmech/spacecraft/plant/poles.hpp"
#include "tests/errata/erratum.hpp"
#include "tests/spacecraft/oracle_poles.hpp"

namespace nlmech::spacecraft::errata_modes_test {
namespace {

using tests::expect_erratum;

// Eq. 3.45: cos(i pi x)/L is no admissible function, cos(i pi x/L) is: phi(0) must be 0.
TEST(Errata, TheAssumedFunctionsAreHeldAtTheRoot) {
  const double l = 4, pi = std::numbers::pi;
  const auto printed = [&](double x) { return 1 - std::cos(pi * x) / l + std::pow(pi * x / l, 2) / 2; };
  const DiscreteModel model = assumed_modes(table_3_1(), 5);
  expect_erratum(
      "gss_control-3.45",
      {.printed = printed(0), .corrected = model.shape(0)[0], .oracle = 0, .tolerance = 1e-15, .scale = 1});
  EXPECT_EQ(model.shape(0).cwiseAbs().maxCoeff(), 0);
  EXPECT_LE(model.shape(1e-8).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_NEAR(model.shape(4)[0], 2 + pi * pi / 2, 1e-14 * 7);
  EXPECT_NEAR(model.shape(4)[1], -2 * pi * pi, 1e-14 * 20);
}

// Eq. 3.48: without EI in the stiffness the first mode is off by 1/sqrt(EI) = 0.116.
TEST(Errata, TheStiffnessHoldsTheBendingStiffness) {
  const Parameters p = without_tip(table_3_1());
  DiscreteModel model = assumed_modes(p, 10);
  const double corrected = diagonalise(model).omega[0];
  model.stiffness /= p.bending_stiffness();
  const double printed = diagonalise(model).omega[0];
  EXPECT_NEAR(printed, 12.857 / std::sqrt(p.bending_stiffness()), 1e-3);
  // Ten modes have the first frequency to 2e-5.
  expect_erratum("gss_control-3.48", {printed, corrected, oracle::pole(p, 11.52, 14), 3e-5});
  // M_qq, missing, for phi = 1 - cos k + k^2/2 with k = pi x/L: integrals over x/L of (1 - cos k)^2, of (1 -
  // cos k) k^2, of k^4/4.
  const double pi = std::numbers::pi, square = 1.5 + (pi * pi / 3 + 2) + std::pow(pi, 4) / 20;
  EXPECT_NEAR(assumed_modes(p, 1).mass(0, 0) / (2 * p.mass_per_length * p.length * square), 1, 1e-14);
}

// Figures 3.5 and 3.6: "a slight truncation error". With tips the tenth frequency of ten modes is 17 % high.
TEST(Errata, TenModesDoNotMeetTheTip) {
  const Parameters p = table_3_1();
  const double exact = oracle::pole(p, 2348.2, 2400);  // after the hub-locked frequency 2348.19
  expect_erratum("gss_control-figure-3.5", {.printed = diagonalise(assumed_modes(p, 10)).omega[9],
                                            .corrected = poles(Plant(p), 10).omega[9],
                                            .oracle = exact,
                                            .tolerance = 1e-12});
}

// Eq. 3.49: two appendages act on the hub. With one, the first poles are 5.53133 and 51.7418 rad/s.
TEST(Errata, TwoAppendagesActOnTheHub) {
  const Plant plant(table_3_1());
  const auto with = [&](double kappa) {
    return [&plant, kappa](Complex s) {
      return plant.effective_inertia(plant.appendage().motion_with_slope(s), kappa);
    };
  };
  const Roots one = find_roots(with(1), {-1, 1.3, 1, 60}), two = find_roots(with(2), {-1, 1.3, 1, 60});
  ASSERT_EQ(one.roots.size(), 2U);
  ASSERT_EQ(two.roots.size(), 2U);
  EXPECT_NEAR(one.roots[0].imag(), 5.53133, 5e-6);
  EXPECT_NEAR(one.roots[1].imag(), 51.7418, 5e-5);
  // Hub-locked frequencies lie at 4.37, 51.40 and 155.7.
  const std::array<double, 2> exact = {oracle::pole(table_3_1(), 4.4, 9),
                                       oracle::pole(table_3_1(), 51.41, 60)};
  for (std::size_t i = 0; i < 2; ++i)
    expect_erratum("gss_control-3.49-two", {one.roots[i].imag(), two.roots[i].imag(), exact[i], 2e-12});
}

// The closed form is right on paper and loses digits: e^(2 q L) at high frequency, 1/omega^2 at low.
TEST(Errata, TheClosedFormLosesDigitsAtBothEnds) {
  const Plant plant(table_3_1());
  const auto error = [&](double omega) {
    const GssSolution<Complex> z(plant.parameters(), {0, omega});
    const AxisResponse r = plant.at_frequency(omega, 2);
    return std::array<double, 2>{std::abs(z.theta(2) / r.theta - 1.),
                                 std::abs(z.deflection(2) / r.deflection - 1.)};
  };
  EXPECT_LT(error(1)[0], 1e-14);
  EXPECT_LT(error(10)[1], 1e-13);
  EXPECT_GT(error(300)[0], 1e-11);
  EXPECT_GT(error(1000)[0], 1e-3);
  EXPECT_GT(error(1e-3)[1], 1e-10);
  EXPECT_GT(error(1e-6)[1], 1e-4);
  EXPECT_FALSE(std::isfinite(std::abs(GssSolution<Complex>(plant.parameters(), {0, 4e5}).theta(2))));
}

}  // namespace
}  // namespace nlmech::spacecraft::errata_modes_test

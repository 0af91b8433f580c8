/// Margins of the torque loop: known sensitivity peaks and delays, the argument principle with a delay,
/// crossovers; and gains of minimum cost.
#include "nlmech/spacecraft/control/margins.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "nlmech/spacecraft/control/optimal_gains.hpp"
#include "nlmech/spacecraft/response.hpp"
#include "tests/spacecraft/random_spacecraft.hpp"
#include "tests/thrown.hpp"

namespace nlmech::spacecraft::margins_test {
namespace {

using std::numbers::pi;

TEST(Sensitivity, HasThePublishedPeaks) {
  const std::vector<SensitivityPeak> unit = sensitivity_peaks(ClosedLoop(table_3_1(), unit_gains), 20);
  ASSERT_EQ(unit.size(), 20u);
  // To all its digits. oracle: gss_control_loop unit sensitivity*, designed sensitivity
  const std::array<double, 6> expected = {3.78, 19.4, 139.8, 416.8, 794, 1245};
  const std::array<double, 6> half_a_unit = {0.005, 0.05, 0.05, 0.05, 0.5, 0.5};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(unit[i].value, expected[i], half_a_unit[i]);
  EXPECT_NEAR(unit[19].value, 2.64e4, 50);
  EXPECT_NEAR(unit[19].omega, 9902, 0.5);
  const std::vector<SensitivityPeak> designed =
      sensitivity_peaks(ClosedLoop(table_3_1(), designed_gains), 20);
  EXPECT_NEAR(designed[0].value, 1.111, 5e-4);
  for (std::size_t i = 1; i < 20; ++i) EXPECT_LT(designed[i].value, 1.02);
}

// A maximum: larger than at neighbouring frequencies; and |S| = 1/|1 + L| by the loop gain.
TEST(Sensitivity, IsThatOfTheLoopGain) {
  const ClosedLoop loop(table_3_1(), unit_gains);
  for (const SensitivityPeak& p : sensitivity_peaks(loop, 6)) {
    EXPECT_NEAR(p.value * std::abs(1. + loop_gain(loop, p.omega)), 1, 1e-8);
    EXPECT_GT(p.value, sensitivity(loop, p.omega * (1 - 1e-5)));
    EXPECT_GT(p.value, sensitivity(loop, p.omega * (1 + 1e-5)));
  }
}

// The scene delay-margin counts unstable poles.
TEST(DelayMargin, OfUnitAndDesignedGains) {
  const ClosedLoop unit(table_3_1(), unit_gains), designed(table_3_1(), designed_gains);
  EXPECT_LT(margins(unit, 9).delay_margin, 10e-6);
  const double designed_margin = margins(designed, 9).delay_margin;
  EXPECT_GT(designed_margin, 1e-3);
  // With k2 = 0, L is imaginary except for k1 at a high mode: a quarter of a period, pi/(2 omega).
  EXPECT_NEAR(designed_margin, pi / 2 / designed.poles(9).s[8].imag(), 2e-3 * designed_margin);
  // The optimum without root-load feedback tolerates a delay that the one with it does not.
  const OptimalGains pd = optimal_pd_gains(table_3_1(), {100, 1 / 144.});
  EXPECT_EQ(delayed_poles(ClosedLoop(table_3_1(), pd.gains), 1e-3, 9).unstable, 0);
}

// Just below the margin all modes are stable with the delay, just above it one is not.
TEST(DelayMargin, IsWhereTheFirstPolePasses) {
  for (const Gains& g :
       {unit_gains, designed_gains, Gains{12, 4.83, 31.9}, Gains{12, -1.9, 16}, Gains{12, 1e3, 16}}) {
    const ClosedLoop loop(table_3_1(), g);
    const double margin = margins(loop, 7).delay_margin;
    EXPECT_EQ(delayed_poles(loop, margin * (1 - 1e-6), 7).unstable, 0) << g.k2;
    EXPECT_EQ(delayed_poles(loop, margin * (1 + 1e-6), 7).unstable, 1) << g.k2;
  }
}

// The tracked poles in the right half plane are all that the argument principle counts.
TEST(DelayedPoles, AreThoseTheArgumentPrincipleCounts) {
  for (const double delay : {1e-5, 1e-3, 1e-2}) {
    for (const Gains& g : {unit_gains, designed_gains}) {
      const ClosedLoop loop(table_3_1(), g);
      const AnalyticFunction f = [&](Complex s) {
        const Motion<Jet> motion = loop.plant().appendage().motion_with_slope(s);
        const Jet z = Jet::variable(s);
        const Jet feedback = (g.k3 * z + Jet(g.k1)) * motion.determinant +
                             g.k2 * z * z * loop.plant().appendage().inertia(motion);
        return z * z * loop.plant().effective_inertia(motion) + exp(-delay * z) * feedback;
      };
      // The boundary between modes 9 and 10 does not pass a pole.
      const LoopPoles poles = loop.poles(10);
      const double top = (poles.s[8].imag() + poles.s[9].imag()) / 2;
      const RootCount count = count_roots(f, {1e-9, 500, 1e-3, top});
      ASSERT_TRUE(count.status.ok()) << count.status.text();
      const DelayedPoles followed = delayed_poles(loop, delay, 9);
      EXPECT_TRUE(followed.status.ok());
      EXPECT_EQ(followed.unstable, count.count) << "delay " << delay << ", k1 " << g.k1;
    }
  }
}

TEST(Margins, FindEveryCrossover) {
  const ClosedLoop loop(table_3_1(), designed_gains);
  const Margins m = margins(loop, 9);
  ASSERT_TRUE(m.status.ok());
  // One of the rigid mode and two next to each open-loop pole.
  EXPECT_EQ(m.crossovers.size(), 17u);
  for (const Crossover& c : m.crossovers) {
    const Complex gain = loop_gain(loop, c.omega);
    // omega has a rounding error, which the resonance amplifies.
    EXPECT_NEAR(std::abs(gain), 1, 1e-7);
    EXPECT_LT(std::abs(gain * std::polar(1., -c.omega * c.delay) + 1.), 1e-7);
    EXPECT_NEAR(std::remainder(std::arg(-gain) - c.phase_margin, 2 * pi), 0, 1e-7);
  }
  EXPECT_TRUE(std::isinf(m.gain_margin));
  EXPECT_NEAR(m.phase_margin, 0.951104, 1e-6);
}

// With k2 = 0 the appendages change the phase of L by pi or 0: it is that of k1 + j k3 omega, for any |L|.
// Near these resonances L changes by 1e11 times the relative change of omega.
TEST(Margins, PhasesWithoutRootLoadFeedbackAreTheLaws) {
  Parameters p = table_3_1();
  p.hub_inertia = 41.8, p.mass_per_length = 0.0122, p.length = 0.4, p.hub_radius = 0,
  p.second_moment = 9.3e-9;
  p.tip_mass = p.tip_inertia = 0;
  const Margins m = margins(ClosedLoop(p, {10354, 0, 1312}), 4);
  ASSERT_TRUE(m.status.ok());
  EXPECT_GE(m.crossovers.size(), 3u);
  for (const Crossover& c : m.crossovers) {
    const double law = std::atan2(1312 * c.omega, 10354);
    EXPECT_NEAR(std::remainder(c.phase_margin - law, pi), 0, 1e-14) << c.omega;
    EXPECT_NEAR(std::abs(std::remainder(c.delay * c.omega - c.phase_margin, 2 * pi)), 0, 1e-14) << c.omega;
  }
}

// The phase margin of the rigid spacecraft in closed form: the first crossover of nearly rigid appendages.
TEST(Margins, TendToTheRigidSpacecrafts) {
  Parameters stiff = table_3_1();
  stiff.youngs_modulus *= 1e8;
  const Margins m = margins(ClosedLoop(stiff, designed_gains), 1);
  const double j = stiff.total_inertia(), k1 = 12, k3 = 16;
  const double square = (k3 * k3 + std::sqrt(std::pow(k3, 4) + 4 * k1 * k1 * j * j)) / (2 * j * j);
  ASSERT_FALSE(m.crossovers.empty());
  EXPECT_NEAR(m.crossovers[0].omega, std::sqrt(square), 1e-6);
  EXPECT_NEAR(m.crossovers[0].phase_margin, std::atan(k3 * std::sqrt(square) / k1), 1e-6);
}

// With all gains times g < -2/k2 the loop is stable; beyond it is refused as unstable.
TEST(Margins, GainMarginOfNegativeRootLoadFeedback) {
  const ClosedLoop loop(table_3_1(), {12, -0.5, 16});
  const double margin = margins(loop, 5).gain_margin;
  EXPECT_EQ(margin, 4);
  EXPECT_NO_THROW(ClosedLoop(table_3_1(), {3.99 * 12, 3.99 * -0.5, 3.99 * 16}));
  EXPECT_THROW(ClosedLoop(table_3_1(), {4.01 * 12, 4.01 * -0.5, 4.01 * 16}), std::invalid_argument);
}

TEST(Margins, RefuseBadInput) {
  const ClosedLoop loop(table_3_1(), designed_gains);
  EXPECT_THROW((void)margins(loop, 0), std::invalid_argument);
  EXPECT_THROW((void)margins(ClosedLoop(table_3_1(), {0, 0, 1}), 3), std::invalid_argument);
  EXPECT_THROW((void)sensitivity_peaks(ClosedLoop(table_3_1(), {1, 0, 0}), 3), std::invalid_argument);
  EXPECT_THROW((void)delayed_poles(loop, -1, 3), std::invalid_argument);
  EXPECT_THROW((void)delayed_poles(loop, std::nan(""), 3), std::invalid_argument);
}

// ---- Costs of a step: closed forms against sums of residues in time; optimal gains: no other gains have a
// smaller cost. The chapter's scene records their values.

constexpr double price = 1 / 144.;

double torque_by_residues(const ClosedLoop& loop, int pairs) {
  return square_integral(step_response(loop, 1, {}, {.pairs = pairs}).torque).value;
}

void expect_costs_of_residues(const Parameters& p, const Gains& g, double x) {
  const ClosedLoop loop(p, g);
  const std::array<double, 1> places = {x};
  const TimeResponse r = step_response(loop, 1, places, {.pairs = 128});
  ASSERT_TRUE(r.status.ok()) << r.status.text();
  const StepCosts c = step_costs(p, g, x);
  const ExponentialSum error({}, r.theta.poles(), r.theta.weights());
  // The costs of e^2 and y^2 converge fast; the others have the error of the truncated sum.
  EXPECT_NEAR(square_integral(error).value / c.error, 1, 1e-11) << g.k2;
  EXPECT_NEAR(square_integral(r.theta_dot).value / c.rate, 1, 1e-9) << g.k2;
  EXPECT_NEAR(square_integral(r.deflection[0]).value / c.deflection, 1, 1e-10) << g.k2;
  EXPECT_NEAR(square_integral(r.deflection_dot[0]).value / c.deflection_dot, 1, 1e-5) << g.k2;
  // With k2 != 0 the torque's residues decrease as 1/n^2; the sum of their squares lacks a/n + b/n^2 + ...
  const double some = torque_by_residues(loop, 64), more = torque_by_residues(loop, 128),
               most = torque_by_residues(loop, 256);
  const double first = 2 * more - some, second = 2 * most - more;
  EXPECT_NEAR((g.k2 == 0 ? most : (4 * second - first) / 3) / c.torque, 1, 1e-6) << g.k2;
}

// Costs from sums of residues in time, without contours. One of the spacecraft has poles near a hub-locked
// resonance: damping as large as the frequency just below the first, and no poles up to the second.
TEST(StepCosts, AreThoseOfTheResiduesInTime) {
  for (const Gains& g :
       {unit_gains, designed_gains, Gains{12, 4.82952499282, 31.9283386251}, Gains{3, -1.5, 5}}) {
    for (const double x : {2., 4.}) expect_costs_of_residues(table_3_1(), g, x);
  }
  Parameters p = table_3_1();
  p.hub_inertia = 32.2, p.mass_per_length = 0.00414, p.length = 10.3, p.hub_radius = 0.351;
  p.second_moment = 6.45e-9, p.tip_mass = 1.569, p.tip_inertia = 0.00795;
  expect_costs_of_residues(p, {3.224, 0.00876, 50.39}, p.length);
  // Each parameter times three and over three, with and without tip.
  for (double Parameters::*const field :
       {&Parameters::hub_inertia, &Parameters::mass_per_length, &Parameters::length, &Parameters::hub_radius,
        &Parameters::second_moment, &Parameters::tip_mass, &Parameters::tip_inertia}) {
    for (const double factor : {1 / 3., 3.}) {
      p = factor > 1 ? without_tip(table_3_1()) : table_3_1();
      p.*field *= factor;
      expect_costs_of_residues(p, {5 * factor, factor, 9}, p.length / 2);
    }
  }
}

// With k2 = 0 e^2 and u^2 do not depend on the bending: the costs of the rigid body.
TEST(StepCosts, WithoutRootLoadAreRigid) {
  Parameters stiff = table_3_1();
  stiff.youngs_modulus *= 1e6;
  const StepCosts flexible = step_costs(table_3_1(), designed_gains, 4),
                  rigid = step_costs(stiff, designed_gains, 4);
  EXPECT_DOUBLE_EQ(flexible.error, rigid.error);
  EXPECT_DOUBLE_EQ(flexible.torque, rigid.torque);
  EXPECT_NEAR(rigid.deflection, flexible.deflection * 1e-12, 1e-20);
}

TEST(StepCosts, RefuseBadInput) {
  EXPECT_THROW((void)step_costs(table_3_1(), {0, 0, 1}, 2), std::invalid_argument);
  EXPECT_THROW((void)step_costs(table_3_1(), {1, 0, 0}, 2), std::invalid_argument);
  EXPECT_THROW((void)step_costs(table_3_1(), {1, -2, 1}, 2), std::invalid_argument);
  EXPECT_THROW((void)step_costs(table_3_1(), unit_gains, 5), std::invalid_argument);
}

RC_GTEST_PROP(OptimalGains, CostLessThanAnyOther, ()) {
  const Parameters p = *random_spacecraft();
  const CostWeights w{std::pow(10, *between(-2, 5)), std::pow(10, *between(-5, 2))};
  const OptimalGains full = optimal_gains(p, w), pd = optimal_pd_gains(p, w);
  // The cost of the optimal gains equals the stated cost, to a few rounding errors.
  RC_ASSERT(std::abs(cost(p, full.gains, w) / full.cost - 1) < 1e-13);
  RC_ASSERT(std::abs(cost(p, pd.gains, w) / pd.cost - 1) < 1e-13);
  RC_ASSERT(full.cost <= pd.cost * (1 + 1e-14));
  const double f1 = std::pow(10, *between(-1, 1)), f3 = std::pow(10, *between(-1, 1));
  const Gains any{full.gains.k1 * f1, -2 + (2 + full.gains.k2) * std::pow(10, *between(-1, 1)),
                  full.gains.k3 * f3};
  RC_ASSERT(cost(p, any, w) >= full.cost * (1 - 1e-13));
  RC_ASSERT(cost(p, {pd.gains.k1 * f1, 0, pd.gains.k3 * f3}, w) >= pd.cost * (1 - 1e-13));
}

// W = 0: the regulator of a rigid body, k3 = sqrt(2 k1 J), which the hand-tuned gains exceed by 3.5 %.
TEST(OptimalGains, WithoutDeflectionAreTheRigidRegulators) {
  const Parameters p = table_3_1();
  const OptimalGains best = optimal_gains(p, {0, price});
  EXPECT_EQ(best.gains.k2, 0);
  EXPECT_NEAR(best.gains.k3, std::sqrt(2 * 12 * p.total_inertia()), 1e-12);
  EXPECT_NEAR(cost(p, designed_gains, {0, price}) / best.cost, 1.035, 5e-4);
}

TEST(OptimalGains, StandExtremes) {
  Parameters hubless = table_3_1();
  hubless.hub_inertia = 0;
  for (const Parameters& p : {table_3_1(), without_tip(table_3_1()), hubless}) {
    for (const double w : {0., 1e-12, 1e12}) {
      for (const double r : {1e-12, 1., 1e12}) {
        const OptimalGains best = optimal_gains(p, {w, r});
        EXPECT_TRUE(std::isfinite(best.cost) && best.gains.k1 > 0 && best.gains.k3 > 0 && best.gains.k2 >= 0);
        EXPECT_NEAR(cost(p, best.gains, {w, r}) / best.cost, 1, 1e-12);
      }
    }
  }
}

TEST(OptimalGains, RefuseBadWeightsByName) {
  const auto message = [](const CostWeights& w) {
    return tests::thrown<std::invalid_argument>([&] { return optimal_gains(table_3_1(), w); });
  };
  EXPECT_TRUE(tests::holds(message({-1, 1}), "deflection is -1"));
  EXPECT_TRUE(tests::holds(message({1, 0}), "torque is 0"));
  EXPECT_TRUE(tests::holds(message({1, std::nan("")}), "torque"));
  EXPECT_THROW((void)optimal_pd_gains(table_3_1(), {1, -1}), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::spacecraft::margins_test

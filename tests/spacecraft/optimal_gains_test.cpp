/// Costs of a step: closed forms against sums of residues in time; optimal gains: no other gains cost less.
/// The chapter's scene holds their values.
#include "nlmech/spacecraft/control/optimal_gains.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "nlmech/spacecraft/response.hpp"
#include "tests/spacecraft/random_spacecraft.hpp"

namespace nlmech::spacecraft::optimal_gains_test {
namespace {

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
  // Those of e^2 and y^2 converge fast; the others are as far off as what is left out.
  EXPECT_NEAR(square_integral(error).value / c.error, 1, 1e-11) << g.k2;
  EXPECT_NEAR(square_integral(r.theta_dot).value / c.rate, 1, 1e-9) << g.k2;
  EXPECT_NEAR(square_integral(r.deflection[0]).value / c.deflection, 1, 1e-10) << g.k2;
  EXPECT_NEAR(square_integral(r.deflection_dot[0]).value / c.deflection_dot, 1, 1e-5) << g.k2;
  // With k2 != 0 the torque's residues fall like 1/n^2, and their squares' sum lacks a/n + b/n^2 + ...
  const double some = torque_by_residues(loop, 64), more = torque_by_residues(loop, 128),
               most = torque_by_residues(loop, 256);
  const double first = 2 * more - some, second = 2 * most - more;
  EXPECT_NEAR((g.k2 == 0 ? most : (4 * second - first) / 3) / c.torque, 1, 1e-6) << g.k2;
}

// The sums of residues in time know nothing of contours. One of the spacecraft has poles beside a hub-locked
// resonance: as much damping as frequency just below the first, and none up to the second.
TEST(StepCosts, AreThoseOfTheResiduesInTime) {
  for (const Gains& g :
       {unit_gains, designed_gains, Gains{12, 4.82952499282, 31.9283386251}, Gains{3, -1.5, 5}}) {
    for (const double x : {2., 4.}) expect_costs_of_residues(table_3_1(), g, x);
  }
  Parameters p = table_3_1();
  p.hub_inertia = 32.2, p.mass_per_length = 0.00414, p.length = 10.3, p.hub_radius = 0.351;
  p.second_moment = 6.45e-9, p.tip_mass = 1.569, p.tip_inertia = 0.00795;
  expect_costs_of_residues(p, {3.224, 0.00876, 50.39}, p.length);
  // Each entry three times as large and a third, with and without tip.
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

// With k2 = 0, e^2 and u^2 do not know that the appendages bend: the rigid body's costs.
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
  // The cost of the optimal gains is the cost stated, to a few roundings.
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
  const auto message = [](const CostWeights& w) -> std::string {
    try {
      (void)optimal_gains(table_3_1(), w);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(message({-1, 1}).find("deflection is -1"), std::string::npos);
  EXPECT_NE(message({1, 0}).find("torque is 0"), std::string::npos);
  EXPECT_NE(message({1, std::nan("")}).find("torque"), std::string::npos);
  EXPECT_THROW((void)optimal_pd_gains(table_3_1(), {1, -1}), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::spacecraft::optimal_gains_test

/// Costs of the step response: closed forms against quadrature over frequency and against sums of residues.
#include "nlmech/spacecraft/control/parseval.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "nlmech/spacecraft/control/optimal_gains.hpp"
#include "nlmech/spacecraft/response.hpp"

namespace nlmech::spacecraft::parseval_test {
namespace {

/// int_0^inf f^2 dt of a sum of exponentials, pole by pole: -sum w_i w_j/(p_i + p_j) over all poles,
/// conjugates included.
double square_integral(const ExponentialSum& f) {
  std::vector<Complex> p, w;
  for (std::size_t k = 0; k < f.poles().size(); ++k) {
    for (const bool conjugate : {false, true}) {
      p.push_back(conjugate ? std::conj(f.poles()[k]) : f.poles()[k]);
      w.push_back(conjugate ? std::conj(f.weights()[k]) : f.weights()[k]);
    }
  }
  Complex sum = 0;
  for (std::size_t i = p.size(); i-- > 0;) {
    for (std::size_t j = p.size(); j-- > 0;) sum -= w[i] * w[j] / (p[i] + p[j]);
  }
  return sum.real();
}

// The sums of residues in time know nothing of contours. Those of e^2 and y^2 converge fast; the others are
// as far off as what is left out.
TEST(StepCosts, AreThoseOfTheResiduesInTime) {
  const std::array<double, 2> places = {2, 4};
  for (const Gains& g : {unit_gains, designed_gains, Gains{12, 4.83, 31.9}, Gains{3, -1.5, 5}}) {
    const ClosedLoop loop(table_3_1(), g);
    const TimeResponse r = step_response(loop, 1, places, {.pairs = 60});
    const ExponentialSum error({}, r.theta.poles(), r.theta.weights());
    for (std::size_t i = 0; i < 2; ++i) {
      const StepCosts c = step_costs(table_3_1(), g, places[i]);
      EXPECT_NEAR(square_integral(error) / c.error, 1, 1e-11);
      EXPECT_NEAR(square_integral(r.theta_dot) / c.rate, 1, 1e-9);
      EXPECT_NEAR(square_integral(r.deflection[i]) / c.deflection, 1, 1e-10);
      EXPECT_NEAR(square_integral(r.deflection_dot[i]) / c.deflection_dot, 1, 1e-5);
      // With k2 != 0 the torque's residues fall like 1/n^2: their squares' sum lacks a part of the order 1/n.
      EXPECT_NEAR(square_integral(r.torque) / c.torque, 1, g.k2 == 0 ? 1e-9 : 3e-3);
    }
  }
}

TEST(StepCosts, AreThoseOfTheQuadratureOverFrequency) {
  for (const Gains& g :
       {unit_gains, designed_gains, Gains{12, 4.82952499282, 31.9283386251}, Gains{3, -1.5, 5}}) {
    const StepCosts c = step_costs(table_3_1(), g, 4);
    const QuadratureCosts q = costs_by_quadrature(table_3_1(), g, 4);
    ASSERT_TRUE(q.status.ok()) << q.status.text();
    // e and y: Gauss's rule on resonances 1e4 times as high as wide. u: the tail, extrapolated.
    EXPECT_NEAR(q.error / c.error, 1, 1e-10) << g.k2;
    EXPECT_NEAR(q.deflection / c.deflection, 1, 1e-11) << g.k2;
    EXPECT_NEAR(q.torque / c.torque, 1, 1e-7) << g.k2;
  }
}

// Rigid poles with as much damping as frequency just below the first hub-locked resonance, and none up to the
// second: an integral over all of this length at once is off by 1/180.
TEST(StepCosts, PolesBesideAHubLockedResonance) {
  Parameters p = table_3_1();
  p.hub_inertia = 32.2, p.mass_per_length = 0.00414, p.length = 10.3, p.hub_radius = 0.351;
  p.second_moment = 6.45e-9, p.tip_mass = 1.569, p.tip_inertia = 0.00795;
  const Gains g{3.224, 0.00876, 50.39};
  const StepCosts c = step_costs(p, g, p.length);
  const QuadratureCosts q = costs_by_quadrature(p, g, p.length);
  ASSERT_TRUE(q.status.ok()) << q.status.text();
  // As for the gains of the source.
  EXPECT_NEAR(q.error / c.error, 1, 1e-10);
  EXPECT_NEAR(q.deflection / c.deflection, 1, 1e-11);
  EXPECT_NEAR(q.torque / c.torque, 1, 1e-7);
}

// Other spacecraft: each entry three times as large and a third, with and without tip.
TEST(StepCosts, AreThoseOfTheQuadratureForOtherSpacecraft) {
  for (double Parameters::*const field :
       {&Parameters::hub_inertia, &Parameters::mass_per_length, &Parameters::length, &Parameters::hub_radius,
        &Parameters::second_moment, &Parameters::tip_mass, &Parameters::tip_inertia}) {
    for (const double factor : {1 / 3., 3.}) {
      Parameters p = table_3_1();
      p.*field *= factor;
      if (factor > 1) p = without_tip(p);
      const Gains g{5 * factor, factor, 9};
      const StepCosts c = step_costs(p, g, p.length / 2);
      const QuadratureCosts q = costs_by_quadrature(p, g, p.length / 2, 48);
      ASSERT_TRUE(q.status.ok()) << q.status.text();
      // Poles far from the axis are the worse for the fixed rule; u: the tail after 48 modes.
      EXPECT_NEAR(q.error / c.error, 1, 1e-8);
      EXPECT_NEAR(q.deflection / c.deflection, 1, 1e-8);
      EXPECT_NEAR(q.torque / c.torque, 1, 1e-5);
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
  EXPECT_THROW((void)costs_by_quadrature(table_3_1(), unit_gains, 2, 8), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::spacecraft::parseval_test

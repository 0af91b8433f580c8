// What problems say of themselves: the equation as text, bounds, conserved sums.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "nlmech/ivp/system.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/support/errors.hpp"
#include "tests/problems/oracle.hpp"
#include "tests/problems/text.hpp"

namespace nlmech::problems::tests::statements_test {
namespace {

RC_GTEST_PROP(Texts, SumsOfConcentrationsAreConserved, ()) {
  std::vector<double> x(3), y(8);
  for (double& component : x) component = *between(-1, 1);
  for (double& component : y) component = *between(-1, 1);
  // Terms up to k3 = 3e7, and to k_plus; a handful of roundings.
  RC_ASSERT(Text("robertson").drift(x) <= 8 * 3e7 * epsilon);
  RC_ASSERT(Text("hires", {{"k_plus", *between(0, 1e4)}}).drift(y) <= 8 * 1e4 * epsilon);
}

/// A place of the plane at a distance from the origin of 0.5 to 2.
Vector<double, 2> place() {
  const double angle = *between(0, 6.28), distance = *between(0.5, 2);
  return {distance * std::cos(angle), distance * std::sin(angle)};
}

// Terms are products of velocities up to 2, accelerations up to 8 and their factors: below 64, some ten of
// them.
RC_GTEST_PROP(Texts, MotionsOfBodiesConserveWhatTheySay, ()) {
  const Vector<double, 2> q = place(), v = place();
  const Text kepler("kepler", {{"mu", *between(0.5, 2)}});
  RC_ASSERT(kepler.equations.conserved().size() == 2);
  RC_ASSERT(kepler.drift({q[0], q[1], v[0], v[1]}) <= 1000 * epsilon);
  // Half a unit from the earth and a tenth from the moon at least: the cubes of distances above 1e-3.
  const Text arenstorf("arenstorf", {{"moon", *between(0, 0.5)}});
  RC_ASSERT(arenstorf.equations.conserved().size() == 1);
  RC_ASSERT(arenstorf.drift({q[0], *between(0.5, 2), v[0], v[1]}) <= 1000 * epsilon);
}

RC_GTEST_PROP(Texts, StarsConserveMomentaAndEnergy, ()) {
  Text stars("pleiades");
  std::vector<double> x = stars.equations.initial_state("", "");
  for (double& component : x) component += *between(-0.4, 0.4);
  RC_ASSERT(stars.equations.conserved().size() == 4);
  // Stars are 0.2 apart at least: masses of 7 at 1/0.04, times velocities and distances of 5, 42 pairs.
  RC_ASSERT(stars.drift(x) <= 1e6 * epsilon);
}

// Bodies are 0.7 apart at least, in units of G m = 1: attractions of 10, velocities of 1, 48 products.
RC_GTEST_PROP(Texts, BodiesConserveMomentumAndEnergy, ()) {
  Text bodies("bodies", {{"gravity", 1}, {"m1", *between(0.5, 2)}});
  std::vector<double> x = bodies.equations.initial_state("", "");
  for (double& component : x) component += *between(-0.4, 0.4);
  RC_ASSERT(bodies.equations.conserved().size() == 4);
  RC_ASSERT(bodies.drift(x) <= 1e4 * epsilon);
}

RC_GTEST_PROP(Texts, SulphurIsConserved, ()) {
  std::vector<double> y(20);
  for (double& component : y) component = *between(0, 2);
  RC_ASSERT(Text("pollution").drift(y) == 0);
}

// The damper alone lessens the energy, at the rate c r'^2.
RC_GTEST_PROP(Texts, DamperTakesEnergyFromThePendulum, ()) {
  const double damping = *between(0, 10);
  Text pendulum("spring-pendulum", {{"stiffness", 100}, {"damping", damping}});
  const Vector<double, 2> q = place();
  const std::vector<double> x = {q[0], q[1], *between(-1, 1), *between(-1, 1)};
  const double rate = pendulum.rate("mass/2*(x'^2 + y'^2) + stiffness/2*(r - length)^2 + mass gravity y", x);
  const double stretching = (x[0] * x[2] + x[1] * x[3]) / std::hypot(x[0], x[1]);
  RC_ASSERT(std::abs(rate + damping * stretching * stretching) <= 1e4 * epsilon);
}

// Force and damper alone change the energy, at the rate (f cos w t - c x') x'; terms below 32, ten of them.
RC_GTEST_PROP(Texts, OscillatorsTurnPowerIntoEnergy, ()) {
  const double c = *between(0, 2), f = *between(-2, 2), w = *between(0, 2), t = *between(0, 10);
  const std::vector<double> x = {*between(-1, 1), *between(-1, 1)};
  const double power = (f * std::cos(w * t) - c * x[1]) * x[1];
  const program::Settings set = {{"damping", c}, {"force", f}, {"frequency", w}};
  for (const char* name : {"driven-duffing", "laier-duffing"})
    RC_ASSERT(std::abs(Text(name, set).rate("x'^2/2 + stiffness/2*x^2 + hardening/4*x^4", x, t) - power) <=
              320 * epsilon);
  RC_ASSERT(std::abs(Text("forced-duffing", set).rate("u'^2/2 + hardening/4*u^4", x, t) - power) <=
            320 * epsilon);
  Text linear("linear", {{"damping_ratio", c / 2}, {"force", f}, {"frequency", w}});
  RC_ASSERT(std::abs(linear.rate("x'^2/2 + x^2/2", x, t) - power) <= 320 * epsilon);
  const std::vector<double> y = {x[0], *between(-1, 1), x[1], *between(-1, 1)};
  const double both = (f * std::cos(w * t) - c * y[2]) * y[2] - c * y[3] * y[3];
  const char* energy =
      "x1'^2/2 + x2'^2/2 + stiffness/2*(x1^2 + x2^2) + hardening/4*(x1^4 + x2^4) + coupling/2*(x1 - x2)^2";
  RC_ASSERT(std::abs(Text("two-dof", set).rate(energy, y, t) - both) <= 320 * epsilon);
}

// Along x' = x/(mu (1 - x^2)) there is no acceleration; elsewhere it is mu (1 - x^2) times the distance.
RC_GTEST_PROP(Texts, VanDerPolsOscillatorCreeps, ()) {
  const double mu = *between(1, 100), x = *between(1.1, 2), creep = x / (mu * (1 - x * x)),
               away = *between(-1, 1);
  for (const char* name : {"van-der-pol", "laier-van-der-pol"}) {
    const double rate = Text(name, {{"mu", mu}}).rate("x'", {x, creep + away});
    // Terms up to 100 * 3 * 1.
    RC_ASSERT(std::abs(rate - mu * (1 - x * x) * away) <= 4 * 1000 * epsilon);
  }
}

// Divergence of Lorenz's flow, -(sigma + 1 + b), and its rest at w = r - 1, u = v = sqrt(b (r - 1)).
TEST(Texts, LorenzsFlowRestsAndShrinks) {
  const TextProblem lorenz("lorenz");
  const double side = std::sqrt(72.0);
  ivp::State f;
  ivp::Jacobian j;
  const ivp::System system(lorenz);
  system.rhs(0, {side, side, 27}, f);
  EXPECT_LE(f.cwiseAbs().maxCoeff(), 8 * 28 * side * epsilon);
  system.jacobian(0, {1, 2, 3}, j);
  EXPECT_NEAR(j.trace(), -(10 + 1 + 8. / 3), 32 * epsilon);
}

// In circles: speed sqrt(mu/r) and period 2 pi sqrt(r^3/mu), so a quarter of it brings x to y.
TEST(Texts, TwoBodiesGoInCircles) {
  const TextProblem circle("two-body", {{"mu", 1}});
  Vector<double, 3> a;
  circle.acceleration(0.0, Vector<double, 3>(0, 2, 0), Vector<double, 3>(1, 1, 1), a);
  EXPECT_EQ(a[0], 0);
  EXPECT_NEAR(a[1], -0.25, epsilon);
  EXPECT_EQ(a[2], 0);
}

TEST(Texts, EndWhereTheySay) {
  for (const ProblemText& known : problem_texts()) {
    const TextProblem problem(known.name);
    EXPECT_GE(problem.initial_time, 0) << known.name;
    EXPECT_GT(problem.final_time, problem.initial_time) << known.name;
    EXPECT_EQ(problem.initial_state().size(), problem.size()) << known.name;
  }
  EXPECT_THROW(TextProblem("no-such"), std::invalid_argument);
  EXPECT_THROW(TextProblem("kepler", {{"eccentricity", 1}}), InputError);
}

TEST(Texts, DeadEndsHaveTheSlopesOfTheirSolutions) {
  const auto slope = [](const TextProblem& problem, double t, double y) {
    Vector<double, Eigen::Dynamic> x = Vector<double, Eigen::Dynamic>::Constant(1, y), f(1);
    problem(t, x, f);
    return f[0];
  };
  EXPECT_EQ(slope(TextProblem("dead-end"), 0.75, 0.5), -1);  // d sqrt(1 - t)/dt there
  EXPECT_EQ(slope(TextProblem("lost-domain"), 0.75, 2), -1.5);
  EXPECT_TRUE(std::isnan(slope(TextProblem("lost-domain"), 1.25, 2)));
}

RC_GTEST_PROP(Texts, ChainsConserveTheirEnergy, ()) {
  const program::Settings set = {
      {"natural_frequency", *between(0, 2)}, {"hardening", *between(-1, 2)}, {"coupling", *between(0, 2)}};
  std::vector<double> x(20);
  for (double& component : x) component = *between(-1, 1);
  RC_ASSERT(Text("duffing-chain", set).drift(x) <= 700 * epsilon);
}

// Where all masses are displaced alike, only the springs to the walls are stretched.
TEST(Texts, ChainPullsAtItsWalls) {
  Vector<double, Eigen::Dynamic> x = Vector<double, Eigen::Dynamic>::Constant(20, 0.5), f(20);
  TextProblem("duffing-chain")(0.0, x, f);
  for (int i = 11; i < 19; ++i) EXPECT_EQ(f[i], -0.5 - 0.125);
  EXPECT_EQ(f[10], -0.5 - 0.125 - 0.5);
  EXPECT_EQ(f[19], f[10]);
}

/// Does the vector field point inwards wherever a component is at its lower bound?
bool points_inwards(const TextProblem& problem) {
  Vector<double, Eigen::Dynamic> lower, upper;
  if (!problem.bounds(lower, upper)) return false;
  bool is_inwards = true;
  for (Eigen::Index i = 0; i < lower.size(); ++i) {
    Vector<double, Eigen::Dynamic> x(lower.size()), f(lower.size());
    for (Eigen::Index k = 0; k < lower.size(); ++k) x[k] = lower[k] + *between(0, 2);
    x[i] = lower[i];
    problem(0.0, x, f);
    is_inwards = is_inwards && f[i] >= 0;
  }
  return is_inwards;
}

RC_GTEST_PROP(Texts, ConcentrationsStayPositive, ()) {
  RC_ASSERT(points_inwards(TextProblem(
      "robertson", {{"k1", *between(0, 1)}, {"k2", *between(0, 1e5)}, {"k3", *between(0, 1e8)}})));
  RC_ASSERT(points_inwards(TextProblem("hires", {{"k_plus", *between(0, 1e4)}})));
  RC_ASSERT(points_inwards(TextProblem("pollution", {{"light", *between(0, 2)}})));
}

// With them concentrations could become negative.
TEST(Texts, RefuseNegativeRates) {
  EXPECT_THROW(TextProblem("robertson", {{"k2", -1}}), InputError);
  EXPECT_THROW(TextProblem("hires", {{"k_plus", -1}}), InputError);
  EXPECT_THROW(TextProblem("three-dof", {{"m3", 0}}), InputError);
}

}  // namespace
}  // namespace nlmech::problems::tests::statements_test

// Hermitian operators where problems are stiff, fast, or their steps far too long.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "nlmech/ivp/hermitian/hermitian.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/texts.hpp"

namespace nlmech::ivp::hermitian_stiff_test {
namespace {

/// Van der Pol's oscillator from (2, 0); ends by Taylor series in 113 bits.
struct Relaxation {
  double mu, end, truth;
};
constexpr Relaxation relaxations[] = {
    {10, 40, 1.872808279858089700}, {100, 200, 1.718587208019240655}, {1000, 2000, 1.706167732170465008}};

Solution run(const Relaxation& r, const Hermitian& method) {
  return integrate(System(problems::TextProblem("van-der-pol", {{"mu", r.mu}})), State{2, 0}, 0, r.end,
                   method);
}

// Fixed steps of every size: what ends with success is right to a tenth of the amplitude, for all three
// methods.
TEST(WrongBranch, NoStepErrsWithoutNotice) {
  int caught = 0, silent_unless_checked = 0;
  for (const Relaxation& r : relaxations) {
    for (const HermitianPair& pair : {laier, argyris, newmark_pair}) {
      for (const double step : {2.0, 0.5, 0.25, 0.125, 0.0625, 0.03125, 0.015625, 0.0078125, 0.00390625}) {
        if (r.mu * step < 0.5 || (r.mu > 100 && step < 0.015))
          continue;  // right, or too many steps for a unit test
        const auto checked = run(r, {.operators = pair, .step = step});
        if (checked.status.ok()) {
          EXPECT_NEAR(checked.x[0], r.truth, 0.2) << pair.name << " mu " << r.mu << " step " << step;
        }
        if (checked.status.outcome() != Outcome::wrong_branch) continue;
        ++caught;
        EXPECT_NE(checked.status.sentence().find("take a smaller step"), std::string::npos);
        const auto blind = run(r, {.operators = pair, .step = step, .branch_tolerance = HUGE_VAL});
        silent_unless_checked += blind.status.ok() && std::abs(blind.x[0] - r.truth) > 0.5 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(caught, 30);
  EXPECT_GT(silent_unless_checked, 15);  // the test is needed
}

// And what is right is let through: steps of a fifth of the leap's length, 1/mu. An error of 2e-6 with
// half the step is recorded for mu = 10; order 4 makes that 3.2e-5.
TEST(WrongBranch, RightStepsPass) {
  for (const Relaxation& r : relaxations) {
    if (r.mu > 100) continue;  // too many steps for a unit test
    const auto end = run(r, {.step = 0.2 / r.mu});
    ASSERT_TRUE(end.status.ok()) << end.status.text();
    EXPECT_NEAR(end.x[0], r.truth, 4e-5);
  }
}

// Steps chosen: tolerance times the number of steps, which the oscillator for the most part forgets.
TEST(Hermitian, CrossesLeapsWithStepsOfItsChoice) {
  for (const Relaxation& r : relaxations) {
    for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
      const auto end = run(r, {.relative_tolerance = tolerance, .absolute_tolerance = tolerance});
      ASSERT_TRUE(end.status.ok()) << end.status.text();
      EXPECT_NEAR(end.x[0], r.truth, 200 * tolerance) << r.mu;
      EXPECT_LT(end.statistics.steps, 12000);
    }
  }
}

// x'' + 1e6 x + x^3 = cos t from the slow motion x = 1e-6 cos t: what is not resolved is 1e-12 at first, and
// stays. Argyris, beyond h omega = sqrt(60), makes it grow.
TEST(Hermitian, FastDuffingFromASmoothStart) {
  const System system(problems::TextProblem("driven-duffing", {{"stiffness", 1e6}}));
  const double slow = std::cos(1.0) / (1e6 - 1);
  for (const double step : {0.1, 0.01, 0.005}) {
    const auto end = integrate(system, State{1e-6, 0}, 0, 1, Hermitian{.step = step});
    ASSERT_TRUE(end.status.ok()) << end.status.text();
    EXPECT_NEAR(end.x[0], slow, 4e-12) << step;
  }
  const auto unstable =
      integrate(system, State{1e-6, 0}, 0, 1, Hermitian{.operators = argyris, .step = 0.01});
  EXPECT_FALSE(unstable.status.ok() && std::abs(unstable.x[0]) < 1);
}

// The same from x = 1, where every period counts: order 4 in h omega; phase z^4/720 a radian over 1000
// radians.
TEST(Hermitian, FastDuffingFromAnOscillatingStart) {
  const problems::TextProblem problem("driven-duffing", {{"stiffness", 1e6}});
  const problems::ReferenceTrajectory<long double, problems::TextProblem> reference(problem, {1, 0}, 0, 1);
  const auto truth = static_cast<double>(reference(1)[0]);
  for (const double step : {1e-4, 5e-5, 2.5e-5}) {
    const auto end = integrate(System(problem), State{1, 0}, 0, 1, Hermitian{.step = step});
    ASSERT_TRUE(end.status.ok()) << end.status.text();
    EXPECT_LT(std::abs(end.x[0] - truth), 1.1 * 1000 * std::pow(1000 * step, 4) / 720) << step;
  }
}

// Steps of up to a million radians: neither growth nor a false alarm. The energy (v/w)^2 + x^2 is kept but
// for rounding, 100 steps of eps times what a step's equations amplify, some z at most.
TEST(Hermitian, LinearWithVeryLongSteps) {
  for (const double z : {1e2, 1e4, 1e6}) {
    for (const HermitianPair& pair : {laier, newmark_pair}) {
      const auto end = integrate(System(problems::TextProblem("linear", {{"natural_frequency", z}})),
                                 State{1, 0}, 0, 100, Hermitian{.operators = pair, .step = 1});
      ASSERT_TRUE(end.status.ok()) << end.status.text();
      EXPECT_NEAR(std::hypot(end.x[0], end.x[1] / z), 1, 1e-15 * 100 * std::max(10.0, z)) << pair.name << z;
    }
  }
}

}  // namespace
}  // namespace nlmech::ivp::hermitian_stiff_test

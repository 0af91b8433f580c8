// The estimates of a Hermitian step, the sum of them, and what lies between the ends of a step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nlmech/ivp/hermitian/hermitian.hpp"
#include "nlmech/ivp/hermitian/hermitian_trial.hpp"
#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/typed.hpp"

namespace nlmech::ivp::hermitian_estimate_test {
namespace {

using problems::TextProblem;
using testing::eps;

// Undamped oscillation of amplitude 1 in any phase, one step of z = h omega: the estimate of unresolved steps
// objects to every one, so that no choice of steps finds lengths at which it is zero. The least value, for z
// from 1.5 to 1e4, comes from an independent evaluation of the same formula: 0.03, 0.5 and 0.0007.
TEST(HermitianEstimate, VanishesForNoLengthOfAStep) {
  const double least[] = {0.02, 0.3, 5e-4};
  int row = 0;
  for (const HermitianPair& pair : {laier, hoff, argyris}) {
    double smallest = HUGE_VAL;
    for (double z = 1.5; z < 1e4; z *= 1.07) {
      const System system(TextProblem("linear", {{"natural_frequency", z}}));
      for (int k = 0; k < 24; ++k) {
        const double phase = std::numbers::pi * k / 24;
        HermitianTrial trial(system, pair, {});
        Statistics work;
        ASSERT_TRUE(trial.begin_segment(0, 1, State{std::cos(phase), -z * std::sin(phase)}, work));
        if (trial.attempt(0, 1, work) != Outcome::success) continue;  // refused in another way
        // With an absolute tolerance of 1 for positions; velocities count for as much.
        smallest = std::min(smallest, trial.unresolved(1, 0, false, work));
      }
    }
    EXPECT_GT(smallest, least[row]) << pair.name;
    ++row;
  }
}

// 1e4 radians at 1e-6: errors of every step are within the tolerance, and those of all steps together are a
// percent of the state and more. The end is off by 8e-3; that is no success.
TEST(HermitianEstimate, ErrorsThatAddUpAreNoSuccess) {
  const System system(TextProblem("linear", {{"natural_frequency", 1e4}}));
  for (const char* name : {"laier", "argyris"}) {
    const auto s = named_integrator(name, {.tolerance = 1e-6})(system, State{1, 0}, 0, 1, {}, {});
    EXPECT_EQ(s.status.outcome(), Outcome::not_converged) << name;
    EXPECT_NE(s.status.sentence().find("smaller tolerance"), std::string::npos) << s.status.text();
  }
  // A smaller tolerance helps, as the sentence says: 1e-8 in each of some 1e5 steps.
  const auto s = named_integrator("laier", {.tolerance = 1e-8})(system, State{1, 0}, 0, 1, {}, {});
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_NEAR(s.x[0], std::cos(1e4), 1e-8 * static_cast<double>(s.statistics.steps));
}

// One step would do for a constant force, and a load that makes whole turns in a half of it looks like one.
TEST(HermitianEstimate, SeesALoadThatTurnsWithinTheFirstStep) {
  const TextProblem p(
      "linear", {{"natural_frequency", 1e-3}, {"force", 0.1}, {"frequency", 2 * std::numbers::pi * 528}});
  for (const char* name : {"laier", "argyris", "hoff"}) {
    const auto s = named_integrator(name, {.tolerance = 1e-5})(System(p), State::Zero(2), 0, 1, {}, {});
    // In exact F (1 - cos)/W^2 = 0, but for steps times tolerance; F/2 is the other answer.
    EXPECT_TRUE(!s.status.ok() || std::abs(s.x[0]) <= 1e-5 * static_cast<double>(s.statistics.steps))
        << s.x[0];
    EXPECT_LT(std::abs(s.x[0]), 1e-2) << name;
  }
}

// Velocities within tiny steps: two nearly equal positions, divided by the step, would have an error of
// eps |q|/h, here 1e-3.
TEST(HermitianDenseOutput, KeepsVelocitiesInTinySteps) {
  const System system(problems::TextProblem("two-dof"));
  const State x0{1, -0.5, 0.12, 0.3};
  State f(4), x(4);
  system.rhs(0, x0, f);
  for (const bool chosen : {true, false}) {
    int rows = 0;
    const Observer observe = [&](const Step& s) {
      for (const double share : {0.2, 0.5, 0.8}) {
        const double t = s.t0 + share * (s.t1 - s.t0);
        s.dense.at(t, x);
        for (int i = 0; i < 4; ++i) EXPECT_NEAR(x[i], x0[i] + t * f[i], 8 * eps) << t;
        ++rows;
      }
      return true;
    };
    const Hermitian method{.step = chosen ? 0 : 3e-13};
    const auto s = integrate(system, x0, 0, 1e-12, method, observe);
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_GT(rows, 2);
  }
}

// Within a step a velocity has, beside the error of the ends, the derivative of what the step's error of the
// position makes of the quintic: for q'' = t a step by Newmark's operators has h^3/12 of it, and v at a share
// s 30 s^2 (1 - s)^2 h^2/12.
TEST(HermitianDenseOutput, VelocitiesHaveTheErrorOfTheirPlace) {
  const System system = testing::typed("x'' = t");
  for (const double h : {1e-1, 1e-2}) {
    State x(2);
    const Observer observe = [&](const Step& step) {
      for (const double s : {0.2, 0.5, 0.97, 1.}) {
        const double t = step.t0 + s * (step.t1 - step.t0);
        step.dense.at(t, x);
        const double off = 30 * s * s * (1 - s) * (1 - s) * h * h / 12;
        EXPECT_NEAR(std::abs(x[1] - t * t / 2), off, 1e-14) << h << ' ' << t;  // roundings of 1
      }
      return true;
    };
    const auto run = integrate(system, State{0, 0}, 0, 1, Hermitian{.operators = hoff, .step = h}, observe);
    ASSERT_TRUE(run.status.ok()) << run.status.text();
  }
}

}  // namespace
}  // namespace nlmech::ivp::hermitian_estimate_test

// Error estimates of a Hermitian step, their sum over all steps, and dense output.
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

// One step of z = h omega on an undamped oscillation of amplitude 1 and any phase: the estimate for
// unresolved steps is positive for every z, so no sequence of steps avoids it. Its least value for z from 1.5
// to 1e4 comes from an independent evaluation of the same formula: 0.03, 0.5 and 0.0007.
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
        if (trial.attempt(0, 1, work) != Outcome::success) continue;  // rejected for another reason
        // The absolute tolerance of positions is 1; velocities have equal weight.
        smallest = std::min(smallest, trial.unresolved(1, 0, false, work));
      }
    }
    EXPECT_GT(smallest, least[row]) << pair.name;
    ++row;
  }
}

// 1e4 radians with tolerance 1e-6: the error of every step is within the tolerance, but their sum is a
// percent of the state or more. The end state has an error of 8e-3; the status is a failure.
TEST(HermitianEstimate, ErrorsThatAddUpAreNoSuccess) {
  const System system(TextProblem("linear", {{"natural_frequency", 1e4}}));
  for (const char* name : {"laier", "argyris"}) {
    const auto s = named_integrator(name, {.tolerance = 1e-6})(system, State{1, 0}, 0, 1, {}, {});
    EXPECT_EQ(s.status.outcome(), Outcome::not_converged) << name;
    EXPECT_NE(s.status.sentence().find("smaller tolerance"), std::string::npos) << s.status.text();
  }
  // A smaller tolerance succeeds, as the message says: 1e-8 in each of some 1e5 steps.
  const auto s = named_integrator("laier", {.tolerance = 1e-8})(system, State{1, 0}, 0, 1, {}, {});
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_NEAR(s.x[0], std::cos(1e4), 1e-8 * static_cast<double>(s.statistics.steps));
}

// A load that makes whole periods within half of the interval looks like a constant force, for which one step
// would suffice.
TEST(HermitianEstimate, SeesALoadThatTurnsWithinTheFirstStep) {
  const TextProblem p(
      "linear", {{"natural_frequency", 1e-3}, {"force", 0.1}, {"frequency", 2 * std::numbers::pi * 528}});
  for (const char* name : {"laier", "argyris", "hoff"}) {
    const auto s = named_integrator(name, {.tolerance = 1e-5})(System(p), State::Zero(2), 0, 1, {}, {});
    // The exact end position F (1 - cos)/W^2 is 0; the tolerance allows steps times tolerance. A constant
    // force gives F/2.
    EXPECT_TRUE(!s.status.ok() || std::abs(s.x[0]) <= 1e-5 * static_cast<double>(s.statistics.steps))
        << s.x[0];
    EXPECT_LT(std::abs(s.x[0]), 1e-2) << name;
  }
}

// Velocities within tiny steps: a difference of two nearly equal positions over the step size would have an
// error of eps |q|/h, here 1e-3.
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

// The velocity within a step has, besides the error of the ends, the derivative of the quintic's part that
// stems from the position error of the step. For q'' = t Newmark's operators have a position error of h^3/12
// a step, so at the fraction s the velocity error is 30 s^2 (1 - s)^2 h^2/12.
TEST(HermitianDenseOutput, VelocitiesHaveTheErrorOfTheirPlace) {
  const System system = testing::typed("x'' = t");
  for (const double h : {1e-1, 1e-2}) {
    State x(2);
    const Observer observe = [&](const Step& step) {
      for (const double s : {0.2, 0.5, 0.97, 1.}) {
        const double t = step.t0 + s * (step.t1 - step.t0);
        step.dense.at(t, x);
        const double off = 30 * s * s * (1 - s) * (1 - s) * h * h / 12;
        EXPECT_NEAR(std::abs(x[1] - t * t / 2), off, 1e-14) << h << ' ' << t;  // rounding errors of 1
      }
      return true;
    };
    const auto run = integrate(system, State{0, 0}, 0, 1, Hermitian{.operators = hoff, .step = h}, observe);
    ASSERT_TRUE(run.status.ok()) << run.status.text();
  }
}

}  // namespace
}  // namespace nlmech::ivp::hermitian_estimate_test

/// The method of order 8(5,3): checks of this method only. Coefficients: dop853_coefficients_test.cpp; shared
/// checks: embedded_runge_kutta_test.cpp, adaptive_methods_test.cpp.
#include "nlmech/ivp/runge_kutta/dop853.hpp"

#include <gtest/gtest.h>

#include "nlmech/problems/texts.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/oracle.hpp"

namespace nlmech::ivp::dop853_test {
namespace {

using namespace testing;

Dop853 within(double tolerance) { return {.relative_tolerance = tolerance, .absolute_tolerance = tolerance}; }

// Arenstorf's orbit closes after its period; errors of steps grow 1e4 times on the way.
TEST(Dop853, ClosesArenstorfsOrbit) {
  const problems::TextProblem problem("arenstorf");
  const State& x0 = problem.initial_state();
  const auto s = integrate(System(problem), x0, 0, problem.final_time, within(1e-12));
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_LT((s.x - x0).cwiseAbs().maxCoeff(), 1e-6);
}

// Slopes on both sides of the end of a step differ by rounding over the distance.
TEST(Dop853, DenseOutputIsContinuouslyDifferentiable) {
  State before = State::Zero(2);
  const auto watch = [&](const Step& step) {
    constexpr double d = 1e-5;
    State x(2);
    step.dense.at(step.t0 + d, x);
    const State slope = (x - step.x0) / d;
    if (step.index > 1) {
      EXPECT_LT(oracle::distance(slope, before), 20 * d);  // second derivatives of size 2 and more
    }
    step.dense.at(step.t1 - d, x);
    before = (step.x1 - x) / d;
    return true;
  };
  const auto s = integrate(System(problems::TextProblem("duffing")), State{1, 0}, 0, 5, within(1e-6), watch);
  EXPECT_GT(s.statistics.steps, 5);
}

// Eleven evaluations a trial, one for the start and for each step; three more where the solution within a
// step is asked for.
TEST(Dop853, CountsItsWork) {
  const auto run = [](const Observer& observer) {
    return integrate(System(problems::TextProblem("duffing")), State{1, 0}, 0, 50, Dop853{}, observer)
        .statistics;
  };
  const auto s = run({});
  EXPECT_GT(s.rejected, 0);
  EXPECT_EQ(s.right_hand_sides, 11 * (s.steps + s.rejected) + s.steps + 1);
  EXPECT_EQ(run([](const Step&) { return true; }).right_hand_sides, s.right_hand_sides);
  const auto some = run([](const Step& step) {
    State x(2);
    for (const double part : {0.5, 0.75}) {
      if (step.index <= 10) step.dense.at(step.t0 + part * (step.t1 - step.t0), x);
    }
    return true;
  });
  EXPECT_EQ(some.right_hand_sides, s.right_hand_sides + 30);
}

// Nothing is finite from 0.03 on: trials of 1, 1/5, 1/25 and 1/125.
TEST(Dop853, ShrinksToAFifthWhereNothingIsFinite) {
  double first = 0;
  const auto stop = [&](const Step& step) {
    first = step.t1;
    return false;
  };
  const auto solution =
      integrate(System(Poisoned{.at = 0.03}), State{1, 0}, 0, 2, Dop853{.initial_step = 1}, stop);
  EXPECT_NEAR(first, 0.008, 4 * eps);
  EXPECT_EQ(solution.statistics.rejected, 3);
}

// At rest f says nothing of the way ahead: the first step is a tenth of it, and a push is not leapt over.
TEST(Dop853, BeginsWithATenthOfTheWay) {
  double first = 0;
  const auto stop = [&](const Step& step) {
    first = step.t1;
    return false;
  };
  (void)integrate(System(Oscillator{}), State{0, 0}, 0, 2, Dop853{}, stop);
  EXPECT_EQ(first, 0.2);
  // Else by (atol + rtol)^(1/8) of the time in which the state changes by its size, here 1.
  (void)integrate(System(Oscillator{}), State{1, 1}, 0, 20, within(1e-8), stop);
  EXPECT_NEAR(first, std::pow(2e-8, 1. / 8), 4 * eps);
}

}  // namespace
}  // namespace nlmech::ivp::dop853_test

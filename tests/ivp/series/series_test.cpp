/// Taylor series method: tolerance at every order, poles, gaps and
/// coefficients beyond the range of double, jumps, failures, refusals. Requirements on all methods:
/// every_integrator_test.cpp. Problems of its sources: the checks of the chapter algebraic_series.
#include "nlmech/ivp/series/series.hpp"

#include <gtest/gtest.h>

#include "chapters/plain_equations.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/reference.hpp"
#include "tests/ivp/typed.hpp"

namespace nlmech::ivp::series_test {
namespace {

using namespace testing;

/// Adaptive steps with one tolerance.
Series with_tolerance(double tolerance, int order = 0) {
  return {.relative_tolerance = tolerance, .absolute_tolerance = tolerance, .order = order};
}

// The norm of the last terms is the tolerance in every step. The local error is smaller by the ratio of the
// next term; ten units of time of a damped motion sum the errors.
TEST(Series, MeetsItsTolerance) {
  const Manufactured problem;
  for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
    for (const int order : {0, 12, 30}) {
      const double error = largest_error(problem, with_tolerance(tolerance, order), 0, 10, true);
      EXPECT_LE(error, 20 * tolerance + 40 * eps) << tolerance << ", order " << order;
    }
  }
}

TEST(Series, OrderFollowsTheTolerance) {
  EXPECT_EQ(series_order(0.1), 10);   // 9 + 0.36 x 2.3, rounded up
  EXPECT_EQ(series_order(1e-9), 17);  // 1 + 0.75 x 20.7, rounded up
  EXPECT_EQ(series_order(1e-18), 33);
}

// Errors of 1e-13 |x|, with |x| up to 50, grow by exp(0.9 4) = 37.
TEST(Series, FollowsChaosAsFarAsItsTolerance) {
  const chapters::PlainLorenz lorenz;
  const State x0{0, 1, 0};
  const auto end = integrate(System(lorenz), x0, 0, 4, with_tolerance(1e-13));
  EXPECT_TRUE(end.status.ok());
  EXPECT_LT((end.x - reference(lorenz, x0, 0, 4)).cwiseAbs().maxCoeff(), 2e-10);
}

TEST(Series, ComesOutTheSameEveryTime) {
  const System system(problems::TextProblem("lorenz")), again(problems::TextProblem("lorenz"));
  const auto one = integrate(system, State{0, 1, 0}, 0, 20, Series{});
  EXPECT_EQ(one.x, integrate(system, State{0, 1, 0}, 0, 20, Series{}).x);
  EXPECT_EQ(one.x, integrate(again, State{0, 1, 0}, 0, 20, Series{}).x);
}

TEST(Series, ExactAcrossAnnouncedJumps) {
  const JumpingForce problem;
  for (const Series& method : {Series{}, Series{.order = 3, .step = 0.07}}) {
    const auto there = integrate(System(problem), State{0, 0}, 0, 1, method);
    EXPECT_LT((there.x - problem.exact(1)).cwiseAbs().maxCoeff(), 16 * eps);
    const auto back = integrate(System(problem), problem.exact(1), 1, 0, method);
    EXPECT_LT(back.x.cwiseAbs().maxCoeff(), 16 * eps);
  }
}

TEST(Series, RefusesAnUnannouncedBranch) {
  const Unannounced<JumpingForce> problem;
  EXPECT_THROW((void)integrate(System(problem), State{0, 0}, 0, 1, Series{}), std::invalid_argument);
}

// ------------------------------------------------------------ extremes

// x' = x^2 has the radius of convergence 1/x, and y' = y^3 has a pole at t = 1/2, at any order.
TEST(Series, NoChosenStepIsLongerThanTheRadiusOfConvergence) {
  const System pole = typed("x' = x^2"), blow_up(problems::TextProblem("blow-up"));
  for (const int order : {2, 8, 20, 40, 100}) {
    const auto look = [&](const Step& step) {
      EXPECT_LT(step.t1 - step.t0, 1 / step.x0[0]) << order;
      return true;
    };
    const auto s = integrate(pole, State{1.0}, 0, 0.9, with_tolerance(1e-6, order), look);
    EXPECT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_NEAR(s.x[0], 10, 1e-3) << order;
    if (order < 40) continue;
    const auto end = integrate(blow_up, State{1.0}, 0, 1, with_tolerance(1e-9, order));
    EXPECT_FALSE(end.status.ok());
    EXPECT_NEAR(end.t, 0.5, 1e-6) << end.status.text();
  }
}

// From t = 0 the series of x' = t^20 to order 10 is zero: the slope at the end of the step detects it.
TEST(Series, DoesNotTakeAGapForAPolynomial) {
  const System gap = typed("x' = t^20");
  const auto s = integrate(gap, State{0.0}, 0, 2, with_tolerance(1e-9, 10));
  EXPECT_TRUE(s.status.ok());
  EXPECT_GT(s.statistics.rejected, 0);
  EXPECT_NEAR(s.x[0] / (std::pow(2, 21) / 21), 1, 1e-8);
  EXPECT_EQ(integrate(gap, State{0.0}, 0, 2, with_tolerance(1e-9, 23)).statistics.steps, 1);
}

// Coefficient 40 of cos(1e9 t) is 1e360/40!: coefficients are scaled by the step size.
TEST(Series, CoefficientsBeyondTheRangeOfDouble) {
  const Oscillator fast{.frequency = 1e9};
  for (const int order : {20, 40, 100}) {
    const auto s = integrate(System(fast), State{1, 0}, 0, 1e-8, with_tolerance(1e-12, order));
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_NEAR(s.x[0], std::cos(10), 1e-10) << order;
  }
}

TEST(Series, FailuresSayWhatHappened) {
  const System root = typed("x' = sqrt(t)");
  // f is finite at t = 0, its derivatives are not.
  const auto singular = integrate(root, State{0.0}, 0, 1, Series{});
  EXPECT_EQ(singular.status.outcome(), Outcome::non_finite);
  EXPECT_NE(singular.status.sentence().find("Taylor coefficients"), std::string::npos);
  EXPECT_EQ(singular.x[0], 0);
  EXPECT_EQ(integrate(root, State{0.0}, 0, 1, Series{.step = 0.1}).status.outcome(), Outcome::non_finite);
  const auto nowhere = integrate(root, State{0.0}, -1, 1, Series{});
  EXPECT_EQ(nowhere.status.outcome(), Outcome::non_finite);
  EXPECT_NE(nowhere.status.sentence().find("right-hand side"), std::string::npos);
}

TEST(Series, OptionsOutOfRangeAreNamed) {
  EXPECT_NE(refusal(Series{.order = 1}).find("order must be between 2 and 100, not 1"), std::string::npos);
  EXPECT_NE(refusal(Series{.order = 101}).find("101"), std::string::npos);
  EXPECT_NE(refusal(Series{.relative_tolerance = 0}).find("relative_tolerance"), std::string::npos);
  EXPECT_NE(refusal(Series{.absolute_tolerance = nan}).find("absolute_tolerance"), std::string::npos);
  EXPECT_NE(refusal(Series{.step = -1}).find("step must be"), std::string::npos);
  EXPECT_NE(refusal(Series{.largest_step = infinity}).find("largest_step"), std::string::npos);
  EXPECT_EQ(refusal(Series{.order = 2, .step = 0.01}), "accepted");
  EXPECT_EQ(refusal(Series{.order = 100}), "accepted");
}

}  // namespace
}  // namespace nlmech::ivp::series_test

#include "nlmech/ivp/named/fixed_steps.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/typed.hpp"

namespace nlmech::ivp::fixed_steps_test {
namespace {

using testing::typed;

RC_GTEST_PROP(StepGrid, CoversTheSegmentWithEqualStepsAndOneRest, ()) {
  const auto real = [](int low, int high, double scale) {
    return rc::gen::map(rc::gen::inRange(low, high), [scale](int k) { return k * scale; });
  };
  const double begin = *real(-1000, 1000, 0.1), span = *real(1, 100000, 0.001),
               length = *real(1, 5000, 0.003);
  const double sign = *rc::gen::element(-1.0, 1.0), end = begin + sign * span;
  RC_PRE(end != begin);
  const StepGrid grid = make_step_grid(begin, end, length);
  RC_ASSERT(grid.time(0) == begin);
  RC_ASSERT(grid.time(grid.count) == end);
  for (std::int64_t k = 0; k < grid.count; ++k) {
    const double actual = grid.time(k + 1) - grid.time(k);
    RC_ASSERT(actual * sign > 0);
    // Each time is rounded to an ulp of the largest of them.
    RC_ASSERT(std::abs(actual - grid.length(k)) <= 4e-16 * (std::abs(begin) + std::abs(end) + length));
    RC_ASSERT(std::abs(grid.length(k)) <= length * (1 + 1e-9));
    if (k + 1 < grid.count) RC_ASSERT(grid.length(k) == grid.step);
  }
}

TEST(StepGrid, AWholeNumberOfStepsHasNoRest) {
  for (const double h : {0.1, 0.03, 0.006, 4.7680220291024608 / 500}) {
    const StepGrid grid = make_step_grid(1, 1 + 16600 * h, h);
    EXPECT_EQ(grid.count, 16600);
    EXPECT_EQ(grid.last, grid.step);
  }
}

// At 1e16 the spacing of doubles is 2, and the end of the fifth step is no double: the last step is still 495
// long.
TEST(StepGrid, TheLastStepIsNotRoundedAsTimesAre) {
  const StepGrid grid = make_step_grid(1e16, 1e16 + 8000, 1501);
  EXPECT_EQ(grid.count, 6);
  EXPECT_EQ(grid.last, 495);
}

// x'' = -w^2 x by rk4: (w h)^5/120 = 6e-7 a step. A last step of 496 would change x by 7e-5.
TEST(FixedSteps, GoAsFarAsAskedWhereTimesAreRounded) {
  const auto s = integrate(typed("x'' = -1e-8 x"), {1, 0}, 1e16, 1e16 + 8000, Rk4{.step = 1501});
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_EQ(s.t, 1e16 + 8000);
  EXPECT_NEAR(s.x[0], std::cos(0.8), 1e-5);
}

TEST(FixedSteps, AreRefusedWhereRoundingOfTheTimeIsAPartOfThem) {
  for (const double sign : {1.0, -1.0}) {
    const double t1 = sign * 1e16, t0 = t1 - 1e5;
    const auto s = integrate(typed("x'' = -x"), {1, 0}, t0, t1, Rk4{.step = 1000});
    EXPECT_EQ(s.status.outcome(), Outcome::step_underflow);
    EXPECT_EQ(s.t, t0);
    EXPECT_TRUE(integrate(typed("x'' = 0"), {1, 0}, t0, t1, Rk4{.step = 1024}).status.ok());
  }
}

TEST(Walk, LandsOnDiscontinuitiesAndOnTheEnd) {
  const System system(problems::TextProblem("impact"));
  std::vector<double> ends;
  const auto s = integrate(system, {0, 0}, 0, 2, Rk4{.step = 0.3}, [&](const Step& step) {
    ends.push_back(step.t1);
    return true;
  });
  EXPECT_TRUE(s.status.ok());
  EXPECT_EQ(ends, (std::vector<double>{0.3, 0.5, 0.8, 1.0, 1.3, 1.6, 1.9, 2.0}));
  EXPECT_EQ(s.statistics.steps, 8);
}

}  // namespace
}  // namespace nlmech::ivp::fixed_steps_test

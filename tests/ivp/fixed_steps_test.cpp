#include "nlmech/ivp/named/fixed_steps.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/problems/texts.hpp"

namespace nlmech::ivp::fixed_steps_test {
namespace {

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
    // Times round to an ulp of the largest of them.
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

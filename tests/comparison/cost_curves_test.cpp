/// Curves of digits against cost: settings that are run, the end of a curve, and the record of failed runs.
#include "nlmech/comparison/cost/cost_curves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "tests/ivp/typed.hpp"

namespace nlmech::comparison::cost_curves_test {
namespace {

Example saddle(double end) {
  return {.name = "saddle",
          .system = ivp::testing::typed("x' = x; y' = -y"),
          .x0 = {1, 1},
          .t0 = 0,
          .t1 = end,
          .amplitude = {std::exp(end), 1},
          .reference = [](double t) -> Vector<long double, 2> {
            return {std::exp(static_cast<long double>(t)), std::exp(-static_cast<long double>(t))};
          }};
}

// The solution has a pole at t = 1.
Example pole() {
  return {.name = "pole",
          .system = ivp::testing::typed("x' = x^2; y' = 0"),
          .x0 = {1, 0},
          .t0 = 0,
          .t1 = 2,
          .amplitude = {1, 1},
          .reference = [](double t) -> Vector<long double, 2> {
            return {1 / (1 - t), 0};
          }};
}

const std::vector<double> halves = {1, 0.5, 0.25, 0.125, 0.0625};

TEST(CostCurves, RunEverySettingOfEveryMethod) {
  const std::vector<MethodSweep> both = {by_steps("rk4", {}, Kind::classical, 0.5, halves, false),
                                         by_tolerances("ode45", Kind::explicit_, false)};
  const std::vector<scene::MethodLine> curves = cost_curves(saddle(2), both, false);
  ASSERT_EQ(curves.size(), 2u);
  ASSERT_EQ(curves[0].attempts.size(), halves.size());
  ASSERT_EQ(curves[1].attempts.size(), 10u);
  for (std::size_t i = 0; i < halves.size(); ++i) {
    const scene::Attempt& cost = curves[0].attempts[i];
    EXPECT_EQ(cost.setting, both[0].settings[i].text);
    EXPECT_EQ(cost.status, "success");
    EXPECT_EQ(std::get<std::int64_t>(cost.work[0]),
              16 << i);  // four evaluations a step of rk4, with steps of 0.5 and less to t = 2
    EXPECT_GE(cost.time.largest, cost.time.smallest);
    EXPECT_GT(cost.time.smallest, 0);
    if (i == 0) continue;
    // Order 4: halving the step divides the error by 16, within a factor of two, because the step ends differ
    // for so few steps.
    const double gain = *curves[0].attempts[i - 1].error / *cost.error;
    EXPECT_GT(gain, 8) << cost.setting;
    EXPECT_LT(gain, 32) << cost.setting;
  }
  EXPECT_EQ(steps_of(curves[0].attempts.back()), 4 << 4);
  EXPECT_EQ(curves[0].best(), &curves[0].attempts.back());
}

// The first run takes more right-hand sides than the limit after which a curve ends.
TEST(CostCurves, EndAfterADearRunButNotBeforeThreePoints) {
  const double dear = 1.0 / (1.1 * static_cast<double>(most_right_hand_sides));
  const std::vector<MethodSweep> euler = {by_steps("euler", {}, Kind::classical, dear, halves, false)};
  EXPECT_EQ(cost_curves(saddle(1), euler, false).front().attempts.size(), 3u);
  EXPECT_EQ(cost_curves(saddle(1), euler, true).front().attempts.size(), 1u);
  const double enough = 1.0 / (1.1 * static_cast<double>(most_right_hand_sides_quick));
  const std::vector<MethodSweep> seen = {by_steps("euler", {}, Kind::classical, 2.2 * enough, halves, true)};
  EXPECT_EQ(cost_curves(saddle(1), seen, true).front().attempts.size(), 2u) << "a half of that, then twice";
  // The first run takes a tenth of the limit, doubled by each halving: the fifth is the first above it, and
  // all are kept.
  const std::vector<MethodSweep> cheap = {by_steps("euler", {}, Kind::classical, 10 * dear, halves, false)};
  EXPECT_EQ(cost_curves(saddle(1), cheap, false).front().attempts.size(), 5u);
}

TEST(CostCurves, KeepRunsThatFailWithoutAnError) {
  const std::vector<MethodSweep> ode45 = {by_tolerances("ode45", Kind::explicit_, true)};
  const std::vector<scene::MethodLine> curves = cost_curves(pole(), ode45, true);
  ASSERT_EQ(curves.front().attempts.size(), 2u);
  for (const scene::Attempt& cost : curves.front().attempts) {
    EXPECT_NE(cost.status, "success");
    EXPECT_FALSE(cost.error.has_value());
  }
  EXPECT_EQ(curves.front().best(), nullptr);
}

// The flow of the saddle is linear: x(3) is e^3 times x(0), so the difference quotient has rounding errors
// only: some ten eps of e^3 in each end state, over the initial change of 1e-6.
TEST(Condition, IsTheGrowthOfADifference) {
  const auto series = ivp::named_integrator("series", {.tolerance = 1e-16});
  Example c = saddle(3);
  c.amplitude = {1, 1};
  EXPECT_NEAR(condition_of(c, series), std::exp(3), 20 * std::exp(3) * 2.2e-16 / 1e-6);
  EXPECT_THROW(static_cast<void>(condition_of(pole(), series)), Failure);
}

TEST(MethodLines, KnowTheirGroupsAndPeers) {
  const auto groups = method_groups("Hermitian operators", "radial functions");
  EXPECT_EQ(groups.at(line_of("one", Kind::source).group).name, "radial functions");
  EXPECT_EQ(groups.at(line_of("two", Kind::series).group).name, "Taylor series");
  EXPECT_EQ(groups.at(line_of("three", Kind::own).group).name, "Hermitian operators");
  EXPECT_EQ(line_of("cvode-bdf", Kind::implicit).side, scene::Side::peer);
  EXPECT_EQ(line_of("Kepler", Kind::closed_form).side, scene::Side::floor);
  EXPECT_EQ(line_of("rk4", Kind::classical).side, scene::Side::library);
}

}  // namespace
}  // namespace nlmech::comparison::cost_curves_test

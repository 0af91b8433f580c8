/// Curves of digits against cost: what is run, when a curve ends, and what is said of runs that fail.
#include "nlmech/comparison/cost/cost_curves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace nlmech::comparison::cost_curves_test {
namespace {

/// x' = x, y' = -y.
struct Saddle {
  static constexpr int dimension = 2;
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    dxdt[0] = x[0];
    dxdt[1] = -x[1];
  }
};

/// x' = x^2 from 1 has a pole at t = 1.
struct Pole {
  static constexpr int dimension = 2;
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    dxdt[0] = x[0] * x[0];
    dxdt[1] = 0.0 * x[1];
  }
};

Example saddle(double end) {
  return {.name = "saddle",
          .system = ivp::System(Saddle{}),
          .x0 = {1, 1},
          .t0 = 0,
          .t1 = end,
          .amplitude = {std::exp(end), 1},
          .reference = [](double t) -> Vector<long double, 2> {
            return {std::exp(static_cast<long double>(t)), std::exp(-static_cast<long double>(t))};
          }};
}

Example pole() {
  return {.name = "pole",
          .system = ivp::System(Pole{}),
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
  const std::vector<Contender> both = {by_steps("rk4", {}, Kind::classical, 0.5, halves, false),
                                       by_tolerances("ode45", Kind::explicit_, false)};
  const std::vector<Curve> curves = cost_curves(saddle(2), both, false);
  ASSERT_EQ(curves.size(), 2u);
  ASSERT_EQ(curves[0].costs.size(), halves.size());
  ASSERT_EQ(curves[1].costs.size(), 10u);
  for (std::size_t i = 0; i < halves.size(); ++i) {
    const Cost& cost = curves[0].costs[i];
    EXPECT_EQ(cost.setting, both[0].settings[i].text);
    EXPECT_EQ(cost.status, "success");
    EXPECT_EQ(cost.work.right_hand_sides, 16 << i);  // four a step, of a half and less, to t = 2
    EXPECT_GE(cost.time.largest, cost.time.smallest);
    EXPECT_GT(cost.time.smallest, 0);
    if (i == 0) continue;
    // Order four: each halving of the step takes a sixteenth of the error, within a factor of two, as the
    // last ends of so few steps do not lie at the same times.
    const double gain = *curves[0].costs[i - 1].error / *cost.error;
    EXPECT_GT(gain, 8) << cost.setting;
    EXPECT_LT(gain, 32) << cost.setting;
  }
  EXPECT_EQ(best_of(curves[0]), &curves[0].costs.back());
  EXPECT_EQ(least_error(curves, "rk4"), *curves[0].costs.back().error);
}

// The first run already takes more right-hand sides than a curve goes on after.
TEST(CostCurves, EndAfterADearRunButNotBeforeThreePoints) {
  const double dear = 1.0 / (1.1 * static_cast<double>(enough_right_hand_sides));
  const std::vector<Contender> euler = {by_steps("euler", {}, Kind::classical, dear, halves, false)};
  EXPECT_EQ(cost_curves(saddle(1), euler, false).front().costs.size(), 3u);
  EXPECT_EQ(cost_curves(saddle(1), euler, true).front().costs.size(), 1u);
  const double enough = 1.0 / (1.1 * static_cast<double>(enough_for_a_look));
  const std::vector<Contender> seen = {by_steps("euler", {}, Kind::classical, 2.2 * enough, halves, true)};
  EXPECT_EQ(cost_curves(saddle(1), seen, true).front().costs.size(), 2u) << "a half of that, then twice";
  // Runs of a tenth of that at first, doubled: the fifth is the first dear one, and all are wanted.
  const std::vector<Contender> cheap = {by_steps("euler", {}, Kind::classical, 10 * dear, halves, false)};
  EXPECT_EQ(cost_curves(saddle(1), cheap, false).front().costs.size(), 5u);
}

TEST(CostCurves, KeepRunsThatFailWithoutAnError) {
  const std::vector<Contender> ode45 = {by_tolerances("ode45", Kind::explicit_, true)};
  const std::vector<Curve> curves = cost_curves(pole(), ode45, true);
  ASSERT_EQ(curves.front().costs.size(), 2u);
  for (const Cost& cost : curves.front().costs) {
    EXPECT_NE(cost.status, "success");
    EXPECT_FALSE(cost.error.has_value());
  }
  EXPECT_EQ(best_of(curves.front()), nullptr);
  EXPECT_TRUE(std::isnan(least_error(curves, "ode45")));
}

TEST(CostCurves, AreFoundByName) {
  const std::vector<Curve> curves = {{"a", Kind::own, {}}, {"b", Kind::own, {}}};
  EXPECT_EQ(&curve_of(curves, "b"), &curves[1]);
  try {
    static_cast<void>(curve_of(curves, "c"));
    FAIL() << "there is none";
  } catch (const std::out_of_range& e) {
    EXPECT_NE(std::string(e.what()).find('c'), std::string::npos);
  }
}

// The flow of the saddle is linear: x(3) is e^3 times x(0), so the quotient of differences has no error but
// rounding. That is the integrator's, some ten eps of e^3 in either end state, over the change of 1e-6 at the
// begin.
TEST(Condition, IsTheGrowthOfADifference) {
  const auto series = ivp::named_integrator("series", {.tolerance = 1e-16});
  Example c = saddle(3);
  c.amplitude = {1, 1};
  EXPECT_NEAR(condition_of(c, series), std::exp(3), 20 * std::exp(3) * 2.2e-16 / 1e-6);
  EXPECT_THROW(static_cast<void>(condition_of(pole(), series)), Failure);
}

std::vector<Curve> three_curves() {
  const Cost coarse{"step 1", "success", 1e-3, {}, {}}, fine{"step 0.1", "success", 1e-7, {}, {}};
  const Cost failed{"step 10", "non_finite", {}, {}, {}};
  return {{"one", Kind::source, {failed, coarse, fine}},
          {"absent", Kind::series, {}},
          {"two", Kind::own, {coarse}}};
}

TEST(MethodLines, AreThoseOfADiagram) {
  const std::vector<scene::MethodLine> lines = method_lines(three_curves());
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0].method, "one");
  EXPECT_EQ(lines[0].attempts.size(), 3U);
  EXPECT_EQ(lines[0].attempts[1].error, 1e-3);
  EXPECT_EQ(lines[0].attempts[0].work.size(), 3U) << "right-hand sides, steps, rejected";
  EXPECT_TRUE(lines[1].attempts.empty()) << "not in this build";
  const auto groups = method_groups("Hermitian operators", "radial functions");
  EXPECT_EQ(groups.at(lines[0].group).name, "radial functions");
  EXPECT_EQ(groups.at(lines[1].group).name, "Taylor series");
  EXPECT_EQ(groups.at(lines[2].group).name, "Hermitian operators");
}

}  // namespace
}  // namespace nlmech::comparison::cost_curves_test

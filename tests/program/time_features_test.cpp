/// Times at which functions of time change after an interval of rest.
#include "nlmech/program/time_features.hpp"

#include <fmt/format.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "nlmech/program/equations.hpp"

namespace nlmech::program::time_features_test {
namespace {

std::vector<double> places(const std::string& right, double t0, double t1) {
  const Equations equations({"test", "x' = " + right});
  return TimeFeatures(equations.graph(), equations.slopes()).between(t0, t1);
}

// A pulse of any width at any time; beyond 5.3 widths it is below 1e-12. The first time is before the pulse,
// by at most some widths, and no gap between times around it is longer than some widths.
RC_GTEST_PROP(TimeFeatures, PulsesAreFound, ()) {
  const double width = std::pow(10, -*rc::gen::inRange(0, 110) / 10.),
               middle = *rc::gen::inRange(250, 750) / 10.;
  RC_PRE(middle > 6 * width + 1e-9 && middle + 6 * width < 100);
  const auto all = places(fmt::format("exp(-((t - {:.17g})/{:.17g})^2)", middle, width), 0, 100);
  RC_ASSERT(all.size() >= 4U);
  RC_ASSERT(all.size() <= 30U);
  RC_ASSERT(all.front() < middle - 5 * width);
  RC_ASSERT(all.front() > middle - 32 * width);
  RC_ASSERT(all.back() > middle + 5 * width);
  const auto near = std::ranges::upper_bound(all, middle);
  RC_ASSERT(*near - *std::prev(near) < 8 * width);
}

TEST(TimeFeatures, OtherShapes) {
  const auto is_near = [](const std::vector<double>& all, double t, double within) {
    return std::ranges::any_of(all, [&](double p) { return std::abs(p - t) <= within; });
  };
  EXPECT_TRUE(is_near(places("(1 + tanh(100 (t - 5))) (1 - tanh(100 (t - 5.5)))", 0, 10), 5, 0.3));
  EXPECT_TRUE(is_near(places("x + 1/cosh((t - 70)/1e-4)", 0, 100), 70, 5e-3));
  EXPECT_TRUE(is_near(places("erf(1e5 (t - 3))", 0, 100), 3, 1e-3));
  // A train of pulses: some times for each.
  const auto train = places("exp(-(sin(t)/0.01)^2)", 1, 100);
  for (int k = 1; k <= 31; ++k) EXPECT_TRUE(is_near(train, k * std::acos(-1.), 0.3)) << k;
  // A burst: only its start.
  const auto burst = places("exp(-((t - 50)/10)^8) sin(1000 t)", 0, 100);
  EXPECT_TRUE(is_near(burst, 35, 5));
  EXPECT_LE(burst.size(), 40U);
}

TEST(TimeFeatures, WavesAndSlowFunctionsHaveNone) {
  for (const char* right : {"cos(10 t)", "t^2 - 3 t", "sqrt(t)", "1/(1 + t)", "exp(-t/30)", "sin(1e6 t) + x",
                            "x^2 - 1", "log(t)", "1/(t - 50)", "1/(1 + 25 (t - 50)^2)"})
    EXPECT_TRUE(places(right, 0, 100).empty()) << right;
}

TEST(TimeFeatures, PartsOfAnIntervalHaveItsPlaces) {
  const Equations equations({"test", "x' = exp(-((t - 50)/0.1)^2)"});
  const TimeFeatures features(equations.graph(), equations.slopes());
  const std::vector<double> all = features.between(0, 100);
  ASSERT_GE(all.size(), 3U);
  EXPECT_EQ(features.between(all[0], all[2]), std::vector{all[1]});
  EXPECT_TRUE(features.between(0, 30).empty());
}

}  // namespace
}  // namespace nlmech::program::time_features_test

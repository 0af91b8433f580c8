/// Trajectory samples for plotting.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nlmech/comparison/commands/run_figure.hpp"

namespace nlmech::comparison {
namespace {

using State = Eigen::Vector2d;

// All states of a short run are kept.
TEST(SampledPath, KeepAShortRun) {
  SampledPath samples(0, 10);
  for (int k = 0; k <= 100; ++k) samples.add(0.1 * k, State{k, -k});
  const auto [t, x] = samples.component(1);
  ASSERT_EQ(t.size(), 101U);
  for (std::size_t k = 0; k < t.size(); ++k) EXPECT_EQ(x[k], -static_cast<double>(k));
}

// Of a million states a few thousand are kept in the order of time, including a peak of a single state at any
// place.
TEST(SampledPath, KeepEveryPeakOfALongRun) {
  constexpr int count = 1'000'000;
  for (const int peak : {0, 1, 4000, 4001, 123'456, 999'998, 999'999}) {
    for (const double direction : {1.0, -1.0}) {
      SampledPath samples(0, direction * count);
      for (int k = 0; k < count; ++k)
        samples.add(direction * k, State{std::sin(k), k == peak ? 5.0 : k == count / 3 ? -4.0 : 0.0});
      const auto [t, x] = samples.component(1);
      EXPECT_LE(t.size(), 8002U);
      EXPECT_GE(t.size(), 2000U);
      EXPECT_TRUE(
          std::ranges::is_sorted(t, [&](double a, double b) { return a * direction < b * direction; }));
      const auto place = std::ranges::find(x, 5.0);
      ASSERT_NE(place, x.end()) << peak;
      EXPECT_EQ(t[static_cast<std::size_t>(place - x.begin())], direction * peak);
      EXPECT_EQ(*std::ranges::min_element(x), -4.0);
    }
  }
}

}  // namespace
}  // namespace nlmech::comparison

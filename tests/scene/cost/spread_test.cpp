/// Labels that are moved apart: gaps, order, range, and the least way.
#include "nlmech/scene/cost/spread.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <vector>

namespace nlmech::scene::spread_test {
namespace {

using Places = std::vector<double>;

TEST(Spread, LeavesAloneWhatHasRoom) {
  EXPECT_EQ(spread({3, 1, 7}, 2, 0, 10), (Places{3, 1, 7}));
  EXPECT_EQ(spread({4}, 2, 0, 10), Places{4});
  EXPECT_TRUE(spread({}, 2, 0, 10).empty());
}

TEST(Spread, MovesNeighboursApartByTheSame) {
  EXPECT_EQ(spread({5, 5}, 2, 0, 10), (Places{4, 6}));
  EXPECT_EQ(spread({5, 4, 9}, 2, 0, 10), (Places{5.5, 3.5, 9}));
  EXPECT_EQ(spread({5, 5, 5}, 2, 0, 10), (Places{3, 5, 7})) << "of equals the first is the lowest";
}

TEST(Spread, StaysInItsRange) {
  EXPECT_EQ(spread({10, 10, 10}, 2, 0, 10), (Places{6, 8, 10}));
  EXPECT_EQ(spread({-3, 0}, 2, 0, 10), (Places{0, 2}));
  EXPECT_EQ(spread({5, 5, 5, 5, 5}, 4, 0, 10), (Places{0, 2.5, 5, 7.5, 10})) << "too many for the gap";
}

RC_GTEST_PROP(Spread, KeepsOrderGapAndRange, (const std::vector<int>& drawn)) {
  constexpr double gap = 3, low = -50, high = 250, rounding = 1e-9;
  Places wanted;
  for (const int x : drawn) wanted.push_back(x % 300);
  const Places places = spread(wanted, gap, low, high);
  RC_ASSERT(places.size() == wanted.size());
  const double least =
      std::min(gap, wanted.size() > 1 ? (high - low) / static_cast<double>(wanted.size() - 1) : gap);
  for (std::size_t i = 0; i < places.size(); ++i) {
    RC_ASSERT(places[i] >= low - rounding && places[i] <= high + rounding);
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (wanted[i] < wanted[k]) RC_ASSERT(places[k] - places[i] >= least - rounding);
    }
  }
}

}  // namespace
}  // namespace nlmech::scene::spread_test

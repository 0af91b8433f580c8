/// A growing series computes what a power series does, one coefficient a pass.
#include "nlmech/program/growing_series.hpp"

#include <gtest/gtest.h>

#include <type_traits>

#include "nlmech/program/dual.hpp"
#include "nlmech/program/power_series.hpp"
#include "tests/program/numbers.hpp"

namespace nlmech::tests::growing_series_test {
namespace {

/// Every operation, with constants on both sides and constants of constants.
template <class S>
Vector<S, 3> tangle(const S& a, const S& b) {
  const S one = 1, two = one + 1;
  S c = a * b - 3.0 * a + b / two;
  c += sqrt(a) * (two - 1);
  c *= exp(-b);
  c -= +a;
  c /= b + 0.5;
  const S d = sin(a * b) / cos(b - 1) + pow(a, 5) - pow(b, -3) * pow(a, 0) + 1 / a;
  const S e = sqrt(two * (one + 1)) - exp(two - one - 1) + cos(S(0)) * sin(S(0)) / two + one / two - one;
  return {c, d, e};
}

constexpr std::size_t order = 12;

// The recurrences are the same, so are their roundings: every coefficient is equal to the last bit.
RC_GTEST_PROP(GrowingSeries, EqualsAPowerSeries, ()) {
  std::vector<double> a = {*between(1, 2)}, b = {*between(1, 2)};
  for (std::size_t k = 1; k <= order; ++k) {
    a.push_back(*between(-1, 1));
    b.push_back(*between(-1, 1));
  }
  const auto whole = tangle(PowerSeries<double>(a), PowerSeries<double>(b));
  SeriesMemory<double> memory;
  for (int use = 0; use < 2; ++use) {  // the second time in memory that has been used
    memory.start(order);
    auto x = GrowingSeries<double>::variable(memory), y = GrowingSeries<double>::variable(memory);
    for (std::size_t k = 0; k <= order; ++k) {
      x.set(k, a[k]);
      y.set(k, b[k]);
      memory.begin_pass(k);
      const auto grown = tangle(x, y);
      for (int i = 0; i < 3; ++i) RC_ASSERT(grown[i][k] == whole[i][k]);
      for (int i = 0; i < 3; ++i) RC_ASSERT(value_of(grown[i]) == value_of(whole[i]));
    }
  }
}

template <class A>
concept HasOrder = requires(const A& a, const A& b) {
  a < b;
};

TEST(GrowingSeriesType, HasNoOrderRelationAndConstantsOfEveryOrder) {
  using S = GrowingSeries<double>;
  static_assert(!HasOrder<S>);
  static_assert(std::is_same_v<decltype(value_of(GrowingSeries<Dual<double, 2>>())), double>);
  EXPECT_EQ(S(2.5)[0], 2.5);
  EXPECT_EQ(S(2.5)[7], 0);
  EXPECT_EQ((S(2) * S(3) - 1)[0], 5);
  EXPECT_EQ((-S(2))[0], -2);
  EXPECT_EQ(value_of(S(4)), 4);
}

}  // namespace
}  // namespace nlmech::tests::growing_series_test

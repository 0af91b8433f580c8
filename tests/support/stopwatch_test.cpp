#include "nlmech/support/stopwatch.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <utility>

#include <algorithm>
#include <stdexcept>

namespace nlmech::stopwatch_test {
namespace {

using nlmech::median;
using nlmech::repeated_timing;
using nlmech::Stopwatch;
using nlmech::time_repeats;
using nlmech::Timing;

TEST(Median, OfAnOddCountIsTheMiddleValue) {
  EXPECT_EQ(median({7}), 7);
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({5, -1, 9, 0, 2}), 2);
}

TEST(Median, OfAnEvenCountIsTheMeanOfTheMiddleTwo) {
  EXPECT_EQ(median({1, 2}), 1.5);
  EXPECT_EQ(median({10, 1, 2, 20}), 6);
  EXPECT_EQ(median({4, 4, 4, 4}), 4);
}

TEST(Median, OfNothingIsRefused) { EXPECT_THROW(static_cast<void>(median({})), std::invalid_argument); }

RC_GTEST_PROP(Median, IsWhatSortingGives, ()) {
  const auto whole = *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(-1000, 1000)));
  const std::vector<double> values(whole.begin(), whole.end());
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t n = sorted.size();
  RC_ASSERT(median(values) == (sorted[(n - 1) / 2] + sorted[n / 2]) / 2);  // exact: halves of small integers
}

TEST(Stopwatch, NeverRunsBackwards) {
  const Stopwatch watch;
  double before = 0;
  for (int i = 0; i < 1000; ++i) {
    const double now = watch.seconds();
    ASSERT_GE(now, before);
    before = now;
  }
}

TEST(TimeRepeats, WarmsUpOnceAndThenCounts) {
  for (const int repeats : {1, 2, 7}) {
    int calls = 0;
    const Timing timing = time_repeats([&] { ++calls; }, repeats);
    EXPECT_EQ(calls, repeats + 1);
    EXPECT_EQ(timing.repeats, repeats);
    EXPECT_LE(0, timing.smallest);
    EXPECT_LE(timing.smallest, timing.median);
    EXPECT_LE(timing.median, timing.largest);
  }
}

TEST(TimeRepeats, NeedsARepeat) {
  int calls = 0;
  EXPECT_THROW(static_cast<void>(time_repeats([&] { ++calls; }, 0)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(time_repeats([&] { ++calls; }, -3)), std::invalid_argument);
  EXPECT_EQ(calls, 0);
}

TEST(TimeRepeats, PassesOnWhatTheWorkThrows) {
  EXPECT_THROW(static_cast<void>(time_repeats([] { throw std::runtime_error("stop"); }, 3)),
               std::runtime_error);
}

TEST(RepeatedTiming, RepeatsWhatIsShortAndNothingElse) {
  int calls = 0;
  const auto work = [&calls] { ++calls; };
  EXPECT_EQ(repeated_timing(work, 1e-5, false).repeats, 5);
  EXPECT_EQ(calls, 5);  // the first call has warmed up
  calls = 0;
  EXPECT_EQ(repeated_timing(work, 0.002, false).repeats, 2);
  EXPECT_EQ(calls, 2);
  calls = 0;
  for (const auto& [first, quick] : {std::pair{0.02, false}, {1e-5, true}}) {
    const Timing timing = repeated_timing(work, first, quick);
    EXPECT_EQ(timing.median, first);
    EXPECT_EQ(timing.repeats, 1);
  }
  EXPECT_EQ(calls, 0);
}

}  // namespace
}  // namespace nlmech::stopwatch_test

/// How much a method gives for how little time: digits of runs, and the front through them.
#include "nlmech/scene/cost/lines.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace nlmech::scene::lines_test {
namespace {

Attempt run(std::optional<double> error, double seconds) {
  return {"", "", error, {seconds, seconds, seconds, 1}};
}

TEST(Attempts, HaveDigitsIfTheirErrorIsANumber) {
  EXPECT_DOUBLE_EQ(*run(1e-7, 1).digits(), 7);
  EXPECT_DOUBLE_EQ(*run(100, 1).digits(), -2);
  EXPECT_DOUBLE_EQ(*run(0, 1).digits(), 53 * std::log10(2)) << "half an epsilon is all that a double has";
  EXPECT_FALSE(run({}, 1).digits());
  EXPECT_FALSE(run(NAN, 1).digits());
  EXPECT_FALSE(run(HUGE_VAL, 1).digits());
}

TEST(MethodLines, HaveABestAttempt) {
  const MethodLine line{"a, N = 3", 0, {run({}, 1), run(1e-3, 1), run(1e-5, 2), run(1e-4, 3), run(NAN, 4)}};
  EXPECT_EQ(line.best(), &line.attempts[2]);
  EXPECT_EQ(line.least_error(), 1e-5);
  EXPECT_EQ(line.family(), "a");
  const MethodLine failing{"b", 0, {run({}, 1)}}, absent{"c", 0, {}};
  EXPECT_EQ(failing.best(), nullptr);
  EXPECT_EQ(failing.least_error(), HUGE_VAL);
  EXPECT_EQ(absent.best(), nullptr);
  EXPECT_EQ(absent.family(), "c");
}

TEST(MethodLines, AreFoundByName) {
  const ProblemLines problem{"", {{"one", 0, {}}, {"two", 0, {run(1e-7, 1)}}}};
  EXPECT_EQ(problem.of("two").least_error(), 1e-7);
  EXPECT_THROW(static_cast<void>(problem.of("three")), std::out_of_range);
}

// Between 1e-2 s at 4 digits and 1 s at 8, six digits take the geometric mean.
TEST(AFront, IsStraightInTheLogarithmOfTime) {
  const Front front({"", 0, {run(1e-4, 1e-2), run(1e-8, 1)}});
  EXPECT_NEAR(*front.time(6), 0.1, 1e-15);
  EXPECT_NEAR(*front.time(5), std::pow(10, -1.5), 1e-15);
  EXPECT_DOUBLE_EQ(*front.time(1), 1e-2) << "the cheapest run gives fewer digits as well";
  EXPECT_DOUBLE_EQ(*front.time(8), 1) << "whatever the logarithm of 1e-8 is rounded to";
  EXPECT_FALSE(front.time(8.1)) << "no run has so many";
}

// A run that another one beats in both is no part of it; the front rises, in whatever order runs come.
TEST(AFront, IsMonotone) {
  const Front front(
      {"", 0, {run(1e-9, 4), run(1e-3, 0.5), run(1e-6, 5), run(1e-5, 1), run({}, 0.1), run(1e-2, 0.7)}});
  EXPECT_DOUBLE_EQ(*front.time(2), 0.5) << "1e-2 in 0.7 s loses to 1e-3 in 0.5 s";
  EXPECT_LT(*front.time(6), 4) << "1e-6 in 5 s loses to 1e-9 in 4 s";
  double before = 0;
  for (double digits = 0; digits <= 9; digits += 0.125) {
    const auto time = front.time(digits);
    ASSERT_TRUE(time) << digits;
    EXPECT_GE(*time, before) << digits;
    before = *time;
  }
}

TEST(AFront, HasNothingOfRunsWithoutDigitsOrTime) {
  EXPECT_FALSE(Front({"", 0, {}}).time(0));
  EXPECT_FALSE(Front({"", 0, {run({}, 1), run(NAN, 1), run(1e-9, 0), run(1e-9, NAN)}}).time(0));
  const Front one({"", 0, {run(1e-3, 2)}});
  EXPECT_DOUBLE_EQ(*one.time(0), 2);
  EXPECT_DOUBLE_EQ(*one.time(3), 2);
  EXPECT_FALSE(one.time(4));
}

}  // namespace
}  // namespace nlmech::scene::lines_test

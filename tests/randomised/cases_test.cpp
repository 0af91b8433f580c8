/// The framework of randomised tests: it detects wrong cases, reports how to repeat them, and rejects empty
/// tests.
#include "tests/randomised/randomised.hpp"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <cmath>

namespace nlmech::randomised::cases_test {
namespace {

TEST(Randomised, FindsTheOneWrongCaseOfAHundred) {
  int number = 0;
  const auto one_wrong = [&number](Draw&) { return Case::judged(++number == 42 ? 2 : 0.5, 1, "the answer"); };
  testing::TestPartResultArray results;
  {
    const testing::ScopedFakeTestPartResultReporter reporter(
        testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &results);
    randomised_test({.quick = 100, .full = 100}, one_wrong);
  }
  ASSERT_EQ(results.size(), 2);  // the case, and the fact that there is one
  EXPECT_NE(std::string(results.GetTestPartResult(0).message()).find("case 41 "), std::string::npos);
  EXPECT_NE(std::string(results.GetTestPartResult(0).message()).find("error 2, allowed 1; the answer"),
            std::string::npos);
}

TEST(Randomised, IsNotContentWithRefusalsAlone) {
  testing::TestPartResultArray results;
  {
    const testing::ScopedFakeTestPartResultReporter reporter(
        testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &results);
    randomised_test({.quick = 10, .full = 10}, [](Draw&) { return Case::refused(); });
  }
  EXPECT_EQ(results.size(), 1);
}

TEST(Randomised, CountsANaNAndAForeignExceptionAsWrong) {
  EXPECT_EQ(Case::judged(NAN, 1, "").verdict, Case::Verdict::wrong);
  testing::TestPartResultArray results;
  {
    const testing::ScopedFakeTestPartResultReporter reporter(
        testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &results);
    randomised_test({.quick = 1, .full = 1, .least_right = 0},
                    [](Draw&) -> Case { throw std::out_of_range("no such row"); });
  }
  EXPECT_EQ(results.size(), 2);
}

TEST(Randomised, DrawsTheCornersAndStaysWithinTheRange) {
  int lowest = 0, highest = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Draw draw(seed);
    const double x = draw.log_uniform(1e-3, 1e5);
    EXPECT_TRUE(x >= 1e-3 && x <= 1e5) << x;
    lowest += x == 1e-3;
    highest += x == 1e5;
    EXPECT_TRUE(std::isfinite(draw.any_finite()));
  }
  EXPECT_GT(lowest, 20);  // share of one special value: 2000/8/3 = 83 on average, standard deviation 9
  EXPECT_GT(highest, 20);
}

}  // namespace
}  // namespace nlmech::randomised::cases_test

#include "nlmech/support/statistics.hpp"

#include <gtest/gtest.h>

namespace nlmech::statistics_test {
namespace {

using nlmech::Statistics;

// Powers of two: all sums are different.
constexpr Statistics small{.steps = 1,
                           .rejected = 2,
                           .right_hand_sides = 4,
                           .jacobians = 8,
                           .newton_iterations = 16,
                           .factorisations = 32,
                           .fallbacks = 64,
                           .seconds = 0.5};
constexpr Statistics large{.steps = 1'000'000'000'000,
                           .rejected = 256,
                           .right_hand_sides = 512,
                           .jacobians = 1024,
                           .newton_iterations = 2048,
                           .factorisations = 4096,
                           .fallbacks = 8192,
                           .seconds = 0.25};

void expect_sum(const Statistics& sum) {
  EXPECT_EQ(sum.steps, 1'000'000'000'001);
  EXPECT_EQ(sum.rejected, 258);
  EXPECT_EQ(sum.right_hand_sides, 516);
  EXPECT_EQ(sum.jacobians, 1032);
  EXPECT_EQ(sum.newton_iterations, 2064);
  EXPECT_EQ(sum.factorisations, 4128);
  EXPECT_EQ(sum.fallbacks, 8256);
  EXPECT_EQ(sum.seconds, 0.75);
}

TEST(Statistics, StartAtZero) {
  const Statistics none;
  expect_sum(small + none + large);
}

TEST(Statistics, AddCounterByCounter) {
  // A new counter of the struct must be added here.
  static_assert(sizeof(Statistics) == 7 * sizeof(std::int64_t) + sizeof(double));
  expect_sum(small + large);
  expect_sum(large + small);
}

TEST(Statistics, AddToTheLeftSide) {
  Statistics sum = small;
  EXPECT_EQ(&(sum += large), &sum);
  expect_sum(sum);
}

}  // namespace
}  // namespace nlmech::statistics_test

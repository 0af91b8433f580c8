#include "nlmech/support/sign_change.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace nlmech::sign_change_test {
namespace {

TEST(SignChange, IsFoundToTheLastBit) {
  const auto f = [](double x) { return x * x - 2; };
  const double root = sign_change(f, 0, 3);
  EXPECT_LT(f(root), 0);
  EXPECT_GE(f(std::nextafter(root, 3.)), 0);
  const auto falling = [](double x) { return 1 - x; };
  EXPECT_NEAR(sign_change(falling, -1e3, 1e3), 1, std::numeric_limits<double>::epsilon());
}

TEST(SignChange, AnEndIsTheAnswerWhereThereIsNone) {
  EXPECT_EQ(sign_change([](double) { return 1.; }, 2, 3), 2);
  EXPECT_EQ(sign_change([](double x) { return x - 3; }, 2, 3), 3);
  EXPECT_EQ(sign_change([](double x) { return x - 2; }, 2, 3), 2);
  EXPECT_EQ(sign_change([](double) { return std::nan(""); }, 2, 3), 2);
}

}  // namespace
}  // namespace nlmech::sign_change_test

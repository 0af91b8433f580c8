/// Sines and cosines of degrees against closed forms.
#include "nlmech/support/degrees.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "nlmech/support/doubles.hpp"

namespace nlmech::degrees_test {
namespace {

TEST(Degrees, QuarterTurnsAreExact) {
  const double sines[] = {0, 1, 0, -1}, cosines[] = {1, 0, -1, 0};
  for (int quarters = -8; quarters <= 8; ++quarters) {
    const auto [sine, cosine] = sine_cosine_of_degrees(90. * quarters);
    EXPECT_EQ(sine, sines[quarters & 3]) << quarters;
    EXPECT_EQ(cosine, cosines[quarters & 3]) << quarters;
    EXPECT_FALSE(std::signbit(sine) && sine == 0) << quarters;
    EXPECT_FALSE(std::signbit(cosine) && cosine == 0) << quarters;
  }
  EXPECT_EQ(sine_cosine_of_degrees(360e15).sine, 0);
}

// Two roundings of the product with pi/180, one of the function.
TEST(Degrees, KnownAngles) {
  const double half = 0.5, root = std::sqrt(3.0) / 2;
  for (const double turns : {-720., 0., 360.}) {
    EXPECT_NEAR(sine_cosine_of_degrees(turns + 30).sine, half, 2 * eps);
    EXPECT_NEAR(sine_cosine_of_degrees(turns + 120).cosine, -half, 2 * eps);
    EXPECT_NEAR(sine_cosine_of_degrees(turns + 240).sine, -root, 2 * eps);
    EXPECT_NEAR(sine_cosine_of_degrees(turns + 330).cosine, root, 2 * eps);
  }
}

// Near multiples of 90 degrees the smaller function has all digits of the distance: sin x = x - x^3/6, where
// the second term is below eps of the first for x below 2^-20 degrees.
TEST(Degrees, SmallOnesKeepTheirDigits) {
  for (int power = -20; power >= -44; --power) {
    const double distance = std::ldexp(1.0, power), small = distance * std::numbers::pi / 180;
    EXPECT_NEAR(sine_cosine_of_degrees(180 - distance).sine / small, 1, 2 * eps) << power;
    EXPECT_NEAR(sine_cosine_of_degrees(90 + distance).cosine / -small, 1, 2 * eps) << power;
    EXPECT_NEAR(sine_cosine_of_degrees(-270 + distance).cosine / -small, 1, 2 * eps) << power;
  }
}

TEST(Degrees, WhatIsNoAngle) {
  EXPECT_TRUE(std::isnan(sine_cosine_of_degrees(HUGE_VAL).sine));
  EXPECT_TRUE(std::isnan(sine_cosine_of_degrees(NAN).cosine));
}

}  // namespace
}  // namespace nlmech::degrees_test

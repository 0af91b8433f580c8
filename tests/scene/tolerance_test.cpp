#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "nlmech/scene/evidence/published.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::scene::tolerance_test {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Tolerance, OfANumberIsRelative) {
  const Tolerance tolerance("0.01");
  EXPECT_TRUE(tolerance.allows(100.9, 100));
  EXPECT_FALSE(tolerance.allows(101.1, 100));
  EXPECT_TRUE(tolerance.allows(-99.1, -100));
  EXPECT_FALSE(tolerance.allows(100, -100));
  EXPECT_TRUE(Tolerance("1e-3").allows(1.0009, 1));
  EXPECT_FALSE(Tolerance("1e-3").allows(1.0011, 1));
}

// Rounded up, rounded down or cut off.
TEST(Tolerance, OfDigitsIsAUnitOfTheLastPrintedOne) {
  const Tolerance digits("digits", "1.18e-4");
  EXPECT_TRUE(digits.allows(1.1899e-4, 1.18e-4));
  EXPECT_TRUE(digits.allows(1.1701e-4, 1.18e-4));
  EXPECT_FALSE(digits.allows(1.1901e-4, 1.18e-4));
  EXPECT_TRUE(Tolerance("digits", "9").allows(10, 9)) << "the edge is within";
  EXPECT_TRUE(Tolerance("digits", "-0.3193").allows(-0.3194, -0.3193));
  EXPECT_FALSE(Tolerance("digits", "-0.3193").allows(-0.3195, -0.3193));
  EXPECT_TRUE(Tolerance("digits", "0.1584e10").allows(0.15845e10, 0.1584e10));
  EXPECT_TRUE(Tolerance("digits", "27.11").allows(27.1199, 27.11));
  EXPECT_FALSE(Tolerance("digits", "0").allows(1.5, 0));
  EXPECT_TRUE(Tolerance("3 units", "-0.3130").allows(-0.31273, -0.3130));
  EXPECT_FALSE(Tolerance("2 units", "-0.3130").allows(-0.31273, -0.3130));
}

TEST(Tolerance, OfAFactorHoldsBothWays) {
  const Tolerance tolerance("factor 5");
  EXPECT_TRUE(tolerance.allows(4.9, 1));
  EXPECT_TRUE(tolerance.allows(0.21, 1));
  EXPECT_FALSE(tolerance.allows(5.1, 1));
  EXPECT_FALSE(tolerance.allows(0.19, 1));
  EXPECT_TRUE(tolerance.allows(-2, -1));
  EXPECT_FALSE(tolerance.allows(-1, 1)) << "another sign is no factor";
}

TEST(Tolerance, OfAnOrderOfMagnitudeIsAFactorOfTheRootOfTen) {
  const Tolerance tolerance("order of magnitude");
  EXPECT_TRUE(tolerance.allows(3.16e-11, 1e-11));
  EXPECT_FALSE(tolerance.allows(3.17e-11, 1e-11));
  EXPECT_TRUE(tolerance.allows(0.317e-11, 1e-11));
  EXPECT_FALSE(tolerance.allows(0.316e-11, 1e-11));
}

TEST(Tolerance, AtLeastAsksForOursAlone) {
  const Tolerance tolerance("at least 100");
  EXPECT_TRUE(tolerance.allows(100, 1));
  EXPECT_TRUE(tolerance.allows(1e9, 1));
  EXPECT_FALSE(tolerance.allows(99.9, 99.9));
  EXPECT_FALSE(tolerance.allows(-200, 100));
}

TEST(Tolerance, BelowAsksForTheMagnitudeOfOursAlone) {
  for (const char* words : {"below 1e-15"}) {
    const Tolerance tolerance(words);
    EXPECT_TRUE(tolerance.allows(0, 1e-22)) << words;
    EXPECT_TRUE(tolerance.allows(-9e-16, 1e-22)) << words;
    EXPECT_FALSE(tolerance.allows(1.1e-15, 1.1e-15)) << words;
    EXPECT_FALSE(tolerance.allows(-1.1e-15, 0)) << words;
  }
}

TEST(Tolerance, RefusesWordsThatItDoesNotKnow) {
  for (const std::string words : {"",
                                  "a little",
                                  "units",
                                  "x units",
                                  "-1 units",
                                  "0 units",
                                  "digit",
                                  "0",
                                  "-0.1",
                                  "5 %",
                                  "0.1 or so",
                                  "factor",
                                  "factor ",
                                  "factor x",
                                  "factor -2",
                                  "factor 0",
                                  "Factor 5",
                                  "at least",
                                  "at least ten",
                                  "below",
                                  "below -1",
                                  "about 5",
                                  "nan",
                                  "inf",
                                  "factor nan",
                                  "1e999",
                                  "order of magnitudes",
                                  "rounding floor",
                                  "at most 3",
                                  "0,15"}) {
    EXPECT_THROW(Tolerance{words}, InputError) << "'" << words << "'";
  }
}

// A factor below one allows nothing, not even a perfect match up to rounding: it is a slip of the pen.
TEST(Tolerance, RefusesAFactorBelowOne) {
  EXPECT_THROW(Tolerance{"factor 0.5"}, InputError);
  EXPECT_TRUE(Tolerance{"factor 1"}.allows(2, 2));
}

TEST(Tolerance, RepeatsTheWordsThatItRefuses) {
  try {
    Tolerance{"a little"};
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "'a little' is no tolerance");
  }
}

const std::vector<std::string> all_forms = {
    "digits", "7 units", "0.5", "1e9", "factor 5", "order of magnitude", "at least 1e-300", "below 1e300"};

TEST(Tolerance, NeverAllowsNaN) {
  for (const std::string& words : all_forms) {
    const Tolerance tolerance(words);
    for (const double theirs : {0.0, 1.0, -1.0, inf, nan})
      EXPECT_FALSE(tolerance.allows(nan, theirs)) << words;
    EXPECT_FALSE(tolerance.allows(nan, 0, 1)) << words;
    EXPECT_FALSE(tolerance.allows(nan, nan, nan)) << words;
  }
}

TEST(Tolerance, AllowsNoInfinityBesideAFiniteNumber) {
  for (const std::string& words : all_forms) {
    if (words.starts_with("at least")) continue;
    EXPECT_FALSE(Tolerance(words).allows(inf, 1)) << words;
    EXPECT_FALSE(Tolerance(words).allows(-inf, 1)) << words;
    EXPECT_FALSE(Tolerance(words).allows(inf, 1, 2)) << words;
  }
}

TEST(Tolerance, OfAPrintedZeroAsksForZero) {
  for (const char* words : {"0.5", "factor 5", "order of magnitude"}) {
    EXPECT_TRUE(Tolerance(words).allows(0, 0)) << words;
    EXPECT_TRUE(Tolerance(words).allows(-0.0, 0)) << words;
    EXPECT_FALSE(Tolerance(words).allows(1e-300, 0)) << words;
    EXPECT_FALSE(Tolerance(words).allows(0, 1e-300)) << words;
  }
}

TEST(Tolerance, OfARangeAllowsAllInsideAndAMarginAround) {
  const Tolerance tolerance("0.1");
  EXPECT_TRUE(tolerance.allows(1.5, 1, 2));
  EXPECT_TRUE(tolerance.allows(1, 1, 2));
  EXPECT_TRUE(tolerance.allows(2.19, 1, 2)) << "within the margin of the upper end";
  EXPECT_FALSE(tolerance.allows(2.21, 1, 2));
  EXPECT_TRUE(tolerance.allows(0.91, 1, 2));
  EXPECT_FALSE(tolerance.allows(0.89, 1, 2));
  EXPECT_TRUE(tolerance.allows(1.5, 2, 1)) << "either end may come first";
  EXPECT_TRUE(tolerance.allows(0, -1, 1));
}

RC_GTEST_PROP(Tolerance, AllowsEveryFiniteNumberBesideItself, ()) {
  const double x = std::bit_cast<double>(*rc::gen::arbitrary<std::uint64_t>());
  RC_PRE(std::isfinite(x));
  for (const char* words : {"digits", "1e-17", "factor 1", "factor 5", "order of magnitude"}) {
    RC_ASSERT(Tolerance(words).allows(x, x));
    RC_ASSERT(Tolerance(words).allows(x, x, x));
  }
}

}  // namespace
}  // namespace nlmech::scene::tolerance_test

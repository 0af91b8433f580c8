/// Verdicts, and the tolerances of printed numbers.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <ostream>

#include "nlmech/scene/evidence/published.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::scene::verdict_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();
using Number = std::optional<double>;
constexpr Number none = std::nullopt;

/// A printed number with the columns of the files.
PublishedValue printed(double value, Verdict expected, std::string nominal = "", std::string inferred = "",
                       std::string tolerance = "0.1", std::string kind = "error") {
  PublishedValue p;
  p.value = value;
  p.expected = expected;
  p.nominal = std::move(nominal);
  p.inferred = std::move(inferred);
  p.tolerance = std::move(tolerance);
  p.kind = std::move(kind);
  return p;
}

bool passes(const PublishedValue& value, Number nominal, Number inferred = none) {
  const Judgement judgement = verdict_on(value, {nominal, inferred});
  if (judgement.passes) {
    EXPECT_EQ(judgement.verdict, value.expected);
  }
  return judgement.passes;
}

TEST(Verdict, HasTheWordsOfTheFiles) {
  EXPECT_EQ(to_string(Verdict::reproduced), "reproduced");
  EXPECT_EQ(to_string(Verdict::reproduced_inferred), "reproduced, inferred reading");
  EXPECT_EQ(to_string(Verdict::same_rounding), "same rounding level");
  EXPECT_EQ(to_string(Verdict::holds), "holds");
  EXPECT_EQ(to_string(Verdict::does_not_hold), "does not hold");
  EXPECT_EQ(to_string(Verdict::better), "better");
  EXPECT_EQ(to_string(Verdict::differs), "differs");
  EXPECT_EQ(to_string(Verdict::not_stated), "not stated");
  EXPECT_EQ(to_string(Verdict::context), "context");
  EXPECT_EQ(to_string(Verdict::input), "input");
}

TEST(Verdict, ReproducedNeedsTheNominalNumberBesideThePrintedOne) {
  const PublishedValue value = printed(2, Verdict::reproduced);
  EXPECT_TRUE(passes(value, 2.19));
  EXPECT_FALSE(passes(value, 2.21));
  EXPECT_FALSE(passes(value, none, 2)) << "an inferred reading is not the nominal one";
  EXPECT_FALSE(passes(value, nan));
  EXPECT_FALSE(passes(value, inf));
  EXPECT_FALSE(passes(value, none));
}

TEST(Verdict, ReproducedMeasuresAgainstThePrintedNumberNotAgainstOurOldOne) {
  const PublishedValue value = printed(2, Verdict::reproduced, "2.15");
  EXPECT_TRUE(passes(value, 1.9));
  EXPECT_FALSE(passes(value, 2.3)) << "beside our own 2.15, but not beside the printed 2";
}

TEST(Verdict, InferredNeedsTheInferredNumberBesideThePrintedOne) {
  const PublishedValue value =
      printed(1.15e-5, Verdict::reproduced_inferred, "", "1.3e-5..1.5e-5 with c = 2.5");
  EXPECT_TRUE(passes(value, none, 1.2e-5));
  EXPECT_FALSE(passes(value, none, 1.4e-5)) << "beside our own, but not beside the printed number";
  EXPECT_FALSE(passes(value, 1.15e-5, none)) << "the nominal number is not the inferred one";
  EXPECT_FALSE(passes(value, none, nan));
}

TEST(Verdict, NoDigitsAreComparedOfNoiseBoundsAndClaims) {
  for (const char* kind : {"rounding", "bound", "claim"}) {
    EXPECT_FALSE(passes(printed(2, Verdict::reproduced, "", "", "0.1", kind), 2)) << kind;
    EXPECT_FALSE(passes(printed(2, Verdict::reproduced_inferred, "", "", "0.1", kind), none, 2)) << kind;
  }
  EXPECT_FALSE(passes(printed(2, Verdict::reproduced, "", "", "below 3"), 2))
      << "no distance from the printed number";
  EXPECT_FALSE(passes(printed(2, Verdict::reproduced, "", "", "at least 1"), 2));
}

TEST(Verdict, NoiseSharesALevel) {
  const auto noise = [](double value, const char* tolerance, const char* kind = "rounding") {
    return printed(value, Verdict::same_rounding, "", "", tolerance, kind);
  };
  EXPECT_TRUE(passes(noise(2e-16, "below 1e-15"), 1e-24));
  EXPECT_TRUE(passes(noise(2e-16, "below 1e-15"), 0));
  EXPECT_FALSE(passes(noise(2e-16, "below 1e-15"), 2e-15));
  EXPECT_FALSE(passes(noise(2e-15, "below 1e-15"), 1e-16)) << "the printed one is no noise of that level";
  EXPECT_TRUE(passes(noise(3.5e-6, "factor 5"), 1e-6));
  EXPECT_FALSE(passes(noise(3.5e-6, "factor 5"), 1e-7));
  EXPECT_FALSE(passes(noise(2e-16, "below 1e-15"), none));
  EXPECT_TRUE(passes(noise(2e-16, "below 1e-15"), none, 1e-24)) << "under a reading, and shown as such";
  EXPECT_FALSE(passes(noise(2e-16, "below 1e-15"), none, 2e-15));
  EXPECT_TRUE(passes(noise(2e-16, "below 1e-15"), 2e-15, 1e-24)) << "whatever the text as printed gives";
  EXPECT_FALSE(passes(noise(2e-16, "below 1e-15", "error"), 1e-24))
      << "an error is no noise unless it is said to be";
}

TEST(Verdict, BetterNeedsABoundOrNoiseAndLessOfIt) {
  for (const char* kind : {"bound", "rounding"}) {
    const PublishedValue value = printed(1e-3, Verdict::better, "7.9e-7", "", "0.1", kind);
    EXPECT_TRUE(passes(value, 7.9e-7));
    EXPECT_TRUE(passes(value, 8.5e-7));
    EXPECT_TRUE(passes(printed(1e-3, Verdict::better, "", "", "0.1", kind), -8.5e-7))
        << "the magnitude counts";
    EXPECT_FALSE(passes(value, 9e-7)) << "no longer what was found";
    EXPECT_FALSE(passes(value, 2e-3));
    EXPECT_FALSE(passes(value, nan));
    EXPECT_FALSE(passes(value, none));
    EXPECT_FALSE(passes(printed(1e-3, Verdict::better, "two digits smaller", "", "0.1", kind), 1e-3));
  }
  for (const char* kind : {"error", "count", "value"})
    EXPECT_FALSE(passes(printed(1e-3, Verdict::better, "", "", "0.1", kind), 1e-6))
        << "a method that misses: " << kind;
}

TEST(Verdict, ClaimsHoldOrDoNot) {
  const auto claim = [](Verdict verdict, const char* kind = "claim") {
    return printed(100, verdict, "", "", "at least 100", kind);
  };
  EXPECT_TRUE(passes(claim(Verdict::holds), 236));
  EXPECT_FALSE(passes(claim(Verdict::holds), 2.3));
  EXPECT_TRUE(passes(claim(Verdict::does_not_hold), 2.3));
  EXPECT_FALSE(passes(claim(Verdict::does_not_hold), 236));
  EXPECT_FALSE(passes(claim(Verdict::does_not_hold), nan));
  EXPECT_FALSE(passes(claim(Verdict::holds), none, 236)) << "as the text stands";
  EXPECT_FALSE(passes(claim(Verdict::holds, "value"), 236));
}

TEST(Verdict, DiffersNeedsAnotherNumberThanThePrintedOne) {
  const PublishedValue value = printed(0.5, Verdict::differs);
  EXPECT_TRUE(passes(value, 0.6));
  EXPECT_TRUE(passes(value, inf)) << "a divergence differs";
  EXPECT_FALSE(passes(value, 0.54)) << "beside the printed number";
  EXPECT_FALSE(passes(value, nan)) << "NaN is no finding";
  EXPECT_FALSE(passes(value, none));
  EXPECT_TRUE(passes(value, none, 0.6)) << "a text that cannot be run as printed";
  EXPECT_FALSE(passes(value, none, 0.54));
  EXPECT_FALSE(passes(value, 0.54, 0.6)) << "the text as printed comes first";
  EXPECT_FALSE(passes(printed(0.5, Verdict::differs, "", "0.7 with c = 2.5"), none, 0.6)) << "not as found";
}

TEST(Verdict, DiffersKeepsToTheNumberThatWasFound) {
  const PublishedValue value = printed(1000, Verdict::differs, "8 its");
  EXPECT_TRUE(passes(value, 8));
  EXPECT_FALSE(passes(value, 9));
  EXPECT_TRUE(passes(printed(1e-6, Verdict::differs, "0.33", "", "1e-3"), 0.34)) << "or 5 %";
  EXPECT_FALSE(passes(printed(1e-6, Verdict::differs, "0.33", "", "1e-3"), 0.35));
  EXPECT_FALSE(passes(value, 1000));
  const PublishedValue range =
      printed(9.6e-3, Verdict::differs, "4.7..1800 m (condition 2e17); 0.07 m with exact D");
  EXPECT_TRUE(passes(range, 4.3));
  EXPECT_TRUE(passes(range, 300));
  EXPECT_FALSE(passes(range, 0.07));
  EXPECT_FALSE(passes(range, 2000));
}

TEST(Verdict, InputNeedsThePrintedNumberItself) {
  const PublishedValue value = printed(0.1, Verdict::input, "", "", "", "parameter");
  EXPECT_TRUE(passes(value, 0.1));
  EXPECT_FALSE(passes(value, 0.1 + 2e-17));
  EXPECT_FALSE(passes(value, none, 0.1));
  EXPECT_FALSE(passes(value, nan));
  EXPECT_TRUE(passes(printed(0, Verdict::input), 0));
  EXPECT_FALSE(passes(printed(0, Verdict::input), 1e-300));
}

TEST(Verdict, ContextAndNotStatedPromiseNothing) {
  for (const Verdict verdict : {Verdict::context, Verdict::not_stated}) {
    const PublishedValue value = printed(0.23, verdict);
    EXPECT_TRUE(passes(value, none));
    EXPECT_TRUE(passes(value, 17));
    EXPECT_TRUE(passes(value, nan));
  }
}

TEST(Verdict, SaysWhatTheNumbersSupportInstead) {
  const auto instead = [](const PublishedValue& value, Number nominal, Number inferred = none) {
    const Judgement judgement = verdict_on(value, {nominal, inferred});
    EXPECT_FALSE(judgement.passes);
    return judgement.verdict;
  };
  EXPECT_EQ(instead(printed(1, Verdict::differs), 1.01), Verdict::reproduced);
  EXPECT_EQ(instead(printed(1, Verdict::differs), none, 1.01), Verdict::reproduced_inferred);
  EXPECT_EQ(instead(printed(1, Verdict::reproduced), 0.5), Verdict::differs);
  EXPECT_EQ(instead(printed(1, Verdict::reproduced, "", "", "0.1", "bound"), 0.5), Verdict::better);
  EXPECT_EQ(instead(printed(1, Verdict::differs, "", "", "0.1", "rounding"), 1.01), Verdict::same_rounding);
  EXPECT_EQ(instead(printed(1, Verdict::does_not_hold, "", "", "0.1", "claim"), 1), Verdict::holds);
  EXPECT_EQ(instead(printed(1, Verdict::holds, "", "", "0.1", "claim"), 2), Verdict::does_not_hold);
  EXPECT_EQ(instead(printed(1, Verdict::reproduced), 2), Verdict::differs);
  EXPECT_EQ(instead(printed(1, Verdict::reproduced, "1", "", "0.1", "value"), 0.5), Verdict::differs);
  EXPECT_EQ(instead(printed(1, Verdict::reproduced), 2, 1), Verdict::reproduced_inferred);
  EXPECT_EQ(instead(printed(1, Verdict::input), 1.01), Verdict::reproduced);
}

/// A text for the columns `nominal` and `inferred`, tested through `differs`.
PublishedValue beginning_with(const std::string& words) {
  return printed(1e9, Verdict::differs, words, "", "1e-9");
}

TEST(LeadingNumber, OrRangeIsReadOffTheWords) {
  const std::vector<std::tuple<std::string, double, double>> words_inside_outside = {
      {"2.4e-11", 2.4e-11, 2.6e-11},
      {"236 lat; 287 h", 236, 287},
      {"8; more", 8, 9},
      {"-0.3193", -0.3193, 0.3193},
      {"1.1e-6..1.3e-6", 1.2e-6, 1.4e-6},
      {"1.1e-6..1.3e-6 with c = 2.5, then 0.66", 1.3e-6, 0.66},
      {"1..3", 2, 4},
      {"1..3 of 7", 3, 7},
      {"-3..-1", -2, 2},
      {"-1..1", 0, 2},
      {"0", 0, 1},
      {"0.", 0, 1},
      {"5. text", 5, 6},
      {"1.0..1.6 at equal accuracy", 1.5, 1.7}};
  for (const auto& [words, inside, outside] : words_inside_outside) {
    EXPECT_TRUE(passes(beginning_with(words), inside)) << words;
    EXPECT_FALSE(passes(beginning_with(words), outside)) << words;
  }
}

// Without a leading number the text states no value, and any other number than the printed one is accepted.
TEST(LeadingNumber, IsNoneWhereNoNumberStandsFirst) {
  for (const char* words :
       {"2-cycle, 4.389 lb", "6-7 its", "x3", "3x", "", "distribution: median 100", "1.2.3", "345/2", "1e-6m",
        "..3", "5..", "1..2-cycle", "nan", "inf", "nan for h = 1", "1..nan", "infeasible"})
    EXPECT_TRUE(passes(beginning_with(words), 7)) << words;
}

TEST(Tolerance, OfANumberIsRelative) {
  const Tolerance tolerance("0.01");
  EXPECT_TRUE(tolerance.allows(100.9, 100));
  EXPECT_FALSE(tolerance.allows(101.1, 100));
  EXPECT_TRUE(tolerance.allows(-99.1, -100));
  EXPECT_FALSE(tolerance.allows(100, -100));
  EXPECT_TRUE(Tolerance("1e-3").allows(1.0009, 1));
  EXPECT_FALSE(Tolerance("1e-3").allows(1.0011, 1));
}

// Rounded or truncated: the printed number is at most half a unit too large or one unit too small.
TEST(Tolerance, OfDigitsIsRoundingOrCuttingOff) {
  const Tolerance digits("digits", "1.18e-4");
  EXPECT_TRUE(digits.allows(1.1899e-4, 1.18e-4));
  EXPECT_TRUE(digits.allows(1.1751e-4, 1.18e-4));
  EXPECT_FALSE(digits.allows(1.1749e-4, 1.18e-4));
  EXPECT_FALSE(digits.allows(1.1901e-4, 1.18e-4));
  EXPECT_FALSE(Tolerance("digits", "0.399").allows(0.3984, 0.399)) << "neither rounds nor cuts to it";
  EXPECT_TRUE(Tolerance("digits", "9").allows(10, 9)) << "the edge is within";
  EXPECT_TRUE(Tolerance("digits", "9").allows(8.5, 9));
  EXPECT_TRUE(Tolerance("digits", "-0.3193").allows(-0.31939, -0.3193));
  EXPECT_TRUE(Tolerance("digits", "-0.3193").allows(-0.31926, -0.3193));
  EXPECT_FALSE(Tolerance("digits", "-0.3193").allows(-0.31924, -0.3193));
  EXPECT_FALSE(Tolerance("digits", "-0.3193").allows(-0.3195, -0.3193));
  EXPECT_FALSE(Tolerance("digits", "5").allows(-5, 5));
  EXPECT_TRUE(Tolerance("digits", "0").allows(-0.9, 0)) << "a zero has no sign";
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
  const Tolerance tolerance("below 1e-15");
  EXPECT_TRUE(tolerance.allows(0, 1e-22));
  EXPECT_TRUE(tolerance.allows(-9e-16, 1e-22));
  EXPECT_FALSE(tolerance.allows(1.1e-15, 1.1e-15));
  EXPECT_FALSE(tolerance.allows(-1.1e-15, 0));
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
                                  "factor 0.5",
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

const std::vector<std::string> all_forms = {
    "digits", "7 units", "0.5", "1e9", "factor 5", "order of magnitude", "at least 1e-300", "below 1e300"};

TEST(Tolerance, NeverAllowsNaN) {
  for (const std::string& words : all_forms) {
    const Tolerance tolerance(words);
    for (const double printed : {0.0, 1.0, -1.0, inf, nan})
      EXPECT_FALSE(tolerance.allows(nan, printed)) << words;
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
}  // namespace nlmech::scene::verdict_test

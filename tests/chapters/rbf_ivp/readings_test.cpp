/// The readings: comparison of printed and computed numbers, and the chapter's variants of Eq. 4.4.
#include <gtest/gtest.h>

#include <cmath>

#include "chapters/rbf_ivp/readings/explicit_variants.hpp"
#include "chapters/rbf_ivp/readings/readings.hpp"

namespace nlmech::chapters::rbf_ivp::readings_test {
namespace {

TEST(LastDigit, OfNumbersAsPrinted) {
  EXPECT_DOUBLE_EQ(last_digit("1.18e-4"), 1e-6);
  EXPECT_DOUBLE_EQ(last_digit("5e-6"), 1e-6);
  EXPECT_DOUBLE_EQ(last_digit("0.0025"), 1e-4);
  EXPECT_DOUBLE_EQ(last_digit("0.1"), 0.1);
  EXPECT_DOUBLE_EQ(last_digit("147"), 1);
  EXPECT_DOUBLE_EQ(last_digit("4.6e3"), 100);
}

TEST(Score, CountsDigitsAndUnits) {
  Score s;
  s.count("0.998", 0.9977);
  EXPECT_EQ(s.exact, 1);
  s.count("0.998", 0.9989);  // cut off
  s.count("0.998", 0.9971);  // neither rounded nor cut off
  s.count("2.41e-2", 2.507e-2);
  s.count("1.18e-4", std::nan(""));
  EXPECT_EQ(s.rows, 5);
  EXPECT_EQ(s.exact, 1);
  EXPECT_EQ(s.close, 2);
}

TEST(Score, NoiseWithinAFactorOfFive) {
  Score s;
  s.count_noise(1e-6, 4.9e-6);
  s.count_noise(1e-6, 2.1e-7);
  s.count_noise(1e-6, 1.9e-7);
  s.count_noise(1e-6, INFINITY);
  EXPECT_EQ(s.exact, 2);
}

TEST(ReadingChoice, RefusesUnknownOptions) {
  const ReadingChoice q{"end", "4.4", "", "499 s", {{"499 s", {}}}};
  EXPECT_EQ(q.option("499 s").score.rows, 0);
  EXPECT_THROW(static_cast<void>(q.option("500 s")), std::logic_error);
}

// The variant equals the library's method step by step, up to rounding errors of 320 steps of numbers about
// 1.
TEST(ExplicitVariants, OneIsTheLibrarysOwn) {
  const Record own = explicit_chain(0.625, ExplicitStart::half_step, ExplicitDamping::from_initial);
  const Record library = record(three_mass_case(), 200, throughout(ivp::CentralDifference{.step = 0.625}));
  ASSERT_EQ(own.values.size(), library.values.size());
  for (std::size_t k = 0; k < own.values.size(); ++k) {
    for (Eigen::Index i = 0; i < 3; ++i)
      EXPECT_NEAR(own.values[k].error[i], library.values[k].error[i], 1e-12) << "step " << k;
  }
}

// RMS errors of x1, x2, x3; those of the first two variants have an oracle, the others are recorded.
// oracle: rbf_ivp_methods 4.6 Explicit-*
TEST(ExplicitVariants, HaveTheKnownErrors) {
  struct Known {
    double h;
    ExplicitStart start;
    ExplicitDamping damping;
    double x1, x2, x3;
  };
  using enum ExplicitStart;
  using enum ExplicitDamping;
  for (const Known& k : {Known{0.625, half_step, from_half, 0.044832, 0.082962, 0.13117},
                         Known{0.00625, half_step, from_half, 5.949e-6, 8.3378e-6, 1.4441e-5},
                         Known{0.625, half_step, implicit, 0.045294, 0.083444, 0.13193},
                         Known{0.625, half_step, lagged, 0.050719, 0.098463, 0.15345},
                         Known{0.625, as_given, from_half, 0.040864, 0.068202, 0.11095},
                         Known{0.625, whole_step, from_initial, 0.051147, 0.10177, 0.15788}}) {
    const Record r = explicit_chain(k.h, k.start, k.damping);
    const auto where = std::string(to_string(k.start)) + ", " + std::string(to_string(k.damping));
    // Half a unit of the last digit of a number that starts with 1 and has five digits, or with 5.9 and has
    // four.
    EXPECT_NEAR(rms_error(r, 0, Points::ends, 200) / k.x1, 1, 9e-5) << where;
    EXPECT_NEAR(rms_error(r, 1, Points::ends, 200) / k.x2, 1, 9e-5) << where;
    EXPECT_NEAR(rms_error(r, 2, Points::ends, 200) / k.x3, 1, 9e-5) << where;
  }
}

}  // namespace
}  // namespace nlmech::chapters::rbf_ivp::readings_test

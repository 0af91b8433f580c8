/// Linear terms and harmonic loads of typed equations, against what one reads in them.
#include "nlmech/program/linear_terms.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "nlmech/program/equations.hpp"

namespace nlmech::program::linear_terms_test {
namespace {

LinearTerms of(const std::string& text) {
  const Equations equations(SourceText("E", text));
  return linear_terms(equations.graph(), equations.slopes());
}

TEST(LinearTerms, AreMultipliedOut) {
  const LinearTerms found =
      of("x'' + 0.5 x' + 4 x + 3 x^3 = (1 - x^2) (2 y + 7); y'' = x - (y - 1)/8 + sin(y)");
  Eigen::Matrix4d a;  // x, y, x', y'
  a << 0, 0, 1, 0, 0, 0, 0, 1, -4, 2, -0.5, 0, 1, -0.125, 0, 0;
  EXPECT_EQ(found.a, a);
  ASSERT_EQ(found.load.size(), 2U);
  EXPECT_EQ(found.load[0].component, 2);
  EXPECT_EQ(found.load[0].frequency, 0);
  EXPECT_EQ(found.load[0].cosine, 7);
  EXPECT_EQ(found.load[1].component, 3);
  EXPECT_EQ(found.load[1].cosine, 0.125);
}

TEST(LinearTerms, HarmonicsHaveFrequenciesAndPhases) {
  const LinearTerms found =
      of("x' = 2 cos(3 t + 0.25) - sin(5 t)/4 + cos(1) + t sin(t) + cos(t^2) + x cos(t)");
  EXPECT_EQ(found.a.norm(), 0);
  ASSERT_EQ(found.load.size(), 3U);
  EXPECT_EQ(found.load[0].cosine, std::cos(1.0));
  EXPECT_EQ(found.load[1].frequency, 3);
  EXPECT_EQ(found.load[1].cosine, 2 * std::cos(0.25));
  EXPECT_EQ(found.load[1].sine, -2 * std::sin(0.25));
  EXPECT_EQ(found.load[2].frequency, 5);
  EXPECT_EQ(found.load[2].cosine, 0);
  EXPECT_EQ(found.load[2].sine, -0.25);
}

// A term whose factor overflows stays among those that are not solved exactly.
TEST(LinearTerms, AreFinite) {
  const LinearTerms found = of("x' = 1e200 (1e200 (x + 1)) + y; y' = 0");
  EXPECT_EQ(found.a, (Eigen::Matrix2d() << 0, 1, 0, 0).finished());
  EXPECT_TRUE(found.load.empty());
}

}  // namespace
}  // namespace nlmech::program::linear_terms_test

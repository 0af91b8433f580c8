#include "nlmech/collocation/wide.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/collocation/real.hpp"

namespace nlmech::collocation::wide_test {
namespace {

using oracle::eps;
using oracle::Real;
using oracle::to_double;

double positive() {
  return std::ldexp(1 + *rc::gen::inRange(0, 1 << 30) * 0x1p-30, *rc::gen::inRange(-300, 300));
}

// Within the range of doubles the operations are theirs.
RC_GTEST_PROP(Wide, RoundsAsDoublesDo, ()) {
  const double a = positive(), b = positive();
  RC_ASSERT((Wide(a) + b).value() == a + b);
  RC_ASSERT((Wide(a) * b).value() == a * b);
  RC_ASSERT((Wide(a) / b).value() == a / b);
}

TEST(Wide, LeavesTheRangeOfDoublesAndReturns) {
  Wide power = 1.0;
  for (int k = 0; k < 1000; ++k) power = power * 3.0;
  EXPECT_NEAR(power.log10(), 1000 * std::log10(3.0), 1e-10);
  EXPECT_TRUE(std::isinf((power * power).value()));
  EXPECT_EQ((Wide(1.0) / (power * power)).value(), 0);
  for (int k = 0; k < 1000; ++k) power = power / 3.0;
  EXPECT_NEAR(power.value(), 1, 2000 * eps);  // an ulp an operation
}

TEST(Wide, Zero) {
  const Wide zero, one = 1.0;
  EXPECT_EQ(zero.value(), 0);
  EXPECT_EQ((zero + zero).value(), 0);
  EXPECT_EQ((zero + one).value(), 1);
  EXPECT_EQ((one + zero).value(), 1);
  EXPECT_EQ((zero * one + Wide::exp(-1e6) * 0.0).value(), 0);
  EXPECT_TRUE(std::isinf(zero.log10()));
}

TEST(Wide, Exponential) {
  for (const double x : {-48e3, -700.5, -1.0, 0.0, 0.25, 3e4}) {
    const Wide found = Wide::exp(x) * Wide::exp(-x / 2) * Wide::exp(-x / 2);
    EXPECT_NEAR(found.value(), 1, 8 * eps) << x;  // a few roundings each
    EXPECT_NEAR(Wide::exp(x).log10(), x * 0.43429448190325182765, 1e-10) << x;
  }
  EXPECT_NEAR(Wide::exp(2.5).value() / to_double(exp(Real(2.5))), 1, 4 * eps);
}

}  // namespace
}  // namespace nlmech::collocation::wide_test

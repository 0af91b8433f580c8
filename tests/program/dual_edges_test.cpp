/// Dual numbers where a function is not differentiable, not finite, or nearly so.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <type_traits>

#include "nlmech/program/dual.hpp"
#include "tests/program/numbers.hpp"

namespace nlmech::tests::dual_edges_test {
namespace {

using D = Dual<double, 2>;
const double inf = std::numeric_limits<double>::infinity();

TEST(DualEdges, AConstantFactorMeetsInfinityAsANumberDoes) {
  D x = D::variable(inf, 0);
  // By the rule for two dual numbers this would be 2 * 1 + inf * 0 = NaN.
  EXPECT_EQ((2.0 * x).partial[0], 2);
  EXPECT_EQ((x / 2.0).partial[0], 0.5);
  EXPECT_EQ((x + 1.0).partial[0], 1);
  x *= 0.5;
  EXPECT_EQ(x.value, inf);
  EXPECT_EQ(x.partial[0], 0.5);
}

TEST(DualEdges, InfiniteSlopesReachOnlyTheirVariable) {
  const D x = D::variable(0, 0);
  for (const D& y : {sqrt(x), pow(x, 0.5)}) {
    EXPECT_EQ(y.value, 0);
    EXPECT_EQ(y.partial[0], inf);
    EXPECT_EQ(y.partial[1], 0) << "0 * inf";
  }
  EXPECT_EQ(log(x).value, -inf);
  EXPECT_EQ(log(x).partial[0], inf);
  EXPECT_EQ(log(x).partial[1], 0);
  EXPECT_EQ((1 / x).partial[1], 0);
}

TEST(DualEdges, PowersAtZero) {
  const D x = D::variable(0, 0);
  EXPECT_EQ(pow(x, 0), D(1.0));
  EXPECT_EQ(pow(x, 0.0), D(1.0));
  EXPECT_EQ(pow(x, 1), x);
  EXPECT_EQ(pow(x, 1.0), x);
  EXPECT_EQ(pow(x, 2), D(0.0));
  EXPECT_EQ(pow(x, 1.5), D(0.0));
  EXPECT_EQ(pow(x, D::variable(2, 1)), D(0.0));
  // As documented: products follow IEEE arithmetic.
  EXPECT_TRUE(std::isnan((x * sqrt(x)).partial[0]));
}

TEST(DualEdges, NegativeBasesHaveIntegerPowers) {
  const D x = D::variable(-2, 0), y = pow(x, 3), z = pow(x, -1);
  EXPECT_EQ(y.value, -8);
  EXPECT_EQ(y.partial[0], 12);
  EXPECT_EQ(z.value, -0.5);
  EXPECT_EQ(z.partial[0], -0.25);
  EXPECT_TRUE(std::isnan(pow(x, 0.5).value));
}

TEST(DualEdges, AbsoluteValueAtZeroIsDerivedFromTheRight) {
  EXPECT_EQ(abs(D::variable(0.0, 0)).partial[0], 1);
  EXPECT_EQ(abs(D::variable(-0.0, 0)).partial[0], 1);
  EXPECT_EQ(abs(D::variable(-1e-300, 0)).partial[0], -1);
}

TEST(DualEdges, TanhKeepsItsSlopeWhereItIsAlmostOne) {
  // Exact to the eight units of any rule, though tanh(25) is 1 in doubles; beyond cosh's range it is 0.
  const Real exact = 1 / (cosh(Real(25)) * cosh(Real(25)));
  const D y = tanh(D::variable(25, 0));
  EXPECT_EQ(y.value, 1);
  EXPECT_LE(abs(y.partial[0] - exact), 8 * epsilon * exact);
  EXPECT_EQ(tanh(D::variable(-800, 0)).value, -1);
  EXPECT_EQ(tanh(D::variable(-800, 0)).partial[0], 0);
}

TEST(DualEdges, AnglesKeepTheirDerivativesInAllQuadrantsAndAtAllSizes) {
  for (const double size : {1e-300, 1.0, 1e300}) {
    for (const double x : {-3 * size, 3 * size}) {
      for (const double y : {-4 * size, 4 * size}) {
        const D angle = atan2(D::variable(y, 0), D::variable(x, 1));
        EXPECT_EQ(angle.value, std::atan2(y, x));
        // Four operations of half a unit each: within four units.
        EXPECT_NEAR(angle.partial[0], x / size / 25 / size, 4 * epsilon / size);
        EXPECT_NEAR(angle.partial[1], -y / size / 25 / size, 4 * epsilon / size);
      }
    }
  }
  EXPECT_FALSE(std::isfinite(atan2(D::variable(0, 0), D(0.0)).partial[0]));
  EXPECT_EQ(asin(D::variable(1, 0)).partial[0], HUGE_VAL);
}

TEST(DualEdges, NaNIsPassedOn) {
  const D x = D::variable(std::nan(""), 0);
  EXPECT_TRUE(std::isnan((x + 1).value));
  EXPECT_TRUE(std::isnan(exp(x).partial[0]));
  EXPECT_FALSE(x == x);
}

template <class A, class B>
concept HasOrder = requires(const A& a, const B& b) {
  a < b;
};

TEST(DualType, HasNoOrderAndSaysWhatIsInside) {
  static_assert(!HasOrder<D, D>);
  static_assert(!HasOrder<D, double>);
  using DD = Dual<D, 3>;
  static_assert(std::is_same_v<decltype(value_of(DD())), double>);
  static_assert(std::is_same_v<decltype(value_of(Dual<Real, 1>())), Real>);
  static_assert(std::is_same_v<decltype(value_of(2.0L)), long double>);
  EXPECT_EQ(value_of(DD(D(1.5))), 1.5);
  EXPECT_EQ(value_of(-3.0), -3.0);
}

TEST(DualType, EqualsInValueAndPartialDerivatives) {
  EXPECT_EQ(D(2.0), D(2));
  EXPECT_FALSE(D(2.0) == D::variable(2, 1));
  EXPECT_EQ(D::variable(2, 1).partial[0], 0);
  EXPECT_EQ(D::variable(2, 1).partial[1], 1);
  EXPECT_EQ(D(), D(0.0));
}

}  // namespace
}  // namespace nlmech::tests::dual_edges_test

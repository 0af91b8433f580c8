/// The functions of power series that have a differential equation, against closed forms in 50 digits and
/// identities that no recurrence is built from; composition.
#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>

#include "nlmech/program/composition.hpp"
#include "nlmech/program/growing_series.hpp"
#include "nlmech/program/power_series.hpp"
#include "tests/program/numbers.hpp"

namespace nlmech::tests::functions_test {
namespace {

constexpr std::size_t order = 30;
using S = PowerSeries<Real>;
const Real real_epsilon = std::numeric_limits<Real>::epsilon();

// All of the identities lose some digits to cancellation in 30 orders; 1000 units of 50 digits leave no room
// for a wrong recurrence.
void expect_equal(const S& a, const S& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k)
    EXPECT_LE(abs(a[k] - b[k]), 1000 * real_epsilon * (1 + abs(b[k]))) << "coefficient " << k;
}

TEST(PowerSeriesFunctions, ClosedForms) {
  const S s = S::variable(0, order), rise = log(1 + s), root = pow(1 + s, Real(-1.5)), grow = sinh(2 * s),
          even = cosh(2 * s);
  Real binomial = 1, power = 1;
  for (int k = 0; k <= static_cast<int>(order); ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (k > 0) {
      binomial *= (Real(-1.5) - (k - 1)) / k;
      power *= Real(2) / k;
      EXPECT_LE(abs(rise[i] * k - (k % 2 == 1 ? 1 : -1)), 3 * k * real_epsilon) << k;
    }
    EXPECT_LE(abs(root[i] - binomial), 90 * real_epsilon * abs(binomial)) << k;
    EXPECT_LE(abs(grow[i] - (k % 2 == 1 ? power : Real(0))), 90 * real_epsilon * power) << k;
    EXPECT_LE(abs(even[i] - (k % 2 == 0 ? power : Real(0))), 90 * real_epsilon * power) << k;
  }
  EXPECT_EQ(rise[0], 0);
}

// 2/sqrt(pi) times the sum of (-1)^k s^(2 k + 1)/(k! (2 k + 1)).
TEST(PowerSeriesFunctions, ErrorFunction) {
  const S bell = erf(S::variable(0, order));
  Real term = 2 / sqrt(boost::math::constants::pi<Real>());
  for (int k = 0; k < static_cast<int>(order) / 2; ++k) {
    if (k > 0) term /= -k;
    const std::size_t i = 2 * static_cast<std::size_t>(k);
    EXPECT_EQ(bell[i], 0) << 2 * k;
    EXPECT_LE(abs(bell[i + 1] - term / (2 * k + 1)), 90 * real_epsilon * abs(term)) << 2 * k + 1;
  }
}

TEST(PowerSeriesFunctions, Identities) {
  const S t = S::variable(Real(0.25), order), x = 1 + t / 2 - t * t / 8;
  expect_equal(tan(x), sin(x) / cos(x));
  expect_equal(tanh(x), sinh(x) / cosh(x));
  expect_equal(exp(x), sinh(x) + cosh(x));
  expect_equal(log(exp(x)), x);
  expect_equal(pow(x, Real(0.5)), sqrt(x));
  expect_equal(pow(x, Real(-3)), 1 / (x * x * x));
  expect_equal(pow(x, Real(2.5)), x * x * sqrt(x));
  expect_equal(log(pow(x, t)), t * log(x));
}

TEST(PowerSeriesFunctions, Inverses) {
  const S t = S::variable(Real(0.25), order), x = (1 + t / 2 - t * t / 8) / 4;
  const Real& pi = boost::math::constants::pi<Real>();
  expect_equal(sin(asin(x)), x);
  expect_equal(asin(x) + acos(x), S(pi / 2) + 0 * t);
  expect_equal(tan(atan(x)), x);
  expect_equal(atan2((2 + t) * sin(x), (2 + t) * cos(x)), x);
  expect_equal(atan2(sin(x + 3), cos(x + 3)), x + 3 - 2 * pi);  // beyond pi the angle is negative
  expect_equal(atan2(S(Real(2)), x), pi / 2 - atan(x / 2));
}

TEST(PowerSeriesFunctions, OfConstants) {
  const S two = Real(2);
  for (const auto& [series, value] : {std::pair{log(two), log(Real(2))},
                                      std::pair{tan(two), tan(Real(2))},
                                      {tanh(two), tanh(Real(2))},
                                      {sinh(two), sinh(Real(2))},
                                      {cosh(two), cosh(Real(2))},
                                      {asin(two / 4), asin(Real(0.5))},
                                      {acos(two / 4), acos(Real(0.5))},
                                      {atan(two), atan(Real(2))},
                                      {atan2(two, -two), atan2(Real(2), Real(-2))},
                                      {erf(two), erf(Real(2))},
                                      {pow(two, Real(0.3)), pow(Real(2), Real(0.3))}}) {
    EXPECT_TRUE(series.is_constant());
    EXPECT_EQ(series[0], value);
  }
}

// The same recurrences, one coefficient a pass: equal to the last bit.
RC_GTEST_PROP(GrowingFunctions, EqualThoseOfPowerSeries, ()) {
  std::vector<double> c = {*between(0.5, 1.5)};
  for (int k = 1; k <= 12; ++k) c.push_back(*between(-1, 1));
  const PowerSeries<double> whole(c);
  const auto all = [](const auto& x) {
    return std::array{log(x),  pow(x, -1.5),  sinh(x),       cosh(x), tan(x),
                      tanh(x), asin(0.5 * x), acos(0.5 * x), atan(x), atan2(x, 1 - x * x),
                      erf(x),  pow(x, x)};
  };
  const auto expected = all(whole);
  SeriesMemory<double> memory;
  memory.start(12);
  auto x = GrowingSeries<double>::variable(memory);
  for (std::size_t k = 0; k <= 12; ++k) {
    x.set(k, c[k]);
    memory.begin_pass(k);
    const auto grown = all(x);
    for (std::size_t i = 0; i < grown.size(); ++i) RC_ASSERT(grown[i][k] == expected[i][k]);
  }
}

// F = (1 + 2 x)(3 - y^2) z has finitely many coefficients; products are another way to it.
TEST(Composition, PolynomialOfThreeSeries) {
  std::vector<Real> alpha(std::size_t{2} * 3 * 2, Real(0));
  const auto at = [&](std::size_t p, std::size_t q, std::size_t r) -> Real& {
    return alpha[(p * 3 + q) * 2 + r];
  };
  at(0, 0, 1) = 3;
  at(1, 0, 1) = 6;
  at(0, 2, 1) = -1;
  at(1, 2, 1) = -2;
  const AnalyticFunction<Real> f(alpha, {2, 3, 2});
  const S t = S::variable(Real(0.5), order), x = exp(t), y = sin(t), z = 1 / t;
  expect_equal(f(x, y, z), (1 + 2 * x) * (3 - y * y) * z);
}

// The paper's way to cos(omega T tau) (Eqs. 49-55): the series of the cosine in powers of x = omega T tau.
TEST(Composition, CosineOfALine) {
  std::vector<Real> alpha(order + 1, Real(0));
  Real factorial = 1;
  for (int k = 0; k <= static_cast<int>(order); ++k) {
    if (k > 0) factorial *= k;
    if (k % 2 == 0) alpha[static_cast<std::size_t>(k)] = (k % 4 == 0 ? 1 : -1) / factorial;
  }
  const S x = Real(0.35) * S::variable(0, order);
  expect_equal(AnalyticFunction<Real>(alpha, {order + 1, 1, 1})(x), cos(x));
}

TEST(Composition, RefusesATableThatIsNotFull) {
  EXPECT_THROW(AnalyticFunction<double>({1, 2, 3}, {2, 2, 1}), std::invalid_argument);
  EXPECT_THROW(AnalyticFunction<double>({}, {0, 1, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::tests::functions_test

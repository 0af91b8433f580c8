/// Power series against closed forms in 50 digits, and identities that no recurrence uses.
#include <gtest/gtest.h>
#include <boost/math/constants/constants.hpp>

#include <type_traits>

#include "nlmech/program/dual.hpp"
#include "nlmech/program/growing_series.hpp"
#include "nlmech/program/power_series.hpp"
#include "tests/program/numbers.hpp"

namespace nlmech::tests::power_series_test {
namespace {

constexpr std::size_t order = 30;

/// Coefficient k of a function in 50 digits.
using ClosedForm = Real (*)(int k);

Real factorial(int k) { return k < 2 ? Real(1) : Real(k * factorial(k - 1)); }
Real binomial(const Real& p, int k) { return k == 0 ? Real(1) : Real(binomial(p, k - 1) * (p - k + 1) / k); }
/// Derivative number k of the sine at x.
Real sine_derivative(const Real& x, int k) {
  const Real values[] = {sin(x), cos(x), -sin(x), -cos(x)};
  return values[k % 4];
}

/// Compares @p series with its closed form; @p units in the last place of each coefficient.
template <class T>
void expect_coefficients(const PowerSeries<T>& series, ClosedForm exact, int units) {
  ASSERT_EQ(series.size(), order + 1);
  const Real eps = Real(std::numeric_limits<T>::epsilon());
  for (std::size_t k = 0; k <= order; ++k) {
    const Real c = exact(static_cast<int>(k)), error = abs(Real(series[k]) - c);
    EXPECT_LE(error, units * eps * abs(c)) << "coefficient " << k << " of order " << order;
  }
}

template <class T>
class PowerSeriesOf : public ::testing::Test {};
using Types = ::testing::Types<double, long double, Real>;
TYPED_TEST_SUITE(PowerSeriesOf, Types);

// A coefficient results from k recurrences of up to k terms. Except for the sine and the root all terms of
// these series have one sign, so errors add up to some k units. Tolerance: two units for each of 30 orders,
// and three where terms alternate.
TYPED_TEST(PowerSeriesOf, ClosedForms) {
  using S = PowerSeries<TypeParam>;
  const S s = S::variable(0, order);
  expect_coefficients(
      1 / (1 - s), [](int) { return Real(1); }, 0);
  expect_coefficients(
      exp(2 * s), [](int k) { return Real(pow(Real(2), k) / factorial(k)); }, 60);
  expect_coefficients(
      sqrt(1 - s), [](int k) { return Real((k % 2 == 0 ? 1 : -1) * binomial(Real(0.5), k)); }, 60);
  expect_coefficients(
      sqrt(1 + s), [](int k) { return binomial(Real(0.5), k); }, 90);
  expect_coefficients(
      pow(1 + s, 40), [](int k) { return binomial(Real(40), k); }, 0);
  expect_coefficients(
      pow(1 - s, -4), [](int k) { return binomial(Real(k + 3), 3); }, 0);
  expect_coefficients(
      1 / (1 - s / 3), [](int k) { return Real(pow(Real(3), -k)); }, 60);
  // About t = 1/4: sin(2 (t + s)).
  const S t = S::variable(TypeParam(0.25), order);
  expect_coefficients(
      sin(2 * t), [](int k) { return Real(pow(Real(2), k) * sine_derivative(0.5, k) / factorial(k)); }, 90);
  expect_coefficients(
      cos(2 * t), [](int k) { return Real(pow(Real(2), k) * sine_derivative(0.5, k + 1) / factorial(k)); },
      90);
}

// Error bound of a product: k + 1 rounding errors of sums and products of its terms.
RC_GTEST_PROP(PowerSeriesProduct, IsRightToTheRoundingOfItsTerms, ()) {
  const auto a = *rc::gen::container<std::vector<double>>(12, between(-1, 1));
  const auto b = *rc::gen::container<std::vector<double>>(15, between(-1, 1));
  const PowerSeries<double> product = PowerSeries<double>(a) * PowerSeries<double>(b);
  RC_ASSERT(product.size() == 12U);
  for (std::size_t k = 0; k < 12; ++k) {
    Real exact = 0, terms = 0;
    for (std::size_t i = 0; i <= k; ++i) {
      exact += Real(a[i]) * b[k - i];
      terms += abs(Real(a[i]) * b[k - i]);
    }
    RC_ASSERT(abs(product[k] - exact) <= static_cast<double>(k + 1) * epsilon * terms);
  }
}

/// c_0 in [1, 2), the others in (-1, 1): the coefficients of the reciprocal grow at most by a factor 2 an
/// order.
rc::Gen<PowerSeries<Real>> any_series() {
  return rc::gen::map(
      rc::gen::pair(between(1, 2), rc::gen::container<std::vector<double>>(11, between(-1, 1))),
      [](const auto& p) {
        std::vector<Real> c = {p.first};
        for (const double each : p.second) c.emplace_back(each);
        return PowerSeries<Real>(std::move(c));
      });
}

bool close(const PowerSeries<Real>& a, const PowerSeries<Real>& b) {
  if (!a.is_constant() && !b.is_constant() && a.size() != b.size()) return false;
  // Rounding of 1e-50 times the growth of three series like 2^k: 12^3 * 2^36 < 1.2e14.
  for (std::size_t k = 0; k < 12; ++k) {
    if (abs(a[k] - b[k]) > 1e-34) return false;
  }
  return true;
}

RC_GTEST_PROP(PowerSeriesIdentities, Hold, ()) {
  using S = PowerSeries<Real>;
  const S a = *any_series(), b = *any_series(), c = *any_series();
  RC_ASSERT(close(a * (b + c), a * b + a * c));
  RC_ASSERT(close(a / b * b, a));
  RC_ASSERT(close((a - b) - a, -b));
  RC_ASSERT(close(sqrt(a) * sqrt(a), a));
  RC_ASSERT(close(exp(a) * exp(-a), S(1)));
  RC_ASSERT(close(exp(a + b), exp(a) * exp(b)));
  RC_ASSERT(close(sin(a) * sin(a) + cos(a) * cos(a), S(1)));
  RC_ASSERT(close(sin(a + b), sin(a) * cos(b) + cos(a) * sin(b)));
  RC_ASSERT(close(pow(a, 5), a * a * a * a * a));
  RC_ASSERT(close(pow(a, -2) * a * a, S(1)));
  S d = a;
  d += b;
  d *= c;
  d -= b;
  d /= c;
  RC_ASSERT(close(d, a + b - b / c));
}

TEST(PowerSeriesOrder, IsTheLowerOfTwo) {
  using S = PowerSeries<double>;
  const S a(std::vector<double>{1, 2, 3, 4}), b(std::vector<double>{1, 1});
  for (const S& c : {a + b, b + a, a - b, b - a, a * b, b * a, a / b, b / a}) EXPECT_EQ(c.size(), 2U);
  EXPECT_EQ((a * b)[1], 3);
  EXPECT_EQ((b / a)[1], -1);
  EXPECT_EQ(a[3], 4);
  EXPECT_EQ(a[4], 0);
  const S lowest(std::vector<double>{5});
  EXPECT_FALSE(lowest.is_constant());
  EXPECT_EQ((lowest * a).size(), 1U);
  EXPECT_EQ(sin(lowest).size(), 1U);
}

TEST(PowerSeriesOrder, ConstantsAreKnownToEveryOrder) {
  using S = PowerSeries<double>;
  const S a(std::vector<double>{1, 2, 3}), zero, two(2);
  EXPECT_TRUE(zero.is_constant() && two.is_constant());
  for (const S& c :
       {a + zero, zero + a, a + two, two + a, a * two, two * a, a / two, two / a, two - a, a - two})
    EXPECT_EQ(c.size(), 3U);
  EXPECT_EQ((two - a)[2], -3);
  EXPECT_EQ((two + a)[0], 3);
  EXPECT_EQ((two + zero)[0], 2);
  EXPECT_EQ((zero + two)[0], 2);
  EXPECT_EQ((zero - two)[0], -2);
  EXPECT_TRUE((two * S(3) - zero).is_constant());
  EXPECT_EQ((two / S(4))[0], 0.5);
  for (const S& c : {exp(zero), sqrt(S(1)), cos(zero), pow(a, 0)}) {
    EXPECT_TRUE(c.is_constant());
    EXPECT_EQ(c[0], 1);
  }
}

template <class A>
concept HasOrder = requires(const A& a, const A& b) {
  a < b;
};

TEST(PowerSeriesType, HasNoOrderRelationAndSaysWhatIsInside) {
  static_assert(!HasOrder<PowerSeries<double>>);
  EXPECT_EQ(value_of(PowerSeries<double>::variable(2.5, 4)), 2.5);
  EXPECT_EQ(value_of(PowerSeries<double>()), 0);
  EXPECT_EQ(value_of(PowerSeries<Dual<double, 2>>(Dual<double, 2>::variable(3, 1))), 3);
}

TEST(PowerSeriesInEigen, FillsVectors) {
  using S = PowerSeries<double>;
  Vector<S, 2> x(S::variable(1, 3), S::variable(2, 3)), y = x + x;
  EXPECT_EQ(y[1][0], 4);
  EXPECT_EQ(y[0][1], 2);
  const S dot = x.dot(y);  // 2 (1 + s)^2 + 2 (2 + s)^2
  EXPECT_EQ(dot[0], 10);
  EXPECT_EQ(dot[1], 12);
  EXPECT_EQ(dot[2], 4);
}

// ---- Functions of power series that satisfy a differential equation, against closed forms in 50 digits and
// identities that no recurrence uses.

using S = PowerSeries<Real>;
const Real real_epsilon = std::numeric_limits<Real>::epsilon();

// The identities lose some digits to cancellation in 30 orders; 1000 units of 50 digits still detect any
// wrong recurrence.
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
  expect_equal(sinh(asinh(x)), x);
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
                                      {asinh(two), asinh(Real(2))},
                                      {atan2(two, -two), atan2(Real(2), Real(-2))},
                                      {erf(two), erf(Real(2))},
                                      {pow(two, Real(0.3)), pow(Real(2), Real(0.3))}}) {
    EXPECT_TRUE(series.is_constant());
    EXPECT_EQ(series[0], value);
  }
}

// ---- A growing series computes the coefficients of a power series, one in each pass.

/// Every operation and function, with constants as either operand and constants of constants.
template <class S>
std::array<S, 16> tangle(const S& a, const S& b) {
  const S one = 1, two = one + 1;
  S c = a * b - 3.0 * a + b / two;
  c += sqrt(a) * (two - 1);
  c *= exp(-b);
  c -= +a;
  c /= b + 0.5;
  const S d = sin(a * b) / cos(b - 1) + pow(a, 5) - pow(b, -3) * pow(a, 0) + 1 / a;
  const S e = sqrt(two * (one + 1)) - exp(two - one - 1) + cos(S(0)) * sin(S(0)) / two + one / two - one;
  return {c,
          d,
          e,
          log(a),
          pow(a, -1.5),
          sinh(a),
          cosh(a),
          tan(a),
          tanh(a),
          asin(0.25 * a),
          acos(0.25 * a),
          atan(a),
          erf(a),
          asinh(a),
          pow(a, b),
          atan2(a, 1 - b * b)};
}

constexpr std::size_t growing_order = 12;

// The recurrences and their rounding are the same: coefficients are bitwise equal.
RC_GTEST_PROP(GrowingSeries, EqualsAPowerSeries, ()) {
  std::vector<double> a = {*between(1, 2)}, b = {*between(1, 2)};
  for (std::size_t k = 1; k <= growing_order; ++k) {
    a.push_back(*between(-1, 1));
    b.push_back(*between(-1, 1));
  }
  const auto whole = tangle(PowerSeries<double>(a), PowerSeries<double>(b));
  SeriesMemory<double> memory;
  for (int use = 0; use < 2; ++use) {  // the second time in used memory
    memory.start(growing_order);
    auto x = GrowingSeries<double>::variable(memory), y = GrowingSeries<double>::variable(memory);
    for (std::size_t k = 0; k <= growing_order; ++k) {
      x.set(k, a[k]);
      y.set(k, b[k]);
      memory.begin_pass(k);
      const auto grown = tangle(x, y);
      for (std::size_t i = 0; i < grown.size(); ++i) {
        RC_ASSERT(grown[i][k] == whole[i][k]);
        RC_ASSERT(value_of(grown[i]) == value_of(whole[i]));
      }
    }
  }
}

TEST(GrowingSeriesType, HasNoOrderRelationAndConstantsOfEveryOrder) {
  using G = GrowingSeries<double>;
  static_assert(!HasOrder<G>);
  static_assert(std::is_same_v<decltype(value_of(GrowingSeries<Dual<double, 2>>())), double>);
  EXPECT_EQ(G(2.5)[0], 2.5);
  EXPECT_EQ(G(2.5)[7], 0);
  EXPECT_EQ((G(2) * G(3) - 1)[0], 5);
  EXPECT_EQ((-G(2))[0], -2);
  EXPECT_EQ(value_of(G(4)), 4);
}

}  // namespace
}  // namespace nlmech::tests::power_series_test

/// Power series against closed forms in 50 digits, and identities that no recurrence is built from.
#include <gtest/gtest.h>

#include "nlmech/program/power_series.hpp"

#include "nlmech/program/dual.hpp"
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

/// Compares @p series with its closed form; @p units in the last place of the coefficient itself.
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

// A coefficient goes through k recurrences of up to k terms. All terms have one sign in these series, but for
// the sine and the root, so that errors add up to some k units; the figures allow two units for each of 30
// orders, and three where terms alternate.
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

// The error of a product is bounded by what its own terms can do: k + 1 roundings of sums and products.
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

/// c_0 in [1, 2), the others in (-1, 1): the reciprocal's coefficients grow by a factor 2 an order at most.
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
  // 1e-50 of rounding, times what three series that grow like 2^k make of it: 12^3 * 2^36 < 1.2e14.
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

// exp(p s) has the coefficients p^k/k!, whose derivatives by p are p^(k-1)/(k-1)!.
TEST(PowerSeriesType, CarriesDualNumbers) {
  using D = Dual<double, 1>;
  const PowerSeries<D> s = PowerSeries<D>::variable(0.0, 8), e = exp(D::variable(1.5, 0) * s);
  for (std::size_t k = 1; k <= 8; ++k) {
    const int n = static_cast<int>(k);
    const Real exact = pow(Real(1.5), n - 1) / factorial(n - 1);
    EXPECT_LE(abs(e[k].partial[0] - exact), 16 * epsilon * exact) << k;
  }
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

}  // namespace
}  // namespace nlmech::tests::power_series_test

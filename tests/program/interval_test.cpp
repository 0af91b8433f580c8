/// Interval arithmetic: results contain the values of all numbers in the operands, and are not much wider.
#include "nlmech/program/interval.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <memory>

#include "nlmech/program/equations.hpp"
#include "nlmech/program/program.hpp"

namespace nlmech::program::interval_test {
namespace {

// The slope of x' = text at t and x, for any type of number.
class Typed {
 public:
  explicit Typed(const std::string& text)
      : equations_({"test", "x' = " + text}), program_(equations_.graph(), equations_.slopes()) {}
  template <class T>
  [[nodiscard]] T operator()(const T& t, const T& x) const {
    T value{};
    const T state[] = {x};
    program_.run(t, state, 0, 1, [&value](int, const T& v) { value = v; });
    return value;
  }

 private:
  Equations equations_;
  Program program_;
};

const char* const texts[] = {"x + t - 2",
                             "x*t",
                             "x/t",
                             "1/(x - t)",
                             "x^2 - t^3",
                             "x^(-2)",
                             "abs(x)^1.5",
                             "sqrt(x) + t",
                             "exp(x - t)",
                             "log(x)",
                             "sin(7 x)",
                             "cos(x)/(2 + t)",
                             "tan(x)",
                             "asin(x/40)",
                             "acos(x/40)",
                             "atan(x) + t",
                             "sinh(x/9)",
                             "cosh(x/9)",
                             "tanh(x) erf(t)",
                             "atan2(x, t)",
                             "max(x, t)",
                             "abs(x) sign(t)",
                             "abs(t)^x",
                             "x/3 - 2 x^5",
                             "asinh(x) + acosh(2 + t)",
                             "floor(t) mod(t, 3) x"};

// For any interval and numbers within it the value in long double, which is practically exact here, lies
// within the bounds.
RC_GTEST_PROP(Interval, HoldsEveryValue, ()) {
  const Typed f(*rc::gen::elementOf(std::vector<std::string>(std::begin(texts), std::end(texts))));
  const auto drawn = [] {
    const double middle = *rc::gen::inRange(-30000, 30000) / 1000.;
    const double half = std::ldexp(*rc::gen::inRange(0, 1000) / 100., -*rc::gen::inRange(0, 40));
    return program::Interval(middle - half, middle + half);
  };
  const program::Interval t = drawn(), x = drawn(), bounds = f(t, x);
  for (int i = 0; i <= 8; ++i) {
    const auto part = [&](const program::Interval& all, int k) {
      return std::clamp(all.low + (all.high - all.low) * k / 8., all.low, all.high);
    };
    const double at = part(t, (5 * i) % 9), there = part(x, i);
    const auto value = f(static_cast<long double>(at), static_cast<long double>(there));
    if (std::isnan(value)) continue;
    RC_ASSERT(static_cast<long double>(bounds.low) <= value);
    RC_ASSERT(value <= static_cast<long double>(bounds.high));
  }
}

// For intervals of one number: some rounding errors of the terms, which are below 1e5 here.
TEST(Interval, OfANumberIsNarrow) {
  for (const char* text : texts) {
    const program::Interval bounds = Typed(text)(program::Interval(1.3), program::Interval(7.7));
    EXPECT_LE(bounds.width(), 1e-9) << text;
    EXPECT_TRUE(bounds.has(Typed(text)(1.3, 7.7))) << text;
  }
}

TEST(Interval, KnowsExtremesWithin) {
  const auto expect = [](const char* text, double low, double high, double least, double greatest) {
    const program::Interval bounds = Typed(text)(program::Interval(0), program::Interval(low, high));
    EXPECT_NEAR(bounds.low, least, 1e-14 * (1 + std::abs(least))) << text;
    EXPECT_NEAR(bounds.high, greatest, 1e-14 * (1 + std::abs(greatest))) << text;
  };
  expect("sin(x)", 0, 3, 0, 1);
  expect("cos(x)", 3, 4, -1, std::cos(4.));
  expect("x^2", -2, 1, 0, 4);
  expect("x^(-2)", 2, 4, 1. / 16, 0.25);
  expect("cosh(x)", -1, 2, 1, std::cosh(2.));
  expect("x^4", -2, 1, 0, 16);
  expect("x^1.5", 1, 4, 1, 8);
}

TEST(Interval, IsTheWholeLineWhereNothingIsKnown) {
  for (const char* text : {"1/x", "tan(2 x)", "log(x - 2)", "sqrt(x - 2)"}) {
    const program::Interval bounds = Typed(text)(program::Interval(0), program::Interval(-1, 1));
    EXPECT_EQ(bounds.width(), std::numeric_limits<double>::infinity()) << text;
  }
  EXPECT_EQ(program::Interval(1, std::nan("")).width(), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace nlmech::program::interval_test

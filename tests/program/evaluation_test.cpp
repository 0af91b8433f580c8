/// Typed equations give the numbers that C++ gives for the same formula.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nlmech/ivp/system.hpp"
#include "nlmech/program/problem.hpp"

namespace nlmech::program::evaluation_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// The right-hand side of `x' = text` (and y' = 0) at t, x, y.
double value(const std::string& text, double t = 0, double x = 0, double y = 0) {
  const Equations equations(SourceText("test", "x' = " + text + "; y' = 0 x + 0 y"));
  const Problem problem(equations);
  Eigen::VectorXd state(2), slope(2);
  state << x, y;
  problem(t, state, slope);
  return slope[0];
}

TEST(Typed, NumbersAndPrecedence) {
  EXPECT_EQ(value("1 + 2*3 - 4/8"), 6.5);
  EXPECT_EQ(value("2^3^2"), 512);
  EXPECT_EQ(value("-2^2"), -4);
  EXPECT_EQ(value("2^-1"), 0.5);
  EXPECT_EQ(value("8/4/2"), 1);
  EXPECT_EQ(value("1 - 2 - 3"), -4);
  EXPECT_EQ(value("- -3"), 3);
  EXPECT_EQ(value("+3 - +2"), 1);
  EXPECT_EQ(value("1.5e1 + .5 + 2.E-1"), 15.7);
  EXPECT_EQ(value("2 pi"), 2 * std::numbers::pi);
}

TEST(Typed, ProductsSideBySide) {
  EXPECT_EQ(value("2 x", 0, 3), 6);
  EXPECT_EQ(value("2x y", 0, 3, 5), 30);
  EXPECT_EQ(value("2(1 + x)(x - 1)", 0, 3), 16);
  EXPECT_EQ(value("x (1 + y)", 0, 3, 5), 18);
  EXPECT_EQ(value("1/2 x", 0, 3), 1.5);
  EXPECT_EQ(value("2 x^2 y", 0, 3, 5), 90);
  EXPECT_EQ(value("-x y", 0, 3, 5), -15);
  EXPECT_EQ(value("2 cos(t) x", 0, 3), 6);
  EXPECT_EQ(value("-1/2 x", 0, 3), -1.5);
  EXPECT_EQ(value("x (y - 1)(y + 1)", 0, 3, 5), 72);
}

TEST(Typed, Functions) {
  const double t = 0.3, x = 0.7, y = -1.2;
  const auto expect = [&](const std::string& text, double expected) {
    // Each of them is one call of the same library function, but for the powers: those are products.
    EXPECT_NEAR(value(text, t, x, y), expected, 8 * eps * (1 + std::abs(expected))) << text;
  };
  expect("sqrt(x)", std::sqrt(x));
  expect("exp(y) log(x)", std::exp(y) * std::log(x));
  expect("sin(t) cos(x) tan(y)", std::sin(t) * std::cos(x) * std::tan(y));
  expect("asin(x) acos(x) atan(y)", std::asin(x) * std::acos(x) * std::atan(y));
  expect("atan2(y, x)", std::atan2(y, x));
  expect("atan2(y, -2)", std::atan2(y, -2));
  expect("atan2(1, x)", std::atan2(1, x));
  expect("sinh(x) cosh(y) tanh(t)", std::sinh(x) * std::cosh(y) * std::tanh(t));
  expect("erf(y)", std::erf(y));
  expect("abs(y) + abs(x)", 1.9);
  expect("sign(y) + 2 sign(x)", 1);
  expect("min(x, y) + 2 max(x, y)", y + 2 * x);
  expect("max(x, 1)", 1);
  expect("x^y", std::pow(x, y));
  expect("x^2.5 + x^-3 + x^0.5", std::pow(x, 2.5) + std::pow(x, -3) + std::sqrt(x));
  expect("2^x", std::pow(2, x));
  expect("y^7", std::pow(y, 7));
  expect("x^100", std::pow(x, 100));
}

TEST(Typed, OperationsOnNumbers) {
  EXPECT_EQ(value("3 - x", 0, 1), 2);
  EXPECT_EQ(value("x - 3", 0, 1), -2);
  EXPECT_EQ(value("3/x", 0, 2), 1.5);
  EXPECT_EQ(value("x/3", 0, 2), 2.0 / 3);
  EXPECT_EQ(value("-(x - y)", 0, 1, 3), 2);
  EXPECT_EQ(value("x - (-y)", 0, 1, 3), 4);
  EXPECT_EQ(value("x + 3 y - 2 x", 0, 1, 3), 8);
  EXPECT_EQ(value("0 x + 1 y", 0, 1, 3), 3);
  EXPECT_EQ(value("x - x"), 0);
}

// What is zero as a formula is zero; x^0 is 1; what is not a number decides nothing.
TEST(Typed, ZerosAndNumbersThatAreNone) {
  EXPECT_EQ(value("0 log(x)", 0, -1), 0);
  EXPECT_EQ(value("0/x", 0, 0), 0);
  EXPECT_EQ(value("x^0", 0, 0), 1);
  EXPECT_EQ(value("0^0"), 1);
  EXPECT_EQ(value("(-8)^3"), -512);
  EXPECT_TRUE(std::isnan(value("x^(1/3)", 0, -8)));
  for (const char* text : {"sign(log(x))", "abs(log(x))", "max(log(x), 1)", "min(1, log(x))"})
    EXPECT_TRUE(std::isnan(value(text, 0, -1))) << text;
  EXPECT_TRUE(std::isinf(value("1/x", 0, 0)));
  EXPECT_EQ(value("sign(0) + abs(0) + min(0, 0)"), 0);
  EXPECT_EQ(value("abs(-2) + sign(-3) + max(-1, -2)"), 0);
}

// By one function where they change on one surface.
TEST(Typed, SwitchesOnOneSurface) {
  const auto switches = [](const std::string& text) {
    return Problem(Equations(SourceText("test", text))).switches();
  };
  EXPECT_EQ(switches("x'' = -x"), 0);
  EXPECT_EQ(switches("x'' = abs(x) + abs(-2 x) + sign(x/3) + max(0, x) + min(x, 0)"), 1);
  EXPECT_EQ(switches("x'' = max(x, x') + min(x', x) + abs(x - x') + sign(x' - x)"), 1);
  EXPECT_EQ(switches("x'' = max(x, 1) + min(1, x)"), 1);
  EXPECT_EQ(switches("x'' = abs(x) + sign(x')"), 2);
  EXPECT_EQ(switches("x'' = abs(-3) x"), 0);
}

// Three dry brakes at rest together: each holds its mass with the share of its friction that it takes.
TEST(Typed, StaysOnSeveralSurfaces) {
  const Equations equations(SourceText("test",
                                       "x'' = a - sign(x'); y'' + x'' = b - sign(y') - sign(x') + a;"
                                       "z' = -2 sign(z); a = 0.5; b = -0.25"));
  const Problem problem(equations);
  ASSERT_EQ(problem.switches(), 3);
  const auto stuck = problem.in_mode({0, 0, 0});
  const Vector<double, Eigen::Dynamic> x = Eigen::VectorXd::Zero(5);
  Vector<double, Eigen::Dynamic> f(5);
  stuck(0.0, x, f);
  EXPECT_EQ(f, Eigen::VectorXd::Zero(5));
  std::vector<double> shares(3), rates(3);
  stuck.surfaces(0.0, x, shares, rates);
  std::sort(shares.begin(), shares.end());  // the order of the functions is the text's business
  EXPECT_EQ(shares, (std::vector<double>{0.375, 0.5, 0.75}));
  EXPECT_EQ(rates, (std::vector<double>{0, 0, 0}));
}

/// The same formula in C++.
struct Tangle {
  static constexpr int dimension = 2;
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& s, Vector<T, 2>& f) const {
    using std::acos, std::asin, std::atan, std::atan2, std::cosh, std::erf, std::exp, std::log, std::pow,
        std::sin, std::sqrt, std::tanh;
    const T x = s[0], y = s[1];
    f[0] = atan(x * y) * exp(-x) + asin(x / 2.0) - acos(y / 3.0) + sqrt(1 + x * x) * pow(1 + y * y, 1.5) + t;
    f[1] = atan2(y, x) - erf(x * y) + log(2 + x) / cosh(y) + tanh(t) * sin(x) - pow(x, 3) + 2 / (1 + y * y);
  }
};
constexpr const char* tangle =
    "x' = atan(x y) exp(-x) + asin(x/2) - acos(y/3) + sqrt(1 + x^2) (1 + y^2)^1.5 + t;"
    "y' = atan2(y, x) - erf(x y) + log(2 + x)/cosh(y) + tanh(t)*sin(x) - x^3 + 2/(1 + y^2)";

// Of x^y at 1 it is y, however large y is: here it has all its digits in double.
TEST(Typed, DerivativesOfSteepPowers) {
  const ivp::System system{Problem(Equations(SourceText("test", "x' = x^(y^2); y' = 0 x")))};
  const double p = 0x1p17;
  ivp::Jacobian j;
  system.jacobian(0, ivp::State{1, p}, j);
  EXPECT_EQ(j(0, 0), p * p);
  EXPECT_EQ(j(0, 1), 0);
}

TEST(Typed, JacobiansAreThoseOfTheSameCode) {
  const ivp::System ours{Problem(Equations(SourceText("test", tangle)))}, theirs{Tangle{}};
  const ivp::State x{0.4, -0.9};
  ivp::Jacobian a, b;
  ours.jacobian(0.2, x, a);
  theirs.jacobian(0.2, x, b);
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), 64 * eps * b.cwiseAbs().maxCoeff());
  ivp::State f(2), g(2), p(2), q(2);
  ASSERT_TRUE(ours.second_derivative(0.2, x, f, g));
  ASSERT_TRUE(theirs.second_derivative(0.2, x, p, q));
  EXPECT_LE((f - p).cwiseAbs().maxCoeff(), 64 * eps * p.cwiseAbs().maxCoeff());
  EXPECT_LE((g - q).cwiseAbs().maxCoeff(), 64 * eps * q.cwiseAbs().maxCoeff());
}

TEST(Typed, TaylorCoefficientsAreThoseOfTheSameCode) {
  const ivp::System ours{Problem(Equations(SourceText("test", tangle)))}, theirs{Tangle{}};
  const ivp::State x{0.4, -0.9};
  constexpr int order = 20;
  auto a = ours.taylor(order), b = theirs.taylor(order);
  a.begin_segment(0.2, x);
  b.begin_segment(0.2, x);
  a.expand(0.2, x, 1);
  b.expand(0.2, x, 1);
  for (int i = 0; i < 2; ++i) {
    double scale = 0;
    for (int k = 0; k <= order; ++k) scale = std::max(scale, std::abs(b.coefficients(i)[k]));
    for (int k = 0; k <= order; ++k)
      EXPECT_NEAR(a.coefficients(i)[k], b.coefficients(i)[k], 64 * (k + 1) * eps * scale) << i << " " << k;
  }
}

TEST(Typed, SharesWhatIsTheSame) {
  const Equations equations(SourceText("test", "r = sqrt(x^2 + y^2); x'' = -x/r^3; y'' = -y/r^3"));
  // x^2, y^2, their sum, the root, r^2 and r^3, two quotients and two signs.
  EXPECT_EQ(Program(equations.graph(), equations.slopes()).instructions(), 10u);
}

}  // namespace
}  // namespace nlmech::program::evaluation_test

/// What typed equations mean: unknowns, definitions, highest derivatives, initial values, and their numbers.
#include "nlmech/program/equations.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nlmech/ivp/system.hpp"
#include "nlmech/program/linear_terms.hpp"
#include "nlmech/program/problem.hpp"
#include "tests/program/numbers.hpp"

namespace nlmech::program::equations_test {
namespace {

using Names = std::vector<std::string>;

Equations read(const std::string& text, const Settings& settings = {}) {
  return Equations(SourceText("test", text), settings);
}
std::vector<double> slopes(const Equations& equations, const std::vector<double>& x, double t = 0) {
  const Problem problem(equations);
  Vector<double, Eigen::Dynamic> state = Eigen::Map<const Eigen::VectorXd>(
                                     x.data(), static_cast<Eigen::Index>(x.size())),
                                 slope(state.size());
  problem(t, state, slope);
  return {slope.begin(), slope.end()};
}

TEST(Equations, TheOneOfTheManual) {
  const Equations e = read("x'' + 0.1 x' + x + 3 x^3 = 0.2 cos(1.1 t)");
  EXPECT_EQ(e.state_names(), (Names{"x", "x'"}));
  EXPECT_TRUE(e.second_order());
  const std::vector<double> f = slopes(e, {0.5, -2}, 3);
  EXPECT_EQ(f[0], -2);
  // Rounding of five terms, none above 0.5.
  EXPECT_NEAR(f[1], 0.2 * std::cos(3.3) + 0.2 - 0.5 - 0.375, 5 * 1.2e-16);
}

// The text names components first where it gives their initial values first.
TEST(Equations, ComponentsAreInTheOrderOfTheText) {
  EXPECT_EQ(read("x' = z; y' = x; z' = y").state_names(), (Names{"x", "z", "y"}));
  EXPECT_EQ(read("x(0) = 1; y(0) = 2; x' = z; y' = x; z' = y").state_names(), (Names{"x", "y", "z"}));
}

TEST(Equations, OrdersMayBeMixed) {
  const Equations e = read("x''' = -x + y; y' = z'' ; z'' = -z");
  EXPECT_EQ(e.state_names(), (Names{"x", "y", "z", "x'", "z'", "x''"}));
  EXPECT_FALSE(e.second_order());
  EXPECT_EQ(slopes(e, {1, 2, 3, 4, 5, 6}), (std::vector<double>{4, -3, 5, 6, -3, 1}));
}

TEST(Equations, OrderFour) {
  const Equations e = read("w'''' = w''");
  EXPECT_EQ(slopes(e, {1, 2, 3, 4}), (std::vector<double>{2, 3, 4, 3}));
}

TEST(Equations, HighestDerivativeAnywhere) {
  EXPECT_EQ(slopes(read("0 = 2 x - 4 x'"), {3}), std::vector<double>{1.5});
  EXPECT_EQ(slopes(read("(1 + x^2) x'' + x x'^2 = 0"), {2, 3}), (std::vector<double>{3, -18.0 / 5}));
  EXPECT_EQ(slopes(read("x'' = 2 (x'' + x)"), {3, 0}), (std::vector<double>{0, -6}));
  EXPECT_EQ(slopes(read("x''/(1 + x) = x x''/2 + 1"), {3, 0}), (std::vector<double>{0, 1 / (0.25 - 1.5)}));
  EXPECT_EQ(slopes(read("F = 3 x'' - x; 0 = F"), {6, 0}), (std::vector<double>{0, 2}));
}

TEST(Equations, CoupledByNumbers) {
  const std::vector<double> f = slopes(read("2 x' + y' + z' = 7; x' - y' = -1; y' + 2 z' = 8"), {0, 0, 0});
  ASSERT_EQ(f.size(), 3u);
  EXPECT_NEAR(f[0], 1, 1e-15);
  EXPECT_NEAR(f[1], 2, 2e-15);
  EXPECT_NEAR(f[2], 3, 3e-15);
}

TEST(Equations, CoupledByTheState) {
  // A double pendulum of unit masses and lengths beside its solution by Eigen.
  const Equations e = read(
      "2 a'' + b'' cos(a - b) + b'^2 sin(a - b) + 2 g sin(a) = 0;"
      "b'' + a'' cos(a - b) - a'^2 sin(a - b) + g sin(b) = 0; g = 9.81");
  EXPECT_EQ(e.state_names(), (Names{"a", "b", "a'", "b'"}));
  const double a = 0.7, b = -0.4, p = 1.3, q = 2.1, g = 9.81;
  Eigen::MatrixXd m(2, 2);
  m << 2, std::cos(a - b), std::cos(a - b), 1;
  const Eigen::VectorXd r{
      {-q * q * std::sin(a - b) - 2 * g * std::sin(a), p * p * std::sin(a - b) - g * std::sin(b)}};
  const Eigen::VectorXd expected = m.fullPivLu().solve(r);
  const std::vector<double> f = slopes(e, {a, b, p, q});
  // A condition of some 7, and a dozen roundings.
  EXPECT_NEAR(f[2], expected[0], 1e-14 * expected.norm());
  EXPECT_NEAR(f[3], expected[1], 1e-14 * expected.norm());
}

/// Random systems of up to six coupled unknowns, with numbers and with states as coefficients.
RC_GTEST_PROP(Equations, AreSolved, ()) {
  const int n = *rc::gen::inRange(1, 7);
  const auto entry = [] { return *rc::gen::inRange(-9, 10); };
  Eigen::MatrixXd m(n, n);
  Eigen::VectorXd b(n);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, 1, n);
  std::string text;
  const bool by_state = *rc::gen::arbitrary<bool>();
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int c = entry() + (i == j ? 30 : 0);
      m(i, j) = by_state ? c * x[j] : c;
      text += (j == 0 ? "" : " + ") + std::string("(") + std::to_string(c) + ")" +
              (by_state ? " x" + std::to_string(j) : "") + " x" + std::to_string(j) + "'";
    }
    b[i] = entry();
    text += " = " + std::to_string(static_cast<int>(b[i])) + "\n";
  }
  const Equations e = read(text);
  const std::vector<double> f = slopes(e, {x.begin(), x.end()});
  const Eigen::VectorXd expected = m.fullPivLu().solve(b);
  for (int i = 0; i < n; ++i) {
    const auto place = std::find(e.state_names().begin(), e.state_names().end(), "x" + std::to_string(i));
    // Diagonally heavy: a condition of some tens.
    RC_ASSERT(std::abs(f[static_cast<std::size_t>(place - e.state_names().begin())] - expected[i]) <=
              1e-13 * (1 + expected.norm()));
  }
}

TEST(Equations, DefinitionsAndSettings) {
  const std::string text = "x'' + k/m x = 0; m = 2; k = m c; c = 8";
  EXPECT_THROW((void)read(text), InputError);  // k/m x
  const std::string clear = "x'' + (k/m) x = 0; m = 2; k = m c; c = 8";
  EXPECT_EQ(slopes(read(clear), {1, 0})[1], -8);
  EXPECT_EQ(slopes(read(clear, {{"c", 3}}), {1, 0})[1], -3);
  EXPECT_EQ(slopes(read(clear, {{"k", 4}}), {1, 0})[1], -2);
  EXPECT_EQ(slopes(read("x' = a x", {{"a", 4}}), {1})[0], 4);
  const Equations e = read(clear);
  EXPECT_EQ(e.parameters(), (std::vector<std::pair<std::string, double>>{{"m", 2}, {"k", 16}, {"c", 8}}));
}

TEST(Equations, DefinitionsOfStateAndTime) {
  EXPECT_EQ(slopes(read("r = sqrt(x^2 + y^2)\nx' = y/r\ny' = -x/r + t # a comment\n"), {3, 4}, 2),
            (std::vector<double>{0.8, 1.4}));
}

// A definition that holds a highest derivative is no parameter.
TEST(Equations, ParametersAreNumbers) {
  EXPECT_EQ(read("F = 3 x''; 0 = F + k x", {{"k", 2}}).parameters().size(), 1U);
}

// Leading minors are 0 at some of these times, where the whole determinant is not: no order of pivots is
// good.
TEST(Equations, CoupledWithoutPivots) {
  const Equations e = read(
      "s a' + b' + c' + d' = 1; a' + s b' + d' = 2; c' s + a' + d' = 3; a' + b' - c' + s d' = 4; s = t/3");
  EXPECT_EQ(e.state_names(), (Names{"a", "b", "c", "d"}));
  for (const double t : {0.0, 1e-9, 0.5, 3.03, -3.0}) {
    const double s = t / 3;
    Eigen::MatrixXd m(4, 4);
    m << s, 1, 1, 1, 1, s, 0, 1, 1, 0, s, 1, 1, 1, -1, s;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(m);
    const double condition = svd.singularValues()[0] / svd.singularValues()[3];
    const Eigen::VectorXd expected = m.fullPivLu().solve(Eigen::VectorXd::LinSpaced(4, 1, 4));
    const std::vector<double> f = slopes(e, {0, 0, 0, 0}, t);
    // Modified Gram-Schmidt is backward stable: the condition, times a few roundings a column.
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(f[i], expected[static_cast<int>(i)], 64 * 2.2e-16 * condition * expected.norm()) << t;
  }
}

TEST(Equations, LinesMayGoOn) {
  EXPECT_EQ(slopes(read("x' = (1\n + 2)\n\n\ny' = 3 +\n  x"), {5, 0}), (std::vector<double>{3, 8}));
}

TEST(Equations, InitialValues) {
  Equations e = read("x'' = -k x; k = 4; x(0) = 1; x'(0) = sqrt(k)");
  EXPECT_EQ(e.initial_time(), 0.0);
  EXPECT_EQ(e.initial_state("--initial", ""), (std::vector<double>{1, 2}));
  EXPECT_EQ(e.initial_state("--initial", "x = 3 k"), (std::vector<double>{12, 2}));
  EXPECT_EQ(e.initial_state("--initial", "x'=atan2(0, 1), x=-1"), (std::vector<double>{-1, 0}));
}

TEST(Equations, SayWhatHoldsOfTheirSolutions) {
  const Equations e =
      read("x'' = -k x; k = 4; k > 0; conserved x'^2 + k x^2; t <= 2 k; x <= 1; x >= -k; conserved k");
  EXPECT_EQ(e.final_time(), 8.0);
  EXPECT_EQ(e.lower_bounds(), (std::vector<double>{-4, -HUGE_VAL}));
  EXPECT_EQ(e.upper_bounds(), (std::vector<double>{1, HUGE_VAL}));
  EXPECT_EQ(e.summary(), "x'' = -k x");
  const Problem problem(e);
  const Vector<double, Eigen::Dynamic> x = Vector<double, 2>(3, 5);
  const Vector<double, Eigen::Dynamic> kept = problem.invariants(0.0, x);
  EXPECT_EQ(std::vector<double>(kept.begin(), kept.end()), (std::vector<double>{25 + 36, 4}));
  Vector<double, Eigen::Dynamic> lower, upper;
  EXPECT_TRUE(problem.bounds(lower, upper));
  EXPECT_EQ(lower[0], -4);
  EXPECT_EQ(upper[0], 1);
}

TEST(Equations, MaySayNothing) {
  const Equations e = read("x'' = -x + # what\n  r; r = 2\t x'");
  EXPECT_FALSE(e.final_time());
  EXPECT_EQ(e.summary(), "x'' = -x + r, r = 2 x'");
  const Problem problem(e);
  Vector<double, Eigen::Dynamic> none, x = Vector<double, 2>(1, 2);
  EXPECT_EQ(problem.invariants(0.0, x).size(), 0);
  EXPECT_FALSE(problem.bounds(none, none));
}

// A name, unless an expression follows.
TEST(Equations, ConservedIsAName) {
  EXPECT_EQ(slopes(read("x' = conserved; conserved = 3"), {0}), (std::vector<double>{3}));
  EXPECT_EQ(slopes(read("conserved x' = 6; conserved = 3"), {0}), (std::vector<double>{2}));
  EXPECT_EQ(read("x' = 0; conserved -x").conserved().size(), 1u);
}

TEST(Equations, Expressions) {
  Equations e = read("x'' = -k x; k = 4");
  const Program p(e.graph(), {e.expression("--event", "x = 1"), e.expression("--event", "k x' t")});
  std::vector<double> values;
  // The graph has grown since: the program is made of it as it is now.
  const Program q(e.graph(), {e.expression("--event", "x = 1"), e.expression("--event", "k x' t")});
  q.run(2.0, Vector<double, 2>(3, 5), 0, 2, [&](int, double v) { values.push_back(v); });
  EXPECT_EQ(values, (std::vector<double>{2, 40}));
}

TEST(Equations, LargeSystems) {
  std::string text;
  const int n = 300;
  for (int i = 0; i < n; ++i) {
    const auto name = [](int k) { return "x" + std::to_string(k); };
    text += name(i) + "'' = " + (i > 0 ? name(i - 1) : "0") + " - 2 " + name(i) + " + " +
            (i + 1 < n ? name(i + 1) : "0") + " - 0.1 " + name(i) + "^3;";
  }
  const Equations e = read(text);
  EXPECT_EQ(e.size(), 2 * n);
  std::vector<double> x(std::size_t{2} * n, 0.0);
  x[7] = 1;
  const std::vector<double> f = slopes(e, x);
  EXPECT_EQ(f[n + 6], 1);
  EXPECT_EQ(f[n + 7], -2.1);
  EXPECT_EQ(f[n + 8], 1);
}

// ---- Typed equations give the numbers that C++ gives for the same formula.

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

// ---- Linear terms and harmonic loads of typed equations, against what one reads in them.

using nlmech::tests::between;
using nlmech::tests::epsilon;

ivp::System system_of(const std::string& text, const Settings& settings = {}) {
  return ivp::System(Problem(Equations({"test", text}, settings)));
}

LinearTerms terms_of(const std::string& text) { return system_of(text).linear_terms(); }

double value(const std::vector<Harmonic>& load, int component, double t) {
  double sum = 0;
  for (const Harmonic& h : load) {
    if (h.component == component)
      sum += h.cosine * std::cos(h.frequency * t) + h.sine * std::sin(h.frequency * t);
  }
  return sum;
}

TEST(LinearTerms, AreMultipliedOut) {
  const LinearTerms found =
      terms_of("x'' + 0.5 x' + 4 x + 3 x^3 = (1 - x^2) (2 y + 7); y'' = x - (y - 1)/8 + sin(y)");
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

// Sines of numbers are the library's on one side and the compiler's on the other.
TEST(LinearTerms, HarmonicsHaveFrequenciesAndPhases) {
  const LinearTerms found =
      terms_of("x' = 2 cos(3 t + 0.25) - sin(5 t)/4 + cos(1) + t sin(t) + cos(t^2) + x cos(t) - x/(x^2 + 1)");
  EXPECT_EQ(found.a.norm(), 0);
  ASSERT_EQ(found.load.size(), 3U);
  EXPECT_DOUBLE_EQ(found.load[0].cosine, std::cos(1.0));
  EXPECT_EQ(found.load[1].frequency, 3);
  EXPECT_DOUBLE_EQ(found.load[1].cosine, 2 * std::cos(0.25));
  EXPECT_DOUBLE_EQ(found.load[1].sine, -2 * std::sin(0.25));
  EXPECT_EQ(found.load[2].frequency, 5);
  EXPECT_EQ(found.load[2].cosine, 0);
  EXPECT_EQ(found.load[2].sine, -0.25);
}

// A term whose factor overflows stays among those that are not solved exactly.
TEST(LinearTerms, AreFinite) {
  const LinearTerms found = terms_of("x' = 1e200 (1e200 (x + 1)) + y; y' = 0");
  EXPECT_EQ(found.a, (Eigen::Matrix2d() << 0, 1, 0, 0).finished());
  EXPECT_TRUE(found.load.empty());
}

// A polynomial in the state whose only terms of the time alone are harmonics: its linear terms are the
// Jacobian at the origin, its load is the right-hand side there.
RC_GTEST_PROP(LinearTerms, AreTheDerivativeOfAPolynomialAtTheOrigin, ()) {
  const Settings set = {{"a", *between(-2, 2)},
                        {"b", *between(-2, 2)},
                        {"w", *between(0, 3)},
                        {"p", *between(-3, 3)},
                        {"f", *between(-2, 2)}};
  const ivp::System system = system_of(
      "x'' = a (1 - x^2) x' + b (x + 2 (y - x)/3) - x^3 + f sin(w t + p) + (2 + y) (3 - x'); "
      "y' = y (x - b) + (1 + y^2) (1 - (cos(p - w t) - a)/3) + t x",
      set);
  const LinearTerms found = system.linear_terms();
  ivp::Jacobian jacobian;
  ivp::State slopes;
  system.jacobian(0, ivp::State::Zero(3), jacobian);
  const double t = *between(0, 5);
  system.rhs(t, ivp::State::Zero(3), slopes);
  // Of y: (1 + y^2) has no linear term, and cos times y^2 is no load.
  RC_ASSERT((found.a - jacobian).cwiseAbs().maxCoeff() <= 64 * epsilon);
  // Arguments up to 20 radians.
  for (int i = 0; i < 3; ++i) RC_ASSERT(std::abs(value(found.load, i, t) - slopes[i]) <= 256 * epsilon);
}

// A part that stands in many places is looked at once: 2^60 paths lead to x here.
TEST(LinearTerms, OfSharedPartsTakeNoTime) {
  std::string text = "x' = a60; a0 = x";
  for (int i = 1; i <= 60; ++i) {
    const std::string before = "a" + std::to_string(i - 1);
    text += "; a" + std::to_string(i) + " = (" + before + " + sin(" + before + ") + " + before + ")/2";
  }
  EXPECT_EQ(system_of(text).linear_terms().a(0, 0), 1);
}

// Announced, in the direction of travel; what depends on the state is still a switch.
TEST(KnownTimes, AreAnnounced) {
  using Times = std::vector<double>;
  const ivp::System ramp = system_of("x' = max(0, t - 1) - 2 max(t - 2, 0) + sign(3 - t) + abs(t)");
  EXPECT_EQ(ramp.switches(), 0);
  EXPECT_EQ(ramp.discontinuities(-1, 5), (Times{0, 1, 2, 3}));
  EXPECT_EQ(ramp.discontinuities(2.5, -1), (Times{2, 1, 0}));
  ivp::State f;
  ramp.rhs(3, {0}, f);
  EXPECT_EQ(f[0], 2 - 2 - 1 + 3) << "the limit from the right";
  const ivp::System both = system_of("x'' = -sign(x') + max(0, t - 1)");
  EXPECT_EQ(both.switches(), 1);
  EXPECT_EQ(both.discontinuities(0, 5), (Times{1}));
  const ivp::System mode = both.in_mode({1});
  mode.rhs(3, {0, 1}, f);
  EXPECT_EQ(f, (ivp::State{1, 1}));
  EXPECT_EQ(mode.discontinuities(0, 5), (Times{1}));
  EXPECT_EQ(system_of("x' = max(x, t)").switches(), 1);
}

}  // namespace
}  // namespace nlmech::program::equations_test

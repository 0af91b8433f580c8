/// Typed equations: unknowns, definitions, highest derivatives, initial values, and their numerical values.
#include "nlmech/program/equations.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nlmech/ivp/system.hpp"
#include "nlmech/program/linear_terms.hpp"
#include "nlmech/program/power_series.hpp"
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
  // Rounding errors of five terms of at most 0.5.
  EXPECT_NEAR(f[1], 0.2 * std::cos(3.3) + 0.2 - 0.5 - 0.375, 5 * 1.2e-16);
}

// The initial values that come first in the text determine the first components.
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
  // A double pendulum of unit masses and lengths against a solution by Eigen.
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
  // A condition number of about 7 and a dozen rounding errors.
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
    // Diagonally dominant: a condition number of some tens.
    RC_ASSERT(std::abs(f[static_cast<std::size_t>(place - e.state_names().begin())] - expected[i]) <=
              1e-13 * (1 + expected.norm()));
  }
}

TEST(Equations, DefinitionsAndSettings) {
  const std::string text = "x'' + k/m x = 0; m = 2; k = m c; c = 8";
  EXPECT_THROW((void)read(text), InputError);  // k/m x is ambiguous
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

// A definition that contains a highest derivative is no parameter.
TEST(Equations, ParametersAreNumbers) {
  EXPECT_EQ(read("F = 3 x''; 0 = F + k x", {{"k", 2}}).parameters().size(), 1U);
}

// Leading minors are 0 at some of these times, but the determinant is not: elimination without pivoting
// fails.
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
    // Modified Gram-Schmidt is backward stable: the condition number times a few rounding errors a column.
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

// `conserved` is a name, unless an expression follows.
TEST(Equations, ConservedIsAName) {
  EXPECT_EQ(slopes(read("x' = conserved; conserved = 3"), {0}), (std::vector<double>{3}));
  EXPECT_EQ(slopes(read("conserved x' = 6; conserved = 3"), {0}), (std::vector<double>{2}));
  EXPECT_EQ(read("x' = 0; conserved -x").conserved().size(), 1u);
}

TEST(Equations, Expressions) {
  Equations e = read("x'' = -k x; k = 4");
  const Program p(e.graph(), {e.expression("--event", "x = 1"), e.expression("--event", "k x' t")});
  std::vector<double> values;
  // The graph has grown: a new program uses its present state.
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

// ---- Typed equations give the same numbers as C++ for the same formula.

constexpr double eps = std::numeric_limits<double>::epsilon();

/// The right-hand side of `x' = text` (with y' = 0) at t, x, y.
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
    // Each is one call of the same library function, except the powers, which are products.
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

/// The function by other formulas, as a series in 50 digits.
using RealSeries = PowerSeries<tests::Real>;
struct ByFormula {
  const char* text;
  RealSeries (*formula)(const RealSeries&);
  double at;
};
const ByFormula by_formula[] = {
    {"ln(x)", [](const RealSeries& x) { return log(x); }, 0.7},
    {"log10(x)", [](const RealSeries& x) { return log(x) / log(tests::Real(10)); }, 0.7},
    {"log2(x)", [](const RealSeries& x) { return log(x) / log(tests::Real(2)); }, 3.7},
    {"sec(x)", [](const RealSeries& x) { return 1 / cos(x); }, -0.7},
    {"csc(x)", [](const RealSeries& x) { return 1 / sin(x); }, 0.7},
    {"cot(x)", [](const RealSeries& x) { return 1 / tan(x); }, 0.7},
    {"asinh(x)", [](const RealSeries& x) { return log(x + sqrt(1 + x * x)); }, -0.7},
    {"acosh(x)", [](const RealSeries& x) { return log(x + sqrt(x * x - 1)); }, 1.7},
    {"atanh(x)", [](const RealSeries& x) { return log((1 + x) / (1 - x)) / 2; }, 0.3}};

// y' = f(x) and x = x0 + t/2: coefficient k of f is k + 1 times coefficient k + 1 of y.
TEST(Typed, FunctionsHaveTheTaylorCoefficientsOfTheirFormulas) {
  constexpr int order = 20;
  for (const ByFormula& f : by_formula) {
    const Equations equations(
        SourceText("test", std::string("x(0) = 0; y' = ") + f.text + "; x' = 0.5 + 0 y"));
    const ivp::System system{Problem(equations)};
    const ivp::State x{f.at, 0};
    auto typed = system.taylor(order + 1);
    typed.begin_segment(0, x);
    typed.expand(0, x, 1);
    const RealSeries exact =
        f.formula(tests::Real(f.at) + RealSeries::variable(tests::Real(0), order + 1) * tests::Real(0.5));
    double scale = 0;
    for (std::size_t k = 0; k <= order; ++k) scale = std::max(scale, std::abs(double(exact[k])));
    for (std::size_t k = 0; k <= order; ++k)
      EXPECT_NEAR(typed.coefficients(1)[k + 1] * double(k + 1), double(exact[k]),
                  64 * double(k + 1) * eps * scale)
          << f.text << " " << k;
    ivp::Jacobian j;
    system.jacobian(0, x, j);
    // exact has the slope in t, which is the slope in x times 1/2.
    EXPECT_NEAR(j(1, 0), 2 * double(exact[1]), 16 * eps * std::abs(2 * double(exact[1]))) << f.text;
  }
}

// Arguments where the formulas lose digits in double. Tolerance: four rounding errors, and functions of one
// or two units.
TEST(Typed, FunctionsKeepTheirDigitsAtTheEdges) {
  const auto expect = [](const char* text, double at, const RealSeries& exact) {
    EXPECT_NEAR(value(text, 0, at), double(exact[0]), 8 * eps * std::abs(double(exact[0])))
        << text << " " << at;
  };
  for (const double at : {1e-300, -1e-9, 1e-3, -1e9, 1e150}) {
    const tests::Real x = abs(tests::Real(at));  // odd function; the formula loses digits below 0
    const tests::Real y = x < 1e-20 ? x : tests::Real(log(x + sqrt(x * x + 1)));
    expect("asinh(x)", at, tests::Real(at < 0 ? -y : y));
  }
  for (const double at : {1.0, 1 + 0x1p-50, 1.5, 1e9, 1e300}) {
    const tests::Real x = at;
    expect("acosh(x)", at, tests::Real(log(x + sqrt(x * x - 1))));
  }
  for (const double at : {-1e-9, 1e-3, 1 - 0x1p-50, -1 + 0x1p-53}) {
    const tests::Real x = at;
    expect("atanh(x)", at, tests::Real(log((1 + x) / (1 - x)) / 2));
  }
  EXPECT_EQ(value("atanh(x)", 0, 1), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(value("acosh(x)", 0, 0.99)));
  EXPECT_TRUE(std::isnan(value("atanh(x)", 0, 1.01)));
}

TEST(Typed, StepsOfNumbers) {
  EXPECT_EQ(value("log10(1000)"), 3);
  EXPECT_EQ(value("log2(8)"), 3);
  EXPECT_EQ(value("floor(-1.5)"), -2);
  EXPECT_EQ(value("ceil(-1.5)"), -1);
  EXPECT_EQ(value("floor(2) + ceil(2)"), 4);
  EXPECT_EQ(value("round(2.5) + 10 round(-2.5) + 100 round(0.4)"), 3 - 20);
  EXPECT_EQ(value("frac(-0.25)"), 0.75);
  EXPECT_EQ(value("mod(-1, 3)"), 2);
  EXPECT_EQ(value("mod(5, -3)"), -1);
  EXPECT_EQ(value("mod(6, 3)"), 0);
  EXPECT_EQ(value("heaviside(0) + 10 step(2) + 100 step(-1)"), 11);
  EXPECT_EQ(value("if(1 < 1, 2, 3)"), 3);
  EXPECT_EQ(value("if(1 <= 1, 2, 3)"), 2);
  EXPECT_EQ(value("if(1 > 1, 2, 3)"), 3);
  EXPECT_EQ(value("if(1 >= 1, 2, 3)"), 2);
}

TEST(Typed, Conditions) {
  for (const double x : {0.5, 1.5}) {
    for (const double y : {0.5, 1.5}) {
      for (const double t : {0.5, 1.5}) {
        const bool a = x<1, b = y> 1, c = t <= 1;
        const auto holds = [&](const char* condition) {
          return value(fmt::format("if({}, 1, 0)", condition), t, x, y) == 1;
        };
        EXPECT_EQ(holds("x < 1 and y > 1 or t <= 1"), (a && b) || c);
        EXPECT_EQ(holds("x < 1 and (y > 1 or t <= 1)"), a && (b || c));
        EXPECT_EQ(holds("not x < 1 and not (y > 1 or not 2 t <= 2)"), !a && !(b || !c));
        EXPECT_EQ(holds("(x + y) < 2 and (2) x >= (x + 0.5)"), x + y < 2);
        EXPECT_EQ(holds("if(x < 1, y, t) > 1"), a ? b : !c);
      }
    }
  }
  EXPECT_EQ(value("if(x > 0, if(y > 0, 1, 2), if(y > 0, 3, 4))", 0, -1, 1), 3);
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

// A factor of zero gives zero; x^0 is 1; NaN in a condition gives NaN.
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

// Terms that change on the same surface share one switching function.
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
  EXPECT_EQ(switches("x'' = sign(x) + heaviside(-x) + if(2 x < 0, 1, 3) + if(0 <= x, x, 0)"), 1);
}

// Three masses with dry friction at rest: each sticks with its own fraction of the friction force.
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
  std::sort(shares.begin(), shares.end());  // the order of the switching functions depends on the text
  EXPECT_EQ(shares, (std::vector<double>{0.375, 0.5, 0.75}));
  EXPECT_EQ(rates, (std::vector<double>{0, 0, 0}));
}

/// The formula in C++.
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

// The derivative of x^y in x at 1 is y, also for large y: exact in double.
TEST(Typed, DerivativesOfSteepPowers) {
  const ivp::System system{Problem(Equations(SourceText("test", "x' = x^(y^2); y' = 0 x")))};
  const double p = 0x1p17;
  ivp::Jacobian j;
  system.jacobian(0, ivp::State{1, p}, j);
  EXPECT_EQ(j(0, 0), p * p);
  EXPECT_EQ(j(0, 1), 0);
}

TEST(Typed, JacobiansAreThoseOfTheSameCode) {
  const ivp::System typed{Problem(Equations(SourceText("test", tangle)))}, compiled{Tangle{}};
  const ivp::State x{0.4, -0.9};
  ivp::Jacobian a, b;
  typed.jacobian(0.2, x, a);
  compiled.jacobian(0.2, x, b);
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), 64 * eps * b.cwiseAbs().maxCoeff());
  ivp::State f(2), g(2), p(2), q(2);
  ASSERT_TRUE(typed.second_derivative(0.2, x, f, g));
  ASSERT_TRUE(compiled.second_derivative(0.2, x, p, q));
  EXPECT_LE((f - p).cwiseAbs().maxCoeff(), 64 * eps * p.cwiseAbs().maxCoeff());
  EXPECT_LE((g - q).cwiseAbs().maxCoeff(), 64 * eps * q.cwiseAbs().maxCoeff());
}

TEST(Typed, TaylorCoefficientsAreThoseOfTheSameCode) {
  const ivp::System typed{Problem(Equations(SourceText("test", tangle)))}, compiled{Tangle{}};
  const ivp::State x{0.4, -0.9};
  constexpr int order = 20;
  auto a = typed.taylor(order), b = compiled.taylor(order);
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

// ---- Linear terms and harmonic loads of typed equations against values found by hand.

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

// Sines of numbers may differ between library and compiler.
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

// A term whose factor overflows is not treated as linear.
TEST(LinearTerms, AreFinite) {
  const LinearTerms found = terms_of("x' = 1e200 (1e200 (x + 1)) + y; y' = 0");
  EXPECT_EQ(found.a, (Eigen::Matrix2d() << 0, 1, 0, 0).finished());
  EXPECT_TRUE(found.load.empty());
}

// A polynomial in the state whose terms of time alone are harmonics: its linear terms are the Jacobian at the
// origin, its load is the right-hand side there.
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
  // For y: (1 + y^2) has no linear term, and cos times y^2 is no load.
  RC_ASSERT((found.a - jacobian).cwiseAbs().maxCoeff() <= 64 * epsilon);
  // Arguments up to 20 radians.
  for (int i = 0; i < 3; ++i) RC_ASSERT(std::abs(value(found.load, i, t) - slopes[i]) <= 256 * epsilon);
}

// A shared subexpression is analysed once: here 2^60 paths lead to x.
TEST(LinearTerms, OfSharedPartsTakeNoTime) {
  std::string text = "x' = a60; a0 = x";
  for (int i = 1; i <= 60; ++i) {
    const std::string before = "a" + std::to_string(i - 1);
    text += "; a" + std::to_string(i) + " = (" + before + " + sin(" + before + ") + " + before + ")/2";
  }
  EXPECT_EQ(system_of(text).linear_terms().a(0, 0), 1);
}

// Times are announced in the direction of integration; a dependence on the state remains a switch.
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

/// x' at the time t.
double rate(const ivp::System& system, double t) {
  ivp::State f;
  system.rhs(t, ivp::State::Zero(system.size()), f);
  return f[0];
}

// Multiples that are exact in double; at a jump the value is the limit from the right.
TEST(KnownTimes, OfWholeNumbers) {
  using Times = std::vector<double>;
  const ivp::System down = system_of("x' = floor(t)"), up = system_of("x' = ceil(t)"),
                    falling = system_of("x' = floor(1 - t/2)");
  EXPECT_EQ(down.switches(), 0);
  EXPECT_EQ(down.discontinuities(0, 3), (Times{1, 2}));
  EXPECT_EQ(down.discontinuities(2.5, -1), (Times{2, 1, 0}));
  EXPECT_EQ(rate(down, 2), 2);
  EXPECT_EQ(rate(down, std::nextafter(2, 0)), 1);
  EXPECT_EQ(up.discontinuities(-1, 1.5), (Times{0, 1}));
  EXPECT_EQ(rate(up, 0), 1);
  EXPECT_EQ(rate(up, 0.5), 1);
  const Times of_falling = falling.discontinuities(-1, 5);
  ASSERT_EQ(of_falling.size(), 3u);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(of_falling[std::size_t(k)], 2 * k, 2 * eps);  // 1 - t/2 is rounded
  EXPECT_EQ(rate(falling, 0), 0);
  EXPECT_EQ(rate(falling, -0.5), 1);
  EXPECT_EQ(rate(falling, 2.5), -1);
}

// mod(t, 0.1) jumps at the first double at which the double t/0.1 reaches a whole number.
TEST(KnownTimes, OfRoundedPeriods) {
  const ivp::System saw = system_of("x' = mod(t, 0.1)");
  const std::vector<double> times = saw.discontinuities(0, 10);
  ASSERT_EQ(times.size(), 99u);
  for (std::size_t k = 0; k < times.size(); ++k) {
    EXPECT_NEAR(times[k], 0.1 * double(k + 1), 4 * eps * times[k]);
    EXPECT_NEAR(rate(saw, times[k]), 0, 4 * eps * times[k]);
    EXPECT_NEAR(rate(saw, std::nextafter(times[k], 0)), 0.1, 4 * eps * times[k]);
  }
}

TEST(KnownTimes, OfConditions) {
  using Times = std::vector<double>;
  const ivp::System square = system_of("x' = if(mod(t, 2) < 1, 1, -1)");
  EXPECT_EQ(square.switches(), 0);
  EXPECT_EQ(square.discontinuities(0, 5), (Times{1, 2, 3, 4}));
  EXPECT_EQ(square.discontinuities(3.5, 0), (Times{3, 2, 1}));
  for (const double t : {0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0})
    EXPECT_EQ(rate(square, t), std::fmod(t, 2) < 1 ? 1 : -1);
  const ivp::System one = system_of("x' = if(3 - 2 t > 0, 5, 7)");
  EXPECT_EQ(one.discontinuities(0, 5), (Times{1.5}));
  EXPECT_EQ(rate(one, 1.5), 7);
  // Steps of steps: equality holds over an interval.
  const ivp::System even =
      system_of("x' = mod(floor(t), 2) + 10 sign(floor(t) - 2) + 100 if(floor(t) > 2, 1, 0)");
  EXPECT_EQ(even.discontinuities(0.5, 4), (Times{1, 2, 3}));
  EXPECT_EQ(rate(even, 1.5), 1 - 10);
  EXPECT_EQ(rate(even, 2.5), 0);
  EXPECT_EQ(rate(even, 3.5), 1 + 10 + 100);
  // A condition that depends on a state is a switch.
  EXPECT_EQ(system_of("x' = if(x > mod(t, 1), 1, 0)").switches(), 1);
}

TEST(KnownTimes, MoreThanAMillionAreRefused) {
  EXPECT_EQ(system_of("x' = floor(1e5 t)").discontinuities(0, 1).size(), 99'999u);
  EXPECT_THROW(static_cast<void>(system_of("x' = floor(1e9 t)").discontinuities(0, 1)),
               std::invalid_argument);
}

// Halves and quarters: the linear interpolation is exact.
TEST(Tables, AreFunctionsOfTheTime) {
  using Times = std::vector<double>;
  const TableReader reader = [](const std::string& name) {
    EXPECT_EQ(name, "a;b.csv");
    return Table{.times = {0, 1, 3, 4}, .values = {0, 2, 2, -1}};
  };
  const Equations equations(SourceText("test", "x' = table(\"a;b.csv\"); y' = table(\"a;b.csv\", steps) x/x"),
                            {}, reader);
  EXPECT_EQ(equations.times_of_tables(), std::pair(0.0, 4.0));
  const ivp::System system{Problem(equations)};
  EXPECT_EQ(system.switches(), 0);
  EXPECT_EQ(system.discontinuities(0, 4), (Times{1, 3}));
  const Times at = {0, 0.5, 1, 2, 3, 3.25, 4}, lines = {0, 1, 2, 2, 2, 1.25, -1},
              steps = {0, 0, 2, 2, 2, 2, -1};
  ivp::State f;
  for (std::size_t i = 0; i < at.size(); ++i) {
    system.rhs(at[i], ivp::State{1, 0}, f);
    EXPECT_EQ(f, (ivp::State{lines[i], steps[i]})) << at[i];
  }
  for (const double outside : {-1e-300, 4.1}) {
    system.rhs(outside, ivp::State{1, 0}, f);
    EXPECT_TRUE(std::isnan(f[0]) && std::isnan(f[1])) << outside;
  }
}

TEST(Columns, AreExpressionsOfTheState) {
  Equations e = read("x'' = -w^2 x + F; w = 2; F = cos(t); r = x^2");
  std::vector<Equations::Column> columns;
  e.read_columns("C", "E = T + w^2 r/2; T = x'^2/2; r; x''", columns);
  e.read_columns("C", "twice = 2 E", columns);
  std::vector<NodeId> nodes;
  Names names;
  for (const Equations::Column& c : columns) {
    names.push_back(c.name);
    nodes.push_back(c.node);
  }
  EXPECT_EQ(names, (Names{"E", "T", "r", "x''", "twice"}));
  std::vector<double> found;
  Program(e.graph(), nodes).run(0.0, std::vector<double>{3, 4}, 0, 5, [&](int, double v) {
    found.push_back(v);
  });
  EXPECT_EQ(found, (std::vector<double>{26, 8, 9, -11, 52}));
}

TEST(InitialOrder, IsThatOfAllNames) {
  const Equations e = read("x'' = z; z' = x + y'; y' = x");
  ASSERT_EQ(e.state_names(), (Names{"x", "z", "y", "x'"}));
  EXPECT_EQ(e.initial_order("y=1, x=0, x'=2, z=3"), (std::vector<int>{2, 0, 3, 1}));
  EXPECT_EQ(e.initial_order("y=1, x=0"), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(e.initial_order("1,2,3,4"), (std::vector<int>{0, 1, 2, 3}));
}

}  // namespace
}  // namespace nlmech::program::equations_test

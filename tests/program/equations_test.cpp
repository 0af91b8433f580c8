/// What typed equations mean: unknowns, definitions, highest derivatives, initial values.
#include "nlmech/program/equations.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>
#include <Eigen/SVD>

#include <cmath>

#include "nlmech/program/problem.hpp"

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

}  // namespace
}  // namespace nlmech::program::equations_test

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "nlmech/bvp/typed/typed_control.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::bvp::control_test {
namespace {

using Eigen::VectorXd;

/// A problem with its solution.
struct Solved {
  TypedControl problem;
  ControlSolution found;

  /// The value of component i of x, lambda, u, mu at the time s of the problem.
  [[nodiscard]] double value(double s, Eigen::Index i, Side side = Side::after) const {
    return found.at(s, side)[i];
  }
  [[nodiscard]] std::vector<double> times() const {
    return found.problem->times(found.solution.parameters());
  }
  /// The free end.
  [[nodiscard]] double end() const { return problem.true_time(1, found.solution.first()).first; }
};

Solved solved(const ControlText& text, const std::string& guess = {}) {
  TypedControl problem(text);
  const Options options{
      .newton_tolerance = 1e-9, .verification = Verification::pieces, .verification_tolerance = 1e-7};
  ControlSolution found = solve_control(problem.problem(), problem.guesses(guess), options);
  return {std::move(problem), std::move(found)};
}

ControlText mass(const std::string& cost, const std::string& conditions) {
  ControlText text;
  text.equations = "x'' = u";
  text.controls = {"u"};
  text.minimise = cost;
  text.conditions = conditions;
  return text;
}

// The residual is 1e-9 of the size of f; costs are stationary in it.
constexpr double accuracy = 1e-9;

TEST(Control, OfAMassBetweenRestsIsLinearInTime) {
  const Solved s = solved(mass("integral(u^2/2)", "x(0) = 0; x'(0) = 0; x(1) = 1; x'(1) = 0"));
  ASSERT_TRUE(s.found.status.ok()) << s.found.status.text();
  EXPECT_NEAR(s.found.cost, 6, accuracy);
  EXPECT_EQ(s.found.second_order.kind, Kind::minimum);
  EXPECT_EQ(s.found.extremals, 1);
  for (const double t : {0., 0.3, 1.}) EXPECT_NEAR(s.value(t, 4), 6 - 12 * t, accuracy * 12);
}

// lambda_x = -12 and lambda_v = 12 t - 6: the multipliers nu of x(0), x'(0), x(1), x'(1) are -lambda(0),
// lambda(1).
TEST(Control, HasTheMultipliersOfItsConditions) {
  const Solved s = solved(mass("integral(u^2/2)", "x(0) = 0; x'(0) = 0; x(1) = 1; x'(1) = 0"));
  ASSERT_TRUE(s.found.status.ok()) << s.found.status.text();
  const VectorXd expected = (VectorXd(4) << 12, 6, -12, 6).finished();
  EXPECT_LE((s.found.solution.parameters() - expected).norm(), accuracy * 20)
      << s.found.solution.parameters();
}

// T + 6/T^3 is least for T^4 = 18.
TEST(Control, WithAFreeEndBalancesTimeAndForce) {
  ControlText text = mass("T + integral(u^2/2)", "x(0) = 0; x'(0) = 0; x(T) = 1; x'(T) = 0");
  text.until = "T";
  const Solved s = solved(text);
  ASSERT_TRUE(s.found.status.ok()) << s.found.status.text();
  EXPECT_NEAR(s.end(), std::pow(18, 0.25), accuracy * 10);
  EXPECT_NEAR(s.found.cost, 4 * std::pow(18, 0.25) / 3, accuracy * 10);
}

// x' = u from 1: x = cosh(1 - t)/cosh(1), J = tanh(1)/2, with lambda(1) = 0 at the free end.
TEST(Control, WithAFreeEndStateHasNoCostateThere) {
  ControlText text = mass("integral(x^2 + u^2)/2", "x(0) = 1");
  text.equations = "x' = u";
  text.until = "1";
  const Solved s = solved(text);
  ASSERT_TRUE(s.found.status.ok()) << s.found.status.text();
  EXPECT_NEAR(s.found.cost, std::tanh(1) / 2, accuracy);
  EXPECT_NEAR(s.value(1, 1), 0, accuracy);
}

// Straight to a circle of radius 1 whose centre is 5 away: J = 4^2/2.
TEST(Control, EndsOnACurve) {
  ControlText text = mass("integral(u^2 + v^2)/2", "x(0) = 0; y(0) = 0; (x(1) - 3)^2 + (y(1) - 4)^2 = 1");
  text.equations = "x' = u; y' = v";
  text.controls = {"u", "v"};
  const Solved s = solved(text);
  ASSERT_TRUE(s.found.status.ok()) << s.found.status.text();
  EXPECT_NEAR(s.found.cost, 8, accuracy * 10);
}

// Up in half of the time and down: lambda jumps at the point between.
TEST(Control, PassesAPointBetween) {
  ControlText text = mass("integral(u^2/2)", "x(0) = 0; x(0.25) = 1; x(1) = 0");
  text.equations = "x' = u";
  const Solved s = solved(text);
  ASSERT_TRUE(s.found.status.ok()) << s.found.status.text();
  EXPECT_NEAR(s.found.cost, 4. / 2 + 4. / 6, accuracy * 10);
  EXPECT_NEAR(s.value(1, 2, Side::before), 4, accuracy * 10);
  EXPECT_NEAR(s.value(1, 2), -4. / 3, accuracy * 10);
}

// A force from a to -a that is linear between w before and after the middle: 1 = a (1/4 - w^2/3), J = a^2
// (1/2 - 2 w/3).
TEST(Control, BetweenBoundsHasThreeArcs) {
  ControlText text = mass("integral(u^2/2)", "x(0) = 0; x'(0) = 0; x(1) = 1; x'(1) = 0");
  text.bounds = "-5 <= u <= 5";
  const Solved s = solved(text);
  ASSERT_TRUE(s.found.status.ok()) << s.found.status.text();
  const double w = std::sqrt(0.15);
  EXPECT_NEAR(s.found.cost, 25 * (0.5 - 2 * w / 3), accuracy * 25);
  ASSERT_EQ(s.times().size(), 4U);
  EXPECT_NEAR(s.times()[1], 0.5 - w, accuracy * 10);
  EXPECT_NEAR(s.times()[2], 0.5 + w, accuracy * 10);
}

// From x = 1, v = 1: brake for sqrt(3/2) + 1, then accelerate: T = 1 + 2 sqrt(3/2).
TEST(Control, OfLeastTimeSwitchesOnce) {
  ControlText text = mass("T", "x(0) = 1; x'(0) = 1; x(T) = 0; x'(T) = 0");
  text.bounds = "-1 <= u <= 1";
  text.until = "T";
  const Solved s = solved(text);
  ASSERT_TRUE(s.found.status.ok()) << s.found.status.text();
  const double T = 1 + 2 * std::sqrt(1.5);
  EXPECT_NEAR(s.end(), T, accuracy * 10);
  ASSERT_EQ(s.times().size(), 3U);
  EXPECT_NEAR(s.times()[1] * T, 1 + std::sqrt(1.5), accuracy * 10);
}

// A speed of at most 1: 1 to accelerate, 1 to brake, 1 between.
TEST(Control, OfLeastTimeStaysOnABoundOfSpeed) {
  ControlText text = mass("T", "x(0) = 0; x'(0) = 0; x(T) = 2; x'(T) = 0");
  text.bounds = "-1 <= u <= 1";
  text.state_bounds = "x' <= 1";
  text.until = "T";
  const Solved s = solved(text);
  ASSERT_TRUE(s.found.status.ok()) << s.found.status.text();
  EXPECT_NEAR(s.end(), 3, accuracy * 10);
}

// Full force to x = 0 at t = 1, then nothing: J = 1/6, and u = 0 on the singular arc.
TEST(Control, MayBeSingular) {
  ControlText text = mass("integral(x^2/2)", "x(0) = 1");
  text.equations = "x' = u";
  text.bounds = "-1 <= u <= 1";
  text.until = "2";
  const Solved s = solved(text);
  ASSERT_TRUE(s.found.status.ok()) << s.found.status.text();
  EXPECT_NEAR(s.found.cost, 1. / 6, accuracy);
  ASSERT_EQ(s.times().size(), 3U);
  EXPECT_NEAR(s.times()[1], 1, accuracy * 10);
  EXPECT_NEAR(s.value(1.5, 2), 0, accuracy);
}

// The cycloid: from rest to its lowest point (pi/2, 1) below, with g = 1, in pi/sqrt(2).
TEST(Control, OfSteepestDescentIsACycloid) {
  ControlText text = mass("T", "x(0) = 0; y(0) = 0; v(0) = 0; x(T) = pi/2; y(T) = 1");
  text.equations = "x' = v sin(a); y' = v cos(a); v' = cos(a)";
  text.controls = {"a"};
  text.until = "T";
  const Solved s = solved(text, "a = t/2, T = 2");
  ASSERT_TRUE(s.found.status.ok()) << s.found.status.text();
  EXPECT_NEAR(s.end(), std::numbers::pi / std::sqrt(2), accuracy * 10);
}

Solved breakwell(const std::string& bound) {
  ControlText text = mass("integral(u^2/2)", "x(0) = 0; x'(0) = 1; x(1) = 0; x'(1) = -1");
  text.state_bounds = "x <= " + bound;
  return solved(text);
}

// Closed forms: A. E. Bryson, Y.-C. Ho, Applied Optimal Control, 1975, section 3.11, example 2.
TEST(Control, OfBreakwellIsNotBoundedAbove) {
  const Solved s = breakwell("0.3");
  ASSERT_TRUE(s.found.status.ok()) << s.found.status.text();
  EXPECT_NEAR(s.found.cost, 2, accuracy);
}

TEST(Control, OfBreakwellTouchesItsBound) {
  const double l = 0.2;
  const Solved s = breakwell("0.2");
  ASSERT_TRUE(s.found.status.ok()) << s.found.status.text();
  EXPECT_NEAR(s.found.cost, 2 + 6 * (1 - 4 * l) * (1 - 4 * l), accuracy * 10);
  ASSERT_EQ(s.times().size(), 3U);
  EXPECT_NEAR(s.times()[1], 0.5, accuracy * 10);
  // u'' = 0 on both sides with slopes +-24 (1 - 4 l): lambda_x = u' jumps by their difference.
  EXPECT_NEAR(s.found.problem->jump_multipliers(0, s.found.solution.parameters())[0], 48 * (1 - 4 * l), 1e-6);
}

TEST(Control, OfBreakwellFollowsItsBound) {
  const double l = 0.1;
  const Solved s = breakwell("0.1");
  ASSERT_TRUE(s.found.status.ok()) << s.found.status.text();
  EXPECT_NEAR(s.found.cost, 4 / (9 * l), accuracy * 10);
  ASSERT_EQ(s.times().size(), 4U);
  EXPECT_NEAR(s.times()[1], 3 * l, accuracy * 10);
  EXPECT_NEAR(s.times()[2], 1 - 3 * l, accuracy * 10);
  EXPECT_NEAR(s.value(0, 4), -2 / (3 * l), accuracy * 100);
}

// Goddard's rocket with c = 0.5, drag 310 v^2 exp(500 (1 - h)), thrust up to 3.5: the final height 1.01283 to
// six digits is that of E. D. Dolan, J. J. More, T. S. Munson, Benchmarking optimization software with
// COPS 3.0, 2004.
TEST(Control, OfGoddardsRocketHasASingularArc) {
  ControlText text;
  text.equations = "h' = v; v' = (u - D)/m - 1/h^2; m' = -2 u; D = 310 v^2 exp(500*(1 - h))";
  text.controls = {"u"};
  text.minimise = "-h(T)";
  text.conditions = "h(0) = 1; v(0) = 0; m(0) = 1; m(T) = 0.6";
  text.bounds = "0 <= u <= 3.5";
  text.until = "T";
  const Solved s = solved(text, "u = 1.7, T = 0.2");
  ASSERT_TRUE(s.found.status.ok()) << s.found.status.text();
  EXPECT_NEAR(-s.found.cost, 1.01283, 1e-5);
  ASSERT_EQ(s.times().size(), 4U);
  EXPECT_EQ(s.found.problem->arc(1).arc().controls.front(), ControlMode::singular);
}

TEST(Control, RefusesWhatItCannotRead) {
  const auto refused = [](const ControlText& text) { EXPECT_THROW(TypedControl{text}, InputError); };
  const std::string rest = "x(0) = 0; x'(0) = 0; x(1) = 1";
  refused(mass("integral(u^2)*x(1)", rest));
  refused(mass("u", rest));
  refused(mass("integral(abs(u))", rest));
  refused(mass("integral(u^2)", rest + "; u(0) = 1"));
  refused(mass("integral(u^2)", rest + "; integral(x) = 1"));
  ControlText text = mass("integral(u^2)", rest);
  text.bounds = "1 <= u <= 0";
  refused(text);
  text.bounds = "x <= 1";
  refused(text);
}

}  // namespace
}  // namespace nlmech::bvp::control_test

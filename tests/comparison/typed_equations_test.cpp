/// Typed equations in every adaptive method, nlmech methods and peers: an end state to nine digits, or a
/// failure status. References are Taylor series in 40 digits. Typed equations against the same formulas in
/// C++: tests/program/equations_test.cpp.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/program/problem.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::comparison::typed_equations_test {
namespace {

using Real = ExtendedReal<40>;
using program::Equations;
using program::SourceText;
using Typed = program::Problem;
using State = ivp::State;

Vector<Real, Eigen::Dynamic> reference(const Typed& problem, const State& x0, double t1) {
  const Vector<Real, Eigen::Dynamic> begin = x0.cast<Real>();
  std::vector<Vector<Real, Eigen::Dynamic>> states;
  const Real end(t1);
  const Status status = problems::reference_states<Real>(problem, begin, Real(0), std::span(&end, 1), states);
  EXPECT_TRUE(status.ok()) << status.text();
  return states.at(0);
}

/// An equation, its initial state, its end and, optionally, its exact end state.
struct Case {
  std::string name, text;
  State x0;
  double end;
  std::optional<State> known = std::nullopt;  ///< exact end state where Taylor series fail
};

State state(std::initializer_list<double> values) {
  State x(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), x.begin());
  return x;
}

// Cases with all features of the language; the condition numbers are at most about 300.
std::vector<Case> cases() {
  const double pi = std::numbers::pi;
  // Half a period at frequency 1, half a period at frequency 2, and the start of the next.
  const double period = pi + pi / 2, late = 3 * period + 0.4;
  // Friction reduces each half swing by 2 mu: 1, -0.7, 0.4, then rest at -0.1.
  return {{"duffing", "x'' + k x' + x^3 = B cos(t); k = 0.05; B = 7.5", state({3, 4}), 6},
          {"lorenz", "u' = sigma (v - u); v' = r u - v - u w; w' = u v - b w; sigma = 10; r = 28; b = 8/3",
           state({1, 1, 1}), 3},
          {"van der pol", "x'' - mu (1 - x^2) x' + x = 0; mu = 5", state({2, 0}), 12},
          {"double pendulum",
           "(m1 + m2) l1 a'' + m2 l2 b'' cos(a - b) + m2 l2 b'^2 sin(a - b) + (m1 + m2) g sin(a) = 0\n"
           "l2 b'' + l1 a'' cos(a - b) - l1 a'^2 sin(a - b) + g sin(b) = 0\n"
           "m1 = 1; m2 = 1; l1 = 1; l2 = 1; g = 9.81",
           state({1, 0.5, 0, 0}), 3},
          {"satellite",
           "x'' = x + 2 y' - (1 - mu) (x + mu)/D1 - mu (x - 1 + mu)/D2\n"
           "y'' = y - 2 x' - (1 - mu) y/D1 - mu y/D2\n"
           "D1 = ((x + mu)^2 + y^2)^1.5; D2 = ((x - 1 + mu)^2 + y^2)^1.5; mu = 0.012277471",
           state({0.5, 0.3, -0.2, -1.2}), 2},
          {"coefficient", "(1 + x^2) x'' + x x'^2 + x = 0", state({1, 0.5}), 10},
          {"loudspeaker",
           "L i' + R i + B x' = U cos(w t); m x'' + c x' + (k + k3 x^2) x = B i; L = 5e-4; R = 6; U = 8\n"
           "w = 2 pi*40; m = 0.02; c = 1.2; k = 1500; k3 = 4e7; B = 7",
           state({0, 0, 0}), 0.1},
          {"beam", "w'''' + 0.5 w'' + w = 0.1 w^3 - erf(t/4) tanh(w')", state({0.1, 0.2, 0, 0}), 6},
          {"functions",
           "x' = atan(y) exp(-x^2) - asin(x/8)/2 + (1 + t)^0.5^2 log(2 + x^2)/9\n"
           "y' = -atan2(x, 2 + sin(t)) - sinh(y)/cosh(x) + acos(y/9)/sqrt(4 + x^2) + 2^-t tan(x/9)",
           state({0.4, -0.9}), 6},
          {"spring of two stiffnesses", "x'' + x + 3 max(x, 0) = 0", state({-1, 0}), late,
           state({-std::cos(0.4), std::sin(0.4)})},
          {"dry friction", "x'' + x + mu sign(x') = 0; mu = 0.15", state({1, 0}), 12, state({-0.1, 0})}};
}

/// The exact end state and the condition number of the initial value problem.
struct Truth {
  State end;
  double condition;
};
Truth truth_of(const Case& c, const Equations& equations) {
  // Oscillations of constant energy, or at rest.
  if (c.known) return {*c.known, 10};
  const Typed problem(equations);
  constexpr double move = 1e-10;
  const State moved = (c.x0.array() + move * (1 + c.x0.array().abs())).matrix();
  const auto exact = reference(problem, c.x0, c.end), near = reference(problem, moved, c.end);
  return {exact.cast<double>(), static_cast<double>((near - exact).norm()) / move};
}

// Methods with a local tolerance and many steps: at 1e-12 the errors add up to less than nine digits.
const std::set<std::string> of_short_steps = {"laier",     "argyris",     "cvode-adams",
                                              "cvode-bdf", "gsl-msadams", "gsl-msbdf"};
// Methods of order 2: nine digits would take some million steps.
const std::set<std::string> of_second_order = {"hoff", "bazzi"};

// A tolerance of 1e-12 for nine digits leaves a factor of a thousand for the sum and growth of local errors.
TEST(TypedEquations, EndInNineDigitsOrWithAStatus) {
  constexpr double digits = 1e-9;
  int ends = 0;
  for (const Case& c : cases()) {
    const Equations equations(SourceText("test", c.text));
    const ivp::System system{Typed(equations)};
    const Truth expected = truth_of(c, equations);
    const double scale = 1 + expected.end.cwiseAbs().maxCoeff();
    EXPECT_LT(expected.condition, 3000) << c.name;
    for (const std::string& name : built_method_names()) {
      const ivp::MethodInfo& method = any_method(name);
      if (!method.is_peer() && method.steps == ivp::Steps::fixed) continue;
      if (of_second_order.contains(name) || (method.second_order_only && !equations.second_order())) continue;
      const double tolerance = of_short_steps.contains(name) ? 1e-14 : 1e-12;
      std::optional<ivp::Solution> end;
      try {
        end = method.with({.tolerance = tolerance})(system, c.x0, 0, c.end, {}, {.steps = 3'000'000});
      } catch (const std::invalid_argument& error) {
        // rkn1210 refuses velocity-dependent forces.
        EXPECT_EQ(name, "rkn1210") << error.what();
        continue;
      }
      // Every method can solve every case.
      EXPECT_TRUE(end->status.ok()) << c.name << ", " << name << ": " << end->status.text();
      ++ends;
      const double error = (end->x - expected.end).cwiseAbs().maxCoeff() / scale;
      EXPECT_LE(error, digits) << c.name << ", " << name << ", condition " << expected.condition;
    }
  }
  EXPECT_GT(ends, 100);
}

// Robertson's reaction to t = 40: stiff methods reach t1; other methods fail within the step limit.
TEST(TypedEquations, StiffOnesEndOrSaySo) {
  const Equations equations(SourceText(
      "test",
      "a' = -k1 a + k3 b c; b' = k1 a - k3 b c - k2 b^2; c' = k2 b^2; k1 = 0.04; k2 = 3e7; k3 = 1e4"));
  const ivp::System system{Typed(equations)};
  const auto exact = reference(Typed(equations), state({1, 0, 0}), 40);
  const State expected = exact.cast<double>();
  std::set<std::string> arrived;
  for (const std::string& name : built_method_names()) {
    const ivp::MethodInfo& method = any_method(name);
    if (!method.is_peer() && method.steps == ivp::Steps::fixed) continue;
    if (method.second_order_only) continue;
    const auto end =
        method.with({.tolerance = 1e-11})(system, state({1, 0, 0}), 0, 40, {}, {.steps = 20'000});
    if (!end.status.ok()) {
      EXPECT_FALSE(end.status.text().empty());
      continue;
    }
    arrived.insert(name);
    EXPECT_LE((end.x - expected).cwiseAbs().maxCoeff(), 1e-9) << name;
  }
  for (const char* name : {"adaptive-collocation", "cvode-bdf"}) EXPECT_TRUE(arrived.contains(name)) << name;
}

// x = 1 - t leaves its bound at t = 1; the switching surface x = -10 is not reached.
TEST(TypedEquations, BoundsHoldWhereEquationsSwitchToo) {
  const Equations equations(SourceText("test", "x' = -sign(x + 10); x >= 0"));
  const ivp::System system{Typed(equations)};
  for (const std::string& name : built_method_names()) {
    const ivp::MethodInfo& method = any_method(name);
    if (method.fixed_step() || method.second_order_only) continue;
    const auto run = method.with({.tolerance = 1e-6});
    EXPECT_TRUE(run(system, state({1}), 0, 0.9, {}, {.steps = 20'000}).status.ok()) << name;
    EXPECT_FALSE(run(system, state({1}), 0, 2, {}, {.steps = 20'000}).status.ok()) << name;
  }
}

}  // namespace
}  // namespace nlmech::comparison::typed_equations_test

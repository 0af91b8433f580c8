// What explicit Runge-Kutta methods with an error estimate share, and two that are nothing but a tableau.
#include "nlmech/ivp/runge_kutta/embedded_runge_kutta.hpp"

#include <gtest/gtest.h>

#include "chapters/plain_equations.hpp"
#include "nlmech/ivp/runge_kutta/rkn1210.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/oracle.hpp"

namespace nlmech::ivp::embedded_runge_kutta_test {
namespace {

using namespace testing;

// Orders 3 and 2, with f at the end of a step as the first stage of the next (P. Bogacki, L. F. Shampine, A
// 3(2) pair of Runge-Kutta formulas, Appl. Math. Lett. 2 (1989) 321-325).
struct BogackiShampine {
  static constexpr std::string_view name = "bogacki-shampine";
  struct Pair : EmbeddedPair<Pair> {
    static constexpr int order = 3;
    static constexpr std::array<double, 4> c = {0, 1. / 2, 3. / 4, 1};
    static constexpr std::array<std::array<double, 3>, 4> a = {
        {{}, {1. / 2}, {0, 3. / 4}, {2. / 9, 1. / 3, 4. / 9}}};
    static constexpr std::array<double, 4> error_weights = {-5. / 72, 1. / 12, 1. / 9, -1. / 8};
  };
  double relative_tolerance = 1e-6, absolute_tolerance = 1e-6, initial_step = 0, largest_step = 0;
};

// Kutta's formula of order 3 with the midpoint rule: f at the end of a step is evaluated for accepted steps.
struct KuttaMidpoint {
  static constexpr std::string_view name = "kutta-midpoint";
  struct Pair : EmbeddedPair<Pair> {
    static constexpr int order = 3;
    static constexpr std::array<double, 4> c = {0, 1. / 2, 1, 1};
    static constexpr std::array<std::array<double, 3>, 4> a = {
        {{}, {1. / 2}, {-1, 2}, {1. / 6, 2. / 3, 1. / 6}}};
    static constexpr std::array<double, 3> error_weights = {1. / 6, -1. / 3, 1. / 6};
  };
  double relative_tolerance = 1e-6, absolute_tolerance = 1e-6, initial_step = 0, largest_step = 0;
};

template <class Method>
Method within(double tolerance) {
  return {.relative_tolerance = tolerance, .absolute_tolerance = tolerance};
}

// Exponents of the errors of one step of length h at its end and in its middle (within 0.3), and of a run of
// `steps` steps.
template <class Method>
void expect_exponents(double h, double end, double middle, double steps, double order, double room) {
  const Manufactured problem;
  const auto errors = [&](double length) {
    State x(2);
    const auto look = [&](const Step& step) {
      step.dense.at(0.5 * length, x);
      return true;
    };
    const auto s = integrate(System(problem), State{1, 0}, 0, length, with_step(Method{}, length), look);
    EXPECT_EQ(s.statistics.steps, 1) << Method::name;
    return State{oracle::distance(s.x, problem.exact(length)),
                 oracle::distance(x, problem.exact(length / 2))};
  };
  const State coarse = errors(h), fine = errors(h / 2);
  EXPECT_NEAR(std::log2(coarse[0] / fine[0]), end, 0.3) << Method::name;
  EXPECT_NEAR(std::log2(coarse[1] / fine[1]), middle, 0.3) << Method::name;
  const double global = largest_error(problem, with_step(Method{}, 2 / steps), 0, 2);
  const double half = largest_error(problem, with_step(Method{}, 1 / steps), 0, 2);
  EXPECT_NEAR(std::log2(global / half), order, room) << Method::name;
}
TEST(EmbeddedRungeKutta, ErrorsHaveTheStatedExponents) {
  expect_exponents<Ode45>(0.1, 6, 5, 50, 5, 0.1);
  expect_exponents<Dop853>(0.3, 9, 8, 6, 8, 0.3);
  expect_exponents<BogackiShampine>(0.1, 4, 4, 50, 3, 0.1);
  expect_exponents<KuttaMidpoint>(0.1, 4, 4, 50, 3, 0.1);
}

// q'' = -q from (1, 0), some dozen steps of methods that go on by a formula of much higher order than the one
// that is controlled.
template <class Method>
void expect_tolerance(double tolerance) {
  const auto s = integrate(System(Oscillator{}), State{1, 0}, 0, 20, within<Method>(tolerance));
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  const double room = 10 * tolerance + 64 * eps;
  EXPECT_NEAR(s.x[0], std::cos(20), room) << Method::name;
  EXPECT_NEAR(s.x[1], -std::sin(20), room) << Method::name;
}
TEST(EmbeddedRungeKutta, HighOrdersMeetTheirTolerance) {
  for (const double tolerance : {1e-6, 1e-9, 1e-11, 1e-13}) expect_tolerance<Dop853>(tolerance);
  for (const double tolerance : {1e-6, 1e-9, 1e-12, 1e-14}) expect_tolerance<Rkn1210>(tolerance);
}

// Inlined expressions may be contracted otherwise.
template <class Method>
void expect_inlined_is_the_same() {
  const chapters::PlainDuffing duffing;
  const auto a = integrate(System(duffing), State{1, 0}, 0, 30, Method{});
  const auto b = integrate(Direct(duffing), State{1, 0}, 0, 30, Method{});
  EXPECT_EQ(a.statistics.right_hand_sides, b.statistics.right_hand_sides) << Method::name;
  EXPECT_LE(oracle::distance(a.x, b.x), 1e3 * eps) << Method::name;
  EXPECT_LE(oracle::distance(a.x, oracle::duffing(30)), 1e-6) << Method::name;
}
TEST(EmbeddedRungeKutta, SystemAndDirectAreTheSame) {
  expect_inlined_is_the_same<Ode45>();
  expect_inlined_is_the_same<Dop853>();
  expect_inlined_is_the_same<Rkn1210>();
}

// Three components are a pair and one: an oscillator and a clock.
struct WithClock {
  static constexpr int dimension = 3;
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 3>& x, Vector<T, 3>& dxdt) const {
    dxdt[0] = x[1];
    dxdt[1] = -x[0];
    dxdt[2] = T(1);
  }
};
TEST(EmbeddedRungeKutta, OddSizes) {
  const auto inlined = integrate(Direct(WithClock{}), State{1, 0, 0}, 0, 5, Dop853{});
  const auto any = integrate(System(WithClock{}), State{1, 0, 0}, 0, 5, Dop853{});
  EXPECT_EQ(inlined.statistics.right_hand_sides, any.statistics.right_hand_sides);
  EXPECT_LE(oracle::distance(inlined.x, any.x), 64 * eps);
  EXPECT_NEAR(any.x[0], std::cos(5), 1e-8);
  EXPECT_NEAR(any.x[2], 5, 1e-14);
}

// The largest error within steps of a small tolerance, at which dense output of a lower order would show.
template <class Method>
void expect_dense(double tolerance, double most) {
  double largest = 0;
  State x(2);
  const auto watch = [&](const Step& step) {
    largest = std::max(largest, oracle::distance(step.x1, oracle::duffing(step.t1)));
    for (const double part : {0.1, 0.2, 0.3, 0.5, 0.8, 0.9, 1.0}) {
      const double t = step.t0 + part * (step.t1 - step.t0);
      step.dense.at(t, x);
      largest = std::max(largest, oracle::distance(x, oracle::duffing(t)));
    }
    return true;
  };
  const auto s = integrate(System(problems::TextProblem("duffing")), State{1, 0}, 0, 5,
                           within<Method>(tolerance), watch);
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_LT(largest, most) << Method::name;
}
TEST(EmbeddedRungeKutta, DenseOutputIsAsAccurateAsTheSteps) {
  expect_dense<Dop853>(1e-10, 1e-8);
  expect_dense<Rkn1210>(1e-12, 1e-11);
}

template <class Method>
void expect_options_are_checked() {
  const auto says = [](const Method& method, const char* option, const char* value) {
    const std::string text = refusal(method);
    EXPECT_NE(text.find(Method::name), std::string::npos) << text;
    EXPECT_NE(text.find(option), std::string::npos) << text;
    EXPECT_NE(text.find(value), std::string::npos) << text;
  };
  says({.relative_tolerance = -1}, "relative_tolerance", "-1");
  says({.relative_tolerance = nan}, "relative_tolerance", "nan");
  says({.absolute_tolerance = 0}, "absolute_tolerance", "0");
  says({.initial_step = -1}, "initial_step", "-1");
  says({.initial_step = nan}, "initial_step", "nan");
  says({.largest_step = -1}, "largest_step", "-1");
  says({.largest_step = infinity}, "largest_step", "inf");
}
TEST(EmbeddedRungeKutta, SaysWhichOptionIsWrong) {
  expect_options_are_checked<Ode45>();
  expect_options_are_checked<Dop853>();
  expect_options_are_checked<Rkn1210>();
  expect_options_are_checked<BogackiShampine>();
  EXPECT_EQ(refusal(Ode45{.relative_tolerance = 1e-15}),
            "ode45: relative_tolerance must be between 2.22045e-14 and 0.1, not 1e-15");
  EXPECT_NE(refusal(Ode45{.refine = 0}).find("refine"), std::string::npos);
  EXPECT_EQ(refusal(Dop853{.relative_tolerance = -1}),
            "dop853: relative_tolerance must be between 0 and 0.1, not -1");
}

// From (1, 0) to t = 10: each step adds an error below the tolerance, which a rotation does not amplify.
template <class Method>
void expect_controlled() {
  double error_before = 1;
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    const auto s = integrate(System(Oscillator{}), State{1, 0}, 0, 10, within<Method>(tolerance));
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    const double error = std::max(std::abs(s.x[0] - std::cos(10)), std::abs(s.x[1] + std::sin(10)));
    EXPECT_LT(error, static_cast<double>(s.statistics.steps) * tolerance) << Method::name;
    EXPECT_LT(error, error_before / 10) << Method::name;
    error_before = error;
  }
}
TEST(EmbeddedRungeKutta, ATableauMeetsItsTolerance) {
  expect_controlled<BogackiShampine>();
  expect_controlled<KuttaMidpoint>();
}

TEST(EmbeddedRungeKutta, ATableauCountsItsWork) {
  const Statistics same =
      integrate(System(Manufactured{}), State{1, 0}, 0, 20, BogackiShampine{.initial_step = 1}).statistics;
  EXPECT_GT(same.rejected, 0);
  EXPECT_EQ(same.right_hand_sides, 1 + 3 * (same.steps + same.rejected));
  const Statistics another =
      integrate(System(Manufactured{}), State{1, 0}, 0, 20, KuttaMidpoint{.initial_step = 1}).statistics;
  EXPECT_GT(another.rejected, 0);
  EXPECT_EQ(another.right_hand_sides, 1 + another.steps + 2 * (another.steps + another.rejected));
}

}  // namespace
}  // namespace nlmech::ivp::embedded_runge_kutta_test

// Explicit Runge-Kutta methods with an error estimate: common properties, a method given by its tableau
// alone, and properties of ode45 and dop853. Requirements on all methods: every_integrator_test.cpp.
#include "nlmech/ivp/runge_kutta/embedded_runge_kutta.hpp"

#include <gtest/gtest.h>

#include "chapters/plain_equations.hpp"
#include "nlmech/ivp/runge_kutta/rkn1210.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/oracle.hpp"

namespace nlmech::ivp::embedded_runge_kutta_test {
namespace {

using namespace testing;

// Orders 3 and 2, first stage same as last (P. Bogacki, L. F. Shampine, A 3(2) pair of Runge-Kutta formulas,
// Appl. Math. Lett. 2 (1989) 321-325).
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

template <class Method>
Method within(double tolerance) {
  return {.relative_tolerance = tolerance, .absolute_tolerance = tolerance};
}

// Expects the exponents of the error of one step of length h at its end and at its middle (within 0.3), and
// the order of an integration of `steps` steps within `room`.
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
}

// Rounding may differ, because the compiler may contract inlined expressions differently.
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
  const chapters::PlainDuffing duffing;
  const Rk4 rk4{.step = 0.01};  // bitwise equal
  EXPECT_EQ(integrate(System(duffing), {1, 0}, 0, 20, rk4).x,
            integrate(Direct(duffing), {1, 0}, 0, 20, rk4).x);
  expect_inlined_is_the_same<Ode45>();
  expect_inlined_is_the_same<Dop853>();
  expect_inlined_is_the_same<Rkn1210>();
}

// Harmonic oscillator and a clock: three components are a SIMD pair and a single one.
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

// From (1, 0) to t = 10: each step adds an error below the tolerance; the rotation does not amplify it.
TEST(EmbeddedRungeKutta, ATableauMeetsItsTolerance) {
  double error_before = 1;
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    const auto s = integrate(System(Oscillator{}), State{1, 0}, 0, 10, within<BogackiShampine>(tolerance));
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    const double error = oracle::distance(s.x, State{std::cos(10), -std::sin(10)});
    EXPECT_LT(error, static_cast<double>(s.statistics.steps) * tolerance);
    EXPECT_LT(error, error_before / 10);
    error_before = error;
  }
}

TEST(Ode45, RefinedOutputIsTheDenseOutput) {
  for (const int refine : {1, 4, 7}) {
    State x(2);
    const auto compare = [&](const Step& step) {
      EXPECT_EQ(step.times.size(), static_cast<std::size_t>(refine));
      EXPECT_EQ(step.times.back(), step.t1);
      EXPECT_EQ(State(step.states.col(refine - 1)), step.x1);
      for (int i = 0; i < refine; ++i) {
        const double t = step.t0 + (i + 1.0) / refine * (step.t1 - step.t0);
        EXPECT_NEAR(step.times[static_cast<std::size_t>(i)], t, 4 * eps * std::abs(t));
        step.dense.at(t, x);
        EXPECT_LT((x - step.states.col(i)).cwiseAbs().maxCoeff(), 16 * eps);
      }
      return true;
    };
    EXPECT_TRUE(
        integrate(System(Manufactured{}), State{1, 0}, 0, 5, Ode45{.refine = refine}, compare).status.ok());
  }
}

// Evaluations: `once` for the start, `trial` for each trial step, `accepted` more for each accepted step if
// its last stage is not the first stage of the next step. rkn1210 tests the dependence on velocities with
// four more.
template <class Method>
void expect_counts(const Method& method, std::int64_t trial, std::int64_t accepted, std::int64_t once = 1) {
  const Statistics s = integrate(System(Oscillator{}), State{1, 0}, 0, 50, method).statistics;
  EXPECT_GT(s.rejected, 0) << Method::name;
  EXPECT_EQ(s.right_hand_sides, once + accepted * s.steps + trial * (s.steps + s.rejected)) << Method::name;
}
TEST(EmbeddedRungeKutta, CountsItsWork) {
  expect_counts(Ode45{.initial_step = 5, .largest_step = 5}, 6, 0);
  expect_counts(Dop853{.initial_step = 5}, 11, 1);
  expect_counts(Rkn1210{.initial_step = 10}, 16, 1, 5);
  expect_counts(BogackiShampine{.initial_step = 1}, 3, 0);
}

// Counts of tools/oracles/rbf_ivp_methods.py. oracle: rbf_ivp_methods 4.2 ODE45-? steps
TEST(Ode45, TakesTheStepsOfMatlab) {
  const auto steps = [](double tolerance) {
    return integrate(System(problems::TextProblem("duffing")), State{1, 0}, 0, 100 * oracle::duffing_period,
                     within<Ode45>(tolerance))
        .statistics.steps;
  };
  EXPECT_EQ(steps(1e-6), 3601);
  EXPECT_EQ(steps(1e-9), 14374);
}

// Difference quotients on both sides of a step end differ by terms of first order in their distance.
TEST(Dop853, DenseOutputIsContinuouslyDifferentiable) {
  State before = State::Zero(2);
  const auto watch = [&](const Step& step) {
    constexpr double d = 1e-5;
    State x(2);
    step.dense.at(step.t0 + d, x);
    const State slope = (x - step.x0) / d;
    if (step.index > 1) {
      EXPECT_LT(oracle::distance(slope, before), 20 * d);  // second derivatives are of size 2 and more
    }
    step.dense.at(step.t1 - d, x);
    before = (step.x1 - x) / d;
    return true;
  };
  const auto s =
      integrate(System(problems::TextProblem("duffing")), State{1, 0}, 0, 5, within<Dop853>(1e-6), watch);
  EXPECT_GT(s.statistics.steps, 5);
}

// Dense output takes three more evaluations in a step that is interpolated, however often.
TEST(Dop853, CountsItsDenseOutput) {
  const auto run = [](const Observer& observer) {
    return integrate(System(problems::TextProblem("duffing")), State{1, 0}, 0, 50, Dop853{}, observer)
        .statistics.right_hand_sides;
  };
  EXPECT_EQ(run([](const Step&) { return true; }), run({}));
  const auto some = run([](const Step& step) {
    State x(2);
    for (const double part : {0.5, 0.75}) {
      if (step.index <= 10) step.dense.at(step.t0 + part * (step.t1 - step.t0), x);
    }
    return true;
  });
  EXPECT_EQ(some, run({}) + 30);
}

// @returns the end of the first step; expects `rejected` rejected trials.
template <class Method>
double first_step(const System& system, const State& x0, const Method& method, std::int64_t rejected = 0) {
  const auto solution = integrate(system, x0, 0, 2, method, [](const Step&) { return false; });
  EXPECT_EQ(solution.statistics.rejected, rejected) << Method::name;
  return solution.t;
}

// f is not finite from t = 0.03. ode45 tries 1, 0.1, 0.05 and 0.025; dop853 tries 1, 1/5, 1/25 and 1/125.
TEST(EmbeddedRungeKutta, ShrinksWhereNothingIsFinite) {
  const System system(Poisoned{.at = 0.03});
  EXPECT_EQ(first_step(system, {1, 0}, Ode45{.initial_step = 1, .largest_step = 1}, 3), 0.025);
  EXPECT_NEAR(first_step(system, {1, 0}, Dop853{.initial_step = 1}, 3), 0.008, 4 * eps);
}

TEST(EmbeddedRungeKutta, RefusesAFirstStepThatIsTooLong) {
  const auto check = [](const auto& method) {
    const auto s = integrate(System(Manufactured{}), State{1, 0}, 0, 5, method);
    EXPECT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_GE(s.statistics.rejected, 1) << method.name;
    EXPECT_LT(oracle::distance(s.x, Manufactured{}.exact(5)), 1e-7) << method.name;
  };
  check(Ode45{.initial_step = 5, .largest_step = 5});
  check(Dop853{.initial_step = 5});
}

// At rest f gives no time scale: the first step is a tenth of the interval of integration. Otherwise it is
// (atol + rtol)^(1/8) times the time in which the state changes by its size, here 1.
TEST(Dop853, BeginsWithATenthOfTheWay) {
  EXPECT_EQ(first_step(System(Oscillator{}), {0, 0}, Dop853{}), 0.2);
  EXPECT_NEAR(first_step(System(Oscillator{}), {1, 1}, within<Dop853>(1e-8)), std::pow(2e-8, 1. / 8),
              4 * eps);
}

}  // namespace
}  // namespace nlmech::ivp::embedded_runge_kutta_test

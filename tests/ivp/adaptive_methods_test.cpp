// Checks of all adaptive methods: directions of time, ends, discontinuities, observers, limits, blow-ups,
// values that are not finite. A check of one method only is in the file of that method.
#include <gtest/gtest.h>

#include <limits>

#include "nlmech/ivp/collocation/adaptive_collocation.hpp"
#include "nlmech/ivp/hermitian/hermitian.hpp"
#include "nlmech/ivp/named/named_integrators.hpp"
#include "nlmech/ivp/runge_kutta/rkn1210.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/oracle.hpp"
#include "tests/ivp/reference.hpp"

namespace nlmech::ivp::adaptive_methods_test {
namespace {

using namespace testing;

template <class Method>
Method to(double tolerance, Method method = {}) {
  method.relative_tolerance = method.absolute_tolerance = tolerance;
  return method;
}

// A method with its options, and the bound of the check that it is for.
struct Case {
  template <class Method>
  explicit Case(const Method& method, double most = 0)
      : name(method_name(method)), run(named::with_options(method)), bound(most) {}
  [[nodiscard]] Solution operator()(const System& system, const State& x0, double t0, double t1,
                                    const Observer& observer = {}, const Limits& limits = {}) const {
    return run(system, x0, t0, t1, observer, limits);
  }
  std::string name;
  NamedIntegrator run;
  double bound;
};

// For equations without velocities in the accelerations, which all methods take.
std::vector<Case> all_methods(double bound = 0) {
  return {Case(Ode45{}, bound),
          Case(Dop853{}, bound),
          Case(Rkn1210{}, bound),
          Case(Series{}, bound),
          Case(AdaptiveCollocation{}, bound),
          Case(Hermitian{}, bound)};
}

// Damping backwards enlarges errors by e^2.
TEST(AdaptiveMethods, GoBackwards) {
  const Manufactured problem;
  for (const Case& method :
       {Case(to<Dop853>(1e-12), 1e-8), Case(Series{.relative_tolerance = 1e-12}, 1e-8),
        Case(Series{.order = 16, .step = 0.25}, 1e-9), Case(to<AdaptiveCollocation>(1e-12), 1e-8)}) {
    const auto there = method(System(problem), problem.exact(3), 3, -4);
    EXPECT_TRUE(there.status.ok()) << there.status.text();
    EXPECT_EQ(there.t, -4) << method.name;
    EXPECT_LT(oracle::distance(there.x, problem.exact(-4)), method.bound) << method.name;
  }
}

TEST(AdaptiveMethods, CrossTheSmallestIntervalAndNone) {
  const System system(Oscillator{});
  const double end = std::nextafter(1.0, 2.0);
  for (const Case& method : all_methods()) {
    EXPECT_EQ(method(system, State{1, 2}, 5, 5).x, (State{1, 2})) << method.name;
    const auto s = method(system, State{1, 0}, 1, end);
    EXPECT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_EQ(s.t, end) << method.name;
  }
}

// A largest step below the spacing of doubles at t would never arrive.
TEST(AdaptiveMethods, NoticeAStepThatDoesNotMoveTime) {
  for (const Case& method : {Case(Ode45{.largest_step = 1e-20}), Case(Dop853{.largest_step = 1e-20}),
                             Case(Rkn1210{.largest_step = 1e-20}), Case(Series{.largest_step = 1e-20})}) {
    const auto s = method(System(Oscillator{}), State{1, 0}, 1, 2);
    EXPECT_EQ(s.status.outcome(), Outcome::step_underflow) << s.status.text();
    EXPECT_EQ(s.t, 1) << method.name;
  }
}

// Steps follow each other without gap, dense output is the state at both ends.
TEST(AdaptiveMethods, ShowEveryStepToTheObserver) {
  for (const Case& method :
       {Case(Dop853{}, 8 * eps), Case(Series{}, 4 * eps), Case(AdaptiveCollocation{}, 8 * eps)}) {
    double t = 0;
    std::int64_t count = 0;
    const auto look = [&](const Step& step) {
      EXPECT_EQ(step.index, ++count);
      EXPECT_EQ(step.t0, t);
      t = step.t1;
      State x(2);
      step.dense.at(step.t0, x);
      EXPECT_EQ(x, step.x0) << method.name;
      step.dense.at(step.t1, x);
      EXPECT_LT(oracle::distance(x, step.x1), method.bound) << method.name;
      EXPECT_EQ(step.times.back(), step.t1);
      EXPECT_EQ(State(step.states.col(0)), step.x1);
      return step.index < 5;
    };
    const auto s = method(System(Manufactured{}), Manufactured{}.exact(0), 0, 10, look);
    EXPECT_EQ(s.status.outcome(), Outcome::interrupted) << method.name;
    EXPECT_EQ(s.t, t);
    EXPECT_EQ(count, 5);
  }
}

TEST(AdaptiveMethods, KeepToTheirLimits) {
  for (const Case& method : all_methods()) {
    const System system(Oscillator{});
    const auto few = method(system, State{1, 0}, 0, 1e6, {}, {.steps = 3});
    EXPECT_EQ(few.status.outcome(), Outcome::step_limit) << method.name;
    EXPECT_EQ(few.statistics.steps + few.statistics.rejected, 3) << method.name;
    if (method.name == "series") {
      EXPECT_EQ(few.statistics.steps, 3);
    }
    const auto late = method(system, State{1, 0}, 0, 1e6, {}, {.seconds = 1e-6});
    EXPECT_EQ(late.status.outcome(), Outcome::time_limit) << method.name;
    const auto stopped = method(system, State{1, 0}, 0, 1e6, [](const Step& step) { return step.index < 3; });
    EXPECT_EQ(stopped.status.outcome(), Outcome::interrupted) << method.name;
    EXPECT_EQ(stopped.statistics.steps, 3) << method.name;
  }
  for (const Case& method :
       {Case(Ode45{.largest_step = 0.0625}), Case(Dop853{.largest_step = 0.0625}),
        Case(Series{.largest_step = 0.0625}), Case(AdaptiveCollocation{.largest_step = 0.0625})}) {
    const auto steps = method(System(Manufactured{}), State{1, 0}, 0, 1).statistics.steps;
    EXPECT_GE(steps, 16) << method.name;
    if (method.name == "series") {
      EXPECT_EQ(steps, 16);
    }
  }
}

// Every discontinuity is the end of a step, and the solution keeps the accuracy of a smooth one: with rtol =
// 1e-9 the free oscillator has 1e-9 a unit of time for ode45 (Table 4.2: 1e-6 after 477); a step of
// adaptive-collocation errs by its tolerance, which grows with time.
TEST(AdaptiveMethods, StopAtDiscontinuities) {
  const problems::TextProblem problem("impact");
  const State end = reference(problem, {0, 0}, 0, 10);
  for (const Case& method : {Case(Ode45{}, 2e-8), Case(Dop853{}, 2e-8), Case(to<Series>(1e-14), 1e-13),
                             Case(to<AdaptiveCollocation>(1e-13))}) {
    std::vector<double> ends;
    const auto note = [&](const Step& step) {
      ends.push_back(step.t1);
      return true;
    };
    const auto there = method(System(problem), State{0, 0}, 0, 10, note);
    EXPECT_TRUE(there.status.ok()) << there.status.text();
    const double bound =
        method.bound > 0 ? method.bound : static_cast<double>(there.statistics.steps) * 1e-13 * 11;
    EXPECT_LT(oracle::distance(there.x, end), bound) << method.name;
    for (const double jump : {0.5, 1.0}) EXPECT_EQ(std::count(ends.begin(), ends.end(), jump), 1);
    const auto back = method(System(problem), there.x, 10, 0, note);
    EXPECT_EQ(std::count(ends.begin(), ends.end(), 0.5), 2) << method.name;
    // Errors of both ways; Dop853's are of one sign.
    EXPECT_LT(back.x.cwiseAbs().maxCoeff(), (method.name == "ode45" ? 1 : 2) * bound) << method.name;
  }
}

// y' = y^3 ends at t = 1/2; how near a run comes is a matter of its accumulated error.
TEST(AdaptiveMethods, EndAtABlowUp) {
  for (const Case& method :
       {Case(Ode45{}, 1e-7), Case(Dop853{}, 1e-7), Case(to<Series>(1e-9), 1e-6),
        Case(to(1e-9, Series{.order = 40}), 1e-6), Case(to(1e-9, Series{.order = 100}), 1e-6),
        Case(to<AdaptiveCollocation>(1e-9), 1e-3)}) {
    for (const double end : {1.0, 10.0}) {
      const auto s = method(System(problems::TextProblem("blow-up")), State{1.0}, 0, end);
      EXPECT_FALSE(s.status.ok());
      if (method.name == "ode45" || method.name == "dop853") {
        EXPECT_EQ(s.status.outcome(), Outcome::step_underflow) << s.status.text();
        EXPECT_GT(s.x[0], 1e3) << method.name;
      }
      EXPECT_NEAR(s.t, 0.5, method.bound) << s.status.text();
      EXPECT_TRUE(s.x.allFinite()) << method.name;
      EXPECT_NE(s.status.sentence().find(method.name), std::string::npos);
    }
  }
}

// Accelerations are not finite from t = 1/2 on: a run ends shortly before, with a finite state, and one from
// a later time fails at once.
TEST(AdaptiveMethods, EndWhereNothingIsFinite) {
  for (const Case& method : {Case(Ode45{}, 1e-6), Case(Dop853{}, 1e-6), Case(Rkn1210{}, 1e-6),
                             Case(AdaptiveCollocation{}, 0.01), Case(Hermitian{}, 0.01)}) {
    for (const double value : {nan, infinity}) {
      const Poisoned problem{.at = 0.5, .value = value};
      const auto s = method(System(problem), State{1, 0}, 0, 1);
      EXPECT_FALSE(s.status.ok());
      if (method.bound < 0.01) {
        EXPECT_EQ(s.status.outcome(), Outcome::non_finite) << s.status.text();
      }
      EXPECT_TRUE(s.x.allFinite()) << method.name;
      EXPECT_LE(s.t, method.bound < 0.01 ? 0.5 + method.bound : 0.5) << method.name;
      EXPECT_GT(s.t, 0.5 - method.bound) << method.name;
      const auto at_once = method(System(problem), State{1, 0}, 0.75, 1);
      EXPECT_EQ(at_once.status.outcome(), Outcome::non_finite) << at_once.status.text();
      EXPECT_EQ(at_once.t, 0.75) << method.name;
    }
  }
  // At t0 = 0 the spacing of doubles is 5e-324, and halving towards it must end too.
  for (const Case& method : {Case(Ode45{}), Case(Dop853{}), Case(Rkn1210{})}) {
    const auto none = method(System(Poisoned{.at = 1e-300}), State{1, 0}, 0, 1);
    EXPECT_EQ(none.status.outcome(), Outcome::non_finite) << none.status.text();
    EXPECT_TRUE(none.x.allFinite()) << method.name;
  }
}

TEST(AdaptiveMethods, RefuseTheFirstStepThatIsTooLong) {
  for (const Case& method :
       {Case(Ode45{.initial_step = 5, .largest_step = 5}), Case(Dop853{.initial_step = 5})}) {
    const auto s = method(System(Manufactured{}), State{1, 0}, 0, 5);
    EXPECT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_GE(s.statistics.rejected, 1) << method.name;
    EXPECT_LT(oracle::distance(s.x, Manufactured{}.exact(5)), 1e-7) << method.name;
  }
}

}  // namespace
}  // namespace nlmech::ivp::adaptive_methods_test

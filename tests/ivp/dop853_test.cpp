/// The method of order 8(5,3): that it converges, controls, and ends as its header says. Its coefficients:
/// dop853_coefficients_test.cpp.
#include "nlmech/ivp/runge_kutta/dop853.hpp"

#include <gtest/gtest.h>

#include "nlmech/problems/blow_up.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/oracle.hpp"

namespace nlmech::ivp::dop853_test {
namespace {

using namespace testing;

Dop853 within(double tolerance) { return {.relative_tolerance = tolerance, .absolute_tolerance = tolerance}; }

// One step of length h: error h^9 at its end (times the number of steps: order 8), h^8 inside.
TEST(Dop853, LocalErrorsHaveTheStatedExponents) {
  const Manufactured problem;
  const auto errors = [&](double h) {
    State middle(2);
    const auto look = [&](const Step& step) {
      step.dense.at(0.5 * h, middle);
      return true;
    };
    const auto solution = integrate(System(problem), State{1, 0}, 0, h, with_step(Dop853{}, h), look);
    EXPECT_EQ(solution.statistics.steps, 1);
    return State{(solution.x - problem.exact(h)).cwiseAbs().maxCoeff(),
                 (middle - problem.exact(h / 2)).cwiseAbs().maxCoeff()};
  };
  const State coarse = errors(0.3), fine = errors(0.15);
  EXPECT_NEAR(std::log2(coarse[0] / fine[0]), 9, 0.3);
  EXPECT_NEAR(std::log2(coarse[1] / fine[1]), 8, 0.3);
  const double global = largest_error(problem, with_step(Dop853{}, 2 / 6.), 0, 2);
  EXPECT_NEAR(std::log2(global / largest_error(problem, with_step(Dop853{}, 2 / 12.), 0, 2)), 8, 0.3);
}

// q'' = -q from (1, 0).
TEST(Dop853, MeetsItsTolerance) {
  for (const double tolerance : {1e-6, 1e-9, 1e-11, 1e-13}) {
    const auto s = integrate(System(Oscillator{}), State{1, 0}, 0, 20, within(tolerance));
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    const double room = 10 * tolerance + 64 * eps;  // some dozen steps
    EXPECT_NEAR(s.x[0], std::cos(20), room);
    EXPECT_NEAR(s.x[1], -std::sin(20), room);
  }
}

// Arenstorf's orbit closes after its period; errors of steps grow 1e4 times on the way.
TEST(Dop853, ClosesArenstorfsOrbit) {
  const problems::TextProblem problem("arenstorf");
  const State& x0 = problem.initial_state();
  const auto s = integrate(problem.system(), x0, 0, problem.final_time, within(1e-12));
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_LT((s.x - x0).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Dop853, SystemAndDirectAreTheSame) {
  const problems::Duffing duffing;
  const auto a = integrate(System(duffing), problems::Duffing::initial_state(), 0, 30, Dop853{});
  const auto b = integrate(Direct(duffing), problems::Duffing::initial_state(), 0, 30, Dop853{});
  EXPECT_EQ(a.statistics.right_hand_sides, b.statistics.right_hand_sides);
  // Inlined expressions may be contracted otherwise.
  EXPECT_LE(oracle::distance(a.x, b.x), 1e3 * eps);
  EXPECT_LE(oracle::distance(a.x, oracle::duffing(30)), 1e-6);
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

TEST(Dop853, SizesAgree) {
  const auto three = integrate(System(WithClock{}), State{1, 0, 0}, 0, 5, Dop853{});
  const auto any = integrate(System(WithClock{}), State{1, 0, 0}, 0, 5, Dop853{});
  EXPECT_EQ(three.statistics.right_hand_sides, any.statistics.right_hand_sides);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(three.x[i], any.x[i], 64 * eps);
  EXPECT_NEAR(three.x[0], std::cos(5), 1e-8);
  EXPECT_NEAR(three.x[2], 5, 1e-14);
}

// The largest error within steps of a tolerance of 1e-10, at which dense output of a lower order would show.
TEST(Dop853, DenseOutputIsAsAccurateAsTheSteps) {
  double ends = 0, inside = 0;
  State x(2);
  const auto watch = [&](const Step& step) {
    ends = std::max(ends, oracle::distance(step.x1, oracle::duffing(step.t1)));
    for (const double part : {0.1, 0.3, 0.5, 0.8}) {
      const double t = step.t0 + part * (step.t1 - step.t0);
      step.dense.at(t, x);
      inside = std::max(inside, oracle::distance(x, oracle::duffing(t)));
    }
    return true;
  };
  const auto s =
      integrate(System(problems::Duffing{}), problems::Duffing::initial_state(), 0, 5, within(1e-10), watch);
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_LT(ends, 1e-8);
  EXPECT_LT(inside, 1e-8);
}

// Slopes on both sides of the end of a step differ by rounding over the distance.
TEST(Dop853, DenseOutputIsContinuouslyDifferentiable) {
  State before = State::Zero(2);
  const auto watch = [&](const Step& step) {
    constexpr double d = 1e-5;
    State x(2);
    step.dense.at(step.t0 + d, x);
    const State slope = (x - step.x0) / d;
    if (step.index > 1) {
      EXPECT_LT(oracle::distance(slope, before), 20 * d);  // second derivatives of size 2 and more
    }
    step.dense.at(step.t1 - d, x);
    before = (step.x1 - x) / d;
    return true;
  };
  const auto s =
      integrate(System(problems::Duffing{}), problems::Duffing::initial_state(), 0, 5, within(1e-6), watch);
  EXPECT_GT(s.statistics.steps, 5);
}

// Eleven evaluations a trial, one for the start and for each step; three more where the solution within a
// step is asked for.
TEST(Dop853, CountsItsWork) {
  const auto run = [](const Observer& observer) {
    return integrate(System(problems::Duffing{}), State{1, 0}, 0, 50, Dop853{}, observer).statistics;
  };
  const auto s = run({});
  EXPECT_GT(s.rejected, 0);
  EXPECT_EQ(s.right_hand_sides, 11 * (s.steps + s.rejected) + s.steps + 1);
  EXPECT_EQ(run([](const Step&) { return true; }).right_hand_sides, s.right_hand_sides);
  const auto some = run([](const Step& step) {
    State x(2);
    for (const double part : {0.5, 0.75}) {
      if (step.index <= 10) step.dense.at(step.t0 + part * (step.t1 - step.t0), x);
    }
    return true;
  });
  EXPECT_EQ(some.right_hand_sides, s.right_hand_sides + 30);
}

// Every discontinuity is the end of a step, and the solution keeps the accuracy of a smooth one.
TEST(Dop853, StopsAtDiscontinuities) {
  const problems::ImpactDuffing problem;
  const problems::ReferenceTrajectory<long double, problems::ImpactDuffing> reference(
      problem, Vector<long double, 2>(0, 0), 0, 10);
  std::vector<double> ends;
  const auto note = [&](const Step& step) {
    ends.push_back(step.t1);
    return true;
  };
  const auto solution = integrate(System(problem), State{0, 0}, 0, 10, Dop853{}, note);
  EXPECT_TRUE(solution.status.ok());
  EXPECT_EQ(std::count(ends.begin(), ends.end(), 0.5), 1);
  EXPECT_EQ(std::count(ends.begin(), ends.end(), 1.0), 1);
  EXPECT_LT((solution.x - reference(10).cast<double>()).cwiseAbs().maxCoeff(), 2e-8);
  const auto back = integrate(System(problem), solution.x, 10, 0, Dop853{}, note);
  EXPECT_EQ(std::count(ends.begin(), ends.end(), 0.5), 2);
  EXPECT_LT(back.x.cwiseAbs().maxCoeff(), 4e-8);
}

// y' = y^3 ends at t = 1/2.
TEST(Dop853, UnderflowsAtABlowUp) {
  const auto solution = integrate(System(problems::BlowUp{}), State{1.0}, 0, 1, Dop853{});
  EXPECT_EQ(solution.status.outcome(), Outcome::step_underflow) << solution.status.text();
  EXPECT_NEAR(solution.t, 0.5, 1e-7);
  EXPECT_GT(solution.x[0], 1e3);
  EXPECT_TRUE(solution.x.allFinite());
  EXPECT_NE(solution.status.sentence().find("dop853"), std::string::npos);
}

TEST(Dop853, RefusesTheFirstStepThatIsTooLong) {
  const auto solution = integrate(System(Manufactured{}), State{1, 0}, 0, 5, Dop853{.initial_step = 5});
  EXPECT_TRUE(solution.status.ok());
  EXPECT_GE(solution.statistics.rejected, 1);
  EXPECT_LT((solution.x - Manufactured{}.exact(5)).cwiseAbs().maxCoeff(), 1e-7);
}

// Nothing is finite from 0.03 on: trials of 1, 1/5, 1/25 and 1/125.
TEST(Dop853, ShrinksToAFifthWhereNothingIsFinite) {
  double first = 0;
  const auto stop = [&](const Step& step) {
    first = step.t1;
    return false;
  };
  const auto solution =
      integrate(System(Poisoned{.at = 0.03}), State{1, 0}, 0, 2, Dop853{.initial_step = 1}, stop);
  EXPECT_NEAR(first, 0.008, 4 * eps);
  EXPECT_EQ(solution.statistics.rejected, 3);
}

// The end of a step where f is not finite is no end, though no stage saw it: the next step could not begin.
TEST(Dop853, EndsWhereNothingIsFinite) {
  const auto s = integrate(System(Poisoned{}), State{1, 0}, 0, 1, Dop853{});
  EXPECT_EQ(s.status.outcome(), Outcome::non_finite) << s.status.text();
  EXPECT_TRUE(s.x.allFinite());
  EXPECT_NEAR(s.t, 0.5, 1e-6);
  const auto none = integrate(System(Poisoned{.at = 1e-300}), State{1, 0}, 0, 1, Dop853{});
  EXPECT_EQ(none.status.outcome(), Outcome::non_finite) << none.status.text();
}

// At rest f says nothing of the way ahead: the first step is a tenth of it, and a push is not leapt over.
TEST(Dop853, BeginsWithATenthOfTheWay) {
  double first = 0;
  const auto stop = [&](const Step& step) {
    first = step.t1;
    return false;
  };
  (void)integrate(System(Oscillator{}), State{0, 0}, 0, 2, Dop853{}, stop);
  EXPECT_EQ(first, 0.2);
  // Else by (atol + rtol)^(1/8) of the time in which the state changes by its size, here 1.
  (void)integrate(System(Oscillator{}), State{1, 1}, 0, 20, within(1e-8), stop);
  EXPECT_NEAR(first, std::pow(2e-8, 1. / 8), 4 * eps);
}

TEST(Dop853, NoticesAStepThatDoesNotMoveTime) {
  const auto solution = integrate(System(Oscillator{}), State{1, 0}, 1, 2, Dop853{.largest_step = 1e-20});
  EXPECT_EQ(solution.status.outcome(), Outcome::step_underflow);
  EXPECT_EQ(solution.t, 1);
}

TEST(Dop853, CrossesTheSmallestInterval) {
  const double end = std::nextafter(1.0, 2.0);
  const auto solution = integrate(System(Oscillator{}), State{1, 0}, 1, end, Dop853{});
  EXPECT_TRUE(solution.status.ok()) << solution.status.text();
  EXPECT_EQ(solution.t, end);
}

TEST(Dop853, SaysWhichOptionIsWrong) {
  EXPECT_EQ(refusal(Dop853{.relative_tolerance = -1}),
            "dop853: relative_tolerance must be between 0 and 0.1, not -1");
  EXPECT_NE(refusal(Dop853{.relative_tolerance = nan}).find("nan"), std::string::npos);
  EXPECT_NE(refusal(Dop853{.absolute_tolerance = 0}).find("absolute_tolerance"), std::string::npos);
  EXPECT_NE(refusal(Dop853{.initial_step = -1}).find("initial_step"), std::string::npos);
  EXPECT_NE(refusal(Dop853{.largest_step = infinity}).find("largest_step"), std::string::npos);
}

}  // namespace
}  // namespace nlmech::ivp::dop853_test

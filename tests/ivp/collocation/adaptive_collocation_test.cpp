// adaptive-collocation: local error, order, and iteration of each step. Requirements on all methods:
// every_integrator_test.cpp, integrator_accuracy_test.cpp.
#include "nlmech/ivp/collocation/adaptive_collocation.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "nlmech/ivp/series/series.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/oracle.hpp"
#include "tests/ivp/typed.hpp"

namespace nlmech::ivp::adaptive_collocation_test {
namespace {

using testing::eps;

AdaptiveCollocation to(double tolerance, int nodes = 0) {
  return {.relative_tolerance = tolerance, .absolute_tolerance = tolerance, .nodes = nodes};
}

/// Largest local error of a step in tolerances, against a Taylor series from the start of the step.
template <class Problem>
double largest_local_error(const Problem& problem, double end, const AdaptiveCollocation& method,
                           std::int64_t* jacobians = nullptr) {
  double largest = 0;
  const Series accurate{.relative_tolerance = 1e-16, .absolute_tolerance = 1e-16};
  const auto measure = [&](const Step& step) {
    const auto exact = integrate(System(problem), step.x0, step.t0, step.t1, accurate);
    EXPECT_TRUE(exact.status.ok());
    for (Eigen::Index i = 0; i < step.x0.size(); ++i) {
      const double size = std::max(std::abs(step.x0[i]), std::abs(step.x1[i]));
      largest = std::max(largest, std::abs(step.x1[i] - exact.x[i]) /
                                      (method.absolute_tolerance + method.relative_tolerance * size));
    }
    return true;
  };
  const auto s = integrate(System(problem), problem.initial_state(), 0, end, method, measure);
  EXPECT_TRUE(s.status.ok());
  if (jacobians) *jacobians = s.statistics.jacobians;
  return largest;
}

// Local errors. With the default number of nodes sweeps meet the tolerance, because the step size aims at a
// tenth of it; with more nodes than suit the tolerance the estimate is less reliable.
TEST(AdaptiveCollocation, SweepsKeepTheirTolerance) {
  for (const int nodes : {0, 9, 13, 17}) {
    const double most = nodes == 0 ? 1 : 5;
    for (const double tolerance : {1e-3, 1e-5, 1e-7, 1e-9, 1e-11}) {
      const auto method = to(tolerance, nodes);
      const auto check = [&](double error) { EXPECT_LT(error, most) << nodes << ' ' << tolerance; };
      check(largest_local_error(problems::TextProblem("duffing"), 60, method));
      check(largest_local_error(problems::TextProblem("duffing", {{"hardening", 1e6}}), 0.1, method));
      check(largest_local_error(problems::TextProblem("three-dof"), 60, method));
      std::int64_t jacobians = 0;
      const double lorenz = largest_local_error(problems::TextProblem("lorenz"), 15, method, &jacobians);
      if (jacobians == 0) check(lorenz);  // otherwise see the next test
    }
  }
}

// The error estimate propagates the defect to the end of the step by the linear part of the equation; it
// neglects the change of the linear part within the step.
TEST(AdaptiveCollocation, NewtonsStepsThroughLeaps) {
  for (const double tolerance : {1e-3, 1e-5, 1e-7, 1e-9, 1e-11}) {
    std::int64_t jacobians = 0;
    EXPECT_LT(
        largest_local_error(problems::TextProblem("van-der-pol", {{"mu", 5}}), 20, to(tolerance), &jacobians),
        3)
        << tolerance;
    EXPECT_LT(largest_local_error(problems::TextProblem("lorenz"), 15, to(tolerance)), 3) << tolerance;
  }
}

// Quadrature with s nodes is exact for slopes of degree 2s - 2 in time, and not for 2s - 1: the order is 2s -
// 1.
TEST(AdaptiveCollocation, QuadratureOfRadau) {
  const auto error = [](int degree, int nodes) {
    const std::string n = std::to_string(degree);
    const System power = testing::typed("x' = (" + n + " + 1) t^" + n);
    const AdaptiveCollocation whole{
        .relative_tolerance = 0.1, .absolute_tolerance = 1e10, .nodes = nodes};  // one step
    const auto s = integrate(power, State{0.0}, 0, 1, whole);
    EXPECT_EQ(s.statistics.steps, 1);
    return std::abs(s.x[0] - 1);
  };
  EXPECT_LT(error(14, 9), 16 * eps);
  EXPECT_GT(error(15, 9), 1e-9);
  EXPECT_LT(error(22, 13), 16 * eps);
  EXPECT_GT(error(23, 13), 1e-14);
  EXPECT_LT(error(30, 17), 16 * eps);
}

// Dense output of Newton's steps: the collocation polynomial has order s + 1, where the end of a step has
// order 2s - 1; on the smooth branch of van der Pol's equation.
TEST(AdaptiveCollocation, DenseOutputOfStiffSteps) {
  const problems::TextProblem problem("van-der-pol", {{"mu", 100}});
  const problems::ReferenceTrajectory<long double, problems::TextProblem> reference(problem, {2, 0}, 0, 60);
  double largest = 0;
  const auto look = [&](const Step& step) {
    State x(2);
    for (const double part : {0.25, 0.5, 0.75}) {
      const double t = step.t0 + part * (step.t1 - step.t0);
      step.dense.at(t, x);
      largest = std::max(largest, oracle::distance(x, State(reference(t).cast<double>())));
    }
    return true;
  };
  const auto s = integrate(System(problem), {2, 0}, 0, 60, to(1e-9), look);
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_GT(s.statistics.jacobians, 0);
  EXPECT_LT(largest, 1e-5);  // 0.1 tol^((s+1)/2s) for s = 5 is 4e-7 a step
}

// Gaussians at the same nodes meet the tolerance with at least as many steps as polynomials; wide Gaussians
// approach the polynomials.
TEST(AdaptiveCollocation, Gaussians) {
  const double end = oracle::duffing_period;
  const State exact = oracle::duffing(end);
  for (const double shape : {0.01, 0.5, 2.0}) {
    for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
      AdaptiveCollocation method = to(tolerance);
      method.shape = shape;
      const auto s = integrate(System(problems::TextProblem("duffing")), {1, 0}, 0, end, method);
      ASSERT_TRUE(s.status.ok()) << s.status.text();
      EXPECT_LT(oracle::distance(s.x, exact), static_cast<double>(s.statistics.steps) * tolerance * (1 + end))
          << shape << ' ' << tolerance;
      EXPECT_GE(s.statistics.steps,
                integrate(System(problems::TextProblem("duffing")), {1, 0}, 0, end, to(tolerance))
                    .statistics.steps);
    }
  }
}

// ------------------------------------------------------------ edges

/// The solution from x = 0 is sin(w t).
System driven(double frequency) {
  return testing::typed(fmt::format("x' = w cos(w t) - (x - sin(w t)); w = {:.17g}", frequency));
}

// The initial guess of a step extrapolates the polynomial of the step before; at twice the distance it may be
// a thousand times as large as any state. A tolerance relative to that guess would let errors grow from step
// to step.
TEST(AdaptiveCollocation, NoToleranceFollowsAGuess) {
  for (const double tolerance : {1e-2, 1e-3, 1e-5, 1e-7}) {
    for (int k = 0; k < 60; ++k) {
      const double frequency = 5 + 0.41 * k, end = 14.2;
      const auto s = integrate(driven(frequency), State{0.0}, 0, end, to(tolerance));
      ASSERT_TRUE(s.status.ok()) << s.status.text();
      // Errors decay in a unit of time, which contains a step of two tolerances (|x| <= 1) or a few steps.
      EXPECT_LT(std::abs(s.x[0] - std::sin(frequency * end)), 10 * tolerance)
          << frequency << ' ' << tolerance;
    }
  }
}

// At a jump that is not announced the estimate shortens the steps; the error stays near the tolerance.
TEST(AdaptiveCollocation, FindsUnannouncedJumps) {
  const testing::Unannounced<testing::JumpingForce> problem;
  const auto s = integrate(System(problem), State{0, 0}, 0, 1, to(1e-8));
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_GT(s.statistics.rejected, 0);
  EXPECT_LT(oracle::distance(s.x, testing::JumpingForce{}.exact(1)), 1e-7);
}

TEST(AdaptiveCollocation, OptionsOutOfRangeAreNamed) {
  using testing::refusal;
  EXPECT_NE(refusal(AdaptiveCollocation{.nodes = 8}).find("nodes must be 9, 13 or 17"), std::string::npos);
  EXPECT_NE(refusal(AdaptiveCollocation{.relative_tolerance = 0.2}).find("relative_tolerance"),
            std::string::npos);
  EXPECT_NE(refusal(AdaptiveCollocation{.absolute_tolerance = testing::nan}).find("absolute_tolerance"),
            std::string::npos);
  EXPECT_NE(refusal(AdaptiveCollocation{.largest_step = -1}).find("largest_step"), std::string::npos);
  EXPECT_EQ(refusal(AdaptiveCollocation{.relative_tolerance = 0}), "accepted");
}

}  // namespace
}  // namespace nlmech::ivp::adaptive_collocation_test

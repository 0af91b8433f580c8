// ode45: coefficients, output, steps. Checks that it shares with other methods:
// embedded_runge_kutta_test.cpp, adaptive_methods_test.cpp.
#include <gtest/gtest.h>

#include <numeric>

#include "nlmech/problems/texts.hpp"
#include "tests/ivp/methods.hpp"

namespace nlmech::ivp::ode45_test {
namespace {

using namespace testing;

// Weights of the stages at the fraction s of a step.
std::vector<double> weights(double s) {
  std::vector<double> b;
  for (const auto& w : dormand_prince::dense) b.push_back(s * (w[0] + s * (w[1] + s * (w[2] + s * w[3]))));
  return b;
}

// The order conditions of the quartic, all eight trees up to order 4, at several fractions of the step: the
// printed coefficients of the pair itself are judged by them too.
TEST(Ode45, DenseOutputFulfilsAllConditionsOfOrderFour) {
  using dormand_prince::a, dormand_prince::c;
  constexpr std::size_t stages = dormand_prince::stages;
  for (const double s : {0.1, 0.25, 0.5, 0.75, 1.0}) {
    const std::vector<double> b = weights(s);
    const auto sum = [&](const auto& term) {
      double total = 0;
      for (std::size_t i = 0; i < stages; ++i) total += b[i] * term(i);
      return total;
    };
    const auto inner = [&](std::size_t i, const auto& term) {
      double total = 0;
      for (std::size_t j = 0; j < i; ++j) total += a[i][j] * term(j);
      return total;
    };
    const auto one = [](std::size_t) { return 1.0; };
    const auto ac = [&](std::size_t i) { return inner(i, [](std::size_t j) { return c[j]; }); };
    const double tolerance = 64 * eps;  // weights up to 10 cancel
    EXPECT_NEAR(sum(one), s, tolerance);
    EXPECT_NEAR(sum([](std::size_t i) { return c[i]; }), s * s / 2, tolerance);
    EXPECT_NEAR(sum([](std::size_t i) { return c[i] * c[i]; }), std::pow(s, 3) / 3, tolerance);
    EXPECT_NEAR(sum(ac), std::pow(s, 3) / 6, tolerance);
    EXPECT_NEAR(sum([](std::size_t i) { return c[i] * c[i] * c[i]; }), std::pow(s, 4) / 4, tolerance);
    EXPECT_NEAR(sum([&](std::size_t i) { return c[i] * ac(i); }), std::pow(s, 4) / 8, tolerance);
    EXPECT_NEAR(sum([&](std::size_t i) { return inner(i, [](std::size_t j) { return c[j] * c[j]; }); }),
                std::pow(s, 4) / 12, tolerance);
    EXPECT_NEAR(sum([&](std::size_t i) { return inner(i, ac); }), std::pow(s, 4) / 24, tolerance);
  }
  for (std::size_t i = 0; i < stages; ++i) {
    EXPECT_NEAR(std::accumulate(a[i].begin(), a[i].end(), 0.0), c[i], 32 * eps);
    // At the end of the step the quartic is the fifth-order formula, and its slope is f there.
    EXPECT_NEAR(weights(1)[i], i + 1 < stages ? a[stages - 1][i] : 0, 16 * eps);
    const auto& w = dormand_prince::dense[i];
    EXPECT_NEAR(w[0] + 2 * w[1] + 3 * w[2] + 4 * w[3], i + 1 == stages ? 1 : 0, 64 * eps);
  }
}

// The fourth-order companion: b minus the difference fulfils the quadrature conditions to order 4, and not
// the fifth.
TEST(Ode45, ErrorEstimateIsOfOrderFour) {
  using dormand_prince::a, dormand_prince::c, dormand_prince::difference;
  for (int power = 0; power < 5; ++power) {
    double fifth = 0, gap = 0;
    for (std::size_t i = 0; i < dormand_prince::stages; ++i) {
      fifth += (i < 6 ? a[6][i] : 0) * std::pow(c[i], power);
      gap += difference[i] * std::pow(c[i], power);
    }
    EXPECT_NEAR(fifth, 1.0 / (power + 1), 8 * eps) << power;
    if (power < 4) {
      EXPECT_NEAR(gap, 0, 4 * eps) << power;
    } else {
      EXPECT_GT(std::abs(gap), 1e-5);
    }
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

// Six evaluations a trial, one for the start: the last stage of a step is the first of the next.
TEST(Ode45, CountsItsWork) {
  const auto s = integrate(System(problems::TextProblem("duffing")), State{1, 0}, 0, 50, Ode45{}).statistics;
  EXPECT_GT(s.rejected, 0);
  EXPECT_EQ(s.right_hand_sides, 6 * (s.steps + s.rejected) + 1);
}

// Nothing is finite from 0.03 on: the first trial, of length 1, is followed by one of a tenth, then by
// halves: 0.1, 0.05, 0.025, which is accepted.
TEST(Ode45, ShrinksFirstToATenthAndThenByHalves) {
  double first = 0;
  const auto stop = [&](const Step& step) {
    first = step.t1;
    return false;
  };
  const Ode45 method{.initial_step = 1, .largest_step = 1};
  const auto solution = integrate(System(Poisoned{.at = 0.03}), State{1, 0}, 0, 2, method, stop);
  EXPECT_EQ(first, 0.025);
  EXPECT_EQ(solution.statistics.rejected, 3);
}

}  // namespace
}  // namespace nlmech::ivp::ode45_test

#include "nlmech/peers/bvp/ipopt.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "nlmech/bvp/optimal_control/duffing.hpp"

namespace nlmech::peers::ipopt_test {
namespace {

using Eigen::VectorXd;

TEST(Ipopt, StartsTheFixedDuffingCase) {
  bvp::DuffingSettings settings;
  settings.which = bvp::DuffingCase::fixed;
  const bvp::ExtremalProblem problem = bvp::duffing_problem(settings);
  const bvp::ControlGuess guess{Eigen::Vector2d::Zero(), [](double, VectorXd& u) { u[0] = 1; }};
  if (!ipopt_available()) {
    EXPECT_THROW((void)ipopt_start(problem, guess), std::logic_error);
    return;
  }
  const bvp::DirectResult direct = ipopt_start(problem, guess, {.pieces = 200});
  ASSERT_TRUE(direct.status.ok()) << direct.status.text();
  // Trapezoidal rule, h = 0.01: within (omega h)^2 of the extremal, omega = 4.
  EXPECT_NEAR(direct.cost, 122.0837680864659, 2e-3 * 122);
  const bvp::Extremal e = bvp::solve_extremal(problem, direct.start);
  ASSERT_TRUE(e.solution.status.ok()) << e.solution.status.text();
  EXPECT_NEAR(e.cost, 122.0837680864659, 1e-9);  // 36-digit reference
  EXPECT_THROW((void)ipopt_start(problem, guess, {.pieces = 1}), std::invalid_argument);
}

// The six cases at T = 1 and 5 by an interior-point method on the trapezoidal rule, from other forces and
// initial guesses. The extremals that it reaches do not cost less than those of the library's own initial
// guesses.
TEST(Ipopt, FindsNothingCheaper) {
  if (!ipopt_available()) GTEST_SKIP() << "no Ipopt in this build";
  using enum bvp::DuffingCase;
  int solved = 0;
  for (const double T : {1.0, 5.0}) {
    for (const bvp::DuffingCase which : {free, fixed, x1x1, x1x2, x2x1, harmonic}) {
      const bvp::DuffingSettings settings{.which = which, .final_time = T, .beta = bvp::printed_beta(which)};
      const bvp::ExtremalProblem problem = bvp::duffing_problem(settings);
      const bvp::Multistart own = duffing_extremals(settings, {.random = 0}, {}, {});
      ASSERT_FALSE(own.found.empty()) << to_string(which);
      for (const double v : {-15.0, 0.0, 15.0}) {
        const bvp::ControlGuess guess{Eigen::Vector2d(v / 5, v), [v, T](double t, VectorXd& u) {
                                        u[0] = v == 0 ? 1 : v * std::sin(4 * t / T);
                                      }};
        const bvp::DirectResult direct = ipopt_start(problem, guess, {.pieces = 120, .iterations = 120});
        if (!direct.status.ok()) continue;
        const bvp::Extremal e = bvp::solve_extremal(problem, direct.start);
        if (!e.solution.status.ok()) continue;
        ++solved;
        EXPECT_GE(e.cost, own.found[0].extremal.cost * (1 - 1e-9)) << to_string(which) << ", T = " << T;
      }
    }
  }
  EXPECT_GE(solved, 18);  // half of them
}

}  // namespace
}  // namespace nlmech::peers::ipopt_test

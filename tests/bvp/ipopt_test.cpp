#include "nlmech/peers/bvp/ipopt.hpp"

#include <gtest/gtest.h>

#include "nlmech/bvp/duffing.hpp"

namespace nlmech::peers {
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

}  // namespace
}  // namespace nlmech::peers

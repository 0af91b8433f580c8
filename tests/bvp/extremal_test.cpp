#include "nlmech/bvp/optimal_control/extremal.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "nlmech/bvp/optimal_control/direct_start.hpp"
#include "nlmech/bvp/optimal_control/dual_control.hpp"
#include "nlmech/bvp/optimal_control/duffing.hpp"
#include "tests/bvp/problems.hpp"

namespace nlmech::bvp::extremal_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector4d;
using Eigen::VectorXd;
using tests::Mass;

ControlTask rest_to_rest(double final_time) {
  ControlTask task;
  task.final_time = final_time;
  task.begin = {0.0, 0.0};
  task.end = {1.0, 0.0};
  return task;
}

ExtremalProblem mass(ControlTask task, double price = 0) {
  return {std::make_shared<const DualControl<Mass>>(Mass{price}), std::move(task)};
}

Start zeros(const ExtremalProblem& problem) {
  return constant_start(VectorXd::Zero(4), problem.own_parameters());
}

// Derivatives of x1' = x2, x2' = f - w^2 x1 - beta x1^3 and H = f^2/2 + lambda1 x2 + lambda2 x2', by hand.
TEST(DualControl, DifferentiatesTheDuffingOscillator) {
  const DualControl<ControlledDuffing> model(ControlledDuffing{.frequency = 3});
  const double beta = 0.7, x1 = 1.25, x2 = -2, f = 0.5, l1 = 1.5, l2 = -0.25;
  const VectorXd x = Vector2d(x1, x2), u = VectorXd::Constant(1, f), lambda = Vector2d(l1, l2);
  const double acceleration = f - 9 * x1 - beta * x1 * x1 * x1, slope = -9 - 3 * beta * x1 * x1;
  // A few rounding errors of numbers below 20.
  const double few = 8 * 20 * 2.2e-16;
  LinearDynamics linear;
  model.linearise(0, x, u, beta, linear);
  const HamiltonianExpansion e = model.expand(0, x, u, lambda, beta, {});
  EXPECT_LE((linear.g - Vector2d(x2, acceleration)).norm(), few);
  EXPECT_LE((linear.g_x - (Eigen::Matrix2d() << 0, 1, slope, 0).finished()).norm(), few);
  EXPECT_LE((linear.g_u - Vector2d(0, 1)).norm(), few);
  EXPECT_EQ(e.g, linear.g);
  EXPECT_EQ(e.g_x, linear.g_x);
  EXPECT_EQ(e.g_u, linear.g_u);
  EXPECT_NEAR(e.value, f * f / 2 + l1 * x2 + l2 * acceleration, few);
  EXPECT_LE((e.gradient - Eigen::Vector3d(l2 * slope, l1, f + l2)).norm(), few);
  const Eigen::Matrix3d hessian = Eigen::Vector3d(-6 * l2 * beta * x1, 0, 1).asDiagonal();
  EXPECT_LE((e.hessian - hessian).norm(), few);
}

TEST(Extremal, OfAMassIsTheKnownParabola) {
  const double T = 2;
  const ExtremalProblem problem = mass(rest_to_rest(T));
  const Extremal e = solve_extremal(problem, zeros(problem));
  ASSERT_TRUE(e.solution.status.ok()) << e.solution.status.text();
  // Polynomials of degree 3: exact up to rounding.
  EXPECT_NEAR(e.cost, 6 / (T * T * T), 1e-14);
  EXPECT_LE(e.miss, 1e-14);
  for (const double t : {0.0, 0.3, 1.1, 2.0}) {
    EXPECT_NEAR(control_at(problem, e.solution, t)[0], 6 / (T * T) * (1 - 2 * t / T), 1e-13);
    EXPECT_NEAR(hamiltonian_at(problem, e.solution, t), hamiltonian_at(problem, e.solution, 0), 1e-13);
  }
  const SecondOrder second = second_order(problem, e.solution);
  EXPECT_EQ(second.kind, Kind::minimum);
  // The cost is convex: integral |du|^2 for directions that keep the end.
  EXPECT_NEAR(second.least, 1, 1e-10);
  EXPECT_THROW((void)second_order(problem, e.solution, 5), std::invalid_argument);
}

TEST(Extremal, WithFreeFinalTimeTakesTheCheapest) {
  ControlTask task = rest_to_rest(1.5);
  task.free_final_time = true;
  const ExtremalProblem problem = mass(task, 1);
  Start start = direct_start(problem, {Vector2d::Zero(), [](double, VectorXd& u) { u[0] = 0; }}).start;
  const Extremal e = solve_extremal(problem, start);
  ASSERT_TRUE(e.solution.status.ok()) << e.solution.status.text();
  const double T = std::pow(18, 0.25);
  EXPECT_NEAR(e.final_time, T, 1e-12);
  EXPECT_NEAR(e.cost, 6 / (T * T * T) + T, 1e-12);
  EXPECT_NEAR(hamiltonian_at(problem, e.solution, 0.7), 0, 1e-12);  // H = -dphi/dT = 0
}

TEST(Extremal, ThroughAWaypointJumpsInItsCostateOnly) {
  // By symmetry the free path passes x(1) = 1/2: no jump of the co-state. With the waypoint 0.8 there is one.
  for (const double value : {0.5, 0.8}) {
    ControlTask task = rest_to_rest(2);
    task.waypoints = {{1, 0, value}};
    const ExtremalProblem problem = mass(task);
    const Extremal e = solve_extremal(problem, zeros(problem));
    ASSERT_TRUE(e.solution.status.ok()) << e.solution.status.text();
    const VectorXd before = e.solution.at(1, Side::before), after = e.solution.at(1, Side::after);
    EXPECT_NEAR(before[0], value, 1e-14);
    EXPECT_NEAR(before[1], after[1], 1e-13);
    EXPECT_NEAR(before[3], after[3], 1e-13);
    // Hermite pieces with v(1) = 3/4 cost J(d) = 3/4 + 12 (d - 1/2)^2; the jump is the sensitivity dJ/dd.
    EXPECT_NEAR(e.cost, 0.75 + 12 * (value - 0.5) * (value - 0.5), 1e-13);
    EXPECT_NEAR(std::abs(after[2] - before[2]), 24 * (value - 0.5), 1e-12);
  }
}

TEST(Extremal, BoundedControlApproachesItsLimitAndNoMore) {
  const ExtremalProblem problem = mass(rest_to_rest(2));
  const double peak = 1.5, limit = 1.1;
  const auto path = control_bound_path(peak, limit, 1e-4);
  const Extremal e = tighten(problem, zeros(problem), path);
  ASSERT_TRUE(e.solution.status.ok()) << e.solution.status.text();
  // u = limit until t1, then linear through 0 at t = 1: distance 1 gives m (1 - (1 - t1)^2/3) = 1.
  const double t1 = 1 - std::sqrt(3 * (1 - 1 / limit));
  const double exact = limit * limit * (t1 + (1 - t1) / 3);
  // The smoothing changes u by about d^2/(4 x) near the corners, and by 1e-4 squared elsewhere.
  EXPECT_NEAR(e.cost, exact, 1e-5);
  const ExtremalProblem bounded = with_constraints(problem, path(1));
  EXPECT_NEAR(control_at(bounded, e.solution, 0)[0], limit, 1e-4);
}

TEST(Extremal, BoundBelowFeasibilityIsInfeasible) {
  const ExtremalProblem problem = mass(rest_to_rest(2));
  const Extremal e = tighten(problem, zeros(problem), control_bound_path(1.5, 0.9, 1e-3));
  EXPECT_EQ(e.solution.status.outcome(), Outcome::infeasible) << e.solution.status.text();
}

TEST(Extremal, BoundedStateStaysWithinThePenaltysReach) {
  // |v| <= 0.6, where the free path reaches 0.75.
  const ExtremalProblem problem = mass(rest_to_rest(2));
  const Extremal e = tighten(problem, zeros(problem), state_bound_path({{.component = 1, .high = 0.6}}, 1e4));
  ASSERT_TRUE(e.solution.status.ok()) << e.solution.status.text();
  double highest = 0;
  for (int i = 0; i <= 100; ++i) highest = std::max(highest, e.solution.at(0.02 * i)[1]);
  // The multiplier of the bound is at most the force's slope, below 10; excess = multiplier/weight.
  EXPECT_LE(highest, 0.6 + 1e-3 + 0.01);
  EXPECT_GT(e.cost, 0.75);
}

TEST(Extremal, RefusesWhatCannotBeMeant) {
  ControlTask task = rest_to_rest(2);
  task.begin.pop_back();
  EXPECT_THROW((void)mass(task), std::invalid_argument);
  EXPECT_THROW((void)mass(rest_to_rest(-1)), std::invalid_argument);
  task = rest_to_rest(2);
  task.waypoints = {{2.5, 0, 1}};
  EXPECT_THROW((void)mass(task), std::invalid_argument);
  task.waypoints = {{1, 0, 1}, {1, 0, 2}};  // the same component twice, with two values
  EXPECT_THROW((void)mass(task), std::invalid_argument);
  task = rest_to_rest(2);
  task.constraints.control_limit = -1;
  EXPECT_THROW((void)mass(task), std::invalid_argument);
  EXPECT_THROW((void)control_bound_path(0, 1), std::invalid_argument);
  EXPECT_THROW((void)state_bound_path({}, 0.5), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::bvp::extremal_test

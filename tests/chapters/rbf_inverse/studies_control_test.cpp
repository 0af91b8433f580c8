/// Basis of the chapter's figures and tables on optimal control.
#include <gtest/gtest.h>

#include <cmath>

#include "chapters/rbf_inverse/control/duffing_runs.hpp"
#include "chapters/rbf_inverse/control/shooting_methods.hpp"
#include "nlmech/bvp/solve.hpp"

namespace nlmech::chapters::rbf_inverse::studies_control_test {
namespace {

using bvp::DuffingCase;

/// An initial guess near the cheapest extremal: the trajectory of its initial values with 16 digits.
bvp::Start start_near(const KnownExtremal& known) {
  const double T = known.final_time;
  const bvp::ExtremalProblem problem = duffing_problem(printed_settings(known.which, T));
  const Eigen::VectorXd z = Eigen::Map<const Eigen::Vector4d>(known.first.data());
  std::vector<double> times;
  for (int k = 0; k <= 400; ++k) times.push_back(T * k / 400.);
  const Eigen::MatrixXd states = integrate_at(problem, z, Eigen::VectorXd(), times).states;
  return {.states = [states, T](double t, Eigen::VectorXd& x) {
    x = states.col(std::lround(t / T * 400));  // the nearest node in time suffices
  }};
}

// Seven cases at three final times against an independent Taylor method in 40 digits.
TEST(KnownExtremals, AreExtremals) {
  EXPECT_EQ(known_extremals().size(), 7 * final_times.size());
  for (const KnownExtremal& known : known_extremals()) {
    const bvp::ExtremalProblem problem = duffing_problem(printed_settings(known.which, known.final_time));
    const bvp::Extremal e = solve_extremal(problem, start_near(known));
    ASSERT_TRUE(e.solution.status.ok()) << to_string(known.which) << e.solution.status.text();
    EXPECT_NEAR(e.cost, known.cost, 1e-9 * known.cost) << to_string(known.which);
    for (Eigen::Index i = 0; i < 4; ++i) {
      const double value = known.first[static_cast<std::size_t>(i)];
      EXPECT_NEAR(e.solution.first()[i], value, 1e-10 * std::max(1.0, std::abs(value)));
    }
    for (Eigen::Index i = 0; i < 2; ++i)
      EXPECT_NEAR(e.solution.last()[i], known.last[static_cast<std::size_t>(i)], 1e-9);
    EXPECT_LE(e.miss, 1e-9);
  }
}

// The polynomial limit resolves the free case with 40 nodes, the printed shape gives five digits: recorded
// are 5e-13 and 3.2e-5.
TEST(GlobalVariants, PrintedShapeLosesDigits) {
  const KnownExtremal& known = known_extremal(DuffingCase::free);
  const bvp::ExtremalProblem problem = duffing_problem(printed_settings(known.which, 2));
  std::vector<double> worst;
  for (const GlobalVariant& v : global_variants()) {
    const bvp::GlobalResult r = solve_global(
        problem,
        {.relative_shape = v.relative_shape, .derivative = v.derivative, .rows = printed_rows(problem)},
        start_near(known));
    ASSERT_TRUE(r.report.status.ok()) << v.name << r.report.status.text();
    const NodeErrors e = node_errors(r);
    worst.push_back(std::max(e.states, e.costates));
  }
  EXPECT_GT(worst[0], 1e-6);
  EXPECT_LT(worst[0], 1e-3);
  EXPECT_LT(worst[1], 1e-5);
  EXPECT_GT(worst[2], 1e-6);  // the error is due to the shape, not to rounding
  EXPECT_LT(worst[3], 1e-11);
}

TEST(NodeErrors, NothingIntegratedIsNaN) {
  const NodeErrors e = node_errors({});
  EXPECT_TRUE(std::isnan(e.states));
  EXPECT_TRUE(std::isnan(e.costates));
}

// The same co-states by an independent method.
TEST(MultipleShooting, FindsTheKnownCostates) {
  if (!multiple_shooting_available()) GTEST_SKIP() << "no CVODE in this build";
  const KnownExtremal& known = known_extremal(DuffingCase::fixed);
  const bvp::ExtremalProblem problem = duffing_problem(printed_settings(known.which, 2));
  const ShootingResult shot = shoot(problem, start_near(known), {.tolerance = 1e-10});
  ASSERT_TRUE(shot.status.ok()) << shot.status.text();
  // Each of some hundred steps may have an error of the tolerance, which the problem amplifies by up to 100.
  EXPECT_NEAR(shot.first[2], known.first[2], 1e-6);
  EXPECT_NEAR(shot.first[3], known.first[3], 1e-6);
  EXPECT_GT(shot.newton, 0);
}

/// The fixed case from zeros.
ShootingResult shoot_from_zeros(double beta, double final_time, const SingleShooting& method = {}) {
  bvp::DuffingSettings settings = printed_settings(DuffingCase::fixed, final_time);
  settings.beta = beta;
  return shoot_once(duffing_problem(settings), Eigen::VectorXd::Zero(4), method);
}

// Without beta, lambda2 = a cos t + b sin t, and x1 = -(a t sin t + b (sin t - t cos t))/2 from rest.
TEST(SingleShooting, LinearOscillatorInClosedForm) {
  const double T = 2, s = std::sin(T), c = std::cos(T);
  Eigen::Matrix2d m;  // of (a, b) to (x1, x2) at T
  m << -T * s / 2, -(s - T * c) / 2, -(s + T * c) / 2, -T * s / 2;
  const Eigen::Vector2d ab = m.inverse() * Eigen::Vector2d(5, 2);
  const ShootingResult shot = shoot_from_zeros(0, T);
  ASSERT_TRUE(shot.status.ok()) << shot.status.text();
  // ode45 at 1e-8 in some hundred steps; co-states of order 10.
  EXPECT_NEAR(shot.first[2], -ab[1], 1e-6);
  EXPECT_NEAR(shot.first[3], ab[0], 1e-6);
}

TEST(SingleShooting, RootIsConfirmedByAnotherIntegrator) {
  const ShootingResult shot = shoot_from_zeros(0.9, 1);
  ASSERT_TRUE(shot.status.ok()) << shot.status.text();
  const bvp::ExtremalProblem problem = duffing_problem(printed_settings(DuffingCase::fixed, 1));
  const Eigen::MatrixXd integrated =
      integrate_at(problem, shot.first, Eigen::VectorXd(), std::array{0.0, 1.0}).states;
  EXPECT_NEAR(integrated(0, 1), 5, 1e-5);  // the end changes by some tens of the co-states' 1e-7
  EXPECT_NEAR(integrated(1, 1), 2, 1e-5);
  EXPECT_GE(shot.reach, shot.first.norm());
}

TEST(SingleShooting, CutOffIsNoRoot) {
  const ShootingResult shot = shoot_from_zeros(0.9, 1, {.iterations = 2});
  EXPECT_FALSE(shot.status.ok());
  EXPECT_FALSE(shot.status.text().empty());
}

// The guesses are equal on every machine: the first numbers of the engine by its definition.
TEST(RandomGuess, ConstantOrIndependent) {
  Eigen::VectorXd a(4), b(4);
  random_guess(1, 2).states(0, a);
  random_guess(1, 2).states(1.3, b);
  EXPECT_EQ(a, b);
  EXPECT_LE(a.cwiseAbs().maxCoeff(), 5);
  random_guess(0, 2).states(0, a);
  random_guess(0, 2).states(2, b);
  EXPECT_NE(a, b);
  EXPECT_LE(b.cwiseAbs().maxCoeff(), 1);
}

}  // namespace
}  // namespace nlmech::chapters::rbf_inverse::studies_control_test

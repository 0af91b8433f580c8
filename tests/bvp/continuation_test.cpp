#include "nlmech/bvp/continuation.hpp"

#include <gtest/gtest.h>

#include "nlmech/bvp/optimal_control/duffing.hpp"
#include "tests/bvp/problems.hpp"

namespace nlmech::bvp::continuation_test {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

/// Bratu's problem with mu as last parameter.
struct BratuFamily {
  static constexpr int states = 2, parameters = 1;
  [[nodiscard]] std::vector<double> points() const { return {0, 1}; }
  template <class T>
  void rhs(const T& /*t*/, const Vector<T, 2>& x, const Vector<T, 1>& p, Vector<T, 2>& f) const {
    using std::exp;
    f[0] = x[1];
    f[1] = -p[0] * exp(x[0]);
  }
  template <class T>
  void conditions(const Matrix<T, 2, Eigen::Dynamic>& ends, const Vector<T, 1>& /*p*/,
                  Vector<T, Eigen::Dynamic>& r) const {
    r[0] = ends(0, 0);
    r[1] = ends(0, 1);
  }
};

/// One condition fewer than solve() asks for.
class Family final : public Problem {
 public:
  int states() const override { return 2; }
  int parameters() const override { return 1; }
  int condition_count() const override { return 2; }
  std::vector<double> points() const override { return {0, 1}; }
  void rhs(double t, const VectorXd& x, const VectorXd& p, VectorXd& f) const override {
    base_.rhs(t, x, p, f);
  }
  void jacobian(double t, const VectorXd& x, const VectorXd& p, Eigen::MatrixXd& by_state,
                Eigen::MatrixXd& by_parameter) const override {
    base_.jacobian(t, x, p, by_state, by_parameter);
  }
  void conditions(const Eigen::MatrixXd& ends, const VectorXd& p, VectorXd& r) const override {
    base_.conditions(ends, p, r);
  }
  void condition_jacobian(const Eigen::MatrixXd& ends, const VectorXd& p, Eigen::MatrixXd& by_ends,
                          Eigen::MatrixXd& by_parameter) const override {
    base_.condition_jacobian(ends, p, by_ends, by_parameter);
  }

 private:
  DualProblem<BratuFamily> base_{BratuFamily{}};
};

TEST(Continuation, PassesBratusFoldAndReachesTheUpperBranch) {
  const Start start = constant_start(Vector2d::Zero(), VectorXd::Constant(1, 1));
  const Branch branch = continue_branch(Family(), start, {.first_step = 0.1, .low = 0.5, .high = 10});
  ASSERT_TRUE(branch.status.ok()) << branch.status.text();
  ASSERT_EQ(branch.folds.size(), 1U);
  // theta = 4.7987145610 solves tanh(theta/4) theta/4 = 1; mu = theta^2/(2 cosh^2(theta/4)).
  const double theta = 4.79871456103, c = std::cosh(theta / 4);
  EXPECT_NEAR(branch.folds[0].parameter, theta * theta / (2 * c * c), 1e-6);
  const BranchPoint& last = branch.points.back();
  const double upper = tests::bratu_theta(last.parameter, true);
  EXPECT_NEAR(last.solution.at(0.5)[0], tests::bratu_exact(0.5, upper), 1e-7);
}

TEST(Continuation, EndsAtItsTarget) {
  const Start start = constant_start(Vector2d::Zero(), VectorXd::Constant(1, 1));
  const Branch branch = continue_branch(Family(), start, {.first_step = 0.1, .target = 2.5});
  ASSERT_TRUE(branch.status.ok()) << branch.status.text();
  EXPECT_EQ(branch.points.back().parameter, 2.5);
  EXPECT_NEAR(branch.points.back().solution.at(0.5)[0],
              tests::bratu_exact(0.5, tests::bratu_theta(2.5, false)), 1e-8);
}

TEST(Continuation, FindsTheFoldsOfTheDuffingProblem) {
  // Natural continuation with N up to 200 stopped at 1.756 (fixed, beta) and 2.677 (fixed, T);
  // pseudo-arclength with 64 nodes found T = 2.679.
  DuffingSettings settings;
  settings.which = DuffingCase::fixed;
  const Multistart m =
      duffing_extremals(settings, {.unforced = 0, .pumps = 2, .direct = 4, .random = 0}, {}, {});
  ASSERT_FALSE(m.found.empty());
  for (const auto& [what, fold] : {std::pair(Continued::parameter, 1.757), {Continued::final_time, 2.679}}) {
    settings.continued = what;
    const ExtremalProblem problem = duffing_problem(settings);
    Start start = start_from(m.found[0].extremal.solution);
    start.parameters = problem.own_parameters();
    const Branch branch = continue_branch(problem, start, {.first_step = 0.02, .points = 60, .folds = 1});
    ASSERT_EQ(branch.folds.size(), 1U) << branch.status.text();
    EXPECT_NEAR(branch.folds[0].parameter, fold, 3e-3);
    EXPECT_GE(branch.folds[0].parameter, fold - 1e-3);
  }
}

TEST(Continuation, BoundedDuffingMatchesShooting) {
  // |f| <= 15 of the fixed case at T = 2, d = 1e-4, polished by shooting with steps of 0.01.
  DuffingSettings settings;
  settings.which = DuffingCase::fixed;
  const ExtremalProblem problem = duffing_problem(settings);
  const Multistart m =
      duffing_extremals(settings, {.unforced = 0, .pumps = 2, .direct = 4, .random = 0}, {}, {});
  ASSERT_FALSE(m.found.empty());
  const Extremal e =
      tighten(problem, start_from(m.found[0].extremal.solution), control_bound_path(16.42, 15, 1e-4));
  ASSERT_TRUE(e.solution.status.ok()) << e.solution.status.text();
  EXPECT_NEAR(e.cost, 122.3004593, 1e-7);
  EXPECT_NEAR(e.solution.first()[2], -21.30021353, 1e-7);
  EXPECT_NEAR(e.solution.first()[3], 0.9462278952, 1e-7);
  EXPECT_LE(e.miss, 1e-9);
}

TEST(Continuation, RefusesWhatCannotBeMeant) {
  const Start start = constant_start(Vector2d::Zero(), VectorXd::Constant(1, 1));
  EXPECT_THROW((void)continue_branch(DualProblem(tests::Bratu{}), start), std::invalid_argument);
  EXPECT_THROW((void)continue_branch(Family(), start, {.first_step = 0}), std::invalid_argument);
  EXPECT_THROW((void)control_bound_path(0, 1), std::invalid_argument);
  EXPECT_THROW((void)state_bound_path({}, 0.5), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::bvp::continuation_test

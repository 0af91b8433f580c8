#include "nlmech/peers/algebraic/gsl_hybrid.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/algebraic/classics.hpp"

namespace nlmech::peers::gsl_hybrid_test {
namespace {

using namespace algebraic::classics;
using algebraic::DenseEquations;
using algebraic::Report;

class GslHybridSolver : public testing::Test {
 protected:
  void SetUp() override {
    if (gsl_hybrid_available()) return;
    DenseEquations equations = circle();
    VectorXd x = vector({2, 1});
    EXPECT_THROW(static_cast<void>(find_root(GslHybrid{}, equations, x)), std::logic_error);
    GTEST_SKIP() << "this build has no GSL";
  }
};

TEST_F(GslHybridSolver, FindsRoots) {
  const double far = std::sqrt(2 + std::sqrt(3.0));
  DenseEquations equations = circle();
  VectorXd x = vector({2, 1});
  const Report report = find_root(GslHybrid{}, equations, x);
  ASSERT_TRUE(report.status.ok()) << report.status.text();
  EXPECT_LE((x - vector({far, 1 / far})).norm(), 1e-10);  // |B^-1| = 0.6
  EXPECT_EQ(report.first, std::hypot(1, 1));
  EXPECT_LE(report.last, 1e-10);
  EXPECT_GT(report.statistics.right_hand_sides, report.statistics.jacobians);  // Broyden's updates
}

// More, Garbow and Hillstrom 1981, problem 2: a minimum of |F|^2 of 48.9842...
TEST_F(GslHybridSolver, EndsInAMinimumThatIsNoRoot) {
  DenseEquations equations = freudenstein_roth();
  VectorXd x = vector({0.5, -2});
  const Report report = find_root(GslHybrid{}, equations, x);
  EXPECT_EQ(report.status.outcome(), Outcome::not_converged);
  EXPECT_GE(report.last * report.last, 48.9842);
}

TEST_F(GslHybridSolver, FailuresBecomeStatus) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  DenseEquations no_root = scalar([](double v) { return 1 + v * v; }, [](double v) { return 2 * v; });
  VectorXd x = vector({3});
  EXPECT_FALSE(find_root(GslHybrid{}, no_root, x).status.ok());
  EXPECT_TRUE(x.allFinite());
  DenseEquations bad = scalar([=](double) { return nan; }, [](double) { return 1.0; });
  EXPECT_EQ(find_root(GslHybrid{}, bad, x).status.outcome(), Outcome::non_finite);
  DenseEquations bad_slope = scalar([](double v) { return v - 1; }, [=](double) { return nan; });
  EXPECT_EQ(find_root(GslHybrid{}, bad_slope, x).status.outcome(), Outcome::non_finite);
  DenseEquations equations = circle();
  x = vector({2, 1});
  EXPECT_EQ(find_root(GslHybrid{.iterations = 1}, equations, x).status.outcome(), Outcome::step_limit);
}

TEST_F(GslHybridSolver, ExceptionsPassAndOptionsAreChecked) {
  DenseEquations throwing(
      1, [](const VectorXd&, VectorXd&) { throw std::domain_error("thrown"); },
      [](const VectorXd&, MatrixXd&) {});
  VectorXd x = vector({1});
  EXPECT_THROW(static_cast<void>(find_root(GslHybrid{}, throwing, x)), std::domain_error);
  DenseEquations equations = circle();
  EXPECT_THROW(static_cast<void>(find_root(GslHybrid{}, equations, x)), std::invalid_argument);
  x = vector({2, 1});
  EXPECT_THROW(static_cast<void>(find_root(GslHybrid{.tolerance = 0}, equations, x)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(find_root(GslHybrid{.iterations = 0}, equations, x)), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::peers::gsl_hybrid_test

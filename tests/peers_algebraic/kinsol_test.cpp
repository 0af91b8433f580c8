#include "nlmech/peers/algebraic/kinsol.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/algebraic/classics.hpp"

namespace nlmech::peers::kinsol_test {
namespace {

using namespace algebraic::classics;
using algebraic::DenseEquations;
using algebraic::Iterate;
using algebraic::Report;

constexpr Kinsol both[] = {{.strategy = Kinsol::Strategy::none}, {.strategy = Kinsol::Strategy::line_search}};

class KinsolSolver : public testing::Test {
 protected:
  void SetUp() override {
    if (kinsol_available()) return;
    DenseEquations equations = circle();
    VectorXd x = vector({2, 1});
    EXPECT_THROW(static_cast<void>(find_root(Kinsol{}, equations, x)), std::logic_error);
    GTEST_SKIP() << "this build has no KINSOL";
  }
};

TEST_F(KinsolSolver, FindRootsDenseAndSparse) {
  const double far = std::sqrt(2 + std::sqrt(3.0));
  for (const Kinsol& method : both) {
    DenseEquations dense = circle();
    algebraic::classics::Sparse sparse(dense);
    VectorXd x = vector({2, 1}), y = x;
    const Report report = find_root(method, dense, x);
    ASSERT_TRUE(report.status.ok()) << report.status.text();
    EXPECT_LE((x - vector({far, 1 / far})).norm(),
              1.5e-10);  // tolerance on the larger of two residuals, |B^-1| = 0.6
    EXPECT_EQ(report.first, std::hypot(1, 1));
    EXPECT_LE(report.last, 1.5e-10);
    EXPECT_EQ(report.statistics.steps, report.statistics.jacobians);  // exact Newton iteration
    ASSERT_TRUE(find_root(method, sparse, y).status.ok());
    EXPECT_EQ(x, y);
  }
}

TEST_F(KinsolSolver, StartsFromZeroWithAFullStep) {
  // KINSOL's own bound on a step is a multiple of |x(0)|.
  DenseEquations equations = linear(MatrixXd::Identity(2, 2), vector({1e6, -1e6}));
  for (const Kinsol& method : both) {
    VectorXd x = VectorXd::Zero(2);
    const Report report = find_root(method, equations, x);
    ASSERT_TRUE(report.status.ok()) << report.status.text();
    EXPECT_EQ(report.statistics.steps, 1);
  }
}

// More, Garbow and Hillstrom 1981, problem 2: a minimum of |F|^2 of 48.9842...
TEST_F(KinsolSolver, LineSearchEndsInAMinimumThatIsNoRoot) {
  DenseEquations equations = freudenstein_roth();
  VectorXd x = vector({0.5, -2});
  const Report report = find_root(Kinsol{}, equations, x);
  EXPECT_FALSE(report.status.ok());
  EXPECT_GE(report.last * report.last, 48.9842);
  EXPECT_NE(report.status.sentence().find("kinsol"), std::string::npos);
}

TEST_F(KinsolSolver, FailuresBecomeStatus) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Kinsol& method : both) {
    DenseEquations no_root = scalar([](double v) { return 1 + v * v; }, [](double v) { return 2 * v; });
    VectorXd x = vector({3});
    EXPECT_FALSE(find_root(method, no_root, x).status.ok());
    EXPECT_TRUE(x.allFinite());
    DenseEquations bad = scalar([=](double) { return nan; }, [](double) { return 1.0; });
    EXPECT_EQ(find_root(method, bad, x).status.outcome(), Outcome::non_finite);
    DenseEquations bad_slope = scalar([](double v) { return v - 1; }, [=](double) { return nan; });
    EXPECT_EQ(find_root(method, bad_slope, x).status.outcome(), Outcome::non_finite);
    DenseEquations equations = circle();
    x = VectorXd::Zero(2);
    EXPECT_EQ(find_root(method, equations, x).status.outcome(), Outcome::singular_matrix);
    x = vector({2, 1});
    Kinsol few = method;
    few.iterations = 1;
    EXPECT_EQ(find_root(few, equations, x).status.outcome(), Outcome::step_limit);
    x = vector({2, 1});
    const auto stop = [](const Iterate& i) { return i.index < 2; };
    EXPECT_EQ(find_root(method, equations, x, stop).status.outcome(), Outcome::interrupted);
  }
}

TEST_F(KinsolSolver, ExceptionsPassAndOptionsAreChecked) {
  DenseEquations throwing(
      1, [](const VectorXd&, VectorXd&) { throw std::domain_error("thrown"); },
      [](const VectorXd&, MatrixXd&) {});
  VectorXd x = vector({1});
  EXPECT_THROW(static_cast<void>(find_root(Kinsol{}, throwing, x)), std::domain_error);
  DenseEquations equations = circle();
  EXPECT_THROW(static_cast<void>(find_root(Kinsol{}, equations, x)), std::invalid_argument);
  x = vector({2, 1});
  EXPECT_THROW(static_cast<void>(find_root(Kinsol{.tolerance = 0}, equations, x)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(find_root(Kinsol{.step_tolerance = -1}, equations, x)),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(find_root(Kinsol{.iterations = 0}, equations, x)), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::peers::kinsol_test

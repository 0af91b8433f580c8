/// Newton's method on workspaces and on equations.
#include "nlmech/algebraic/newton/newton.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "nlmech/algebraic/equations.hpp"
#include "tests/algebraic/classics.hpp"
#include "tests/thrown.hpp"

namespace nlmech::algebraic::newton_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Two = Workspace<Vector2d>;

constexpr double eps = std::numeric_limits<double>::epsilon();

// Circle x^2 + y^2 = 4 and hyperbola x y = 1 intersect at x^2 = 2 + sqrt(3).
const auto circle = [](const Vector2d& x, Vector2d& f) { f << x.squaredNorm() - 4, x[0] * x[1] - 1; };
const auto circle_derivative = [](const Vector2d& x, MatrixXd& j) { j << 2 * x[0], 2 * x[1], x[1], x[0]; };

TEST(Newton, FindsARegularRootToRoundingQuadraticallyAndCountsItsWork) {
  Vector2d x(2, 1);
  Two w(2);
  Statistics cost;
  ASSERT_EQ(solve(Newton{}, circle, circle_derivative, x, w, cost), Outcome::success);
  const double exact = std::sqrt(2 + std::sqrt(3.0));
  EXPECT_NEAR(x[0], exact, 4 * eps * exact);  // condition number below 2
  EXPECT_NEAR(x[1], 1 / exact, 4 * eps);
  // The initial error is 0.5: errors 0.5, 0.1, 1e-2, 1e-4, 1e-8, 1e-16, and one update that confirms it.
  EXPECT_LE(cost.newton_iterations, 6);
  EXPECT_EQ(cost.jacobians, cost.newton_iterations);
  EXPECT_EQ(cost.factorisations, cost.newton_iterations);
}

TEST(Newton, SingularDerivativeIsReported) {
  Vector2d x(0, 0);
  Two w(2);
  Statistics cost;
  EXPECT_EQ(solve(Newton{}, circle, circle_derivative, x, w, cost), Outcome::singular_matrix);
}

TEST(Newton, NonFiniteFunctionIsReported) {
  const auto bad = [](const Vector2d&, Vector2d& f) { f << 0, std::numeric_limits<double>::quiet_NaN(); };
  const auto infinite = [](const Vector2d&, Vector2d& f) { f << HUGE_VAL, 0; };
  Two w(2);
  Statistics cost;
  Vector2d x(2, 1);
  EXPECT_EQ(solve(Newton{}, bad, circle_derivative, x, w, cost), Outcome::non_finite);
  EXPECT_EQ(solve(DampedNewton{}, bad, circle_derivative, x, w, cost), Outcome::non_finite);
  EXPECT_EQ(solve(Newton{}, infinite, circle_derivative, x, w, cost), Outcome::non_finite);
  EXPECT_EQ(solve(DampedNewton{}, infinite, circle_derivative, x, w, cost), Outcome::non_finite);
}

using One = Eigen::Matrix<double, 1, 1>;

// Newton's iteration on atan diverges for |x| > 1.3917; with damping it converges from any start.
const auto arctangent = [](const One& x, One& f) { f[0] = std::atan(x[0]); };
const auto arctangent_derivative = [](const One& x, MatrixXd& j) { j(0, 0) = 1 / (1 + x[0] * x[0]); };

TEST(Newton, DivergenceIsReported) {
  One x(2);
  Workspace<One> w(1);
  Statistics cost;
  const Outcome outcome = solve(Newton{}, arctangent, arctangent_derivative, x, w, cost);
  EXPECT_TRUE(outcome == Outcome::newton_diverged || outcome == Outcome::singular_matrix ||
              outcome == Outcome::non_finite);
}

RC_GTEST_PROP(DampedNewton, ConvergesWhereNewtonDiverges, ()) {
  One x(*rc::gen::map(rc::gen::inRange(-100000, 100000), [](int k) { return k / 100.0; }));
  Workspace<One> w(1);
  Statistics cost;
  RC_ASSERT(solve(DampedNewton{}, arctangent, arctangent_derivative, x, w, cost) == Outcome::success);
  RC_ASSERT(std::abs(x[0]) <= 1e-12);  // tolerance on the update, at a root with slope 1
}

TEST(DampedNewton, NoRootIsNotConverged) {
  const auto f = [](const One& x, One& r) { r[0] = 1 + x[0] * x[0]; };
  const auto df = [](const One& x, MatrixXd& j) { j(0, 0) = 2 * x[0]; };
  One x(1);
  Workspace<One> w(1);
  Statistics cost;
  const Outcome outcome = solve(DampedNewton{}, f, df, x, w, cost);
  EXPECT_NE(outcome, Outcome::success);
}

TEST(Newton, NoiseEndsAnIterationThatCannotShrink) {
  // The residual has an error of 1e-9 that changes its sign in every call: updates remain at 1e-9.
  int calls = 0;
  const auto noisy = [&calls](const One& x, One& f) { f[0] = x[0] - 1 + (calls++ % 2 == 0 ? 1e-9 : -1e-9); };
  const auto slope = [](const One&, MatrixXd& j) { j(0, 0) = 1; };
  Workspace<One> w(1);
  Statistics cost;
  One x(3);
  EXPECT_EQ(solve(Newton{.tolerance = 1e-12}, noisy, slope, x, w, cost), Outcome::not_converged);
  x[0] = 3;
  EXPECT_EQ(solve(Newton{.tolerance = 1e-12, .noise = 1e-8}, noisy, slope, x, w, cost), Outcome::success);
  EXPECT_EQ(cost.fallbacks, 1);
  EXPECT_NEAR(x[0], 1, 2e-9);
}

using Eigen::VectorXd;

/// Equations that provide matrix-vector products only.
struct Products : Equations {
  [[nodiscard]] Eigen::Index size() const override { return 1; }
  void residual(const VectorXd& x, VectorXd& f) override { f = x; }
  void linearise(const VectorXd&) override {}
  void apply(const VectorXd& v, VectorXd& out) const override { out = v; }
  void apply_transposed(const VectorXd& v, VectorXd& out) const override { out = v; }
};

TEST(DenseEquations, ProductsAreThoseOfTheMatrix) {
  DenseEquations equations = classics::circle();
  VectorXd x(2), v(2), out(2);
  MatrixXd b(2, 2);
  x << 3, 5;
  v << 7, 11;
  equations.linearise(x);
  equations.matrix(b);
  EXPECT_EQ(b(0, 0), 6);
  equations.apply(v, out);  // (6 10; 5 3) (7, 11)
  EXPECT_EQ(out[0], 152);
  EXPECT_EQ(out[1], 68);
  equations.apply_transposed(v, out);
  EXPECT_EQ(out[0], 97);
  EXPECT_EQ(out[1], 103);
}

TEST(DenseEquations, RefusesWhatItCannotUse) {
  const auto f = [](const VectorXd&, VectorXd&) {};
  const auto d = [](const VectorXd&, MatrixXd&) {};
  EXPECT_THROW(DenseEquations(0, f, d), std::invalid_argument);
  EXPECT_THROW(DenseEquations(1, {}, d), std::invalid_argument);
  EXPECT_THROW(DenseEquations(1, f, {}), std::invalid_argument);
}

TEST(FindRoot, NewtonAndItsDampedFormFindTheRootAndReport) {
  const double exact = std::sqrt(2 + std::sqrt(3.0));
  const auto expect = [&](const auto& method) {
    DenseEquations equations = classics::circle();
    VectorXd x(2);
    x << 2, 1;
    std::int64_t seen = 0;
    const Report report = find_root(method, equations, x, [&](const Iterate& i) {
      EXPECT_EQ(i.index, seen++);
      return true;
    });
    ASSERT_TRUE(report.status.ok()) << report.status.text();
    EXPECT_NEAR(x[0], exact, 4 * eps * exact);  // condition number below 2
    EXPECT_EQ(report.first, std::hypot(1, 1));
    EXPECT_EQ(report.statistics.steps, report.statistics.newton_iterations);
    EXPECT_EQ(report.statistics.right_hand_sides, seen);
    EXPECT_EQ(report.statistics.jacobians, report.statistics.factorisations);
    EXPECT_LT(report.last, 1e-7);  // quadratic convergence: the last update, at most 1e-12, is of the size of
                                   // this residual squared
  };
  expect(Newton{});
  expect(DampedNewton{});
}

TEST(FindRoot, FailuresOfNewtonHaveTheirSentences) {
  DenseEquations equations = classics::circle();
  VectorXd x = VectorXd::Zero(2);
  const Report singular = find_root(Newton{}, equations, x);
  EXPECT_EQ(singular.status.outcome(), Outcome::singular_matrix);
  EXPECT_TRUE(tests::holds(singular.status.sentence(), "newton"));
  x << 2, 1;
  const Report few = find_root(Newton{.iterations = 2}, equations, x);
  EXPECT_FALSE(few.status.ok());
  EXPECT_TRUE(tests::holds(few.status.sentence(), "2 of 2"));
}

TEST(FindRoot, NewtonNeedsAMatrix) {
  Products equations;
  VectorXd x = VectorXd::Ones(1);
  EXPECT_THROW((void)find_root(Newton{}, equations, x), std::logic_error);
}

}  // namespace
}  // namespace nlmech::algebraic::newton_test

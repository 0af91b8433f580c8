#include "nlmech/algebraic/equations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace nlmech::algebraic::equations_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double eps = std::numeric_limits<double>::epsilon();

DenseEquations circle() {
  return {2, [](const VectorXd& x, VectorXd& f) { f << x.squaredNorm() - 4, x[0] * x[1] - 1; },
          [](const VectorXd& x, MatrixXd& b) { b << 2 * x[0], 2 * x[1], x[1], x[0]; }};
}

/// Equations that offer products only.
struct Products : Equations {
  [[nodiscard]] Eigen::Index size() const override { return 1; }
  void residual(const VectorXd& x, VectorXd& f) override { f = x; }
  void linearise(const VectorXd&) override {}
  void apply(const VectorXd& v, VectorXd& out) const override { out = v; }
  void apply_transposed(const VectorXd& v, VectorXd& out) const override { out = v; }
};

TEST(DenseEquations, ProductsAreThoseOfTheMatrix) {
  DenseEquations equations = circle();
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
    DenseEquations equations = circle();
    VectorXd x(2);
    x << 2, 1;
    std::int64_t seen = 0;
    const Report report = find_root(method, equations, x, [&](const Iterate& i) {
      EXPECT_EQ(i.index, seen++);
      return true;
    });
    ASSERT_TRUE(report.status.ok()) << report.status.text();
    EXPECT_NEAR(x[0], exact, 4 * eps * exact);  // condition of this root is below 2
    EXPECT_EQ(report.first, std::hypot(1, 1));
    EXPECT_EQ(report.statistics.steps, report.statistics.newton_iterations);
    EXPECT_EQ(report.statistics.right_hand_sides, seen);
    EXPECT_EQ(report.statistics.jacobians, report.statistics.factorisations);
    EXPECT_LT(report.last, 1e-7);  // quadratic: the last update, 1e-12 or less, was the square of this
  };
  expect(Newton{});
  expect(DampedNewton{});
}

TEST(FindRoot, FailuresOfNewtonHaveTheirSentences) {
  DenseEquations equations = circle();
  VectorXd x = VectorXd::Zero(2);
  const Report singular = find_root(Newton{}, equations, x);
  EXPECT_EQ(singular.status.outcome(), Outcome::singular_matrix);
  EXPECT_NE(singular.status.sentence().find("newton"), std::string::npos);
  x << 2, 1;
  const Report few = find_root(Newton{.iterations = 2}, equations, x);
  EXPECT_FALSE(few.status.ok());
  EXPECT_NE(few.status.sentence().find("2 of 2"), std::string::npos) << few.status.text();
  x << 2, 1;
  const Report stopped = find_root(Newton{}, equations, x, [](const Iterate& i) { return i.index < 1; });
  EXPECT_EQ(stopped.status.outcome(), Outcome::interrupted);
  x << std::numeric_limits<double>::infinity(), 1;
  EXPECT_EQ(find_root(Newton{}, equations, x).status.outcome(), Outcome::non_finite);
}

TEST(FindRoot, NewtonNeedsAMatrix) {
  Products equations;
  VectorXd x = VectorXd::Ones(1);
  EXPECT_THROW(static_cast<void>(find_root(Newton{}, equations, x)), std::logic_error);
}

}  // namespace
}  // namespace nlmech::algebraic::equations_test

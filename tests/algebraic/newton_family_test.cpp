// Properties of single methods: Broyden, continuous Newton, least squares, Levenberg-Marquardt, dogleg and
// similar ones.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/SVD>
#include <limits>
#include <numeric>

#include "nlmech/algebraic/homotopies/continuous_newton.hpp"
#include "nlmech/algebraic/newton/broyden.hpp"
#include "nlmech/algebraic/newton/descent.hpp"
#include "nlmech/algebraic/newton/least_squares.hpp"
#include "tests/algebraic/classics.hpp"

namespace nlmech::algebraic::newton_family_test {
namespace {

using namespace classics;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// e+ = F''/(2 F') e^2 (1 + O(e)); at the root 2 of x^3 - 8 the constant is 1/2.
TEST(Newton, ErrorIsSquaredByTheConstantOfTheory) {
  DenseEquations equations = cube();
  const std::vector<VectorXd> path = iterates(Newton{}, equations, vector({2.1}));
  ASSERT_GE(path.size(), 4U);
  for (std::size_t k = 0; k < 2; ++k) {
    const double e = path[k][0] - 2, next = path[k + 1][0] - 2;
    // Tolerance: the next term, a few e, and the rounding of x.
    EXPECT_NEAR(next / (e * e), 0.5, e + 8 * eps / (e * e));
  }
}

// In one variable Broyden's method is the secant method.
TEST(Broyden, IsTheSecantMethodInOneVariable) {
  DenseEquations equations = cube();
  const std::vector<VectorXd> path = iterates(Broyden{}, equations, vector({2.5}));
  const auto f = [](double x) { return x * x * x - 8; };
  ASSERT_GE(path.size(), 6U);
  EXPECT_NEAR(path[1][0], 2.5 - f(2.5) / (3 * 2.5 * 2.5), 4 * eps * 2.5);
  for (std::size_t k = 1; k + 2 < path.size(); ++k) {
    const double a = path[k - 1][0], b = path[k][0];
    const double secant = b - f(b) * (b - a) / (f(b) - f(a));
    // Rounding error of F: 8 eps 8, over its slope of 12 and the difference of a and b.
    EXPECT_NEAR(path[k + 1][0], secant, 16 * eps * (1 + std::abs(f(b) / (f(b) - f(a)))) + 1e-15);
  }
}

TEST(Broyden, ConvergesSuperlinearlyOnTheFactorsOfItsStart) {
  DenseEquations equations = broyden_tridiagonal(10);
  VectorXd x = VectorXd::Constant(10, -1), root = x;
  ASSERT_TRUE(find_root(Newton{}, equations, root).status.ok());
  const std::vector<VectorXd> path = iterates(Broyden{.tolerance = 1e-13}, equations, x);
  const auto error = [&](std::size_t back) { return (path[path.size() - 1 - back] - root).norm(); };
  // Superlinear convergence: the mean factor of four late steps is far below that of the first four.
  const double early = std::pow(error(path.size() - 5) / error(path.size() - 1), 0.25);
  const double late = std::pow(error(1) / error(5), 0.25);
  EXPECT_LT(late, 0.6 * early);
  const Report report = find_root(Broyden{}, equations, x);
  EXPECT_EQ(report.statistics.factorisations, 1);
}

TEST(Broyden, StartsAnewWhenItsMemoryIsFull) {
  DenseEquations equations = broyden_tridiagonal(10);
  VectorXd x = VectorXd::Constant(10, -1);
  const Report report = find_root(Broyden{.memory = 3}, equations, x);
  ASSERT_TRUE(report.status.ok()) << report.status.text();
  EXPECT_GT(report.statistics.factorisations, 1);
  EXPECT_LE(report.statistics.steps, 4 * report.statistics.factorisations);
}

// Eq. 2.3 has the exact solution F(x(t)) = F(x(0)) e^-t.
TEST(ContinuousNewton, FlowFollowsTheExactOneToFirstOrder) {
  double errors[2];
  for (int k = 0; k < 2; ++k) {
    DenseEquations equations = cube();
    VectorXd x = vector({3});
    const int steps = 200 << k;
    const Report report =
        find_root(ContinuousNewton{.step = 2.0 / steps, .tolerance = 0, .iterations = steps}, equations, x);
    EXPECT_EQ(report.status.outcome(), Outcome::step_limit);
    EXPECT_NEAR(report.time, 2, 1e-12);
    errors[k] = std::abs(x[0] - std::cbrt(8 + 19 * std::exp(-2.0)));
  }
  EXPECT_NEAR(errors[0] / errors[1], 2, 0.05);  // next term: dt = 0.01 times a constant below 5
}

TEST(ContinuousNewton, StepOfOneIsNewton) {
  DenseEquations equations = circle();
  const std::vector<VectorXd> flow = iterates(ContinuousNewton{.step = 1}, equations, vector({2, 1}));
  const std::vector<VectorXd> newton = iterates(Newton{}, equations, vector({2, 1}));
  ASSERT_LE(flow.size(), newton.size());
  for (std::size_t k = 0; k < flow.size(); ++k) {
    EXPECT_EQ(flow[k], newton[k]);
  }
}

// For F = D x Euler's method gives x_k = prod (1 - h nu d/q(t_j)) x_0.
RC_GTEST_PROP(FictitiousTime, IsEulersProductForDiagonalEquations, ()) {
  const double d = *rc::gen::inRange(1, 50) / 10.0, power = *rc::gen::inRange(0, 11) / 10.0;
  const double h = *rc::gen::inRange(1, 20) / 100.0;
  DenseEquations equations = scalar([=](double x) { return d * x; }, [](double) { return nan; });
  VectorXd x = vector({1});
  static_cast<void>(
      find_root(FictitiousTime{.power = power, .step = h, .tolerance = 0, .iterations = 20}, equations, x));
  double expected = 1;
  for (int j = 0; j < 20; ++j) expected *= 1 - h * d / std::pow(1 + h * j, power);
  RC_ASSERT(std::abs(x[0] - expected) <=
            200 * eps);  // twenty factors below 1 with a few rounding errors each
}

TEST(FictitiousTime, SignOfNuDecides) {
  DenseEquations equations = scalar([](double x) { return 1 - x; }, [](double) { return -1.0; });
  VectorXd x = vector({0});
  EXPECT_FALSE(find_root(FictitiousTime{.iterations = 2000}, equations, x).status.ok());
  x = vector({0});
  EXPECT_TRUE(find_root(FictitiousTime{.nu = -1}, equations, x).status.ok());
}

// The shortest minimiser of |F + B d| is the step of the pseudo-inverse.
RC_GTEST_PROP(LeastSquares, StepOfASingularMatrixIsTheShortest, ()) {
  const auto n = *rc::gen::inRange<Eigen::Index>(2, 6);
  const auto rank = *rc::gen::inRange<Eigen::Index>(1, n);
  const MatrixXd b = random_matrix(n, rank) * random_matrix(rank, n);
  const VectorXd f = random_vector(n);
  const Eigen::JacobiSVD<MatrixXd> svd(b, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const VectorXd& s = svd.singularValues();
  RC_PRE(s[rank - 1] > 1e-3 * s[0]);
  VectorXd expected = VectorXd::Zero(n);
  for (Eigen::Index k = 0; k < rank; ++k)
    expected -= svd.matrixV().col(k) * svd.matrixU().col(k).dot(f) / s[k];
  RC_PRE((b * expected).norm() > 1e-3 * f.norm());
  for (const bool is_sparse : {false, true}) {
    DenseEquations dense(
        n, [&](const VectorXd& x, VectorXd& out) { out = f + b * x; },
        [&](const VectorXd&, MatrixXd& out) { out = b; });
    Sparse sparse(dense);
    VectorXd x = VectorXd::Zero(n);
    static_cast<void>(find_root(LeastSquares{.rank = 1e-10, .iterations = 1},
                                is_sparse ? static_cast<Equations&>(sparse) : dense, x));
    // The condition number is below 1e3 within the range; its square applies to the residual outside of it.
    RC_ASSERT((x - expected).norm() <= 1e7 * eps * (expected.norm() + f.norm() / s[rank - 1]));
  }
}

TEST(LeastSquares, IsNewtonWhereTheMatrixIsRegular) {
  DenseEquations equations = circle();
  const std::vector<VectorXd> flow = iterates(LeastSquares{}, equations, vector({2, 1}));
  const std::vector<VectorXd> newton = iterates(Newton{}, equations, vector({2, 1}));
  ASSERT_LE(flow.size(), newton.size());
  for (std::size_t k = 0; k < flow.size(); ++k) {
    EXPECT_LE((flow[k] - newton[k]).norm(), 50 * eps);  // |B^-1| |B| = 2 times a few rounding errors a step
  }
}

// More, Garbow and Hillstrom 1981, problem 2: 48.9842... at (11.41..., -0.8968...).
TEST(ResidualDescent, EndsAtThePublishedMinimumThatIsNoRoot) {
  const auto expect = [](const auto& method) {
    DenseEquations equations = freudenstein_roth();
    VectorXd x = vector({0.5, -2});
    const Report report = find_root(method, equations, x);
    EXPECT_EQ(report.status.outcome(), Outcome::not_converged) << report.status.text();
    EXPECT_GE(report.last * report.last, 48.9842);  // printed digits, truncated
    EXPECT_LE(report.last * report.last, 48.9843);
    EXPECT_NEAR(x[0], 11.41, 5e-3);
    EXPECT_NEAR(x[1], -0.8968, 5e-5);
  };
  expect(LevenbergMarquardt{});
  expect(Dogleg{});
  expect(SteepestDescent{});
  expect(SteepestDescent{.length = SteepestDescent::Length::cauchy});
}

TEST(ResidualDescent, NormFallsAtEveryStep) {
  const auto report_of = [](const auto& method) {
    DenseEquations equations = rosenbrock();
    VectorXd x = vector({-1.2, 1});
    double before = HUGE_VAL;
    return find_root(method, equations, x, [&](const Iterate& i) {
      EXPECT_LT(i.norm, before);
      before = i.norm;
      return true;
    });
  };
  (void)report_of(LevenbergMarquardt{});
  (void)report_of(Dogleg{});
  (void)report_of(SteepestDescent{.length = SteepestDescent::Length::cauchy, .iterations = 500});
}

RC_GTEST_PROP(Dogleg, IsNewtonWithinItsRadius, ()) {
  const auto n = *rc::gen::inRange<Eigen::Index>(1, 6);
  const MatrixXd a = random_matrix(n, n);
  const Eigen::JacobiSVD<MatrixXd> svd(a);
  RC_PRE(svd.singularValues()[n - 1] > 1e-3 * svd.singularValues()[0]);
  const VectorXd root = random_vector(n);
  DenseEquations equations = linear(a, root);
  VectorXd x = VectorXd::Zero(n);
  const Report report = find_root(Dogleg{.radius = 1e3, .tolerance = 1e-9}, equations, x);
  RC_ASSERT(report.status.ok());
  RC_ASSERT(report.statistics.steps <= 1);
  RC_ASSERT((x - root).norm() <=
            1e3 * 100 * eps * root.norm());  // condition number times n^2 rounding errors
}

TEST(Dogleg, NoStepIsLongerThanTheRadius) {
  DenseEquations equations = rosenbrock();
  const std::vector<VectorXd> path = iterates(Dogleg{.radius = 0.01}, equations, vector({-1.2, 1}));
  double radius = 0.01;
  for (std::size_t k = 1; k < path.size(); ++k, radius *= 2) {  // it at most doubles
    EXPECT_LE((path[k] - path[k - 1]).norm(), radius * (1 + 4 * eps));
  }
}

// For two unknowns span{F, B^T F} is the plane, unless the two are parallel.
RC_GTEST_PROP(OptimalIterative, EndsTwoLinearEquationsInOneStep, ()) {
  const MatrixXd a = random_matrix(2, 2);
  const VectorXd root = random_vector(2), f = a * root, g = a.transpose() * f;
  const Eigen::JacobiSVD<MatrixXd> svd(a);
  const double condition = svd.singularValues()[0] / svd.singularValues()[1];
  const double area = std::abs(f[0] * g[1] - f[1] * g[0]);
  RC_PRE(condition < 100 && area > 0.01 * f.norm() * g.norm());
  DenseEquations equations = linear(a, root);
  VectorXd x = VectorXd::Zero(2);
  static_cast<void>(find_root(OptimalIterative{.gamma = 0, .tolerance = 0, .iterations = 1}, equations, x));
  // The sine of the angle between B F and B B^T F is a divisor twice: its rounding error enters their
  // difference and u.
  const double sine = std::abs(a.determinant()) * area / ((a * f).norm() * (a * g).norm());
  RC_ASSERT((x - root).norm() <= 16 * eps * condition / (sine * sine) * root.norm());
}

RC_GTEST_PROP(OptimalIterative, IsDampedNewtonInOneVariable, ()) {
  const double gamma = *rc::gen::inRange(0, 100) / 100.0, start = *rc::gen::inRange(1, 500) / 100.0;
  DenseEquations equations = cube();
  VectorXd x = vector({start});
  static_cast<void>(
      find_root(OptimalIterative{.gamma = gamma, .tolerance = 1e-300, .iterations = 1}, equations, x));
  const double step = (1 - gamma) * (start * start * start - 8) / (3 * start * start);
  RC_ASSERT(std::abs(x[0] - (start - step)) <= 16 * eps * (start + std::abs(step)));
}

// For linear equations no other vector of the span gives a smaller residual.
RC_GTEST_PROP(OptimalIterative, FindsTheLeastResidualOfTheSpan, ()) {
  const auto n = *rc::gen::inRange<Eigen::Index>(3, 6);
  const MatrixXd a = random_matrix(n, n);
  const VectorXd root = random_vector(n), f = a * root;
  RC_PRE(f.norm() > 0.1);
  DenseEquations equations = linear(a, root);
  VectorXd x = VectorXd::Zero(n);
  const Report report =
      find_root(OptimalIterative{.gamma = 0, .tolerance = 0, .iterations = 1}, equations, x);
  RC_PRE(report.statistics.steps == 1);
  MatrixXd span(n, 2);
  span << a * f / f.norm(), a * a.transpose() * f / (a.transpose() * f).norm();
  const Eigen::JacobiSVD<MatrixXd> svd(span, Eigen::ComputeThinU | Eigen::ComputeThinV);
  RC_PRE(svd.singularValues()[1] > 1e-4 * svd.singularValues()[0]);
  const double least = (f - svd.matrixU() * (svd.matrixU().transpose() * f)).norm();
  RC_ASSERT(std::abs(report.last - least) <= 1e5 * eps * (f.norm() + a.norm() * x.norm()));
}

// Kantorovich: |F+| <= (k^2 - 1)/(k^2 + 1) |F| for Cauchy's step and linear F with condition number k.
RC_GTEST_PROP(SteepestDescent, CauchysStepKeepsKantorovichsBound, ()) {
  const auto n = *rc::gen::inRange<Eigen::Index>(2, 5);
  const MatrixXd a = random_matrix(n, n);
  const Eigen::JacobiSVD<MatrixXd> svd(a);
  const double k = svd.singularValues()[0] / svd.singularValues()[n - 1];
  RC_PRE(k < 30);
  const VectorXd root = random_vector(n);
  DenseEquations equations = linear(a, root);
  VectorXd x = VectorXd::Zero(n);
  double before = HUGE_VAL;
  const double bound = (k * k - 1) / (k * k + 1);
  const SteepestDescent method = {
      .length = SteepestDescent::Length::cauchy, .tolerance = 1e-6, .iterations = 50};
  static_cast<void>(find_root(method, equations, x, [&](const Iterate& i) {
    RC_ASSERT(i.norm <= bound * before * (1 + 1e-9) + 1e-13);  // rounding errors of A x, which is below 100
    before = i.norm;
    return true;
  }));
}

TEST(SteepestDescent, BarzilaiAndBorweinNeedFewerSteps) {
  MatrixXd a = MatrixXd::Zero(3, 3);
  a.diagonal() << 1, 5, 20;
  std::int64_t steps[2];
  for (int k = 0; k < 2; ++k) {
    DenseEquations equations = linear(a, vector({1, 1, 1}));
    VectorXd x = VectorXd::Zero(3);
    const Report report =
        find_root(SteepestDescent{.length = static_cast<SteepestDescent::Length>(k)}, equations, x);
    ASSERT_TRUE(report.status.ok());
    steps[k] = report.statistics.steps;
  }
  EXPECT_LT(10 * steps[1], steps[0]);
}

TEST(NewtonFamily, OptionsOutOfRangeAreRefused) {
  expect_refused(ContinuousNewton{.step = 0});
  expect_refused(ContinuousNewton{.tolerance = nan});
  expect_refused(FictitiousTime{.nu = 0});
  expect_refused(FictitiousTime{.power = 1.5});
  expect_refused(FictitiousTime{.step = nan});
  expect_refused(Broyden{.memory = 0});
  expect_refused(Broyden{.growth = 0.5});
  expect_refused(Broyden{.iterations = -1});
  expect_refused(LeastSquares{.rank = 0});
  expect_refused(LevenbergMarquardt{.damping = 0});
  expect_refused(Dogleg{.radius = 0});
  expect_refused(Dogleg{.radius = nan});
  expect_refused(OptimalIterative{.gamma = 1});
  expect_refused(SteepestDescent{.tolerance = -1});
}

}  // namespace
}  // namespace nlmech::algebraic::newton_family_test

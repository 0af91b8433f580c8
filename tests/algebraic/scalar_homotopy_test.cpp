#include "nlmech/algebraic/homotopies/scalar_homotopy.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>
#include <limits>
#include <vector>

namespace nlmech::algebraic::scalar_homotopy_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Function = ScalarHomotopy::Function;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr std::array both = {Function::fixed_point, Function::newton};

VectorXd vector(std::initializer_list<double> list) {
  VectorXd v(static_cast<Eigen::Index>(list.size()));
  std::copy(list.begin(), list.end(), v.begin());
  return v;
}

/// The circle x^2 + y^2 = 4 meets the hyperbola x y = 1 at x^2 = 2 + sqrt(3).
DenseEquations circle() {
  return {2, [](const VectorXd& x, VectorXd& f) { f << x.squaredNorm() - 4, x[0] * x[1] - 1; },
          [](const VectorXd& x, MatrixXd& b) { b << 2 * x[0], 2 * x[1], x[1], x[0]; }};
}

/// A x = b for a given root.
DenseEquations linear(const MatrixXd& a, const VectorXd& root) {
  return {a.rows(), [=](const VectorXd& x, VectorXd& f) { f = a * (x - root); },
          [=](const VectorXd&, MatrixXd& b) { b = a; }};
}

/// One equation.
template <class F, class D>
DenseEquations scalar(F f, D d) {
  return {1, [f](const VectorXd& x, VectorXd& r) { r[0] = f(x[0]); },
          [d](const VectorXd& x, MatrixXd& b) { b(0, 0) = d(x[0]); }};
}

VectorXd random_vector(Eigen::Index n) {
  VectorXd v(n);
  for (double& x : v) x = *rc::gen::map(rc::gen::inRange(-1000, 1001), [](int k) { return k / 250.0; });
  return v;
}

MatrixXd random_rotation(Eigen::Index n) {
  MatrixXd m(n, n);
  for (Eigen::Index k = 0; k < n; ++k) m.col(k) = random_vector(n);
  return Eigen::HouseholderQR<MatrixXd>(m).householderQ();
}

/// The iterates of a few steps.
std::vector<VectorXd> path(const ScalarHomotopy& method, Equations& equations, VectorXd x) {
  std::vector<VectorXd> all;
  static_cast<void>(find_root(method, equations, x, [&](const Iterate& i) {
    all.push_back(i.x);
    return true;
  }));
  return all;
}

TEST(ScalarHomotopy, FindsKnownRoots) {
  const double far = std::sqrt(2 + std::sqrt(3.0));
  const VectorXd root = vector({far, 1 / far});
  MatrixXd b(2, 2);
  b << 2 * root[0], 2 * root[1], root[1], root[0];
  const double least = Eigen::JacobiSVD<MatrixXd>(b).singularValues()[1];
  for (const Function function : both) {
    for (const double turn : {0.0, 0.1}) {
      for (const double step : {0.3, 1.0}) {
        DenseEquations equations = circle();
        VectorXd x = vector({2, 1});
        const ScalarHomotopy method = {.function = function, .step = step, .turn = turn};
        const Report report = find_root(method, equations, x);
        ASSERT_TRUE(report.status.ok()) << report.status.text();
        EXPECT_LE(report.last, method.tolerance);
        // |B^-1| |F|; the curvature of F is nothing at this distance.
        EXPECT_LE((x - root).norm(), 1.01 * method.tolerance / least);
      }
    }
  }
}

TEST(ScalarHomotopy, ReportsWhatItDid) {
  for (const double turn : {0.0, 0.1}) {
    DenseEquations equations = circle();
    VectorXd x = vector({2, 1});
    std::int64_t seen = 0;
    double least = HUGE_VAL, last = 0, time = -1;
    const Report report = find_root(ScalarHomotopy{.turn = turn}, equations, x, [&](const Iterate& i) {
      EXPECT_EQ(i.index, seen++);
      EXPECT_GT(i.time, time);
      EXPECT_EQ(i.norm, i.f.norm());
      time = i.time;
      least = std::min(least, last = i.norm);
      return true;
    });
    ASSERT_TRUE(report.status.ok());
    EXPECT_EQ(report.first, std::hypot(1, 1));  // F(2, 1) = (1, 1)
    EXPECT_EQ(report.least, least);
    EXPECT_EQ(report.last, last);
    EXPECT_EQ(report.time, time);
    const Statistics& s = report.statistics;
    EXPECT_EQ(s.steps + 1, seen);
    EXPECT_EQ(s.right_hand_sides, s.steps + s.rejected + 1);
    EXPECT_LE(s.jacobians, s.right_hand_sides);  // none at a root
    EXPECT_EQ(s.factorisations, 0);
    EXPECT_EQ(s.newton_iterations, 0);
  }
}

// Eqs 2.15 and 2.16 with one unknown: dx/dt = -F/(2 F'), and so Euler's step is Newton's times dt/2.
RC_GTEST_PROP(ScalarHomotopy, FirstStepInOneVariableIsADampedNewtonStep, ()) {
  const double start = *rc::gen::map(rc::gen::inRange(-300, 300), [](int k) { return k / 100.0 + 0.005; });
  const double dt = *rc::gen::map(rc::gen::inRange(1, 200), [](int k) { return k / 100.0; });
  const auto f = [](double x) { return x * x * x + x - 3; };
  const auto d = [](double x) { return 3 * x * x + 1; };
  for (const Function function : both) {
    DenseEquations equations = scalar(f, d);
    VectorXd x = vector({start});
    const Report report =
        find_root({.function = function, .step = dt, .tolerance = 0, .steps = 1}, equations, x);
    RC_ASSERT(report.status.outcome() == Outcome::step_limit);
    const double step = -dt / 2 * f(start) / d(start);
    // Eight roundings or so, each of the step or of the sum.
    RC_ASSERT(std::abs(x[0] - (start + step)) <= 8 * eps * (std::abs(start) + std::abs(step)));
  }
}

// The Newton homotopy in one variable has the closed flow F(x(t)) = F(x(0)) exp(-t/2).
TEST(ScalarHomotopy, EulersRuleIsOfFirstOrderToTheExactFlow) {
  DenseEquations equations =
      scalar([](double x) { return x * x * x - 8; }, [](double x) { return 3 * x * x; });
  const double exact = std::cbrt(8 + (27 - 8) * std::exp(-1.0));  // at t = 2, from x = 3
  double errors[2];
  for (int k = 0; k < 2; ++k) {
    const int steps = 200 << k;
    VectorXd x = vector({3});
    const Report report = find_root(
        {.function = Function::newton, .step = 2.0 / steps, .tolerance = 0, .steps = steps}, equations, x);
    EXPECT_NEAR(report.time, 2, 1e-12);  // sum of 400 steps
    errors[k] = std::abs(x[0] - exact);
  }
  // Order 1 with a next term of relative size dt = 0.01, times a constant below 5.
  EXPECT_NEAR(errors[0] / errors[1], 2, 0.1);
}

/// The largest defect on the way to t = 1 of what the exact flow keeps: |F|^2 e^t less |x - x(0)|^2 for the
/// fixed point.
double invariant_defect(Function function, int steps) {
  DenseEquations equations = circle();
  VectorXd x = vector({3, -1});
  const VectorXd start = x;
  double defect = 0, first = -1;
  const ScalarHomotopy method = {.function = function, .step = 1.0 / steps, .tolerance = 0, .steps = steps};
  static_cast<void>(find_root(method, equations, x, [&](const Iterate& i) {
    double kept = i.f.squaredNorm() * std::exp(i.time);
    if (function == Function::fixed_point) kept -= (i.x - start).squaredNorm();
    if (first < 0) first = kept;
    defect = std::max(defect, std::abs(kept - first));
    return true;
  }));
  return defect;
}

TEST(ScalarHomotopy, FlowKeepsItsInvariantToFirstOrder) {
  for (const Function function : both) {
    const double coarse = invariant_defect(function, 400), fine = invariant_defect(function, 800);
    EXPECT_GT(coarse, 0);
    // Order 1 with a next term of relative size dt = 0.0025, times a constant below 40: the path is bent.
    EXPECT_NEAR(coarse / fine, 2, 0.1);
    // With the sign as printed in Eq. 2.15 the defect of the fixed point tends to 0.47; this bound is
    // Euler's error with a step of 1/800 and a constant of 80.
    EXPECT_LT(fine, 0.1);
  }
}

// |x+ - r|^2 = |x - r|^2 - dt (1 - dt/4) |F|^4/|B^T F|^2 for linear F and the Newton homotopy.
RC_GTEST_PROP(ScalarHomotopy, EveryStepBelowFourApproachesTheRootOfLinearEquations, ()) {
  const Eigen::Index n = *rc::gen::inRange(1, 6);
  MatrixXd a(n, n);
  for (Eigen::Index k = 0; k < n; ++k) a.col(k) = random_vector(n);
  const VectorXd root = random_vector(n), start = random_vector(n);
  const double dt = *rc::gen::map(rc::gen::inRange(1, 400), [](int k) { return k / 100.0; });
  const VectorXd f = a * (start - root), g = a.transpose() * f;
  RC_PRE(g.norm() > 1e-3 * f.norm() && f.norm() > 0);
  DenseEquations equations = linear(a, root);
  VectorXd x = start;
  static_cast<void>(
      find_root({.function = Function::newton, .step = dt, .tolerance = 0, .steps = 1}, equations, x));
  const double gain = dt * (1 - dt / 4) * std::pow(f.squaredNorm() / g.norm(), 2);
  const double before = (start - root).squaredNorm(), length = dt / 2 * f.squaredNorm() / g.norm();
  // Rounding of the squares, of F (which enters the gain relatively, magnified by |a||start|/|F|) and of the
  // step; a few of each.
  const double noise = 100 * eps * (before + length * length) *
                       (1 + a.norm() * (start.norm() + root.norm()) / f.norm()) *
                       (1 + a.norm() * f.norm() / g.norm());
  RC_ASSERT(std::abs((x - root).squaredNorm() - (before - gain)) <= noise);
}

// F -> U F, F -> c F (Newton only), x -> V x with orthogonal U, V leave the path where it was.
RC_GTEST_PROP(ScalarHomotopy, PathDoesNotDependOnTheFrame, ()) {
  const MatrixXd U = random_rotation(2), V = random_rotation(2);
  for (const Function function : both) {
    const double c = function == Function::newton ? 0x1p20 : 1;
    const ScalarHomotopy method = {.function = function, .step = 0.25, .tolerance = 0, .steps = 10};
    DenseEquations plain = circle();
    DenseEquations turned(
        2,
        [&](const VectorXd& y, VectorXd& f) {
          VectorXd inner(2);
          plain.residual(V.transpose() * y, inner);
          f = c * (U * inner);
        },
        [&](const VectorXd& y, MatrixXd& b) {
          MatrixXd inner(2, 2);
          plain.linearise(V.transpose() * y);
          plain.matrix(inner);
          b = c * (U * inner * V.transpose());
        });
    const VectorXd start = vector({2, 1});
    const std::vector<VectorXd> first = path(method, plain, start), second = path(method, turned, V * start);
    RC_ASSERT(first.size() == second.size());
    for (std::size_t k = 0; k < first.size(); ++k) {
      // Ten steps, on which nearby paths of this F separate by less than a factor of 10 each; roundings of
      // |x| = 2.2.
      RC_ASSERT((V * first[k] - second[k]).norm() <= 1e-11);
    }
  }
}

TEST(ScalarHomotopy, PassesASingularDerivativeAtTheStart) {
  // Roots (1, 2) and (-2, -1); dF/dx is singular for x = -1/2.
  DenseEquations equations(
      2, [](const VectorXd& x, VectorXd& f) { f << x[0] * x[0] + x[1] - 3, x[0] - x[1] + 1; },
      [](const VectorXd& x, MatrixXd& b) { b << 2 * x[0], 1, 1, -1; });
  VectorXd x = vector({-0.5, 3});
  EXPECT_EQ(find_root(Newton{}, equations, x).status.outcome(), Outcome::singular_matrix);
  for (const Function function : both) {
    x = vector({-0.5, 3});
    const Report report = find_root(ScalarHomotopy{.function = function}, equations, x);
    ASSERT_TRUE(report.status.ok()) << report.status.text();
    EXPECT_LE((x - vector({1, 2})).norm(), 1e-10);  // |B^-1| = 1.03 at (1, 2), times the tolerance
  }
}

TEST(ScalarHomotopy, AStationaryPointThatIsNoRootIsReported) {
  DenseEquations equations = scalar([](double x) { return 1 + x * x; }, [](double x) { return 2 * x; });
  for (const Function function : both) {
    VectorXd x = vector({0});
    const Report at_it = find_root(ScalarHomotopy{.function = function}, equations, x);
    EXPECT_EQ(at_it.status.outcome(), Outcome::singular_matrix);
    EXPECT_NE(at_it.status.sentence().find("|F| = 1"), std::string::npos) << at_it.status.text();
    for (const double turn : {0.0, 0.1}) {
      x[0] = 1;
      const Report report =
          find_root(ScalarHomotopy{.function = function, .turn = turn, .steps = 5000}, equations, x);
      EXPECT_FALSE(report.status.ok());
      EXPECT_GE(report.least, 1);
      EXPECT_TRUE(std::isfinite(x[0]));
    }
  }
}

TEST(ScalarHomotopy, ChosenStepsEndAtAMinimumWhereFixedOnesWander) {
  DenseEquations equations = scalar([](double x) { return 1 + x * x; }, [](double x) { return 2 * x; });
  VectorXd x = vector({1});
  const ScalarHomotopy chosen = {.function = Function::newton, .turn = 0.1, .steps = 5000};
  EXPECT_EQ(find_root(chosen, equations, x).status.outcome(), Outcome::step_underflow);
  EXPECT_LT(std::abs(x[0]), 1e-3);
  x[0] = 1;
  const ScalarHomotopy fixed = {.function = Function::newton, .step = 1, .steps = 5000};
  EXPECT_EQ(find_root(fixed, equations, x).status.outcome(), Outcome::step_limit);
}

TEST(ScalarHomotopy, RootAtTheStartCostsOneEvaluation) {
  DenseEquations equations = linear(MatrixXd::Identity(3, 3), vector({1, 2, 3}));
  for (const Function function : both) {
    VectorXd x = vector({1, 2, 3});
    const Report report = find_root(ScalarHomotopy{.function = function, .tolerance = 0}, equations, x);
    ASSERT_TRUE(report.status.ok());
    EXPECT_EQ(report.statistics.steps, 0);
    EXPECT_EQ(report.statistics.right_hand_sides, 1);
    EXPECT_EQ(report.statistics.jacobians, 0);
    EXPECT_EQ(x, vector({1, 2, 3}));
  }
}

TEST(ScalarHomotopy, NonFiniteValuesAreReported) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  DenseEquations bad = scalar([=](double) { return nan; }, [](double) { return 1.0; });
  DenseEquations bad_slope = scalar([](double x) { return x; }, [=](double) { return nan; });
  DenseEquations steep =
      scalar([](double x) { return x > 0 ? HUGE_VAL : x - 1; }, [](double) { return 1e-3; });
  for (const double turn : {0.0, 0.25}) {
    VectorXd x = vector({1});
    EXPECT_EQ(find_root(ScalarHomotopy{.turn = turn}, bad, x).status.outcome(), Outcome::non_finite);
    EXPECT_EQ(find_root(ScalarHomotopy{.turn = turn}, bad_slope, x).status.outcome(), Outcome::non_finite);
  }
  VectorXd x = vector({-1});
  EXPECT_EQ(find_root(ScalarHomotopy{}, steep, x).status.outcome(), Outcome::non_finite);
  EXPECT_EQ(x[0], -1);  // the last iterate at which F exists
}

// sqrt does not exist left of 0; a first step of 2 from 1.5 would go there.
TEST(ScalarHomotopy, ChosenStepsAvoidWhereTheFunctionDoesNotExist) {
  const auto f = [](double x) { return std::sqrt(x) - 0.1; };
  const auto d = [](double x) { return 0.5 / std::sqrt(x); };
  DenseEquations equations = scalar(f, d);
  VectorXd x = vector({1.5});
  EXPECT_EQ(find_root(ScalarHomotopy{.step = 2}, equations, x).status.outcome(), Outcome::non_finite);
  x[0] = 1.5;
  const Report report = find_root(ScalarHomotopy{.step = 2, .turn = 0.25}, equations, x);
  ASSERT_TRUE(report.status.ok()) << report.status.text();
  EXPECT_NEAR(x[0], 0.01, 1e-10);  // tolerance over F' = 5
  EXPECT_GT(report.statistics.rejected, 0);
}

TEST(ScalarHomotopy, StepLimitAndObserverEndTheFlow) {
  DenseEquations equations = circle();
  VectorXd x = vector({2, 1});
  const Report none = find_root(ScalarHomotopy{.steps = 0}, equations, x);
  EXPECT_EQ(none.status.outcome(), Outcome::step_limit);
  EXPECT_EQ(x, vector({2, 1}));
  for (const double turn : {0.0, 0.1}) {
    x = vector({2, 1});
    const Report three = find_root(ScalarHomotopy{.step = 0.1, .turn = turn, .steps = 3}, equations, x);
    EXPECT_EQ(three.status.outcome(), Outcome::step_limit);
    EXPECT_EQ(three.statistics.steps + three.statistics.rejected, 3);
  }
  x = vector({2, 1});
  const Report stopped =
      find_root(ScalarHomotopy{}, equations, x, [](const Iterate& i) { return i.index < 2; });
  EXPECT_EQ(stopped.status.outcome(), Outcome::interrupted);
  EXPECT_EQ(stopped.statistics.steps, 2);
}

TEST(ScalarHomotopy, RefusesOptionsOutOfRange) {
  DenseEquations equations = circle();
  VectorXd x = vector({2, 1}), longer = vector({1, 2, 3});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const ScalarHomotopy& bad :
       {ScalarHomotopy{.step = 0}, ScalarHomotopy{.step = -1}, ScalarHomotopy{.step = nan},
        ScalarHomotopy{.turn = -0.1}, ScalarHomotopy{.turn = nan}, ScalarHomotopy{.longest = 0},
        ScalarHomotopy{.tolerance = -1}, ScalarHomotopy{.tolerance = nan}, ScalarHomotopy{.steps = -1}}) {
    EXPECT_THROW(static_cast<void>(find_root(bad, equations, x)), std::invalid_argument);
  }
  EXPECT_THROW(static_cast<void>(find_root(ScalarHomotopy{}, equations, longer)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(find_root(Newton{}, equations, longer)), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::algebraic::scalar_homotopy_test

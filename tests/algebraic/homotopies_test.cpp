/// Vector homotopies, Chow and Yorke's path, scalar homotopies and the options of Eq. 2.14.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <Eigen/QR>
#include <Eigen/SVD>

#include <cmath>
#include <limits>
#include <vector>

#include "nlmech/algebraic/homotopies/scalar_homotopy.hpp"
#include "nlmech/algebraic/homotopies/vector_homotopy.hpp"
#include "tests/algebraic/classics.hpp"
#include "tests/thrown.hpp"

namespace nlmech::algebraic::homotopies_test {
namespace {

using namespace classics;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr Homotopy both[] = {Homotopy::fixed_point, Homotopy::newton};

/// x^3 - 3 x + 3: extrema at -1 and 1, and one root to the left of both.
DenseEquations bent() {
  return scalar([](double x) { return (x * x - 3) * x + 3; }, [](double x) { return 3 * x * x - 3; });
}
/// The root by Cardano's formula.
double root_of_bent() { return -std::cbrt((3 + std::sqrt(5.0)) / 2) - std::cbrt((3 - std::sqrt(5.0)) / 2); }

/// H at an iterate, from F there and at the start.
VectorXd value_of(Homotopy function, const Iterate& i, const VectorXd& start, const VectorXd& first) {
  const double t = i.time;
  if (function == Homotopy::newton) return i.f - (1 - t) * first;
  return t * i.f + (1 - t) * (i.x - start);
}

TEST(VectorHomotopy, StaysOnThePath) {
  for (const Homotopy function : both) {
    DenseEquations equations = circle();
    VectorXd x = vector({2, 1}), first(2);
    const VectorXd start = x;
    equations.residual(x, first);
    const VectorHomotopy method = {.function = function, .accuracy = 1e-6};
    const Report report = find_root(method, equations, x, [&](const Iterate& i) {
      // |dH/dx| <= 6 on the path; the error of the path is a hundred times that of a step.
      EXPECT_LE(value_of(function, i, start, first).norm(), 6e-4 * (1 + i.x.norm()));
      return true;
    });
    ASSERT_TRUE(report.status.ok()) << report.status.text();
    EXPECT_EQ(report.time, 1);
  }
}

TEST(VectorHomotopy, StopsAtATurningPointThatChowAndYorkePass) {
  DenseEquations equations = bent();
  VectorXd x = vector({2});
  const Report stopped = find_root(VectorHomotopy{.function = Homotopy::newton}, equations, x);
  EXPECT_EQ(stopped.status.outcome(), Outcome::step_underflow) << stopped.status.text();
  EXPECT_NEAR(stopped.time, 0.8, 1e-3);  // F(1) = 1 and F(2) = 5
  EXPECT_NEAR(x[0], 1, 0.05);  // F is flat there: an error of 1e-3 in t becomes its square root, times a few
}

// The path goes from x = 2 to 1, where t = 0.8, back to t = 0 at -1, and to the root.
TEST(ChowYorke, PassesTurningPoints) {
  DenseEquations equations = bent();
  for (const double longest : {0.05, 1.0}) {
    VectorXd x = vector({2});
    const VectorXd start = x, first = vector({5});
    double greatest_before = 0, least_after = 1, previous = 2;
    const ChowYorke method = {.function = Homotopy::newton, .longest = longest};
    const Report report = find_root(method, equations, x, [&](const Iterate& i) {
      if (i.time < 1) {
        EXPECT_LE(value_of(Homotopy::newton, i, start, first).norm(), 5e-6);  // the accuracy of the path
      }
      EXPECT_LT(i.x[0], previous + 1e-9);
      previous = i.x[0];
      (i.x[0] > 1 ? greatest_before : least_after) =
          i.x[0] > 1 ? std::max(greatest_before, i.time) : std::min(least_after, i.time);
      return true;
    });
    ASSERT_TRUE(report.status.ok()) << report.status.text();
    EXPECT_NEAR(x[0], root_of_bent(), 2e-11);  // tolerance over F' = 10.3
    EXPECT_LE(greatest_before, 0.8 + 1e-6);
    EXPECT_GE(least_after, -1e-6);
    if (longest < 0.1) {
      EXPECT_LT(least_after, 0.01);  // t is below 0.01 over an interval of 0.26 of x
    }
  }
}

TEST(ChowYorke, BothHomotopiesFindTheirRootDenseAndSparse) {
  for (const Homotopy function : both) {
    DenseEquations dense = circle();
    Sparse sparse(dense);
    // det B > 0 at the root nearby, as det dH/dx at the start of the fixed-point path.
    VectorXd x = vector({3, 0.5}), y = x;
    ASSERT_TRUE(find_root(ChowYorke{.function = function}, dense, x).status.ok());
    const Report report = find_root(ChowYorke{.function = function}, sparse, y);
    ASSERT_TRUE(report.status.ok()) << report.status.text();
    EXPECT_LE((x - y).norm(), 1e-9);
  }
}

TEST(ChowYorke, StartsWhereTheMatrixIsSingular) {
  // dF/dx = 0 at 1: the path of the Newton homotopy starts along x, not along t.
  DenseEquations equations = bent();
  VectorXd x = vector({1});
  const Report report = find_root(ChowYorke{.function = Homotopy::newton}, equations, x);
  EXPECT_EQ(report.statistics.fallbacks, 1);
  // Both directions of the path are possible: one leads to the root, the other one to t = -infinity.
  if (report.status.ok()) {
    EXPECT_NEAR(x[0], root_of_bent(), 2e-11);
  } else {
    EXPECT_EQ(report.status.outcome(), Outcome::step_limit) << report.status.text();
  }
}

// For linear equations the path of the Newton homotopy is a straight line: H = 0 at the start, F = H at the
// end.
RC_GTEST_PROP(ChowYorke, IsStraightForLinearEquations, ()) {
  MatrixXd m(3, 3);
  for (double& v : m.reshaped()) v = *rc::gen::inRange(-100, 101) / 100.0;
  const MatrixXd a = m + 4 * MatrixXd::Identity(3, 3);  // diagonally dominant
  const VectorXd root = vector({1, -2, 3});
  DenseEquations equations = linear(a, root);
  VectorXd x = VectorXd::Zero(3);
  const Report report =
      find_root(ChowYorke{.function = Homotopy::newton}, equations, x, [&](const Iterate& i) {
        RC_ASSERT((i.x - i.time * root).norm() <= 1e-12);
        return true;
      });
  RC_ASSERT(report.status.ok());
  RC_ASSERT(report.statistics.rejected == 0);
}

/// The largest residual of h = 0 in the first pass, with h of Eq. 2.11.
double defect(int steps) {
  DenseEquations equations = circle();
  VectorXd x = vector({3, -1});
  const VectorXd start = x;
  double worst = 0;
  const FirstScalarHomotopy method = {.weight = 1, .steps = steps, .tolerance = 0, .iterations = steps};
  static_cast<void>(find_root(method, equations, x, [&](const Iterate& i) {
    const double h = (i.time * i.f.squaredNorm() - (1 - i.time) * (i.x - start).squaredNorm()) / 2;
    worst = std::max(worst, std::abs(h));
    return true;
  }));
  return worst;
}

TEST(FirstScalarHomotopy, KeepsItsFunctionZeroToSecondOrder) {
  const double coarse = defect(400), fine = defect(800);
  EXPECT_GT(coarse, 0);
  EXPECT_NEAR(coarse / fine, 4, 0.5);  // next term: the step of 0.004 times a constant below 30
}

TEST(FirstScalarHomotopy, DoesNotDependOnTheUnitsOfF) {
  VectorXd ends[2];
  for (int k = 0; k < 2; ++k) {
    const double c = k == 0 ? 1 : 0x1p40;
    DenseEquations plain = circle();
    DenseEquations scaled(
        2,
        [&](const VectorXd& x, VectorXd& f) {
          plain.residual(x, f);
          f *= c;
        },
        [&](const VectorXd& x, MatrixXd& b) {
          plain.linearise(x);
          plain.matrix(b);
          b *= c;
        });
    ends[k] = vector({3, -1});
    static_cast<void>(find_root(FirstScalarHomotopy{.tolerance = 0, .iterations = 30}, scaled, ends[k]));
  }
  EXPECT_EQ(ends[0], ends[1]);  // a power of two
}

TEST(FirstScalarHomotopy, TimeRunsFromZeroToOneInEveryPass) {
  DenseEquations equations = circle();
  VectorXd x = vector({2, 1});
  std::vector<double> times;
  const FirstScalarHomotopy method = {.steps = 4, .tolerance = 0, .iterations = 8};
  static_cast<void>(find_root(method, equations, x, [&](const Iterate& i) {
    times.push_back(i.time);
    return true;
  }));
  ASSERT_EQ(times.size(), 9U);
  for (int k = 1; k <= 8; ++k) {
    const double s = std::sin(std::acos(-1.0) / 8 * ((k - 1) % 4 + 1));
    EXPECT_NEAR(times[static_cast<std::size_t>(k)], s * s, 1e-15);
  }
}

/// The largest relative deviation up to t = 1 of the invariant of the exact flow: |F|^2 Q, minus |x - x(0)|^2
/// for the fixed-point function.
double kept(const ScalarHomotopy& options, int steps) {
  MatrixXd a(2, 2);
  a << 3, 1, 1, 2;
  DenseEquations equations(
      2,
      [a](const VectorXd& x, VectorXd& f) {
        f = a * x + x.array().cube().matrix() - vector({1, 2});
      },
      [a](const VectorXd& x, MatrixXd& b) {
        b = a;
        b.diagonal() += (3 * x.array().square()).matrix();
      });
  VectorXd x = vector({2, -1});
  const VectorXd start = x;
  double worst = 0, first = -1;
  ScalarHomotopy method = options;
  method.step = 1.0 / steps;
  method.tolerance = 0;
  method.steps = steps;
  static_cast<void>(find_root(method, equations, x, [&](const Iterate& i) {
    double value = i.f.squaredNorm() * std::exp(i.time);
    if (method.function == ScalarHomotopy::Function::fixed_point) value -= (i.x - start).squaredNorm();
    if (first < 0) first = value;
    worst = std::max(worst, std::abs(value - first) / first);
    return true;
  }));
  return worst;
}

// With the printed sign of Eq. 2.15 the deviation for the fixed-point function does not tend to 0.
TEST(ScalarHomotopy, KeepsItsInvariantToFirstOrder) {
  for (const auto function : {ScalarHomotopy::Function::fixed_point, ScalarHomotopy::Function::newton}) {
    const double coarse = kept({.function = function}, 400), fine = kept({.function = function}, 800);
    EXPECT_GT(coarse, 0);
    EXPECT_NEAR(coarse / fine, 2, 0.1);  // next term: the step of 0.0025 times a constant below 40
    EXPECT_LT(fine, 0.02);               // the step of 1/800 times a constant of 16
  }
}

TEST(Homotopies, OptionsOutOfRangeAreRefused) {
  expect_refused(VectorHomotopy{.accuracy = 0});
  expect_refused(ChowYorke{.step = 0});
  expect_refused(ChowYorke{.longest = nan});
  expect_refused(ChowYorke{.turn = 2});
  expect_refused(ChowYorke{.accuracy = 0});
  expect_refused(FirstScalarHomotopy{.steps = 0});
  expect_refused(FirstScalarHomotopy{.weight = -1});
  for (const double step : {0., -1., nan}) expect_refused(ScalarHomotopy{.step = step});
  for (const double tolerance : {-1., nan}) expect_refused(ScalarHomotopy{.tolerance = tolerance});
  expect_refused(ScalarHomotopy{.steps = -1});
}

using Function = ScalarHomotopy::Function;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr std::array functions = {Function::fixed_point, Function::newton};

MatrixXd random_rotation(Eigen::Index n) {
  return Eigen::HouseholderQR<MatrixXd>(random_matrix(n, n)).householderQ();
}

TEST(ScalarHomotopy, FindsKnownRoots) {
  const double far = std::sqrt(2 + std::sqrt(3.0));
  const VectorXd root = vector({far, 1 / far});
  MatrixXd b(2, 2);
  b << 2 * root[0], 2 * root[1], root[1], root[0];
  const double least = Eigen::JacobiSVD<MatrixXd>(b).singularValues()[1];
  for (const Function function : functions) {
    for (const double step : {0.3, 1.0}) {
      DenseEquations equations = circle();
      VectorXd x = vector({2, 1});
      const ScalarHomotopy method = {.function = function, .step = step};
      const Report report = find_root(method, equations, x);
      ASSERT_TRUE(report.status.ok()) << report.status.text();
      EXPECT_LE(report.last, method.tolerance);
      // |B^-1| |F|; the curvature of F is negligible at this distance.
      EXPECT_LE((x - root).norm(), 1.01 * method.tolerance / least);
    }
  }
}

TEST(ScalarHomotopy, ReportsWhatItDid) {
  DenseEquations equations = circle();
  VectorXd x = vector({2, 1});
  std::int64_t seen = 0;
  double least = HUGE_VAL, last = 0, time = -1;
  const Report report = find_root(ScalarHomotopy{}, equations, x, [&](const Iterate& i) {
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
  EXPECT_EQ(s.right_hand_sides, s.steps + 1);
  EXPECT_LE(s.jacobians, s.right_hand_sides);  // none at a root
  EXPECT_EQ(s.factorisations, 0);
  EXPECT_EQ(s.newton_iterations, 0);
}

// Eqs 2.15 and 2.16 with one unknown: dx/dt = -F/(2 F'), so Euler's step is Newton's times dt/2.
RC_GTEST_PROP(ScalarHomotopy, FirstStepInOneVariableIsADampedNewtonStep, ()) {
  const double start = *rc::gen::map(rc::gen::inRange(-300, 300), [](int k) { return k / 100.0 + 0.005; });
  const double dt = *rc::gen::map(rc::gen::inRange(1, 200), [](int k) { return k / 100.0; });
  const auto f = [](double x) { return x * x * x + x - 3; };
  const auto d = [](double x) { return 3 * x * x + 1; };
  for (const Function function : functions) {
    DenseEquations equations = scalar(f, d);
    VectorXd x = vector({start});
    const Report report =
        find_root({.function = function, .step = dt, .tolerance = 0, .steps = 1}, equations, x);
    RC_ASSERT(report.status.outcome() == Outcome::step_limit);
    const double step = -dt / 2 * f(start) / d(start);
    // About eight rounding errors of the step or of the sum.
    RC_ASSERT(std::abs(x[0] - (start + step)) <= 8 * eps * (std::abs(start) + std::abs(step)));
  }
}

// The Newton homotopy in one variable has the exact flow F(x(t)) = F(x(0)) exp(-t/2).
TEST(ScalarHomotopy, EulersRuleIsOfFirstOrderToTheExactFlow) {
  DenseEquations equations = cube();
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
  // Order 1; the next term has the relative size dt = 0.01 times a constant below 5.
  EXPECT_NEAR(errors[0] / errors[1], 2, 0.1);
}

// |x+ - r|^2 = |x - r|^2 - dt (1 - dt/4) |F|^4/|B^T F|^2 for linear F and the Newton homotopy.
RC_GTEST_PROP(ScalarHomotopy, EveryStepBelowFourApproachesTheRootOfLinearEquations, ()) {
  const Eigen::Index n = *rc::gen::inRange(1, 6);
  const MatrixXd a = random_matrix(n, n);
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
  // A few rounding errors each of the squares, of F (which enters the gain relatively, times |a||start|/|F|)
  // and of the step.
  const double noise = 100 * eps * (before + length * length) *
                       (1 + a.norm() * (start.norm() + root.norm()) / f.norm()) *
                       (1 + a.norm() * f.norm() / g.norm());
  RC_ASSERT(std::abs((x - root).squaredNorm() - (before - gain)) <= noise);
}

// F -> U F, F -> c F (Newton only) and x -> V x with orthogonal U, V do not change the path.
RC_GTEST_PROP(ScalarHomotopy, PathDoesNotDependOnTheFrame, ()) {
  const MatrixXd U = random_rotation(2), V = random_rotation(2);
  for (const Function function : functions) {
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
    const std::vector<VectorXd> first = iterates(method, plain, start),
                                second = iterates(method, turned, V * start);
    RC_ASSERT(first.size() == second.size());
    for (std::size_t k = 0; k < first.size(); ++k) {
      // Ten steps, in which nearby paths of this F diverge by less than a factor of 10 each; rounding errors
      // of |x| = 2.2.
      RC_ASSERT((V * first[k] - second[k]).norm() <= 1e-11);
    }
  }
}

TEST(ScalarHomotopy, AStationaryPointThatIsNoRootIsReported) {
  DenseEquations equations = scalar([](double x) { return 1 + x * x; }, [](double x) { return 2 * x; });
  for (const Function function : functions) {
    VectorXd x = vector({0});
    const Report at_it = find_root(ScalarHomotopy{.function = function}, equations, x);
    EXPECT_EQ(at_it.status.outcome(), Outcome::singular_matrix);
    EXPECT_TRUE(tests::holds(at_it.status.sentence(), "|F| = 1"));
    x[0] = 1;
    const Report report = find_root(ScalarHomotopy{.function = function, .steps = 5000}, equations, x);
    EXPECT_EQ(report.status.outcome(), Outcome::step_limit);
    EXPECT_GE(report.least, 1);
    EXPECT_TRUE(std::isfinite(x[0]));
  }
}

TEST(ScalarHomotopy, NonFiniteValuesAreReported) {
  DenseEquations bad = scalar([=](double) { return nan; }, [](double) { return 1.0; });
  DenseEquations bad_slope = scalar([](double x) { return x; }, [=](double) { return nan; });
  DenseEquations steep =
      scalar([](double x) { return x > 0 ? HUGE_VAL : x - 1; }, [](double) { return 1e-3; });
  VectorXd x = vector({1});
  EXPECT_EQ(find_root(ScalarHomotopy{}, bad, x).status.outcome(), Outcome::non_finite);
  EXPECT_EQ(find_root(ScalarHomotopy{}, bad_slope, x).status.outcome(), Outcome::non_finite);
  x = vector({-1});
  EXPECT_EQ(find_root(ScalarHomotopy{}, steep, x).status.outcome(), Outcome::non_finite);
  EXPECT_EQ(x[0], -1);  // the last iterate at which F is defined
}

TEST(ScalarHomotopy, StepLimitEndsTheFlow) {
  DenseEquations equations = circle();
  VectorXd x = vector({2, 1});
  const Report none = find_root(ScalarHomotopy{.steps = 0}, equations, x);
  EXPECT_EQ(none.status.outcome(), Outcome::step_limit);
  EXPECT_EQ(x, vector({2, 1}));
  const Report three = find_root(ScalarHomotopy{.step = 0.1, .steps = 3}, equations, x);
  EXPECT_EQ(three.status.outcome(), Outcome::step_limit);
  EXPECT_EQ(three.statistics.steps, 3);
}

}  // namespace
}  // namespace nlmech::algebraic::homotopies_test

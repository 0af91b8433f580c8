/// Path following: limit points, branch points, and solvers made of it.
#include "nlmech/algebraic/paths/path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "nlmech/algebraic/paths/fold.hpp"
#include "nlmech/algebraic/paths/path_solvers.hpp"
#include "tests/algebraic/paths.hpp"

namespace nlmech::algebraic::path_test {
namespace {

using namespace paths;

// A point of the path has F = 0 to rounding (corrections below 1e-8 of a step leave their square); the limit
// load is stationary, so that it is right to rounding; the place, in the derivative of F, to the same, as
// second derivatives are of size 1.
TEST(Path, FindsLimitPoints) {
  for (const bool symmetric : {true, false}) {
    for (const Kind kind : kinds) {
      Cubic cubic;
      cubic.symmetric = symmetric;
      Path path({.kind = kind, .first = 0.1}, cubic, VectorXd::Constant(1, -1.2), 0.5);
      ASSERT_TRUE(path.start(false).ok());
      EXPECT_NEAR(path.now().x[0] - std::pow(path.now().x[0], 3), 0.5, 1e-13);
      const double signs[] = {-1, 1};
      std::size_t found = 0;
      for (int k = 0; k < 200 && path.now().x[0] < 1.5; ++k) {
        ASSERT_TRUE(path.advance().ok());
        const PathPoint& now = path.now();
        EXPECT_NEAR(now.x[0] - std::pow(now.x[0], 3), now.load, 1e-13);
        EXPECT_FALSE(path.has_passed_branch());
        EXPECT_EQ(now.negative, std::abs(now.x[0]) > limit_x ? 1 : 0);
        if (!path.has_passed_fold()) continue;
        PathPoint fold;
        ASSERT_EQ(path.fold(fold), Outcome::success);
        ASSERT_LT(found, 2u);
        EXPECT_NEAR(fold.load, signs[found] * limit_load, 4 * eps);
        EXPECT_NEAR(fold.x[0], signs[found++] * limit_x, symmetric ? 8 * eps : 1e-12);
      }
      EXPECT_EQ(found, 2u);
    }
  }
}

TEST(Path, CrossesALoad) {
  Cubic cubic;
  Path path({.first = 0.1}, cubic, VectorXd::Zero(1), 0);
  ASSERT_TRUE(path.start().ok());
  PathPoint point;
  while (path.now().load < 0.25) ASSERT_TRUE(path.advance().ok());
  ASSERT_EQ(path.crossing(0.25, path.before(), path.now(), point), Outcome::success);
  EXPECT_NEAR(point.x[0] - std::pow(point.x[0], 3), 0.25, 2 * eps);
  EXPECT_EQ(path.crossing(0.9, path.before(), path.now(), point), Outcome::not_converged);
  EXPECT_EQ(path.fold(point), Outcome::not_converged);
}

/// load = x^3 - tiny x: limit points at +-sqrt(tiny/3), as close together as tiny is small.
struct FlatCubic : Loaded {
  explicit FlatCubic(double t) : tiny(t) {}
  [[nodiscard]] Eigen::Index size() const override { return 1; }
  void residual(const VectorXd& x, double load, VectorXd& f) override {
    f.setConstant(1, x[0] * x[0] * x[0] - tiny * x[0] - load);
  }
  void linearise(const VectorXd& x, double) override { slope = 3 * x[0] * x[0] - tiny; }
  void load_vector(VectorXd& q) const override { q.setConstant(1, -1); }
  void matrix(MatrixXd& k) const override { k.setConstant(1, 1, slope); }
  double tiny, slope = 0;
};

// Two limit points within one step, at whose ends the load rises: no sign shows them.
TEST(Path, FindsPairsOfLimitPointsWithinAStep) {
  for (const double tiny : {1e-2, 1e-4, 1e-6}) {
    for (const double from : {-1., -0.97, -0.9}) {
      FlatCubic cubic(tiny);
      Path path({.first = 0.3}, cubic, VectorXd::Constant(1, from), std::pow(from, 3) - tiny * from);
      ASSERT_TRUE(path.start().ok());
      std::vector<PathPoint> all, some;
      while (path.now().x[0] < 1) {
        ASSERT_TRUE(path.advance().ok());
        ASSERT_EQ(path.folds(some), Outcome::success);
        all.insert(all.end(), some.begin(), some.end());
      }
      ASSERT_EQ(all.size(), 2u) << tiny << ' ' << from;
      const double x = std::sqrt(tiny / 3), load = 2 * tiny * x / 3;
      // The second derivative of the load is 6 x.
      EXPECT_NEAR(all[0].x[0], -x, 16 * eps / x);
      EXPECT_NEAR(all[1].x[0], x, 16 * eps / x);
      EXPECT_NEAR(all[0].load, load, 4 * eps);
      EXPECT_NEAR(all[1].load, -load, 4 * eps);
    }
  }
  FlatCubic none(-1e-6);
  Path path({.first = 0.3}, none, VectorXd::Constant(1, -1), -1 - 1e-6);
  ASSERT_TRUE(path.start().ok());
  std::vector<PathPoint> some;
  while (path.now().x[0] < 1) {
    ASSERT_TRUE(path.advance().ok());
    ASSERT_EQ(path.folds(some), Outcome::success);
    EXPECT_TRUE(some.empty());
  }
}

// Quadratic convergence of the extended system, from a tenth away.
TEST(Fold, ConvergesQuadratically) {
  Cubic cubic;
  PathSystem system(cubic, VectorXd::Zero(1), 0, {});
  PathVector at = system.scaled(VectorXd::Constant(1, limit_x + 0.1), limit_load);
  VectorXd direction = VectorXd::Ones(1);
  ASSERT_EQ(refine_fold(system, at, direction), Outcome::success);
  EXPECT_NEAR(system.unscaled(at.y)[0], limit_x, 4 * eps);
  EXPECT_NEAR(at.m / system.load_scale(), limit_load, 4 * eps);
  EXPECT_LE(system.statistics.newton_iterations, 7);
}

TEST(Path, FindsABranchPointAndGoesOver) {
  Pitchfork pitchfork;
  VectorXd start(2);
  start << 0, -1;
  Path path({.first = 0.3}, pitchfork, start, -1);
  ASSERT_TRUE(path.start().ok());
  while (!path.has_passed_branch()) ASSERT_TRUE(path.advance().ok());
  EXPECT_FALSE(path.has_passed_fold());
  EXPECT_EQ(path.before().negative, 0);
  EXPECT_EQ(path.now().negative, 1);
  PathPoint point;
  VectorXd direction;
  ASSERT_EQ(path.branch(point, direction), Outcome::success);
  EXPECT_NEAR(point.load, 0, 1e-13);
  EXPECT_NEAR(std::abs(direction[0]), 1, 1e-13);
  EXPECT_NEAR(direction[1], 0, 1e-13);
  for (const double length : {0.05, -0.05}) {
    ASSERT_TRUE(path.switch_branch(point, direction, length).ok());
    for (int k = 0; k < 5; ++k) {
      ASSERT_TRUE(path.advance().ok());
      const PathPoint& now = path.now();
      EXPECT_GT(std::abs(now.x[0]), 0.05);
      EXPECT_GT(now.x[0] * length * direction[0], 0);
      EXPECT_NEAR(now.x[0] * now.x[0], now.load, 1e-13);
      EXPECT_EQ(now.negative, 0);
    }
  }
}

TEST(Path, RefusesWhatItCannotUse) {
  Cubic cubic;
  const VectorXd x = VectorXd::Zero(1);
  EXPECT_THROW(Path({.first = 0}, cubic, x, 0), std::invalid_argument);
  EXPECT_THROW(Path({.turn = 2}, cubic, x, 0), std::invalid_argument);
  EXPECT_THROW(Path({.spherical = -1}, cubic, x, 0), std::invalid_argument);
  EXPECT_THROW(Path({.iterations = 0}, cubic, x, 0), std::invalid_argument);
  EXPECT_THROW(Path({.scale = VectorXd::Ones(2)}, cubic, x, 0), std::invalid_argument);
  EXPECT_THROW(Path({}, cubic, VectorXd::Zero(2), 0), std::invalid_argument);
}

DenseEquations cubic_equation(double load) {
  return {1, [=](const VectorXd& x, VectorXd& f) { f[0] = x[0] - std::pow(x[0], 3) - load; },
          [](const VectorXd& x, MatrixXd& b) { b(0, 0) = 1 - 3 * x[0] * x[0]; }};
}

// The path from x = 0 goes up to the limit point and back: the first crossing is on the way up, however near
// to the limit; beyond it, there is none, and the path goes away for ever.
TEST(ArcLength, TheLimitPointDecides) {
  for (const Kind kind : kinds) {
    for (const double below : {0.5, 1e-3, 1e-6, 1e-9, 1e-12}) {
      DenseEquations equations = cubic_equation(limit_load * (1 - below));
      VectorXd x = VectorXd::Zero(1);
      const Report report = find_root(ArcLength{{.kind = kind}}, equations, x);
      ASSERT_TRUE(report.status.ok()) << report.status.text();
      EXPECT_LE(report.last, 4 * eps);
      // The root is known to a rounding over the slope of F, 2 sqrt(below/3 ...) or so.
      EXPECT_LE(x[0], limit_x - 0.3 * std::sqrt(below * limit_load / limit_x)) << below;
    }
    DenseEquations none = cubic_equation(limit_load * (1 + 1e-9));
    VectorXd x = VectorXd::Zero(1);
    const Report report = find_root(ArcLength{.path = {.kind = kind}, .steps = 60}, none, x);
    EXPECT_EQ(report.status.outcome(), Outcome::step_limit);
    EXPECT_NE(report.status.sentence().find("of 1"), std::string::npos);
  }
}

// Equations that are no gradient.
TEST(ArcLength, FollowsAnyEquations) {
  const double exact = std::sqrt(2 + std::sqrt(3.0));
  for (const Kind kind : kinds) {
    DenseEquations circle(
        2, [](const VectorXd& x, VectorXd& f) { f << x.squaredNorm() - 4, x[0] * x[1] - 1; },
        [](const VectorXd& x, MatrixXd& b) { b << 2 * x[0], 2 * x[1], x[1], x[0]; });
    VectorXd x(2);
    x << 2, 1;
    std::int64_t seen = 0;
    const Report report = find_root(ArcLength{{.kind = kind}}, circle, x, [&](const Iterate& i) {
      EXPECT_EQ(i.index, seen++);
      return true;
    });
    ASSERT_TRUE(report.status.ok()) << report.status.text();
    EXPECT_NEAR(x[0], exact, 8 * eps * exact);
    EXPECT_NEAR(x[1], 1 / exact, 8 * eps);
    EXPECT_EQ(report.time, 1);
    const Report again =
        find_root(ArcLength{{.kind = kind}}, circle, x, [](const Iterate&) { return false; });
    EXPECT_TRUE(again.status.ok() || again.status.outcome() == Outcome::interrupted);
  }
}

TEST(ArcLength, SaysWhyItFails) {
  DenseEquations equations = cubic_equation(0.1);
  VectorXd x = VectorXd::Constant(1, HUGE_VAL);
  EXPECT_EQ(find_root(ArcLength{}, equations, x).status.outcome(), Outcome::non_finite);
  x[0] = 0;
  EXPECT_EQ(
      find_root(ArcLength{}, equations, x, [](const Iterate& i) { return i.index < 1; }).status.outcome(),
      Outcome::interrupted);
  x = VectorXd::Zero(2);
  EXPECT_THROW((void)find_root(ArcLength{}, equations, x), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::algebraic::path_test

/// Path following: limit points, bifurcation points, and solvers based on it.
#include "nlmech/algebraic/paths/path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/algebraic/paths/fold.hpp"
#include "nlmech/algebraic/paths/path_solvers.hpp"
#include "tests/algebraic/classics.hpp"
#include "tests/thrown.hpp"

namespace nlmech::algebraic::path_test {
namespace {

using classics::vector;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Kind = PathMethod::Kind;
constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr Kind kinds[] = {Kind::riks, Kind::crisfield, Kind::gdc};

/// An equation F(x, load) = 0 with both derivatives.
class OneUnknown : public Loaded {
 public:
  using Function = std::function<double(double x, double load)>;
  OneUnknown(Function f, Function slope, Function along)
      : f_(std::move(f)), slope_(std::move(slope)), along_(std::move(along)) {}
  [[nodiscard]] Eigen::Index size() const override { return 1; }
  void residual(const VectorXd& x, double load, VectorXd& f) override { f.setConstant(1, f_(x[0], load)); }
  void linearise(const VectorXd& x, double load) override { x_ = x[0], load_ = load; }
  void load_vector(VectorXd& q) const override { q.setConstant(1, along_(x_, load_)); }
  void matrix(MatrixXd& k) const override { k.setConstant(1, 1, slope_(x_, load_)); }
  [[nodiscard]] bool is_symmetric() const override { return symmetric; }
  bool symmetric = true;

 private:
  Function f_, slope_, along_;
  double x_ = 0, load_ = 0;
};
/// load = x - x^3: limit points at x = +-1/sqrt(3) with the loads +-2/(3 sqrt(3)).
struct Cubic : OneUnknown {
  Cubic()
      : OneUnknown([](double x, double load) { return x - x * x * x - load; },
                   [](double x, double) { return 1 - 3 * x * x; }, [](double, double) { return -1.; }) {}
};
const double limit_load = 2 / (3 * std::sqrt(3.0)), limit_x = 1 / std::sqrt(3.0);

/// V = x^4/4 - load x^2/2 + (y - load)^2/2: the path x = 0, y = load, with the branch x^2 = load from load 0.
struct Pitchfork : Loaded {
  [[nodiscard]] Eigen::Index size() const override { return 2; }
  void residual(const VectorXd& x, double load, VectorXd& f) override {
    f.resize(2);
    f << x[0] * x[0] * x[0] - load * x[0], x[1] - load;
  }
  void linearise(const VectorXd& x, double load) override {
    at = x;
    k00 = 3 * x[0] * x[0] - load;
  }
  void load_vector(VectorXd& q) const override {
    q.resize(2);
    q << -at[0], -1;
  }
  void matrix(MatrixXd& k) const override {
    k.setIdentity(2, 2);
    k(0, 0) = k00;
  }
  VectorXd at;
  double k00 = 0;
};

// A point of the path satisfies F = 0 to rounding (corrections below 1e-8 of a step leave their square). The
// load is stationary at a limit point, so it is accurate to rounding; x is as accurate as the derivative of
// F, because second derivatives are of size 1.
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
        EXPECT_EQ(path.before().sign, now.sign);  // no branch point
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

/// load = x^3 - tiny x: limit points at +-sqrt(tiny/3), close together for small tiny.
OneUnknown flat_cubic(double tiny) {
  return {[=](double x, double load) { return x * x * x - tiny * x - load; },
          [=](double x, double) { return 3 * x * x - tiny; }, [](double, double) { return -1.; }};
}

// Two limit points within one step: the load increases at both ends of the step, so no sign reveals them.
TEST(Path, FindsPairsOfLimitPointsWithinAStep) {
  for (const double tiny : {1e-2, 1e-4, 1e-6}) {
    for (const double from : {-1., -0.97, -0.9}) {
      OneUnknown cubic = flat_cubic(tiny);
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
  OneUnknown none = flat_cubic(-1e-6);
  Path path({.first = 0.3}, none, VectorXd::Constant(1, -1), -1 - 1e-6);
  ASSERT_TRUE(path.start().ok());
  std::vector<PathPoint> some;
  while (path.now().x[0] < 1) {
    ASSERT_TRUE(path.advance().ok());
    ASSERT_EQ(path.folds(some), Outcome::success);
    EXPECT_TRUE(some.empty());
  }
}

// Quadratic convergence of the extended system, from a distance of 0.1.
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
  VectorXd start = vector({0, -1});
  Path path({.first = 0.3}, pitchfork, start, -1);
  ASSERT_TRUE(path.start().ok());
  while (path.before().sign * path.now().sign >= 0) ASSERT_TRUE(path.advance().ok());
  EXPECT_FALSE(path.has_passed_fold());
  EXPECT_EQ(path.before().negative, 0);
  EXPECT_EQ(path.now().negative, 1);
  std::vector<CriticalPoint> found;
  ASSERT_EQ(path.critical_points(found), Outcome::success);
  ASSERT_EQ(found.size(), 1u);
  const VectorXd direction = found[0].across.y;
  EXPECT_NEAR(found[0].point.load, 0, 1e-13);
  EXPECT_NEAR(std::abs(direction[0]), 1, 1e-13);
  EXPECT_NEAR(direction[1], 0, 1e-13);
  for (const double length : {0.05, -0.05}) {
    ASSERT_TRUE(path.switch_branch(found[0].point, found[0].across, length).ok());
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
  EXPECT_THROW(Path({.iterations = 0}, cubic, x, 0), std::invalid_argument);
  EXPECT_THROW(Path({.scale = VectorXd::Ones(2)}, cubic, x, 0), std::invalid_argument);
  EXPECT_THROW(Path({}, cubic, VectorXd::Zero(2), 0), std::invalid_argument);
}

DenseEquations cubic_equation(double load) {
  return {1, [=](const VectorXd& x, VectorXd& f) { f[0] = x[0] - std::pow(x[0], 3) - load; },
          [](const VectorXd& x, MatrixXd& b) { b(0, 0) = 1 - 3 * x[0] * x[0]; }};
}

// The path from x = 0 ascends to the limit point and descends: the first crossing is on the ascending part,
// however close to the limit load. Above the limit load there is no crossing, and the path continues without
// end.
TEST(ArcLength, TheLimitPointDecides) {
  for (const Kind kind : kinds) {
    for (const double below : {0.5, 1e-3, 1e-6, 1e-9, 1e-12}) {
      DenseEquations equations = cubic_equation(limit_load * (1 - below));
      VectorXd x = VectorXd::Zero(1);
      const Report report = find_root(ArcLength{{.kind = kind}}, equations, x);
      ASSERT_TRUE(report.status.ok()) << report.status.text();
      EXPECT_LE(report.last, 4 * eps);
      // The root has an error of rounding over the slope of F, about 2 sqrt(below/3 ...).
      EXPECT_LE(x[0], limit_x - 0.3 * std::sqrt(below * limit_load / limit_x)) << below;
    }
    DenseEquations none = cubic_equation(limit_load * (1 + 1e-9));
    VectorXd x = VectorXd::Zero(1);
    const Report report = find_root(ArcLength{.path = {.kind = kind}, .steps = 60}, none, x);
    EXPECT_EQ(report.status.outcome(), Outcome::step_limit);
    EXPECT_TRUE(tests::holds(report.status.sentence(), "of 1"));
  }
}

// Equations without a potential.
TEST(ArcLength, FollowsAnyEquations) {
  const double exact = std::sqrt(2 + std::sqrt(3.0));
  for (const Kind kind : kinds) {
    DenseEquations circle = classics::circle();
    VectorXd x = vector({2, 1});
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

// A path stays on its branch and finds every limit and bifurcation point that it passes.

/// Branches u = 0, u = gap and u = 2 gap with u = x - sin(load); the outer ones have equal stability.
OneUnknown parallel_branches(double gap) {
  const auto slope = [gap](double x, double load) {
    const double u = x - std::sin(load);
    return 3 * u * u - 6 * gap * u + 2 * gap * gap;
  };
  return {[gap](double x, double load) {
            const double u = x - std::sin(load);
            return u * (u - gap) * (u - 2 * gap);
          },
          slope, [slope](double x, double load) { return -std::cos(load) * slope(x, load); }};
}

// The path stays on its branch for any first step. F has an error of eps; its slope is 2 gap^2.
TEST(Path, StaysOnItsBranch) {
  for (const Kind kind : kinds) {
    for (const double gap : {0.05, 0.2, 0.5}) {
      for (const double first : {0.01, 0.3, 2., 30.}) {
        OneUnknown parallel = parallel_branches(gap);
        Path path({.kind = kind, .first = first}, parallel, VectorXd::Zero(1), 0);
        ASSERT_TRUE(path.start().ok());
        // gdc measures steps in displacements, which vanish where x is stationary.
        const double end = kind == Kind::gdc ? 1.5 : 8;
        for (int k = 0; k < 4000 && path.now().load < end; ++k) {
          const Status status = path.advance();
          ASSERT_TRUE(status.ok()) << gap << ' ' << first << ' ' << status.text();
          ASSERT_NEAR(path.now().x[0], std::sin(path.now().load), 1e-13 / (gap * gap))
              << gap << ' ' << first << ' ' << path.now().load;
        }
        EXPECT_GE(path.now().load, end);
      }
    }
  }
}

/// V = x^4/4 - load x^2/2 - tiny x: from rest the path bends into one side of a pitchfork. The other branch,
/// x = -tiny/load, is unstable and continues straight.
OneUnknown imperfect_pitchfork(double tiny) {
  return {[=](double x, double load) { return x * x * x - load * x - tiny; },
          [](double x, double load) { return 3 * x * x - load; }, [](double x, double) { return -x; }};
}

// The straight continuation is a solution with another number of negative eigenvalues, without a zero
// eigenvalue in between.
TEST(Path, FollowsTheBendAndNotTheBranchStraightAhead) {
  for (const double tiny : {1e-2, 1e-4, 1e-6}) {
    for (const double first : {0.1, 1., 10., 1000.}) {
      OneUnknown fork = imperfect_pitchfork(tiny);
      Path path({.first = first}, fork, VectorXd::Constant(1, tiny), -1);
      ASSERT_TRUE(path.start().ok());
      for (int k = 0; k < 2000 && path.now().load < 1; ++k) {
        ASSERT_TRUE(path.advance().ok());
        EXPECT_EQ(path.now().negative, 0);
        EXPECT_GT(path.now().x[0], 0);
      }
      EXPECT_GE(path.now().load, 1) << tiny << ' ' << first;
    }
  }
}

/// F = -load x - x^3 - tiny: the path from x = tiny/(-load) has one maximum, at x^3 = tiny/2, and turns away
/// there. Straight ahead is the other half of the pitchfork, which is unstable throughout.
OneUnknown imperfect_subcritical(double tiny) {
  return {[=](double x, double load) { return -load * x - x * x * x - tiny; },
          [](double x, double load) { return -load - 3 * x * x; }, [](double x, double) { return -x; }};
}

// For any imperfection and first step: one maximum, in closed form, and no bifurcation.
TEST(Path, TurnsOffAtAnImperfectBifurcation) {
  for (const double tiny : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    for (const double first : {0.01, 0.1, 1., 10.}) {
      OneUnknown fork = imperfect_subcritical(tiny);
      // Load and initial displacement have equal weight: steps become long compared with the displacement.
      Path path({.first = first, .longest = 1e15}, fork, VectorXd::Constant(1, tiny), -1);
      ASSERT_TRUE(path.start().ok());
      std::vector<CriticalPoint> found;
      const Status status = follow(
          path, [](const Path& p) { return p.now().load < -0.5 && p.now().x[0] > 0.5; }, 2000, found);
      ASSERT_TRUE(status.ok()) << tiny << ' ' << first << ' ' << status.text();
      ASSERT_EQ(found.size(), 1u) << tiny << ' ' << first;
      EXPECT_EQ(found[0].kind, CriticalPoint::Kind::maximum);
      const double load = -3 * std::cbrt(tiny * tiny / 4);
      EXPECT_NEAR(found[0].point.load, load, 1e-9 * -load);
    }
  }
}

/// Two unknowns joined by a spring of stiffness 1e14: V = spring (x - y)^2/2 + (1 - load) x^2/2. The entry
/// spring + 1 - load of K has a rounding error of 0.01 in double and 1e-5 in long double of 64 bits.
struct StiffPair : Loaded {
  static constexpr double spring = 1e14;
  [[nodiscard]] Eigen::Index size() const override { return 2; }
  void residual(const VectorXd& x, double load, VectorXd& f) override {
    f.resize(2);
    f << spring * (x[0] - x[1]) + (1 - load) * x[0], -spring * (x[0] - x[1]);
  }
  void linearise(const VectorXd& x, double load) override {
    k.resize(2, 2);
    k << spring + 1 - load, -spring, -spring, spring;
    q.resize(2);
    q << -x[0], 0;
  }
  void load_vector(VectorXd& out) const override { out = q; }
  void matrix(MatrixXd& out) const override { out = k; }
  bool long_matrix(const LongVector&, double load, Eigen::SparseMatrix<long double>& out) override {
    Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic> exact(2, 2);
    const long double stiff = spring;
    exact << stiff + 1 - load, -stiff, -stiff, stiff;
    out = exact.sparseView();
    return true;
  }
  MatrixXd k;
  VectorXd q;
};

// Next to an eigenvalue of 2e14 the sign of the eigenvalue (1 - load)/2 needs long double.
TEST(Path, CountsAnEigenvalueThatTheRoundingOfKHides) {
  if (std::numeric_limits<long double>::digits <= std::numeric_limits<double>::digits) GTEST_SKIP();
  StiffPair pair;
  PathSystem system(pair, VectorXd::Zero(2), 0, VectorXd::Ones(2));
  for (const double off : {1e-1, 1e-2, 1e-3, 1e-4}) {
    for (const double load : {1 - off, 1 + off}) {
      ASSERT_TRUE(system.linearise(system.scaled(VectorXd::Zero(2), load)));
      system.certify();
      EXPECT_EQ(system.inertia().negative, load > 1 ? 1 : 0) << load;
    }
  }
}

/// Two pitchforks at the loads 0 and `apart`: V = (x^4 + z^4)/4 - load x^2/2 - (load - apart) z^2/2 + (y -
/// load)^2/2.
struct TwoPitchforks : Pitchfork {
  [[nodiscard]] Eigen::Index size() const override { return 3; }
  void residual(const VectorXd& x, double load, VectorXd& f) override {
    f.resize(3);
    f << x[0] * x[0] * x[0] - load * x[0], x[1] - load, x[2] * x[2] * x[2] - (load - apart) * x[2];
  }
  void linearise(const VectorXd& x, double load) override {
    at = x;
    k00 = 3 * x[0] * x[0] - load;
    k22 = 3 * x[2] * x[2] - load + apart;
  }
  void load_vector(VectorXd& q) const override {
    q.resize(3);
    q << -at[0], -1, -at[2];
  }
  void matrix(MatrixXd& k) const override {
    k.setIdentity(3, 3);
    k(0, 0) = k00;
    k(2, 2) = k22;
  }
  double apart = 0, k22 = 0;
};

// The path x^2 = load passes the bifurcation, where the load has a minimum and no eigenvalue changes its
// sign.
TEST(Path, FindsAForkFromTheBranchThatLeavesIt) {
  for (const double start : {1., 0.7, 0.31}) {
    Pitchfork pitchfork;
    VectorXd x = vector({start, start * start});
    Path path({.first = 0.1, .turn = 0.15}, pitchfork, x, start * start);
    ASSERT_TRUE(path.start(false).ok());
    std::vector<CriticalPoint> found;
    const Status status = follow(
        path, [](const Path& p) { return p.now().x[0] < -0.5; }, 200, found);
    ASSERT_TRUE(status.ok()) << status.text();
    EXPECT_EQ(path.now().negative, 0);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].kind, CriticalPoint::Kind::bifurcation);
    EXPECT_NEAR(found[0].point.load, 0, 1e-13);
    EXPECT_NEAR(found[0].point.x.norm(), 0, 1e-13);
    EXPECT_EQ(found[0].vanishing, 0);
    EXPECT_EQ(found[0].point.negative, 0);
    EXPECT_NEAR(std::abs(found[0].direction[0]), 1, 1e-12);
    // The other branch is x = 0, y = load.
    for (const double length : {0.05, -0.05}) {
      ASSERT_TRUE(path.switch_branch(found[0].point, found[0].across, length).ok());
      EXPECT_NEAR(path.now().x[0], 0, 1e-13);
      EXPECT_GT(length * path.now().load, 0);
      EXPECT_EQ(path.now().negative, length > 0 ? 1 : 0);
    }
  }
}

TEST(Path, ListsCriticalPoints) {
  Cubic cubic;
  Path path({.first = 0.1}, cubic, VectorXd::Constant(1, -1.2), 0.5);
  ASSERT_TRUE(path.start(false).ok());
  std::vector<CriticalPoint> found;
  const Status status = follow(
      path, [](const Path& p) { return p.now().x[0] > 1.2; }, 200, found);
  ASSERT_TRUE(status.ok()) << status.text();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(to_string(found[0].kind), "minimum");
  EXPECT_EQ(to_string(found[1].kind), "maximum");
  EXPECT_NEAR(found[0].point.load, -limit_load, 4 * eps);
  EXPECT_NEAR(found[1].point.load, limit_load, 4 * eps);
  EXPECT_EQ(follow(
                path, [](const Path&) { return false; }, 3, found)
                .outcome(),
            Outcome::step_limit);
}

// Two eigenvalues vanish at one point, or one after the other within a step: the determinant has the same
// sign before and after.
TEST(Path, ListsTwoBifurcationsInOneStep) {
  for (const double apart : {0., 1e-3, 0.1}) {
    TwoPitchforks forks;
    forks.apart = apart;
    VectorXd start = vector({0, -1, 0});
    Path path({.first = 0.4}, forks, start, -1);
    ASSERT_TRUE(path.start().ok());
    std::vector<CriticalPoint> found;
    ASSERT_TRUE(follow(
                    path, [](const Path& p) { return p.now().load > 1; }, 50, found)
                    .ok());
    Eigen::Index all = 0;
    for (const CriticalPoint& c : found) {
      EXPECT_EQ(to_string(c.kind), "bifurcation");
      all += c.vanishing;
    }
    EXPECT_EQ(all, 2);
    ASSERT_EQ(found.size(), apart == 0 ? 1u : 2u);
    // A double point is accurate to 1e-7 of a step. Eigenvalues that vanish 1e-3 apart are of size 1e-3 in
    // between, which costs the interpolation as many digits.
    const double close = apart == 0 ? 1e-7 : 1e-13 / apart;
    EXPECT_NEAR(found[0].point.load, 0, close);
    EXPECT_NEAR(found.back().point.load, apart, close);
    if (apart == 0) continue;
    EXPECT_NEAR(std::abs(found[0].direction[0]), 1, 1e-9);
    EXPECT_NEAR(std::abs(found[1].direction[2]), 1, 1e-9);
  }
}

/// V = x^4/4 + (load^2 - half^2) x^2/2 + (y - load)^2/2: x = 0 is unstable for |load| < half.
struct Window : Pitchfork {
  explicit Window(double h) : half(h) {}
  void residual(const VectorXd& x, double load, VectorXd& f) override {
    f.resize(2);
    f << x[0] * (x[0] * x[0] + load * load - half * half), x[1] - load;
  }
  void linearise(const VectorXd& x, double load) override {
    at = x;
    k00 = 3 * x[0] * x[0] + load * load - half * half;
    along = 2 * load * x[0];
  }
  void load_vector(VectorXd& q) const override {
    q.resize(2);
    q << along, -1;
  }
  double half, along = 0;
};

// An eigenvalue becomes negative and positive again within a step: both ends have the same signs.
TEST(Path, ListsTwoBifurcationsThatUndoEachOtherInAStep) {
  for (const double half : {0.3, 0.03, 1e-3}) {
    for (const double from : {-1., -0.9, -1.37}) {
      Window window(half);
      VectorXd start = vector({0, from});
      Path path({.first = 0.8}, window, start, from);
      ASSERT_TRUE(path.start().ok());
      std::vector<CriticalPoint> found;
      const Status status = follow(
          path, [](const Path& p) { return p.now().load > 1; }, 50, found);
      ASSERT_TRUE(status.ok()) << half << ' ' << from << ' ' << status.text();
      ASSERT_EQ(found.size(), 2u) << half << ' ' << from;
      EXPECT_NEAR(found[0].point.load, -half, 1e-7);  // two close points: 1e-7 of a step
      EXPECT_NEAR(found[1].point.load, half, 1e-7);
    }
  }
}

}  // namespace
}  // namespace nlmech::algebraic::path_test

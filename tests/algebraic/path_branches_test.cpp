/// A walk stays on its path, and knows all limit and branch points that it passes.
#include <gtest/gtest.h>

#include <vector>

#include "tests/algebraic/paths.hpp"

namespace nlmech::algebraic::path_branches_test {
namespace {

using namespace paths;

/// Branches u = 0, u = gap and u = 2 gap with u = x - sin(load), the outer ones of the same stability.
struct Parallel : Loaded {
  explicit Parallel(double g) : gap(g) {}
  [[nodiscard]] Eigen::Index size() const override { return 1; }
  void residual(const VectorXd& x, double load, VectorXd& f) override {
    const double u = x[0] - std::sin(load);
    f.setConstant(1, u * (u - gap) * (u - 2 * gap));
  }
  void linearise(const VectorXd& x, double load) override {
    const double u = x[0] - std::sin(load);
    slope = 3 * u * u - 6 * gap * u + 2 * gap * gap;
    along = -std::cos(load) * slope;
  }
  void load_vector(VectorXd& q) const override { q.setConstant(1, along); }
  void matrix(MatrixXd& k) const override { k.setConstant(1, 1, slope); }
  double gap, slope = 0, along = 0;
};

// However long the first step, the walk stays on its branch. F is known to eps, its slope is 2 gap^2.
TEST(Path, StaysOnItsBranch) {
  for (const Kind kind : kinds) {
    for (const double gap : {0.05, 0.2, 0.5}) {
      for (const double first : {0.01, 0.3, 2., 30.}) {
        Parallel parallel(gap);
        Path path({.kind = kind, .first = first}, parallel, VectorXd::Zero(1), 0);
        ASSERT_TRUE(path.start().ok());
        // gdc steps by displacements, and has none where x is stationary.
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

/// V = x^4/4 - load x^2/2 - tiny x: from rest the path bends into one side of a pitchfork. The other one,
/// x = -tiny/load and unstable, goes straight on.
struct ImperfectPitchfork : Loaded {
  explicit ImperfectPitchfork(double t) : tiny(t) {}
  [[nodiscard]] Eigen::Index size() const override { return 1; }
  void residual(const VectorXd& x, double load, VectorXd& f) override {
    f.setConstant(1, x[0] * x[0] * x[0] - load * x[0] - tiny);
  }
  void linearise(const VectorXd& x, double load) override {
    slope = 3 * x[0] * x[0] - load;
    along = -x[0];
  }
  void load_vector(VectorXd& q) const override { q.setConstant(1, along); }
  void matrix(MatrixXd& k) const override { k.setConstant(1, 1, slope); }
  double tiny, slope = 0, along = 0;
};

// Straight ahead lies a solution with another number of negative eigenvalues and no point between where one
// vanishes.
TEST(Path, FollowsTheBendAndNotTheBranchStraightAhead) {
  for (const double tiny : {1e-2, 1e-4, 1e-6}) {
    for (const double first : {0.1, 1., 10., 1000.}) {
      ImperfectPitchfork fork(tiny);
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

/// F = -load x - x^3 - tiny: the path from x = tiny/(-load) has one maximum, at x^3 = tiny/2, and turns off
/// there. Straight ahead lies the other half of the pitchfork, which is unstable throughout.
struct ImperfectSubcritical : Loaded {
  explicit ImperfectSubcritical(double t) : tiny(t) {}
  [[nodiscard]] Eigen::Index size() const override { return 1; }
  void residual(const VectorXd& x, double load, VectorXd& f) override {
    f.setConstant(1, -load * x[0] - x[0] * x[0] * x[0] - tiny);
  }
  void linearise(const VectorXd& x, double load) override {
    slope = -load - 3 * x[0] * x[0];
    along = -x[0];
  }
  void load_vector(VectorXd& q) const override { q.setConstant(1, along); }
  void matrix(MatrixXd& k) const override { k.setConstant(1, 1, slope); }
  double tiny, slope = 0, along = 0;
};

// Whatever the imperfection and the first step: one maximum, in closed form, and no bifurcation.
TEST(Path, TurnsOffAtAnImperfectBifurcation) {
  for (const double tiny : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    for (const double first : {0.01, 0.1, 1., 10.}) {
      ImperfectSubcritical fork(tiny);
      // The load counts as much as the small displacement of the start: steps become long beside it.
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

/// Two unknowns that a spring of stiffness 1e14 joins: V = spring (x - y)^2/2 + (1 - load) x^2/2. In double
/// the entry spring + 1 - load of K is rounded by 0.01, in long double of 64 bits by 1e-5.
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

// The eigenvalue (1 - load)/2 beside one of 2e14 has its sign from long double.
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

/// Two pitchforks at once: V = (x^4 + z^4)/4 - load (x^2 + z^2)/2 + (y - load)^2/2.
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

// Along x^2 = load and through the fork, where the load has a minimum and no eigenvalue changes its sign.
TEST(Path, FindsAForkFromTheBranchThatLeavesIt) {
  for (const double start : {1., 0.7, 0.31}) {
    Pitchfork pitchfork;
    VectorXd x(2);
    x << start, start * start;
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

// Two eigenvalues vanish in one place, or one behind the other within a step: the determinant has the same
// sign before and behind.
TEST(Path, ListsTwoBifurcationsInOneStep) {
  for (const double apart : {0., 1e-3, 0.1}) {
    TwoPitchforks forks;
    forks.apart = apart;
    VectorXd start(3);
    start << 0, -1, 0;
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
    // One place is 1e-7 of a step. Eigenvalues that vanish 1e-3 apart are 1e-3 by themselves in between,
    // which costs the interpolation as many digits.
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

// An eigenvalue dips below zero and returns within a step: both ends have the same signs.
TEST(Path, ListsTwoBifurcationsThatUndoEachOtherInAStep) {
  for (const double half : {0.3, 0.03, 1e-3}) {
    for (const double from : {-1., -0.9, -1.37}) {
      Window window(half);
      VectorXd start(2);
      start << 0, from;
      Path path({.first = 0.8}, window, start, from);
      ASSERT_TRUE(path.start().ok());
      std::vector<CriticalPoint> found;
      const Status status = follow(
          path, [](const Path& p) { return p.now().load > 1; }, 50, found);
      ASSERT_TRUE(status.ok()) << half << ' ' << from << ' ' << status.text();
      ASSERT_EQ(found.size(), 2u) << half << ' ' << from;
      EXPECT_NEAR(found[0].point.load, -half, 1e-7);  // two next to each other: 1e-7 of a step
      EXPECT_NEAR(found[1].point.load, half, 1e-7);
    }
  }
}

}  // namespace
}  // namespace nlmech::algebraic::path_branches_test

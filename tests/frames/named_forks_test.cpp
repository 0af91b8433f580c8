/// Branch points of frames described by names: where they are, what is counted there, and where branches end.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "tests/frames/named_walks.hpp"

namespace nlmech::frames::named_forks_test {
namespace {

using namespace walks;
constexpr double pi = std::numbers::pi;

// Straight, the column has a negative eigenvalue for each of Euler's loads k^2 (1 + k^2 pi^2/EA) below its
// own, also where a walk ends within a step that goes on past the next of them.
TEST(NamedForks, TheEndCountsItsOwnNegativeEigenvalues) {
  const NamedFrame f = build(models::column(1e6), 4);
  for (const auto& [until, below] : {std::pair{1.5, 1}, {2., 1}, {3., 1}, {3.99, 1}, {6., 2}, {9.5, 3}}) {
    const FramePoint last = paths_of(f, {.until = until}).points.back();
    EXPECT_EQ(last.load, until);
    EXPECT_EQ(last.negative, below) << until;
  }
}

// Two equal columns side by side, which nothing joins: both buckle at once.
TEST(NamedForks, AtADoubleBifurcationTwoEigenvaluesVanishAndNoBranchIsFollowed) {
  const FramePaths paths = paths_of(build(columns({1}), 4), {.until = 2, .branches = 4});
  const auto forks = only(paths, Kind::bifurcation);
  ASSERT_EQ(forks.size(), 1u);
  EXPECT_NEAR(forks[0].load, 1, 2e-5);  // pi^2/EA and m^-2
  EXPECT_EQ(forks[0].vanishing, 2);
  EXPECT_EQ(forks[0].negative, 0);
  EXPECT_EQ(paths.points.back().negative, 2);
  EXPECT_EQ(paths.branches, 0);
  EXPECT_EQ(paths.unfollowed, 0);
}

// A rigid column on a foot that a level spring of stiffness 1 holds: leaning at an angle a it bears cos a.
// Its branch goes all the way round, through the fork of the column that hangs, and ends where it began.
TEST(NamedForks, ABranchThatReturnsFindsTheForksOnItsWay) {
  FrameModel m;
  m.nodes = {{"foot", 0, 0}, {"top", 0, 1}, {"anchor", 2, 0}};
  m.members = {models::bar("foot", "top"), models::bar("foot", "anchor")};
  m.members[0].ea = 1e6;
  m.members[1].ea = 2;
  m.supports = {{"foot", Motion::y}, {"top", Motion::x}};
  models::pin(m, "anchor");
  m.loads = {{"top", Motion::y, -1}};
  const NamedFrame f = build(m, 1);
  const FramePaths paths = paths_of(f, {.branches = 1});
  ASSERT_EQ(paths.branches, 1);
  const auto forks = only(paths, Kind::bifurcation, 1);
  ASSERT_EQ(forks.size(), 3u);
  const double limit = (1 - 1e-6);  // cos a but for the column's compression, P/EA
  for (const std::size_t i : {0u, 1u, 2u}) {
    EXPECT_NEAR(forks[i].load, i == 1 ? -limit : limit, 1e-9);  // rounding of EA
    EXPECT_EQ(forks[i].negative, 0);
    EXPECT_EQ(forks[i].vanishing, 1);
  }
  EXPECT_NEAR(forks[1].x[unknown_of(f, "top.y")], -2, 2e-6);
  EXPECT_EQ(paths.unfollowed, 2);  // both ways of the column that hangs
  EXPECT_TRUE(only(paths, Kind::maximum, 1).empty());
  EXPECT_TRUE(only(paths, Kind::minimum, 1).empty());
  for (const FramePoint& p : only(paths, Kind::step, 1))
    EXPECT_NEAR(p.load, 1 + p.x[unknown_of(f, "top.y")], 3e-6);
}

// Columns of 1, 1.9, 3.6 and 6.9 times the stiffness that nothing joins buckle one after the other, each
// before twice the load of the one before: the end is that of the second, the last within twice the first.
TEST(NamedForks, TheEndIsNotPutOffByEachFurtherFork) {
  const FramePaths paths = paths_of(build(columns({1.9, 3.6, 6.9}), 2));
  EXPECT_NEAR(paths.points.back().load, 3.8, 1e-2);  // pi^2/EA and m^-2
  EXPECT_EQ(paths.points.back().negative, 3);
}

// A clamped column of one element buckles at (pi/2)^2 and (3 pi/2)^2, by stability functions exactly. At (2
// pi)^2 its element buckles between its ends, which has a pole of the stiffness there and no fork of the
// frame.
TEST(NamedForks, TheBucklingOfAnElementIsNoFork) {
  FrameModel m;
  m.nodes = {{"base", 0, 0}, {"top", 0, 1}};
  m.members = {{.first = "base", .second = "top", .ea = 1e9, .ei = 1}};
  models::clamp(m, "base");
  m.loads = {{"top", Motion::y, -1}};
  const NamedFrame f = build(m, 1);
  const FramePaths paths = equilibrium_paths(f, {.until = 130});
  EXPECT_EQ(paths.status.outcome(), Outcome::wrong_branch);
  EXPECT_NE(paths.status.text().find("clamped buckling load"), std::string::npos) << paths.status.text();
  const auto forks = only(paths, Kind::bifurcation);
  ASSERT_EQ(forks.size(), 2u);
  EXPECT_NEAR(forks[0].load, pi * pi / 4, 1e-6);  // P/EA
  EXPECT_NEAR(forks[1].load, 9 * pi * pi / 4, 1e-6);
  for (const FramePoint& p : paths.points) EXPECT_LT(p.load, 4 * pi * pi);
  EXPECT_EQ(paths.points.back().negative, 2);
}

// A clamped column that stands askew, so that its straight path is straight but for rounding: EA eps over the
// soft stiffness sideways is as long as a hundredth of a step.
TEST(NamedForks, ASlenderColumnAskewBucklesAsUpright) {
  for (const double angle : {0., 0.3, 0.52, 1.2, 2.9}) {
    for (const double ea : {1e5, 1e6, 1e7}) {
      FrameModel m;
      m.nodes = {{"base", 0, 0}, {"top", std::sin(angle), std::cos(angle)}};
      m.members = {{.first = "base", .second = "top", .ea = ea, .ei = 1}};
      models::clamp(m, "base");
      m.loads = {{"top", Motion::x, -std::sin(angle)}, {"top", Motion::y, -std::cos(angle)}};
      const auto forks = only(paths_of(build(m, 8), {.until = 5}), Kind::bifurcation);
      ASSERT_EQ(forks.size(), 1u) << angle << ' ' << ea;
      const double euler = pi * pi / 4;
      EXPECT_NEAR(forks[0].load, 2 * euler / (1 + std::sqrt(1 - 4 * euler / ea)),
                  0.1 / ea + 1e-8);  // m^-2 P/EA
    }
  }
}

// Two columns side by side, one stiffer by 1e-5: while the first bends, the other one buckles at its own
// load, which the first has reached before it has bent by a hundredth.
TEST(NamedForks, ABranchPointNextToTheBeginningOfABranch) {
  const FramePaths paths = paths_of(build(columns({1 + 1e-5}), 4), {.until = 1.01, .branches = 2});
  ASSERT_EQ(paths.branches, 2);
  const auto forks = only(paths, Kind::bifurcation);
  ASSERT_EQ(forks.size(), 2u);
  EXPECT_NEAR(forks[1].load - forks[0].load, 1e-5, 1e-9);
  for (const int branch : {1, 2}) {
    const auto found = only(paths, Kind::bifurcation, branch);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[1].load, forks[1].load, 1e-10);
    EXPECT_EQ(found[1].negative, 0);
    EXPECT_EQ(paths.points.back().negative, 1);
  }
}

}  // namespace
}  // namespace nlmech::frames::named_forks_test

/// Equilibrium paths of named frames: limit points, bifurcation points and branches.
#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "nlmech/frames/loaded_frame.hpp"
#include "nlmech/frames/named/frame_paths.hpp"
#include "nlmech/frames/named/mesh_error.hpp"
#include "nlmech/frames/toggle.hpp"
#include "tests/frames/named_models.hpp"
#include "tests/thrown.hpp"

namespace nlmech::frames::named_paths_test {
namespace {

using namespace models;
constexpr double pi = std::numbers::pi;

/// The loads of the limit points.
std::vector<double> limits_of(const FrameModel& model, int elements) {
  const FramePaths paths = paths_of(build(model, elements));
  std::vector<double> loads;
  for (const FramePoint& p : paths.points) {
    if (p.kind == Kind::maximum || p.kind == Kind::minimum) loads.push_back(p.load);
  }
  EXPECT_GE(loads.size(), 2u);
  loads.resize(2);
  return loads;
}

// Tolerance: half a unit of the last digit, and rounding errors of 1e-10 for 20 elements.
// oracle: homotopy_frames Lee's frame of * limit, Lee's frame of * lower limit
TEST(NamedPaths, LeesFrameSnapsThroughAndBack) {
  for (const auto& [share, high, low] :
       {std::tuple{1, 1.8559563314, -0.9412607899}, std::tuple{2, 1.8556922898, -0.9414308972},
        std::tuple{4, 1.8556739134, -0.9414420703}}) {
    const std::vector<double> loads = limits_of(models::lee(), share);
    EXPECT_NEAR(loads[0], high, 2e-10);
    EXPECT_NEAR(loads[1], low, 2e-10);
  }
  // The displacement of the load increases to about 61, decreases below 51, and increases again.
  const NamedFrame f = build(models::lee(), 4);
  const Eigen::Index at = unknown_of(f, "load.y");
  double farthest = 0, back = HUGE_VAL, last = 0;
  for (const FramePoint& p : paths_of(f).points) {
    last = -p.x[at];
    if (last > 55 && back == HUGE_VAL) farthest = std::max(farthest, last);
    if (farthest > 60 && last < 55) back = std::min(back, last);
  }
  EXPECT_NEAR(farthest, 60.99, 0.3);  // from steps of the path, not refined
  EXPECT_NEAR(back, 50.8, 0.3);
  EXPECT_GT(last, 90);
}

/// Expects equilibrium and a zero eigenvalue by Eigen's dense solver. @returns its eigenvector
Eigen::VectorXd singular_shape(const NamedFrame& f, const FramePoint& p) {
  LoadedFrame equations(f.frame, f.load);
  Eigen::VectorXd r(f.frame.size());
  equations.residual(p.x, p.load, r);
  EXPECT_LT(r.cwiseAbs().maxCoeff(), 1e-6);  // forces are up to 30
  equations.linearise(p.x, p.load);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(Eigen::MatrixXd(*equations.sparse()));
  Eigen::Index at = 0;
  EXPECT_LT(spectrum.eigenvalues().cwiseAbs().minCoeff(&at), 1e-10 * spectrum.eigenvalues().maxCoeff());
  return spectrum.eigenvectors().col(at);
}

// The branch leaves the symmetric path near 27.0, is antisymmetric, and returns to it at the second
// bifurcation; its two halves are mirror images.
TEST(NamedPaths, TheAntisymmetricBranchOfTheShallowArch) {
  const NamedFrame f = build(models::arch(models::shallow_arch), 16);
  const FramePaths paths = paths_of(f, {.branches = 8});
  EXPECT_EQ(paths.branches, 2);
  EXPECT_EQ(paths.unfollowed, 0);
  const std::vector<FramePoint> forks = only(paths, Kind::bifurcation);
  ASSERT_EQ(forks.size(), 2u);
  EXPECT_NEAR(forks[0].load, 27.0, 0.15);  // between two steps of the path with v = 0.74 and 0.76
  const Eigen::Index down = unknown_of(f, "crown.y"), sideways = unknown_of(f, "crown.x");
  EXPECT_NEAR(-forks[0].x[down], 0.75, 0.01);
  EXPECT_LT(-forks[1].x[down], 0.96);
  for (const FramePoint& fork : forks) {
    const Eigen::VectorXd v = singular_shape(f, fork);
    EXPECT_NEAR(v[down], 0, 1e-6);
    EXPECT_GT(std::abs(v[sideways]), 1e-3);
  }
  std::vector<double> sums(3);
  for (const int branch : {1, 2}) {
    const std::vector<FramePoint> ends = only(paths, Kind::bifurcation, branch);
    ASSERT_EQ(ends.size(), 2u);
    EXPECT_EQ(ends[0].load, forks[0].load);
    EXPECT_EQ(ends[1].load, forks[1].load);
    double most = 0;
    for (const FramePoint& p : only(paths, Kind::step, branch)) {
      EXPECT_LT(p.load, forks[0].load);
      EXPECT_GT(p.load, forks[1].load);
      EXPECT_NE(p.x[sideways], 0);
      if (std::abs(p.x[sideways]) > std::abs(most)) most = p.x[sideways];
    }
    sums[static_cast<std::size_t>(branch)] = most;
  }
  EXPECT_LT(sums[1] * sums[2], 0);
}

// W = 2 EA (1/l - 1/L) (h - d) has the limit load 2 EA (1 - (b/L)^(2/3))^(3/2), at l = (b^2 L)^(1/3).
TEST(NamedPaths, TrussOfTwoBars) {
  const NamedFrame f = build(models::truss(), 1);
  const FramePaths paths = paths_of(f);
  const Eigen::Index at = unknown_of(f, "apex.y");
  const double h = 0.5, length = std::hypot(1, h),
               limit = 2 * std::pow(1 - std::pow(1 / length, 2. / 3), 1.5);
  for (const FramePoint& p : paths.points) {
    const double rise = h + p.x[at], now = std::hypot(1, rise);
    EXPECT_NEAR(p.load, 2 * (1 / now - 1 / length) * rise, 1e-12);
  }
  const auto top = only(paths, Kind::maximum), bottom = only(paths, Kind::minimum);
  ASSERT_EQ(top.size(), 1u);
  ASSERT_EQ(bottom.size(), 1u);
  EXPECT_NEAR(top[0].load, limit, 1e-14);
  EXPECT_NEAR(bottom[0].load, -limit, 1e-14);
  const double rise = std::sqrt(std::pow(length, 2. / 3) - 1);
  EXPECT_NEAR(top[0].x[at], rise - h, 1e-9);
}

// Buckling of a bar with axial strain: P (1 - P/EA) = pi^2 EI/l^2.
TEST(NamedPaths, EulersLoads) {
  for (const double ea : {1e4, 1e6, 1e9}) {
    const auto expected = [&](int mode) {
      const double euler = pi * pi * mode * mode;
      return 2 * euler / (1 + std::sqrt(1 - 4 * euler / ea)) / (pi * pi);
    };
    // The discretisation error of the elements is due to the axial strain: P/EA m^-2, next term m^-4.
    std::vector<FramePoint> forks[2];
    for (const int k : {0, 1}) {
      forks[k] = only(paths_of(build(models::column(ea), 16 << k), {.until = 10}), Kind::bifurcation);
      ASSERT_EQ(forks[k].size(), 3u);
    }
    for (const int mode : {1, 2, 3}) {
      const auto i = static_cast<std::size_t>(mode) - 1;
      EXPECT_EQ(forks[0][i].negative, mode - 1);
      EXPECT_NEAR((4 * forks[1][i].load - forks[0][i].load) / 3, expected(mode),
                  1e-8 * std::pow(mode, 6) + 1e-9)
          << ea;
    }
  }
}

// Postbuckling: P/P_1 = (2 K(sin(a/2))/pi)^2 with the rotation a of the ends (Euler 1744).
TEST(NamedPaths, TheBentColumnIsEulersElastica) {
  double errors[2] = {};
  for (const int k : {0, 1}) {
    const NamedFrame f = build(models::column(1e7), 10 << k);
    const FramePaths paths = paths_of(f, {.until = 1.6, .branches = 2});
    ASSERT_EQ(paths.branches, 2);
    const Eigen::Index turn = unknown_of(f, "base.rotation");
    for (const int branch : {1, 2}) {
      for (const FramePoint& p : only(paths, Kind::step, branch)) {
        EXPECT_EQ(p.negative, 0);
        const double a = p.x[turn], k1 = 2 * std::comp_ellint_1(std::sin(std::abs(a) / 2)) / pi;
        errors[k] = std::max(errors[k], std::abs(p.load / (k1 * k1) - 1));
      }
    }
  }
  EXPECT_LT(errors[0], 3e-4);
  EXPECT_LT(errors[1], 0.3 * errors[0] + 2e-6);  // m^-2, and P/EA
}

// Every element bends to the same arc; rotations and the closed polygon of chords are exact: 1e-12. At half
// the moment the distance of the tip from the base is a diameter 2/pi; the chords are too long by m^-4 of
// that.
TEST(NamedPaths, TheCantileverRollsUpToACircle) {
  for (const int elements : {5, 20}) {
    const NamedFrame f = build(models::cantilever(1e6), elements);
    const FramePoint last = paths_of(f, {.until = 1}).points.back();
    EXPECT_EQ(last.load, 1);
    EXPECT_NEAR(last.x[unknown_of(f, "tip.x")], -1, 1e-12);
    EXPECT_NEAR(last.x[unknown_of(f, "tip.y")], 0, 1e-12);
    EXPECT_NEAR(last.x[unknown_of(f, "tip.rotation")], 2 * pi, 1e-12);
  }
  const NamedFrame f = build(models::cantilever(1e6), 100);
  const FramePoint half = paths_of(f, {.until = 0.5}).points.back();
  EXPECT_NEAR(half.x[unknown_of(f, "tip.x")], -1, 1e-8);
  EXPECT_NEAR(half.x[unknown_of(f, "tip.y")], 2 / pi, 1e-8);
}

// Sway buckling of a portal with clamped columns and a beam, all of equal stiffness and length: k cot k = -6,
// P = k^2.
TEST(NamedPaths, ThePortalSways) {
  const auto portal = [](double ea) {
    FrameModel m;
    m.nodes = {{"a", 0, 0}, {"b", 0, 1}, {"c", 1, 1}, {"d", 1, 0}};
    for (const auto& [p, q] : {std::pair{"a", "b"}, {"b", "c"}, {"c", "d"}})
      m.members.push_back({.first = p, .second = q, .ea = ea, .ei = 1});
    models::clamp(m, "a");
    models::clamp(m, "d");
    m.loads = {{"b", Motion::y, -1}, {"c", Motion::y, -1}};
    return build(m, 4);
  };
  double low = 2, high = 3;
  for (int i = 0; i < 60; ++i) {
    const double k = (low + high) / 2;
    (k / std::tan(k) > -6 ? low : high) = k;
  }
  const NamedFrame stiff = portal(1e9), soft = portal(1e4);
  const auto forks = only(paths_of(stiff, {.until = 10}), Kind::bifurcation);
  ASSERT_GE(forks.size(), 1u);
  EXPECT_NEAR(forks[0].load, low * low, 1e-6);  // P/EA
  const FramePaths paths = paths_of(soft, {.until = 10, .branches = 1});
  ASSERT_EQ(paths.branches, 1);
  const auto bent = only(paths, Kind::step, 1);
  EXPECT_GT(std::abs(bent.back().x[unknown_of(soft, "b.x")]), 0.1);
}

// The same frame with another order of nodes, members, and ends of members.
TEST(NamedPaths, NumberingDoesNotMatter) {
  std::mt19937 random(7);
  for (const FrameModel& model : {models::lee(), models::arch(models::shallow_arch)}) {
    const auto known = paths_of(build(model, 4)).points;
    for (int trial = 0; trial < 4; ++trial) {
      FrameModel other = model;
      std::shuffle(other.nodes.begin(), other.nodes.end(), random);
      std::shuffle(other.members.begin(), other.members.end(), random);
      for (NamedMember& m : other.members) {
        if (random() % 2 == 0) continue;
        std::swap(m.first, m.second);
        m.radius = -m.radius;
      }
      std::size_t next = 0;
      for (const FramePoint& p : paths_of(build(other, 4)).points) {
        if (p.kind == Kind::step) continue;
        while (next < known.size() && known[next].kind == Kind::step) ++next;
        ASSERT_LT(next, known.size());
        EXPECT_EQ(p.kind, known[next].kind);
        EXPECT_NEAR(p.load, known[next].load, 1e-8 * std::abs(p.load));
        EXPECT_EQ(p.negative, known[next].negative);
        ++next;
      }
    }
  }
}

// 5000 unknowns. Errors of Lee's frame decrease as m^-4: the reference is extrapolated from 10 and 20
// elements, next order 1e-7.
// oracle: homotopy_frames Lee's frame of 10 limit
TEST(NamedPaths, FiveThousandUnknowns) {
  const NamedFrame f = build(models::lee(), 167);
  EXPECT_GT(f.frame.size(), 5000);
  const FramePaths paths = paths_of(f);
  ASSERT_EQ(only(paths, Kind::maximum).size(), 1u);
  EXPECT_NEAR(only(paths, Kind::maximum)[0].load, 1.8556739134 + (1.8556739134 - 1.8556922898) / 15, 2e-7);
}

TEST(NamedPaths, EndWhereTheyAreTold) {
  const NamedFrame f = build(models::lee(), 1);
  const FramePaths until = paths_of(f, {.until = 0.5});
  EXPECT_EQ(until.points.back().load, 0.5);
  EXPECT_EQ(until.points.front().load, 0);
  const FramePaths few = equilibrium_paths(f, {.steps = 3});
  EXPECT_EQ(few.status.outcome(), Outcome::step_limit);
  EXPECT_EQ(few.points.size(), 4u);
  const FramePaths short_of = equilibrium_paths(f, {.steps = 3, .until = 0.5});
  EXPECT_EQ(short_of.status.outcome(), Outcome::step_limit);
  EXPECT_FALSE(short_of.points.empty());
  const FramePaths past = paths_of(f, {.until = 2});
  EXPECT_EQ(past.points.back().load, 2);
  EXPECT_EQ(only(past, Kind::minimum).size(), 1u);
  EXPECT_THROW((void)equilibrium_paths(f, {.steps = 0}), std::invalid_argument);
  EXPECT_THROW((void)equilibrium_paths(f, {.until = 0}), std::invalid_argument);
}

// ---- Bifurcation points of named frames: places, counts of negative eigenvalues, and ends of branches.

// The straight column has one negative eigenvalue for each Euler load k^2 (1 + k^2 pi^2/EA) below its load,
// also if the path ends within a step that passes a further Euler load.
TEST(NamedForks, TheEndCountsItsOwnNegativeEigenvalues) {
  const NamedFrame f = build(models::column(1e6), 4);
  for (const auto& [until, below] : {std::pair{1.5, 1}, {2., 1}, {3., 1}, {3.99, 1}, {6., 2}, {9.5, 3}}) {
    const FramePoint last = paths_of(f, {.until = until}).points.back();
    EXPECT_EQ(last.load, until);
    EXPECT_EQ(last.negative, below) << until;
  }
}

// Two equal unconnected columns buckle at the same load.
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

// A rigid column whose foot is held by a horizontal spring of stiffness 1: at the angle a it carries cos a.
// Its branch passes the bifurcation of the hanging column and returns to its start.
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
  const double limit = (1 - 1e-6);  // cos a, reduced by the axial strain P/EA of the column
  for (const std::size_t i : {0u, 1u, 2u}) {
    EXPECT_NEAR(forks[i].load, i == 1 ? -limit : limit, 1e-9);  // rounding error of EA
    EXPECT_EQ(forks[i].negative, 0);
    EXPECT_EQ(forks[i].vanishing, 1);
  }
  EXPECT_NEAR(forks[1].x[unknown_of(f, "top.y")], -2, 2e-6);
  EXPECT_EQ(paths.unfollowed, 2);  // both directions at the hanging column
  EXPECT_TRUE(only(paths, Kind::maximum, 1).empty());
  EXPECT_TRUE(only(paths, Kind::minimum, 1).empty());
  for (const FramePoint& p : only(paths, Kind::step, 1))
    EXPECT_NEAR(p.load, 1 + p.x[unknown_of(f, "top.y")], 3e-6);
}

// Unconnected columns of stiffness 1, 1.9, 3.6 and 6.9 buckle one after the other, each before twice the load
// of the one before. The path ends at twice the second load; the last bifurcation within twice the first load
// is the second.
TEST(NamedForks, TheEndIsNotPutOffByEachFurtherFork) {
  const FramePaths paths = paths_of(build(columns({1.9, 3.6, 6.9}), 2));
  EXPECT_NEAR(paths.points.back().load, 3.8, 1e-2);  // pi^2/EA and m^-2
  EXPECT_EQ(paths.points.back().negative, 3);
}

// A clamped column of one element buckles at (pi/2)^2 and (3 pi/2)^2, exactly by stability functions. At (2
// pi)^2 its element buckles between its ends: the stiffness has a pole there, and the frame has no
// bifurcation.
TEST(NamedForks, TheBucklingOfAnElementIsNoFork) {
  FrameModel m;
  m.nodes = {{"base", 0, 0}, {"top", 0, 1}};
  m.members = {{.first = "base", .second = "top", .ea = 1e9, .ei = 1}};
  models::clamp(m, "base");
  m.loads = {{"top", Motion::y, -1}};
  const NamedFrame f = build(m, 1);
  const FramePaths paths = equilibrium_paths(f, {.until = 130});
  EXPECT_EQ(paths.status.outcome(), Outcome::wrong_branch);
  EXPECT_TRUE(tests::holds(paths.status.text(), "clamped buckling load"));
  const auto forks = only(paths, Kind::bifurcation);
  ASSERT_EQ(forks.size(), 2u);
  EXPECT_NEAR(forks[0].load, pi * pi / 4, 1e-6);  // P/EA
  EXPECT_NEAR(forks[1].load, 9 * pi * pi / 4, 1e-6);
  for (const FramePoint& p : paths.points) EXPECT_LT(p.load, 4 * pi * pi);
  EXPECT_EQ(paths.points.back().negative, 2);
}

// A clamped inclined column, whose path is straight up to rounding errors: EA eps over the lateral stiffness
// is as long as a hundredth of a step.
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

// Two unconnected columns, one stiffer by 1e-5: on the branch of the first the other one buckles at its own
// load, which is reached before the first has bent by a hundredth.
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

// ---- Columns that buckle against a spring, and toggles and arches with an asymmetric apex.

/// A hinged column whose top is held by a long bar that acts as a spring.
struct Sprung {
  double length, spring, ea, ei,
      far;  ///< length of the column; stiffness of the spring; EA and EI of the column; length of the bar
  double bar_ei = 1e9;

  [[nodiscard]] FrameModel model() const {
    FrameModel m;
    m.nodes = {{"base", 0, 0}, {"top", 0, length}, {"far", far, length}};
    m.members = {{.first = "base", .second = "top", .ea = ea, .ei = ei},
                 {.first = "top",
                  .second = "far",
                  .ea = spring * far,
                  .ei = bar_ei,
                  .is_first_pinned = true,
                  .is_second_pinned = true}};
    models::pin(m, "base");
    models::pin(m, "far");
    m.loads = {{"top", Motion::y, -1}};
    return m;
  }
  /// P = k l (1 - P/EA): moment equilibrium of load and spring about the base. The bar is inclined by the
  /// shortening of the column and extended by v^2/(2 far), which reduces P by Koiter's factor 1 - 3/2
  /// e^(2/3).
  [[nodiscard]] double critical() const {
    const double load = spring * length / (1 + spring * length / ea), drop = load * length / ea;
    const double imperfection = drop * drop / (2 * far * length);
    return load * (1 - 1.5 * std::pow(imperfection, 2. / 3));
  }
};

/// Points of a path, except steps, within a tenth of the load @p around.
std::vector<FramePoint> criticals(const NamedFrame& frame, const PathOptions& walk, double around) {
  std::vector<FramePoint> some;
  for (const FramePoint& p : equilibrium_paths(frame, walk).points) {
    if (p.kind != Kind::step && std::abs(p.load - around) < around / 10) some.push_back(p);
  }
  return some;
}

void expect_one_point(const Sprung& sprung, int elements, const PathOptions& walk) {
  const auto points = criticals(build(sprung.model(), elements), walk, sprung.critical());
  ASSERT_EQ(points.size(), 1u) << sprung.ei << ' ' << sprung.far << ' ' << elements;
  EXPECT_NE(points[0].kind, Kind::minimum);
  // Koiter's next term, and the digits lost at a bifurcation that an imperfection of 1e-16 splits.
  EXPECT_NEAR(points[0].load, sprung.critical(), 1e-6 * sprung.critical())
      << sprung.ei << ' ' << sprung.far << ' ' << elements;
}

// The stiffness has eigenvalues up to 1e10, and one of about 100 changes its sign: it is found once, with
// every mesh and every first step.
TEST(SprungColumns, TipOverOnceWhateverTheStiffnessesAndTheMesh) {
  for (const double ei : {1e6, 1e8, 1e9}) {
    for (const double far : {60., 600., 6e4}) {
      for (const int elements : {1, 2, 3, 8}) {
        expect_one_point({6, 10, 1e9, ei, far}, elements, {.until = 90});
        expect_one_point({6, 10, 1e9, ei, far}, elements, {});
      }
    }
  }
}

TEST(SprungColumns, TheEndDoesNotMatter) {
  for (const double until : {1500., 2500., 5000.}) {
    expect_one_point({10, 120, 2.9e7, 2.9e10, 1e5, 1e12}, 2, {.until = until});
    expect_one_point({10, 120, 2.9e7, 2.9e10, 300, 1e12}, 2, {.until = until});
    expect_one_point({10, 120, 2.9e7, 2.9e10, 1000, 1e12}, 1, {.until = until});
  }
}

// Members with EA = EI = 1e10 and more and a spring of 10: double precision gives the eigenvalue that changes
// its sign to less than seven digits.
TEST(SprungColumns, TipOverOnceWhereDoubleDoesNotTellTheSpring) {
  if (std::numeric_limits<long double>::digits <= std::numeric_limits<double>::digits) GTEST_SKIP();
  for (const double stiff : {1e10, 1e11}) {
    for (const double far : {6., 60., 6e3}) {
      for (const int elements : {1, 3, 4, 8}) {
        if (stiff > 1e10 && elements > 4) continue;  // may fail: KNOWN_ISSUES.md
        expect_one_point({6, 10, stiff, stiff, far}, elements, {.until = 75});
      }
    }
  }
}

// The bar buckles when it is shortened by pi^2 EI/far, and becomes straight again. References: two straight
// bars, Newton's iteration in 34 digits for the equilibrium with that shortening and for the limit load.
TEST(SprungColumns, BuckleTheBarAndHangFromItsLimitLoad) {
  const Sprung sprung{10, 120, 2.9e7, 2.9e10, 1e5, 1e12};
  const FramePaths paths = paths_of(build(sprung.model(), 1), {.until = 1300});
  const auto forks = only(paths, Kind::bifurcation), minima = only(paths, Kind::minimum);
  ASSERT_EQ(forks.size(), 3u);
  ASSERT_EQ(minima.size(), 1u);
  // A load is converged to 1e-6 of the largest load.
  EXPECT_NEAR(forks[0].load, sprung.critical(), 1e-6 * 1300);
  EXPECT_NEAR(forks[1].load, 682.42161433067, 1e-6 * 1300);
  EXPECT_NEAR(forks[2].load, -682.32727680827, 1e-6 * 1300);
  EXPECT_NEAR(minima[0].load, -1193.8210755524, 1e-6 * 1300);
}

/// A frame in which one node is moved to (x, y), with four elements per member.
NamedFrame moved(FrameModel m, const std::string& node, double x, double y) {
  for (NamedNode& n : m.nodes) {
    if (n.name == node) n.x = x, n.y = y;
  }
  return build(m, 4);
}

/// The whole toggle as a model.
FrameModel toggle_model(const Toggle& t) {
  const double half = std::sqrt(t.length * t.length - t.height * t.height);
  FrameModel m;
  m.nodes = {{"left", -half, 0}, {"apex", 0, t.height}, {"right", half, 0}};
  m.members = {{.first = "left", .second = "apex", .ea = t.ea, .ei = t.ei},
               {.first = "apex", .second = "right", .ea = t.ea, .ei = t.ei}};
  models::clamp(m, "left");
  models::clamp(m, "right");
  m.loads = {{"apex", Motion::y, -1}};
  return m;
}

// Near the bifurcation of the symmetric toggle the maximum decreases with the 2/3 power of the imperfection
// (Koiter); the next term has the 4/3 power.
TEST(ImperfectToggles, LoseByTwoThirdsFromTheBifurcation) {
  const Toggle steep{.height = 0.9, .length = std::hypot(12.932517156377562, 0.9)};
  const auto perfect = criticals(moved(toggle_model(steep), "apex", 0, 0.9), {}, 141);
  ASSERT_FALSE(perfect.empty());
  double share = 0;
  for (const double off : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
    for (const double turn : {0.15, 0.05}) {
      const auto points =
          criticals(moved(toggle_model(steep), "apex", off, 0.9), {.steps = 600, .turn = turn}, 141);
      ASSERT_EQ(points.size(), 1u) << off << ' ' << turn;
      EXPECT_EQ(points[0].kind, Kind::maximum);
      const double lost = (perfect.front().load - points[0].load) / std::pow(off, 2. / 3);
      if (share > 0) {
        EXPECT_NEAR(lost, share, 0.03 * share) << off << ' ' << turn;
      }
      if (share == 0) share = lost;
    }
  }
}

// ---- Estimated errors of meshes against closed forms and the elastica.

constexpr double no_limit = std::numeric_limits<double>::infinity();

struct Estimated {
  FramePaths paths;
  std::vector<std::optional<double>> errors;
  /// Estimated error of the first point of a kind.
  [[nodiscard]] double of(FramePoint::Kind kind) const {
    for (std::size_t i = 0; i < errors.size(); ++i) {
      if (paths.points[i].kind == kind) return errors[i].value_or(NAN);
    }
    return NAN;
  }
};

Estimated estimated(const FrameModel& model, int elements, const PathOptions& walk) {
  const NamedFrame frame = build(model, elements);
  const int others = second_mesh(elements, frame.members.size());
  const NamedFrame second = build(model, others);
  Estimated e{equilibrium_paths(frame, walk), {}};
  e.errors = mesh_errors(
      {frame, e.paths, second, equilibrium_paths(second, walk), mesh_factor(elements, others)}, no_limit);
  return e;
}

/// Expects that the estimate of a relative error is within a factor of 2.
void expect_error(double estimate, double value, double exact) {
  const double error = std::abs(value / exact - 1);
  EXPECT_GE(estimate, error / 2) << value;
  EXPECT_LE(estimate, error * 2) << value;
}

/// A quarter of a ring of radius 1 with symmetry conditions, pinched by a force of 2: each half carries 1.
FrameModel quarter_ring() {
  FrameModel m;
  m.nodes = {{"top", 0, 1}, {"side", 1, 0}};
  m.members = {{.first = "top", .second = "side", .ea = 1e9, .ei = 1, .radius = 1}};
  m.supports = {
      {"top", Motion::x}, {"top", Motion::rotation}, {"side", Motion::y}, {"side", Motion::rotation}};
  m.loads = {{"top", Motion::y, -1}};
  return m;
}

// Timoshenko, Strength of Materials: the two loaded points approach each other by P R^3/EI (pi/4 - 2/pi),
// each by half of that. Under a load of 1e-6 the ring is linear to 1e-6.
TEST(MeshError, OfAPinchedRing) {
  for (const int elements : {2, 3, 4, 8, 16}) {
    const Estimated e = estimated(quarter_ring(), elements, {.until = 1e-6});
    const NamedFrame frame = build(quarter_ring(), elements);
    ASSERT_EQ(frame.motions[0].name, "top.y");
    expect_error(e.errors.back().value_or(NAN), -e.paths.points.back().x[frame.motions[0].unknown] / 1e-6,
                 pi / 4 - 2 / pi);
  }
}

// Timoshenko and Gere: the ends of a simple beam under w and an axial force P turn by w/(2 P) (tan(k/2)/(k/2)
// - 1), k^2 = P/EI. Its one free end moves by P l/EA, which any mesh has.
TEST(MeshError, OfRotations) {
  for (const double p : {5., 9.}) {
    FrameModel m;
    m.nodes = {{"A", 0, 0}, {"B", 1, 0}};
    m.members = {{.first = "A", .second = "B", .ea = 1e6, .ei = 1}};
    m.supports = {{"A", Motion::x}, {"A", Motion::y}, {"B", Motion::y}};
    constexpr double w = 1e-6;
    m.loads = {{"B", Motion::x, -p, true}, {"A-B", Motion::y, -w}};
    const double half = std::sqrt(p * (1 + p / 1e6)) / 2;
    for (const int elements : {1, 2, 4}) {
      const Estimated e = estimated(m, elements, {.until = 1});
      const Eigen::VectorXd& x = e.paths.points.back().x;
      expect_error(e.errors.back().value_or(NAN), -x[unknown_of(build(m, elements), "A.rotation")],
                   w / (2 * p) * (std::tan(half) / half - 1));
    }
  }
}

// Limit loads of the toggle against the exact elastica.
TEST(MeshError, OfAToggle) {
  const Toggle toggle{.height = 0.44};
  constexpr double limit = 42.4397755886;  // oracle: homotopy_elastica elastica 0.44 maximum
  for (const int elements : {1, 2, 3, 4, 8}) {
    const Estimated e = estimated(toggle_model(toggle), elements, {});
    ASSERT_TRUE(e.paths.status.ok());
    expect_error(e.of(FramePoint::Kind::maximum), only(e.paths, FramePoint::Kind::maximum)[0].load, limit);
  }
}

// Bars without bending are exact: only rounding errors remain.
TEST(MeshError, OfATrussIsRounding) {
  const Estimated e = estimated(models::truss(), 1, {});
  for (const auto& error : e.errors) {
    ASSERT_TRUE(error);
    EXPECT_LE(*error, 1e-12);
  }
}

// A column so soft that it would shorten by half before it buckles: EA < 4 pi^2 EI/l^2, so P (1 - P/EA) =
// pi^2 has no solution. Eight elements give two spurious bifurcations, twelve give none.
TEST(MeshError, OfPointsThatAnotherMeshDoesNotHaveIsAll) {
  FrameModel m;
  m.nodes = {{"base", 0, 0}, {"top", 0, 1}};
  m.members = {{.first = "base", .second = "top", .ea = 39, .ei = 1}};
  m.supports = {{"base", Motion::x}, {"base", Motion::y}, {"top", Motion::x}};
  m.loads = {{"top", Motion::y, -1}};
  const Estimated e = estimated(m, 8, {.until = 30});
  EXPECT_EQ(only(e.paths, FramePoint::Kind::bifurcation).size(), 2U);
  EXPECT_EQ(e.of(FramePoint::Kind::bifurcation), 1);
}

TEST(MeshError, TheSecondMesh) {
  EXPECT_EQ(second_mesh(1, 2), 3);
  EXPECT_EQ(second_mesh(4, 8), 6);
  EXPECT_EQ(second_mesh(3000, 3000), 2000);
  EXPECT_DOUBLE_EQ(mesh_factor(4, 6), 1.8);
  EXPECT_DOUBLE_EQ(mesh_factor(3, 2), 0.8);
}

}  // namespace
}  // namespace nlmech::frames::named_paths_test

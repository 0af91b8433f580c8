/// Paths of frames described by names, with their limit and branch points and the branches that leave them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include "nlmech/frames/loaded_frame.hpp"
#include "nlmech/frames/named/frame_paths.hpp"
#include "tests/frames/named_walks.hpp"

namespace nlmech::frames::named_paths_test {
namespace {

using namespace walks;
constexpr double pi = std::numbers::pi;

/// The loads of the first limit points.
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

// Half a unit of the last digit and the rounding floor of 1e-10 for 20 elements.
// oracle: homotopy_frames Lee's frame of * limit, Lee's frame of * lower limit
TEST(NamedPaths, LeesFrameSnapsThroughAndBack) {
  for (const auto& [share, high, low] :
       {std::tuple{1, 1.8559563314, -0.9412607899}, std::tuple{2, 1.8556922898, -0.9414308972},
        std::tuple{4, 1.8556739134, -0.9414420703}}) {
    const std::vector<double> loads = limits_of(models::lee(), share);
    EXPECT_NEAR(loads[0], high, 2e-10);
    EXPECT_NEAR(loads[1], low, 2e-10);
  }
  // The displacement of the load grows to some 61, comes back to below 51, and grows again.
  const NamedFrame f = build(models::lee(), 4);
  const Eigen::Index at = unknown_of(f, "load.y");
  double farthest = 0, back = HUGE_VAL, last = 0;
  for (const FramePoint& p : paths_of(f).points) {
    last = -p.x[at];
    if (last > 55 && back == HUGE_VAL) farthest = std::max(farthest, last);
    if (farthest > 60 && last < 55) back = std::min(back, last);
  }
  EXPECT_NEAR(farthest, 60.99, 0.3);  // places of steps, not refined
  EXPECT_NEAR(back, 50.8, 0.3);
  EXPECT_GT(last, 90);
}

/// Is it an equilibrium, with a vanishing eigenvalue by Eigen's dense solver? Then its vector.
Eigen::VectorXd singular_shape(const NamedFrame& f, const FramePoint& p) {
  LoadedFrame equations(f.frame, f.load);
  Eigen::VectorXd r(f.frame.size());
  equations.residual(p.x, p.load, r);
  EXPECT_LT(r.cwiseAbs().maxCoeff(), 1e-6);  // of forces of 30
  equations.linearise(p.x, p.load);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(Eigen::MatrixXd(*equations.sparse()));
  Eigen::Index at = 0;
  EXPECT_LT(spectrum.eigenvalues().cwiseAbs().minCoeff(&at), 1e-10 * spectrum.eigenvalues().maxCoeff());
  return spectrum.eigenvectors().col(at);
}

// The branch leaves the symmetric path near 27.0, is antisymmetric, and returns to it at the second
// bifurcation; both halves are mirror images.
TEST(NamedPaths, TheAntisymmetricBranchOfTheShallowArch) {
  const NamedFrame f = build(models::arch(models::shallow_arch), 16);
  const FramePaths paths = paths_of(f, {.branches = 8});
  EXPECT_EQ(paths.branches, 2);
  EXPECT_EQ(paths.unfollowed, 0);
  const std::vector<FramePoint> forks = only(paths, Kind::bifurcation);
  ASSERT_EQ(forks.size(), 2u);
  EXPECT_NEAR(forks[0].load, 27.0, 0.15);  // between two places of a walk with v = 0.74 and 0.76
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

// W = 2 EA (1/l - 1/L) (h - d): its limit is 2 EA (1 - (b/L)^(2/3))^(3/2), at l = (b^2 L)^(1/3).
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

// A bar that stretches while it bends buckles where P (1 - P/EA) = pi^2 EI/l^2.
TEST(NamedPaths, EulersLoads) {
  for (const double ea : {1e4, 1e6, 1e9}) {
    const auto expected = [&](int mode) {
      const double euler = pi * pi * mode * mode;
      return 2 * euler / (1 + std::sqrt(1 - 4 * euler / ea)) / (pi * pi);
    };
    // Elements are exact but for what the compression changes: errors of P/EA m^-2, the next ones m^-4.
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

// Behind the bifurcation: P/P_1 = (2 K(sin(a/2))/pi)^2 with the rotation a of the ends (Euler 1744).
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

// Every element bends to the same arc, and rotations and the closed polygon of chords are exact: 1e-12. Half
// rolled up, the tip is a diameter 2/pi from the base; chords are too long by m^-4 of that.
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

// Sway of a portal with clamped columns and a beam, all of one stiffness and length: k cot k = -6, P = k^2.
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

// The same frame with nodes, members, and the ends of members in another order.
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

// 5000 unknowns. Errors of Lee's frame fall like m^-4: the limit is that of 10 and of 20 elements
// extrapolated, the next order 1e-7. oracle: homotopy_frames Lee's frame of 10 limit
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

}  // namespace
}  // namespace nlmech::frames::named_paths_test

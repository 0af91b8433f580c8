/// Frames some of whose motions are given, and frames with imperfections.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "nlmech/frames/loaded_frame.hpp"
#include "nlmech/frames/named/frame_paths.hpp"
#include "tests/frames/named_walks.hpp"

namespace nlmech::frames::named_given_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Kind = FramePoint::Kind;
using walks::unknown_of;

/// The model with the displacement of its first load given, instead of the load.
FrameModel driven(FrameModel m, double value) {
  m.displacements = {{m.loads[0].node, m.loads[0].motion, value}};
  m.loads.clear();
  return m;
}

double force_at(const NamedFrame& f, const FramePoint& p, Eigen::Index at) {
  VectorXd forces;
  EXPECT_TRUE(f.frame.force<double>(p.x, forces).ok());
  return forces[at];
}

// W = 2 EA (1/l - 1/L) (h - d) all the way through both limit points of the load, without one of the
// displacement.
TEST(GivenDisplacements, TheTrussNeedsTheForceOfItsClosedForm) {
  const NamedFrame f = build(driven(models::truss(), -1), 1);
  const FramePaths paths = equilibrium_paths(f, {.until = 1.2});
  ASSERT_TRUE(paths.status.ok()) << paths.status.text();
  EXPECT_EQ(paths.points.back().load, 1.2);
  const Eigen::Index at = unknown_of(f, "apex.y");
  const double h = 0.5, length = std::hypot(1, h);
  for (const FramePoint& p : paths.points) {
    EXPECT_EQ(p.kind, Kind::step);
    EXPECT_EQ(p.negative, 0);
    EXPECT_EQ(p.x[at], -p.load);
    const double rise = h - p.load, now = std::hypot(1, rise);
    EXPECT_NEAR(force_at(f, p, at), -2 * (1 / now - 1 / length) * rise, 1e-12);
  }
}

// Lee's frame under a given displacement of its load stops where that displacement turns back: at a limit
// point of its own, with the load of the path under the load there. Both are found to rounding, and the
// displacement there is stationary along the path of the load: the least of both paths' distances is that of
// their steps squared.
TEST(GivenDisplacements, LeesFrameSnapsBackAtALimitPointOfTheDisplacement) {
  const NamedFrame by_load = build(models::lee(), 1), by_motion = build(driven(models::lee(), -1), 1);
  const FramePaths forces = equilibrium_paths(by_load, {.steps = 2000, .until = 2, .turn = 0.01}),
                   motions = equilibrium_paths(by_motion, {.steps = 400, .until = 70, .turn = 0.05});
  ASSERT_TRUE(forces.status.ok());
  const Eigen::Index at = unknown_of(by_load, "load.y");
  double farthest = 0, load = 0;
  for (const FramePoint& p : forces.points) {
    if (-p.x[at] < farthest) break;
    farthest = -p.x[at];
    load = p.load;
  }
  const auto limit = std::find_if(motions.points.begin(), motions.points.end(),
                                  [](const FramePoint& p) { return p.kind == Kind::maximum; });
  ASSERT_NE(limit, motions.points.end());
  EXPECT_GE(limit->load, farthest - 1e-9);
  EXPECT_NEAR(limit->load, farthest, 0.01);
  EXPECT_NEAR(-force_at(by_motion, *limit, at), load, 0.05);
  // Before it the paths are the same: at the displacement 20, by interpolation between steps of either.
  const auto at_twenty = [](const std::vector<FramePoint>& points, const auto& place, const auto& value) {
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double a = place(points[i - 1]), b = place(points[i]);
      if (a <= 20 && b > 20)
        return value(points[i - 1]) + (20 - a) / (b - a) * (value(points[i]) - value(points[i - 1]));
    }
    return HUGE_VAL;
  };
  const double one = at_twenty(
      forces.points, [&](const FramePoint& p) { return -p.x[at]; },
      [](const FramePoint& p) { return p.load; });
  const double other = at_twenty(
      motions.points, [](const FramePoint& p) { return p.load; },
      [&](const FramePoint& p) { return -force_at(by_motion, p, at); });
  EXPECT_NEAR(one, other, 5e-3);
}

TEST(GivenDisplacements, DerivativesAreThoseOfTheResidual) {
  FrameModel m = models::lee();
  m.displacements = {{"corner", Motion::rotation, 0.3}, {"end", Motion::rotation, -0.2}};
  const NamedFrame f = build(m, 1);
  LoadedFrame equations(f);
  ASSERT_EQ(equations.size(), f.frame.size() - 2);
  VectorXd x(equations.size()), plus, minus, column;
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = 0.05 * std::sin(1. + static_cast<double>(i));
  const double load = 0.7, h = 1e-6;
  equations.linearise(x, load);
  MatrixXd k;
  equations.matrix(k);
  equations.load_vector(column);
  const double size = k.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    VectorXd moved = x;
    moved[i] += h;
    equations.residual(moved, load, plus);
    moved[i] -= 2 * h;
    equations.residual(moved, load, minus);
    EXPECT_LT(((plus - minus) / (2 * h) - k.col(i)).cwiseAbs().maxCoeff(), 1e-8 * size);
  }
  equations.residual(x, load + h, plus);
  equations.residual(x, load - h, minus);
  EXPECT_LT(((plus - minus) / (2 * h) - column).cwiseAbs().maxCoeff(), 1e-8 * size);
  // Given motions are at their places.
  const VectorXd all = equations.whole(x, load);
  EXPECT_EQ(all[unknown_of(f, "corner.rotation")], load * 0.3);
  EXPECT_EQ(equations.free(all), x);
}

TEST(GivenDisplacements, AreRefusedWhereTheyContradict) {
  const auto expect = [](const FrameModel& m, ModelPart part, const std::string& words) {
    try {
      (void)build(m, 1);
      ADD_FAILURE() << words;
    } catch (const ModelError& error) {
      EXPECT_EQ(error.part(), part);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  const FrameModel good = driven(models::truss(), -1);
  FrameModel m = good;
  m.displacements.push_back(m.displacements[0]);
  expect(m, ModelPart::displacements, "apex.y stands twice");
  m = good;
  m.displacements[0].node = "left";
  expect(m, ModelPart::displacements, "left.y, which is held");
  m = good;
  m.displacements[0].value = NAN;
  expect(m, ModelPart::displacements, "apex.y = nan");
  m = good;
  m.displacements[0].value = 0;
  expect(m, ModelPart::loads, "no load");
  m = good;
  m.loads = {{"apex", Motion::y, 1}};
  expect(m, ModelPart::loads, "whose displacement is given");
  // What is given is held: a bar that could swing stands, and a load elsewhere is borne.
  m = {};
  m.nodes = {{"a", 0, 0}, {"b", 1, 0}};
  m.members = {{.first = "a", .second = "b", .ea = 1, .ei = 1}};
  models::pin(m, "a");
  m.displacements = {{"b", Motion::y, 0.1}};
  EXPECT_EQ(build(m, 1).given.size(), 1u);
  m.displacements.clear();
  m.loads = {{"b", Motion::y, 1}};
  EXPECT_THROW((void)build(m, 1), ModelError);
}

/// A rigid column whose foot slides and is held by a brace to an anchor.
FrameModel braced(double x, double y) {
  FrameModel m;
  m.nodes = {{"foot", 0, 0}, {"top", 0, 1}, {"anchor", x, y}};
  m.members = {models::bar("foot", "top"), models::bar("foot", "anchor")};
  m.members[0].ea = 1e6;
  m.supports = {{"foot", Motion::y}, {"top", Motion::x}};
  models::pin(m, "anchor");
  m.loads = {{"top", Motion::y, -1}};
  return m;
}

FramePoint first_limit(const NamedFrame& f) {
  const FramePaths paths = equilibrium_paths(f, {.critical = 1});
  EXPECT_TRUE(paths.status.ok()) << paths.status.text();
  EXPECT_EQ(paths.points.back().kind, Kind::maximum);
  return paths.points.back();
}

// A level brace: P = k L' cos(a) (1 - sin(a0)/sin(a)), greatest at (1 - sin(a0)^(2/3))^(3/2). The column
// shortens by P/EA = 1e-6.
TEST(Imperfections, ALevelBraceLosesByTwoThirds) {
  const NamedFrame perfect = build(braced(1, 0), 1);
  for (const double e : {0.1, 0.01, -0.01, 1e-4}) {
    const Imperfect f = imperfect(perfect, {.mode = 1, .amplitude = e});
    ASSERT_TRUE(f.status.ok()) << f.status.text();
    EXPECT_EQ(f.buckled.kind, Kind::bifurcation);
    EXPECT_NEAR(f.buckled.load, 1 / (1 + 1e-6), 1e-10);
    EXPECT_DOUBLE_EQ(f.frame.frame.nodes()[0].x, e);
    EXPECT_NEAR(f.frame.frame.nodes()[1].y, 1, 1e-9 * std::abs(e));
    const double column = std::hypot(1, e), sine = std::abs(e) / column;
    EXPECT_NEAR(first_limit(f.frame).load, column / (1 - e) * std::pow(1 - std::pow(sine, 2. / 3), 1.5),
                3e-6);
  }
}

// 45 degrees: 1 - P/P_c = 2 sqrt(0.75 e), the next term e (Koiter).
TEST(Imperfections, AnInclinedBraceLosesByTheRoot) {
  const NamedFrame perfect = build(braced(1, -1), 1);
  for (const double e : {1e-3, 1e-4, 1e-5}) {
    const Imperfect f = imperfect(perfect, {.mode = 1, .amplitude = e});
    ASSERT_TRUE(f.status.ok()) << f.status.text();
    EXPECT_NEAR(f.buckled.load, std::sqrt(0.125), 1e-6);
    EXPECT_NEAR(1 - first_limit(f.frame).load / f.buckled.load, 2 * std::sqrt(0.75 * e), 3 * e);
  }
  // The other way there is no limit point at that load.
  const Imperfect other = imperfect(perfect, {.mode = 1, .amplitude = -0.01});
  const FramePaths paths = equilibrium_paths(other.frame, {.until = 0.38});
  EXPECT_TRUE(std::none_of(paths.points.begin(), paths.points.end(),
                           [](const FramePoint& p) { return p.kind != Kind::step; }));
}

// The modes of Euler's column are sines, and the second has its node in the middle.
TEST(Imperfections, ModesOfAColumn) {
  const NamedFrame perfect = build(models::column(1e6), 4);
  for (const int mode : {1, 2}) {
    const Imperfect f = imperfect(perfect, {.mode = mode, .amplitude = 0.01});
    ASSERT_TRUE(f.status.ok()) << f.status.text();
    double most = 0;
    for (std::size_t i = 0; i < f.frame.frame.nodes().size(); ++i) {
      const Node &now = f.frame.frame.nodes()[i], &before = perfect.frame.nodes()[i];
      EXPECT_NEAR(std::abs(now.x), std::abs(0.01 * std::sin(mode * std::acos(-1.) * before.y)), 1e-8);
      EXPECT_NEAR(now.y, before.y, 1e-8);
      most = std::max(most, std::abs(now.x));
    }
    EXPECT_NEAR(most, 0.01, 1e-15);
  }
  EXPECT_THROW((void)imperfect(perfect, {.mode = 0, .amplitude = 1}), std::invalid_argument);
  EXPECT_THROW((void)imperfect(perfect, {.mode = 1, .amplitude = NAN}), std::invalid_argument);
  const Imperfect none =
      imperfect(build(models::cantilever(1e6), 2), {.mode = 1, .amplitude = 1}, {.steps = 5});
  EXPECT_EQ(none.status.outcome(), Outcome::not_converged);
  EXPECT_NE(none.status.sentence().find("0 limit and branch points in 5 steps"), std::string::npos)
      << none.status.text();
}

}  // namespace
}  // namespace nlmech::frames::named_given_test

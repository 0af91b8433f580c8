/// Named frames: refusals, arcs, pinned ends, loads, prescribed displacements, imperfections, motion in time.
#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "nlmech/algebraic/newton/energy_trust_region.hpp"
#include "nlmech/frames/equilibrium.hpp"
#include "nlmech/frames/loaded_frame.hpp"
#include "nlmech/frames/named/frame_model.hpp"
#include "nlmech/frames/named/frame_motion.hpp"
#include "nlmech/frames/named/frame_paths.hpp"
#include "tests/frames/named_models.hpp"
#include "tests/thrown.hpp"

namespace nlmech::frames::named_test {
namespace {

using Eigen::VectorXd;
using models::clamp;
using models::pin;

TEST(NamedFrames, ArcsHaveTheirNodesOnTheCircle) {
  for (const models::Arch& arch : {models::shallow_arch, models::deep_arch}) {
    const NamedFrame named = build(models::arch(arch), 8);
    ASSERT_EQ(named.frame.nodes().size(), 17U);
    std::vector<double> angles;
    for (const Node& n : named.frame.nodes()) {
      EXPECT_NEAR(std::hypot(n.x, n.y + arch.radius), arch.radius, 1e-13 * arch.radius);
      angles.push_back(std::atan2(n.x, n.y + arch.radius) * 180 / std::numbers::pi);
    }
    std::sort(angles.begin(), angles.end());
    for (std::size_t i = 0; i < angles.size(); ++i)
      EXPECT_NEAR(angles[i], arch.half_angle * (static_cast<double>(i) / 8 - 1), 1e-11 * arch.half_angle);
  }
}

TEST(NamedFrames, MirroredArcsAreExactMirrorImages) {
  const NamedFrame named = build(models::arch(models::shallow_arch), 7);
  std::vector<Node> all = named.frame.nodes();
  for (const Node& n : all)
    EXPECT_TRUE(
        std::any_of(all.begin(), all.end(), [&](const Node& m) { return m.x == -n.x && m.y == n.y; }));
}

// Linear theory: the deflection under a load P at the middle of a beam is P l^3/(192 EI) with clamped ends,
// 7/768 of P l^3/EI with one pinned end, 1/48 with both ends pinned. The load is so small that nonlinear
// terms are 1e-12.
TEST(NamedFrames, PinnedEndsOfABeam) {
  const auto deflection = [](bool left, bool right) {
    FrameModel m = models::beam(left, right);
    const NamedFrame f = build(m, 3);
    Equilibrium equations(f.frame, f.load, 1e-6);
    VectorXd x = VectorXd::Zero(f.frame.size());
    EXPECT_TRUE(find_root(algebraic::EnergyTrustRegion{}, equations, x).status.ok());
    const auto at = std::find_if(f.motions.begin(), f.motions.end(),
                                 [](const NamedMotion& n) { return n.name == "middle.y"; });
    return -x[at->unknown] * 1e6;
  };
  EXPECT_NEAR(deflection(false, false), 1. / 192, 1e-10);
  EXPECT_NEAR(deflection(true, false), 7. / 768, 1e-10);
  EXPECT_NEAR(deflection(true, true), 1. / 48, 1e-10);
}

// A node that joins pinned ends only has no rotation and cannot carry a moment.
TEST(NamedFrames, ANodeOfPinnedEndsHasNoRotation) {
  FrameModel m = models::truss();
  const NamedFrame f = build(m, 1);
  EXPECT_EQ(f.frame.unknown(1, Motion::rotation), -1);
  EXPECT_EQ(f.motions.size(), 2u);
  EXPECT_EQ(f.frame.size(), 6);  // plus four rotations of member ends
  m.loads.push_back({"apex", Motion::rotation, 1});
  EXPECT_THROW((void)build(m, 1), ModelError);
}

/// The error of a model that is refused.
template <class Build>
ModelError refusal(const Build& build_it) {
  try {
    (void)build_it();
  } catch (const ModelError& error) {
    return error;
  }
  return {ModelPart::nodes, 99, "not refused"};
}
ModelError refusal_of(const FrameModel& m, int elements = 2) {
  return refusal([&] { return build(m, elements); });
}
void expect_refused(const FrameModel& m, ModelPart part, std::size_t index, const std::string& words) {
  const ModelError error = refusal_of(m);
  EXPECT_EQ(error.part(), part) << error.what();
  EXPECT_EQ(error.index(), index) << error.what();
  EXPECT_TRUE(tests::holds(error.what(), words));
}

TEST(NamedFrames, RefuseWhatMakesNoFrame) {
  const FrameModel good = models::beam(false, false);
  (void)build(good, 2);
  EXPECT_THROW((void)build(good, 0), std::invalid_argument);
  const auto with = [&](const auto& change) {
    FrameModel m = good;
    change(m);
    return m;
  };
  using M = FrameModel;
  expect_refused({}, ModelPart::nodes, 0, "no nodes");
  expect_refused(with([](M& m) { m.members.clear(); }), ModelPart::members, 0, "no members");
  expect_refused(with([](M& m) { m.loads.clear(); }), ModelPart::loads, 0, "no load");
  expect_refused(with([](M& m) { m.loads[0].value = NAN; }), ModelPart::loads, 0, "middle.y = nan");
  expect_refused(with([](M& m) { m.nodes[2].x = HUGE_VAL; }), ModelPart::nodes, 2, "right");
  expect_refused(with([](M& m) { m.nodes[2].name = "left"; }), ModelPart::nodes, 2, "is given twice");
  expect_refused(with([](M& m) { m.nodes[2].x = 0; }), ModelPart::nodes, 2, "position of node left");
  expect_refused(with([](M& m) { m.nodes.push_back({"alone", 5, 5}); }), ModelPart::nodes, 3, "alone has no");
  expect_refused(with([](M& m) { m.members[1].second = "rihgt"; }), ModelPart::members, 1, "no node rihgt");
  expect_refused(with([](M& m) { m.members[1].second = "middle"; }), ModelPart::members, 1, "to itself");
  expect_refused(with([](M& m) { m.members[0].ea = 0; }), ModelPart::members, 0, "EA = 0");
  expect_refused(with([](M& m) { m.members[0].ei = -1; }), ModelPart::members, 0, "EI = -1");
  expect_refused(with([](M& m) { m.members[0].radius = 0.1; }), ModelPart::members, 0, "does not span");
  expect_refused(with([](M& m) { m.members[0].elements = 1 << 30; }), ModelPart::members, 0, "more than");
  expect_refused(with([](M& m) { m.nodes[1].x = 4.9e-324, m.nodes[1].y = 0; }), ModelPart::members, 0,
                 "are too short for the rounding");
  expect_refused(with([](M& m) { m.supports[0].node = "x"; }), ModelPart::supports, 0, "no node x");
  expect_refused(with([](M& m) { m.loads[0].node = "left"; }), ModelPart::loads, 0, "left.y, which is fixed");
}

// Mechanisms, and the node that the message names.
TEST(NamedFrames, RefuseMechanisms) {
  FrameModel free = models::beam(false, false);
  free.supports.clear();
  expect_refused(free, ModelPart::nodes, 0, "can move along");
  FrameModel rolling = models::beam(false, false);
  rolling.supports = {{"left", Motion::y}, {"right", Motion::y}};
  EXPECT_TRUE(tests::holds(refusal_of(rolling).what(), "along x"));
  FrameModel apart = models::beam(false, false);
  apart.nodes.push_back({"p", 3, 3});
  apart.nodes.push_back({"q", 4, 3});
  apart.members.push_back({"p", "q", 1, 1});
  EXPECT_GE(refusal_of(apart).index(), 3u);
  EXPECT_LE(refusal_of(apart).index(), 4u);
  // Two collinear pinned bars: the middle node can move transversely without strain to first order.
  FrameModel line = models::truss();
  line.nodes[1].y = 0;
  expect_refused(line, ModelPart::nodes, 1, "apex can move along y");
  // A square of pinned bars.
  FrameModel square;
  square.nodes = {{"a", 0, 0}, {"b", 0, 1}, {"c", 1, 1}, {"d", 1, 0}};
  square.members = {models::bar("a", "b"), models::bar("b", "c"), models::bar("c", "d")};
  pin(square, "a");
  pin(square, "d");
  square.loads = {{"b", Motion::y, -1}};
  EXPECT_THROW((void)build(square, 1), ModelError);
  square.members.push_back(models::bar("a", "c"));
  (void)build(square, 1);
}

// Soft frames are no mechanisms: a cantilever of a thousand members, whose softest mode has 1e-12 of the
// energy of a single node's displacement, and one with a ratio of 1e-12 between bending and axial stiffness.
TEST(NamedFrames, SoftFramesAreAccepted) {
  FrameModel m;
  constexpr int members = 1000;
  for (int i = 0; i <= members; ++i) m.nodes.push_back({std::to_string(i), 0.001 * i, 0});
  for (int i = 0; i < members; ++i) m.members.push_back({std::to_string(i), std::to_string(i + 1), 1e6, 1});
  clamp(m, "0");
  m.loads = {{std::to_string(members), Motion::y, -1}};
  (void)build(m, 1);
  m.supports.pop_back();  // the rotation
  EXPECT_THROW((void)build(m, 1), ModelError);
  FrameModel stiff = models::beam(false, false);
  for (NamedMember& member : stiff.members) member.ea = 1e12;
  (void)build(stiff, 4);
}

// Stiffnesses and lengths of very different sizes make no mechanism, and hide none.
TEST(NamedFrames, MechanismsDoNotDependOnStiffness) {
  for (const double length : {1e-8, 1e-6, 1e-4, 1.}) {
    for (const double spring : {1e-40, 1., 1e40}) {
      FrameModel m;
      m.nodes = {{"a", 0, 0}, {"b", length, 0}, {"c", 1 + length, 0}, {"d", 1 + 2 * length, 0}};
      m.members = {{.first = "a", .second = "b", .ea = 1e4, .ei = 1},
                   {.first = "b", .second = "c", .ea = 1, .ei = 1e-9},
                   {.first = "c", .second = "d", .ea = 1e4, .ei = 1e9}};
      m.springs = {{.first = "", .second = "d", .y = 1, .stiffness = spring}};
      m.loads = {{"c", Motion::y, -1}};
      pin(m, "a");
      (void)build(m, 1);
      m.springs[0].turns = true;
      (void)build(m, 1);
      if (length < 1e-5) continue;  // rounding hides the mechanism of so short a bar
      m.members[0].is_second_pinned = true;
      EXPECT_TRUE(tests::holds(refusal_of(m).what(), "along y"));
      m.springs[0].turns = false;
      EXPECT_TRUE(tests::holds(refusal_of(m).what(), "mechanism"));
    }
  }
}

// ---- Frames with prescribed displacements, and frames with imperfections.

using Eigen::MatrixXd;
using Kind = FramePoint::Kind;
using models::unknown_of;

/// The model with a prescribed displacement instead of its first load.
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

// W = 2 EA (1/l - 1/L) (h - d) through both limit points of the load; the displacement has none.
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

// Lee's frame with a prescribed displacement at its load has a limit point of that displacement, at the same
// load as on the path under load control. Both are found to rounding. On the latter path the displacement is
// stationary there, so the largest displacement of its steps has an error of second order in the step.
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
  // Before the limit point both paths agree: at the displacement 20, by interpolation between steps.
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
  // Prescribed displacements have their values.
  const VectorXd all = equations.whole(x, load);
  EXPECT_EQ(all[unknown_of(f, "corner.rotation")], load * 0.3);
  EXPECT_EQ(equations.free(all), x);
}

TEST(GivenDisplacements, AreRefusedWhereTheyContradict) {
  const auto expect = [](const FrameModel& m, ModelPart part, const std::string& words) {
    const ModelError error = refusal_of(m, 1);
    EXPECT_EQ(error.part(), part);
    EXPECT_TRUE(tests::holds(error.what(), words));
  };
  const FrameModel good = driven(models::truss(), -1);
  FrameModel m = good;
  m.displacements.push_back(m.displacements[0]);
  expect(m, ModelPart::displacements, "apex.y is given twice");
  m = good;
  m.displacements[0].node = "left";
  expect(m, ModelPart::displacements, "left.y, which is fixed");
  m = good;
  m.displacements[0].value = NAN;
  expect(m, ModelPart::displacements, "apex.y = nan");
  m = good;
  m.displacements[0].value = 0;
  expect(m, ModelPart::loads, "no load");
  m = good;
  m.loads = {{"apex", Motion::y, 1}};
  expect(m, ModelPart::loads, "whose displacement is given");
  // A prescribed displacement acts as a support: a hinged bar is no mechanism, and a load elsewhere is
  // carried.
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

/// A rigid column with a sliding foot that a brace holds to an anchor.
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

// A horizontal brace: P = k L' cos(a) (1 - sin(a0)/sin(a)), with maximum at (1 - sin(a0)^(2/3))^(3/2). The
// column shortens by P/EA = 1e-6.
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

// Brace at 45 degrees: 1 - P/P_c = 2 sqrt(0.75 e), next term e (Koiter).
TEST(Imperfections, AnInclinedBraceLosesByTheRoot) {
  const NamedFrame perfect = build(braced(1, -1), 1);
  for (const double e : {1e-3, 1e-4, 1e-5}) {
    const Imperfect f = imperfect(perfect, {.mode = 1, .amplitude = e});
    ASSERT_TRUE(f.status.ok()) << f.status.text();
    EXPECT_NEAR(f.buckled.load, std::sqrt(0.125), 1e-6);
    EXPECT_NEAR(1 - first_limit(f.frame).load / f.buckled.load, 2 * std::sqrt(0.75 * e), 3 * e);
  }
  // For the opposite sign there is no limit point at that load.
  const Imperfect other = imperfect(perfect, {.mode = 1, .amplitude = -0.01});
  const FramePaths paths = equilibrium_paths(other.frame, {.until = 0.38});
  EXPECT_TRUE(std::none_of(paths.points.begin(), paths.points.end(),
                           [](const FramePoint& p) { return p.kind != Kind::step; }));
}

// The buckling modes of Euler's column are sines; the second has its node at the middle.
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
  EXPECT_TRUE(tests::holds(none.status.sentence(), "0 limit and branch points in 5 steps"));
}

// ---- Motion of frames in time: frequencies, energies, and loads without buckling.

constexpr double pi = std::numbers::pi;

/// A beam with mass 1 per length and EI = 1: a cantilever clamped at its left end, or pinned at both ends.
FrameModel heavy_beam(bool is_cantilever) {
  FrameModel m;
  m.nodes = {{"a", 0, 0}, {"b", 1, 0}};
  m.members = {{.first = "a", .second = "b", .ea = 1e4, .ei = 1, .mass = 1}};
  if (is_cantilever) {
    models::clamp(m, "a");
    m.loads = {{"b", Motion::y, -1}};
  } else {
    models::pin(m, "a");
    m.supports.push_back({"b", Motion::y});
    m.loads = {{"b", Motion::rotation, 1}};
  }
  return m;
}

/// Frequencies of small motions from the Jacobian, ascending.
VectorXd frequencies(const FrameMotion& motion) {
  const int n = motion.size() / 2;
  MatrixXd j;
  motion.jacobian(0, motion.rest(), j);
  const VectorXd root = motion.frame().mass.cwiseSqrt();
  const MatrixXd symmetric =
      -(root.asDiagonal() * j.bottomLeftCorner(n, n) * root.cwiseInverse().asDiagonal());
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(symmetric).eigenvalues().cwiseMax(0).cwiseSqrt();
}

/// The frequency nearest to a known one.
double nearest(const VectorXd& all, double known) {
  Eigen::Index at = 0;
  (all.array() - known).abs().minCoeff(&at);
  return all[at];
}

// Euler and Bernoulli: beta^2 with cos(beta) cosh(beta) = -1 for the cantilever, (k pi)^2 for pinned ends;
// axially the cantilever has pi/2 sqrt(EA/m). Lumped masses have errors of m^-2.
TEST(FrameMotions, FrequenciesOfBeams) {
  const auto worst = [](int elements) {
    const NamedFrame cantilever = build(heavy_beam(true), elements),
                     pinned = build(heavy_beam(false), elements);
    const VectorXd one = frequencies({cantilever, {}}), other = frequencies({pinned, {}});
    double off = 0;
    for (const double beta : {1.8751040687119611, 4.694091132974175, 7.854757438237613})
      off = std::max(off, std::abs(nearest(one, beta * beta) / (beta * beta) - 1));
    for (const int k : {1, 2, 3})
      off = std::max(off, std::abs(nearest(other, k * k * pi * pi) / (k * k * pi * pi) - 1));
    return std::max(off, std::abs(nearest(one, 50 * pi) / (50 * pi) - 1));
  };
  const double coarse = worst(20), fine = worst(40);
  EXPECT_LT(coarse, 0.02);
  EXPECT_NEAR(coarse / fine, 4, 0.2);
}

TEST(FrameMotions, MassesAddUp) {
  FrameModel m = models::lee();
  for (NamedMember& member : m.members) member.mass = 0.5;
  m.masses = {{"load", 3, 7}};
  const NamedFrame f = build(m, 2);
  double along = 0;
  for (std::size_t i = 0; i < f.frame.nodes().size(); ++i) {
    const Eigen::Index at = f.frame.unknown(static_cast<int>(i), Motion::y);
    if (at >= 0) along += f.mass[at];
  }
  // The mass of the members is 240, minus the share of the supports: half an element at each end.
  EXPECT_NEAR(along, 3 + 0.5 * (240 - 12), 1e-12);
  FrameModel without = m;
  without.masses.clear();
  const NamedFrame g = build(without, 2);
  const auto turn = [](const NamedFrame& of) { return of.mass[of.frame.unknown(2, Motion::rotation)]; };
  EXPECT_NEAR(turn(f) - turn(g), 7, 1e-12);
  m.masses[0].mass = -1;
  EXPECT_THROW((void)build(m, 2), ModelError);
}

TEST(FrameMotions, JacobianIsThatOfTheAcceleration) {
  FrameModel m = heavy_beam(true);
  m.damping = {.mass = 0.3, .stiffness = 0.01};
  const NamedFrame f = build(m, 3);
  const FrameMotion motion(f, {.factor = 2});
  VectorXd x(motion.size()), plus, minus;
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = 0.02 * std::sin(1. + static_cast<double>(i));
  MatrixXd j;
  motion.jacobian(0.5, x, j);
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double h = 1e-6;
    VectorXd moved = x;
    moved[i] += h;
    motion(0.5, moved, plus);
    moved[i] -= 2 * h;
    motion(0.5, moved, minus);
    EXPECT_LT(((plus - minus) / (2 * h) - j.col(i)).cwiseAbs().maxCoeff(), 1e-7 * j.cwiseAbs().maxCoeff());
  }
}

TEST(FrameMotions, LoadHistories) {
  const LoadHistory step{.factor = 3}, ramp{LoadHistory::Kind::ramp, 3, 2},
      pulse{LoadHistory::Kind::pulse, 3, 2};
  EXPECT_EQ(step.at(0), 3);
  EXPECT_EQ(ramp.at(0), 0);
  EXPECT_EQ(ramp.at(1), 1.5);
  EXPECT_EQ(ramp.at(5), 3);
  EXPECT_EQ(pulse.at(1.999), 3);
  EXPECT_EQ(pulse.at(2), 0);
  const NamedFrame f = build(heavy_beam(true), 1);
  EXPECT_TRUE(FrameMotion(f, step).discontinuities(0, 5).empty());
  EXPECT_EQ(FrameMotion(f, ramp).discontinuities(0, 5), std::vector<double>{2});
  EXPECT_TRUE(FrameMotion(f, pulse).discontinuities(2, 5).empty());
  EXPECT_THROW(FrameMotion(f, {LoadHistory::Kind::ramp, 1, 0}), std::invalid_argument);
  EXPECT_THROW(FrameMotion(f, {.factor = NAN}), std::invalid_argument);
}

TEST(FrameMotions, HighestFrequency) {
  const NamedFrame f = build(heavy_beam(true), 6);
  const FrameMotion motion(f, {});
  const double highest = frequencies(motion).maxCoeff();
  EXPECT_LE(motion.highest_frequency(), highest * (1 + 1e-9));
  EXPECT_GE(motion.highest_frequency(), 0.9 * highest);
}

TEST(FrameMotions, NeedMassesAndNoGivenDisplacements) {
  FrameModel m = models::truss();
  const NamedFrame massless = build(m, 1);
  const ModelError error = refusal([&] { return FrameMotion(massless, {}); });
  EXPECT_EQ(error.part(), ModelPart::members);
  EXPECT_TRUE(tests::holds(error.what(), "mass"));
  for (NamedMember& member : m.members) member.mass = 1;
  m.displacements = {{"apex", Motion::y, 1}};
  m.loads.clear();
  const NamedFrame f = build(m, 1);
  EXPECT_THROW(FrameMotion(f, {}), ModelError);
}

/// A step for FrameEnergies: the state is linear in time.
struct Line {
  double t0, t1;
  VectorXd x0, x1;
  [[nodiscard]] VectorXd at(double t) const { return x0 + (t - t0) / (t1 - t0) * (x1 - x0); }
};

// With a linear state all integrands are polynomials of low degree, for which Gauss quadrature is exact.
TEST(FrameEnergies, WorkAndDissipationOfALine) {
  FrameModel m = heavy_beam(true);
  m.damping.mass = 0.5;
  const NamedFrame f = build(m, 1);
  const FrameMotion motion(f, {LoadHistory::Kind::ramp, 3, 2});
  const Eigen::Index n = f.frame.size(), down = f.frame.unknown(1, Motion::y);
  Line line{0, 1, motion.rest(), motion.rest()};
  line.x1[down] = -0.4;      // the load is -1 times 1.5 t
  line.x1[n + down] = -0.4;  // the velocity of the state, not the slope of the displacement
  FrameEnergies energies(motion);
  energies.take(line);
  EXPECT_NEAR(energies.work, 1.5 * 0.4 / 2, 1e-14);  // 1.5 t times 0.4 dt
  EXPECT_NEAR(energies.kinetic, 0.5 * f.mass[down] * 0.16, 1e-14);
  EXPECT_NEAR(energies.dissipated, 0.5 * f.mass[down] * 0.16 / 3, 1e-14);
}

}  // namespace
}  // namespace nlmech::frames::named_test

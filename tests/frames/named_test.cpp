/// Frames described by names: what they are refused for, arcs, pinned ends, loads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "nlmech/algebraic/newton/energy_trust_region.hpp"
#include "nlmech/frames/equilibrium.hpp"
#include "nlmech/frames/named/frame_model.hpp"
#include "tests/frames/named_models.hpp"

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

// Linear theory: the deflection under a load P at the middle of a beam is P l^3/(192 EI) if it is clamped at
// both ends, 7/768 of P l^3/EI if one of them is pinned, 1/48 if both are. Loads are so small that the rest
// is 1e-12.
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

// A node between pinned ends has no rotation, and no load can turn it.
TEST(NamedFrames, ANodeOfPinnedEndsHasNoRotation) {
  FrameModel m = models::truss();
  const NamedFrame f = build(m, 1);
  EXPECT_EQ(f.frame.unknown(1, Motion::rotation), -1);
  EXPECT_EQ(f.motions.size(), 2u);
  EXPECT_EQ(f.frame.size(), 6);  // and four rotations of ends
  m.loads.push_back({"apex", Motion::rotation, 1});
  EXPECT_THROW((void)build(m, 1), ModelError);
}

void expect_refused(const FrameModel& m, ModelPart part, std::size_t index, const std::string& words) {
  try {
    (void)build(m, 2);
    ADD_FAILURE() << "not refused: " << words;
  } catch (const ModelError& error) {
    EXPECT_EQ(error.part(), part) << error.what();
    EXPECT_EQ(error.index(), index) << error.what();
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
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
  expect_refused(with([](M& m) { m.nodes[2].name = "left"; }), ModelPart::nodes, 2, "stands twice");
  expect_refused(with([](M& m) { m.nodes[2].x = 0; }), ModelPart::nodes, 2, "where node left is");
  expect_refused(with([](M& m) { m.nodes.push_back({"alone", 5, 5}); }), ModelPart::nodes, 3, "alone has no");
  expect_refused(with([](M& m) { m.members[1].second = "rihgt"; }), ModelPart::members, 1, "no node rihgt");
  expect_refused(with([](M& m) { m.members[1].second = "middle"; }), ModelPart::members, 1, "to itself");
  expect_refused(with([](M& m) { m.members[0].ea = 0; }), ModelPart::members, 0, "EA = 0");
  expect_refused(with([](M& m) { m.members[0].ei = -1; }), ModelPart::members, 0, "EI = -1");
  expect_refused(with([](M& m) { m.members[0].radius = 0.1; }), ModelPart::members, 0, "does not span");
  expect_refused(with([](M& m) { m.members[0].elements = 1 << 30; }), ModelPart::members, 0, "more than");
  expect_refused(with([](M& m) { m.nodes[1].x = 4.9e-324, m.nodes[1].y = 0; }), ModelPart::members, 0,
                 "cannot be told apart");
  expect_refused(with([](M& m) { m.supports[0].node = "x"; }), ModelPart::supports, 0, "no node x");
  expect_refused(with([](M& m) { m.loads[0].node = "left"; }), ModelPart::loads, 0, "left.y, which is held");
}

// Frames that can move without a strain, and the node that is named.
TEST(NamedFrames, RefuseMechanisms) {
  FrameModel free = models::beam(false, false);
  free.supports.clear();
  expect_refused(free, ModelPart::nodes, 0, "can move along");
  FrameModel rolling = models::beam(false, false);
  rolling.supports = {{"left", Motion::y}, {"right", Motion::y}};
  try {
    (void)build(rolling, 2);
    ADD_FAILURE();
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("along x"), std::string::npos) << error.what();
  }
  FrameModel apart = models::beam(false, false);
  apart.nodes.push_back({"p", 3, 3});
  apart.nodes.push_back({"q", 4, 3});
  apart.members.push_back({"p", "q", 1, 1});
  try {
    (void)build(apart, 2);
    ADD_FAILURE();
  } catch (const ModelError& error) {
    EXPECT_GE(error.index(), 3u) << error.what();
  }
  // Two bars in a line, pinned: the middle can move across by as little as nothing.
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

// Soft is not loose: a cantilever of a thousand members, whose softest shape has 1e-12 of the energy of a
// node by itself, and one whose members stretch by a millionth of what they bend.
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

}  // namespace
}  // namespace nlmech::frames::named_test

/// Springs, joints, loads along members, constant loads, member forces, and modes against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/frames/named/frame_forces.hpp"
#include "nlmech/frames/named/frame_modes.hpp"
#include "nlmech/frames/named/frame_paths.hpp"
#include "tests/frames/named_models.hpp"

namespace nlmech::frames::named_loads_test {
namespace {

using Eigen::VectorXd;
using models::clamp;
using models::pin;
using models::unknown_of;

constexpr double pi = std::numbers::pi;
/// Load factor of linear theory: displacements are so small that their squares are rounding.
constexpr double small = 1e-6;

/// A member of length 1 and EI = 1 from a to b along x.
FrameModel beam(double ea = 1e4) {
  FrameModel m;
  m.nodes = {{"a", 0, 0}, {"b", 1, 0}};
  m.members = {{.first = "a", .second = "b", .ea = ea, .ei = 1, .mass = 1}};
  return m;
}

FrameModel cantilever() {
  FrameModel m = beam();
  clamp(m, "a");
  return m;
}

/// The equilibrium at a load factor.
VectorXd equilibrium(const NamedFrame& f, double load) {
  const FramePaths paths = models::paths_of(f, {.until = load});
  return paths.points.back().x;
}

/// Displacement by linear theory for a load factor of 1.
double linear(const FrameModel& m, const std::string& motion, int elements = 2) {
  const NamedFrame f = build(m, elements);
  return equilibrium(f, small)[unknown_of(f, motion)] / small;
}

// 45 degrees: half of the spring acts in the direction of the bending, and the stiff axis carries the rest.
TEST(FrameSprings, InclinedSpring) {
  FrameModel m = cantilever();
  m.members[0].ea = 1e9;
  m.loads = {{"b", Motion::y, 1}};
  m.springs = {{.first = "", .second = "b", .x = 1, .y = -1, .stiffness = 5}};
  EXPECT_NEAR(linear(m, "b.y"), 1 / (3 + 2.5), 1e-7);
}

// Two cantilevers of stiffness 3 whose tips, at one place, a spring of stiffness 2 joins: it carries P/(2 +
// 3/2).
TEST(FrameSprings, BetweenNodes) {
  FrameModel m = cantilever();
  m.nodes.push_back({"c", 1, 0});
  m.nodes.push_back({"d", 2, 0});
  m.members.push_back({.first = "c", .second = "d", .ea = 1e4, .ei = 1});
  clamp(m, "d");
  m.loads = {{"b", Motion::y, 1}};
  EXPECT_THROW((void)build(m, 1), ModelError);  // two nodes at one place
  m.springs = {{.first = "b", .second = "c", .y = 1, .stiffness = 2}};
  const NamedFrame f = build(m, 1);
  const VectorXd x = equilibrium(f, small);
  EXPECT_NEAR(f.frame.spring_force(x, 0) / small, -1 / 3.5, 1e-9);
  EXPECT_NEAR(forces_of(m, f, x, small).nodes[3 * 3 + 1] / small, -1 / 3.5, 1e-9);
}

// A load along a beam: with any number of elements nodes are exact in linear theory, and so are moments.
TEST(FrameLoads, AlongBeams) {
  for (const int elements : {1, 2, 3}) {
    FrameModel m = cantilever();
    m.loads = {{"b-a", Motion::y, -8}};
    EXPECT_NEAR(linear(m, "b.y", elements), -1, 1e-8);  // w l^4/(8 EI)
    EXPECT_NEAR(linear(m, "b.rotation", elements), -8. / 6, 1e-8);
    m.loads = {{"gravity", Motion::y, -8}};
    EXPECT_NEAR(linear(m, "b.y", elements), -1, 1e-8);
    const NamedFrame f = build(m, elements);
    const FrameForces forces = forces_of(m, f, equilibrium(f, small), small);
    EXPECT_NEAR(forces.nodes[1], 8 * small, 1e-9 * small);
    EXPECT_NEAR(forces.nodes[2], 4 * small, 1e-9 * small);
    EXPECT_NEAR(forces.members[0].first.moment, -4 * small, 1e-9 * small);
    EXPECT_NEAR(forces.members[0].first.shear, 8 * small, 1e-9 * small);
    EXPECT_NEAR(forces.members[0].second.shear, 0, 1e-9 * small);
    // Two spans: 10/8 of a span's load in the middle, -w l^2/8 there, 9/128 w l^2 in the spans.
    FrameModel spans = beam();
    spans.nodes.push_back({"c", 2, 0});
    spans.members.push_back({.first = "b", .second = "c", .ea = 1e4, .ei = 1});
    pin(spans, "a");
    for (const char* const node : {"b", "c"}) spans.supports.push_back({node, Motion::y});
    spans.loads = {{"a-b", Motion::y, -1}, {"b-c", Motion::y, -1}};
    const NamedFrame g = build(spans, elements);
    const FrameForces two = forces_of(spans, g, equilibrium(g, small), small);
    EXPECT_NEAR(two.nodes[3 + 1], 1.25 * small, 1e-8 * small);
    EXPECT_NEAR(two.members[0].second.moment, -small / 8, 1e-8 * small);
    EXPECT_NEAR(two.members[1].second.moment, 0, 1e-8 * small);
  }
  FrameModel simple = beam();
  pin(simple, "a");
  simple.supports.push_back({"b", Motion::y});
  simple.loads = {{"a-b", Motion::y, -8}};
  const NamedFrame f = build(simple, 3);
  EXPECT_NEAR(forces_of(simple, f, equilibrium(f, small), small).members[0].moment, small, 1e-8 * small);
}

// In any state the forces of supports and springs balance all loads, and sections of an arch their ends.
TEST(FrameLoads, ForcesBalanceInLargeDisplacements) {
  FrameModel m;
  m.nodes = {{"left", 0, 0}, {"top", 1, 1}, {"right", 2, 0.5}};
  m.members = {
      {.first = "left", .second = "top", .ea = 1e3, .ei = 1, .radius = 1, .mass = 2},
      {.first = "top", .second = "right", .ea = 1e3, .ei = 1, .is_first_pinned = true, .first_joint = 3}};
  pin(m, "left");
  m.supports.push_back({"right", Motion::y});
  m.springs = {{.first = "", .second = "right", .x = 1, .stiffness = 4},
               {.first = "left", .second = "top", .x = 1, .y = 3, .stiffness = 2}};
  m.masses = {{"left", 3, 0}};
  m.loads = {{"left-top", Motion::y, -3}, {"top-right", Motion::x, 2}, {"top", Motion::rotation, 1}};
  m.loads.push_back({"gravity", Motion::y, -1, true});
  const NamedFrame f = build(m, 5);
  const double load = 1.5;
  const VectorXd x = equilibrium(f, load);
  const FrameForces all = forces_of(m, f, x, load);
  double first = 0, second = 0;
  for (std::size_t i = 0; i < f.members.size(); ++i) {
    const Member& e = f.frame.members()[i];
    const Node &a = f.frame.nodes()[static_cast<std::size_t>(e.first)],
               &b = f.frame.nodes()[static_cast<std::size_t>(e.second)];
    (f.members[i] == 0 ? first : second) += std::hypot(b.x - a.x, b.y - a.y);
  }
  const double down = load * 3 * first + 2 * first + 3;
  EXPECT_NEAR(all.nodes[1] + all.nodes[7], down, 1e-9 * down);
  EXPECT_NEAR(all.nodes[0] - all.springs[0], -load * 2 * second, 1e-9 * down);
  for (const Eigen::Index free : {3, 4, 5, 6, 8}) EXPECT_NEAR(all.nodes[free], 0, 1e-9 * down) << free;
  // The node at the top: what the members exert on it, the spring and the moment.
  const SectionForces &left = all.members[0].second, &right = all.members[1].first;
  EXPECT_NEAR(left.moment - right.moment, load, 1e-9 * down);
}

// A force along the tangent at the free end of a quarter of a circle: thrust there, shear at the clamped end.
TEST(FrameForces, AxialForceOfAnArcLiesAlongItsTangent) {
  FrameModel m;
  m.nodes = {{"left", -1, 0}, {"top", 0, 1}};
  m.members = {{.first = "left", .second = "top", .ea = 1e4, .ei = 1, .radius = 1}};
  clamp(m, "left");
  m.loads = {{"top", Motion::x, -1}};
  const NamedFrame f = build(m, 40);
  const FrameForces forces = forces_of(m, f, equilibrium(f, small), small);
  EXPECT_NEAR(forces.members[0].second.axial / small, -1, 1e-5);  // along the tangent of the circle
  EXPECT_NEAR(forces.members[0].second.shear / small, 0, 1e-5);
  EXPECT_NEAR(forces.members[0].first.axial / small, 0, 1e-5);
  EXPECT_NEAR(std::abs(forces.members[0].first.shear) / small, 1, 1e-5);
  EXPECT_NEAR(std::abs(forces.members[0].first.moment) / small, 1, 1e-5);
}

TEST(FramePaths, PointsAtGivenLoadFactors) {
  const NamedFrame f = build(models::truss(), 1);
  const FramePaths paths = models::paths_of(f, {.at = {0.03, -0.02, 0}});
  int first = 0, second = 0;
  VectorXd force;
  for (const FramePoint& p : paths.points) {
    first += p.load == 0.03, second += p.load == -0.02;
    ASSERT_TRUE(f.frame.force<double>(p.x, force).ok());
    EXPECT_LT((force - p.load * f.load).norm(), 1e-13);
  }
  EXPECT_EQ(first, 3);  // up, down behind the maximum, up again behind the minimum
  EXPECT_EQ(second, 2);
}

/// Values of one kind.
std::vector<double> values(const NamedFrame& f, FrameMode::Kind kind, int count, double load = 0) {
  const VectorXd x = load == 0 ? start_of(f, {}).x : equilibrium(f, load);
  const FrameModes modes = frame_modes(f, x, load, count);
  EXPECT_TRUE(modes.status.ok()) << modes.status.text();
  std::vector<double> some;
  for (const FrameMode& mode : modes.modes) {
    if (mode.kind == kind) some.push_back(mode.value);
  }
  return some;
}

// Euler's columns have errors of m^-4. 300 elements take subspace iteration, 10 a dense solver.
TEST(FrameModes, EulersColumns) {
  for (const int elements : {5, 150}) {
    const std::vector<double> loads =
        values(build(models::column(1e6), elements), FrameMode::Kind::buckling, 4);
    ASSERT_EQ(loads.size(), 4u);
    for (int k = 1; k <= 4; ++k)
      EXPECT_NEAR(loads[static_cast<std::size_t>(k - 1)], k * k,
                  k * k * (0.4 * std::pow(k * pi / (2 * elements), 4) / 45 + 1e-7))
          << k;
  }
}

// Columns on springs: a rigid one buckles at k l by a spring k at its top, at k/l by one against rotation at
// its base; a tension member does not buckle.
TEST(FrameModes, RigidColumns) {
  FrameModel m = beam(1e8);
  m.members[0].ei = 1e6;
  pin(m, "a");
  m.loads = {{"b", Motion::x, -1}};
  m.springs = {{.first = "", .second = "b", .y = 1, .stiffness = 3}};
  EXPECT_NEAR(values(build(m, 1), FrameMode::Kind::buckling, 1).front(), 3, 1e-5);
  m.springs = {{.first = "", .second = "a", .turns = true, .stiffness = 5}};
  EXPECT_NEAR(values(build(m, 1), FrameMode::Kind::buckling, 1).front(), 5, 1e-4);
  m.loads[0].value = 1;
  EXPECT_TRUE(values(build(m, 1), FrameMode::Kind::buckling, 1).empty());
}

/// Frequencies with lumped masses have errors of m^-2: extrapolated.
double frequency(const FrameModel& m, std::size_t number, double load = 0) {
  const auto at = [&](int elements) {
    return values(build(m, elements), FrameMode::Kind::vibration, 3, load).at(number);
  };
  return (4 * at(40) - at(20)) / 3;
}

// Euler and Bernoulli: 2 pi f = beta^2 with cos(beta) cosh(beta) = 1 for clamped ends, (k pi)^2 for pinned
// ones; under a compression of P this is times sqrt(1 - P/(k pi)^2).
TEST(FrameModes, FrequenciesOfBeamColumns) {
  FrameModel fixed = beam();
  clamp(fixed, "a");
  clamp(fixed, "b");
  fixed.needs_load = false;
  const double betas[] = {4.730040744862704, 7.853204624095838, 10.995607838001671};
  for (const std::size_t i : {0U, 1U, 2U})
    EXPECT_NEAR(frequency(fixed, i) * 2 * pi, betas[i] * betas[i], 1e-4 * betas[i] * betas[i]);
  FrameModel pinned = beam(1e7);
  pin(pinned, "a");
  pinned.supports.push_back({"b", Motion::y});
  pinned.loads = {{"b", Motion::x, -1}};
  for (const double load : {0., 5., 9., -20.})
    EXPECT_NEAR(frequency(pinned, 0, load) * 2 * pi, pi * pi * std::sqrt(1 - load / (pi * pi)), 1e-3);
}

}  // namespace
}  // namespace nlmech::frames::named_loads_test

/// Estimated errors of meshes against closed forms and the elastica.
#include "nlmech/frames/named/mesh_error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/frames/named_models.hpp"
#include "tests/frames/named_walks.hpp"

namespace nlmech::frames::mesh_error_test {
namespace {

constexpr double pi = std::numbers::pi, no_limit = std::numeric_limits<double>::infinity();

using walks::only;

struct Estimated {
  FramePaths paths;
  std::vector<std::optional<double>> errors;
  /// Of the first point of a kind.
  [[nodiscard]] double of(FramePoint::Kind kind) const {
    for (std::size_t i = 0; i < errors.size(); ++i) {
      if (paths.points[i].kind == kind) return errors[i].value_or(NAN);
    }
    return NAN;
  }
};

Estimated estimated(const FrameModel& model, int elements, const FrameWalk& walk) {
  const NamedFrame frame = build(model, elements);
  const int others = second_mesh(elements, frame.members.size());
  const NamedFrame second = build(model, others);
  Estimated e{equilibrium_paths(frame, walk), {}};
  e.errors = mesh_errors(
      {frame, e.paths, second, equilibrium_paths(second, walk), mesh_factor(elements, others)}, no_limit);
  return e;
}

/// Is an estimate that of a relative error, within a factor of 2?
void expect_error(double estimate, double value, double exact) {
  const double error = std::abs(value / exact - 1);
  EXPECT_GE(estimate, error / 2) << value;
  EXPECT_LE(estimate, error * 2) << value;
}

/// A quarter of a ring of radius 1 between its symmetry planes, pinched by a force of 2: each half bears 1.
FrameModel quarter_ring() {
  FrameModel m;
  m.nodes = {{"top", 0, 1}, {"side", 1, 0}};
  m.members = {{.first = "top", .second = "side", .ea = 1e9, .ei = 1, .radius = 1}};
  m.supports = {
      {"top", Motion::x}, {"top", Motion::rotation}, {"side", Motion::y}, {"side", Motion::rotation}};
  m.loads = {{"top", Motion::y, -1}};
  return m;
}

// Timoshenko, Strength of Materials: both points approach each other by P R^3/EI (pi/4 - 2/pi), each by half
// of that. Under a load of 1e-6 the ring is linear to 1e-6.
TEST(MeshError, OfAPinchedRing) {
  for (const int elements : {2, 3, 4, 8, 16}) {
    const Estimated e = estimated(quarter_ring(), elements, {.until = 1e-6});
    const NamedFrame frame = build(quarter_ring(), elements);
    ASSERT_EQ(frame.motions[0].name, "top.y");
    expect_error(e.errors.back().value_or(NAN), -e.paths.points.back().x[frame.motions[0].unknown] / 1e-6,
                 pi / 4 - 2 / pi);
  }
}

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

// Bars that only stretch are exact: what is left is rounding.
TEST(MeshError, OfATrussIsRounding) {
  const Estimated e = estimated(models::truss(), 1, {});
  for (const auto& error : e.errors) {
    ASSERT_TRUE(error);
    EXPECT_LE(*error, 1e-12);
  }
}

// A column so soft that it shortens by half before it buckles: EA < 4 pi^2 EI/l^2, and P (1 - P/EA) has no
// value of pi^2. Eight elements find two bifurcations, which twelve do not have.
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
}  // namespace nlmech::frames::mesh_error_test

// Typed equations F(x) = 0: reading, derivatives, all roots. tests/commands/homotopy_equations.t has single
// roots, points that are none, mistakes and most paths; tests/randomised judges bounds.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "nlmech/algebraic/typed/all_roots.hpp"
#include "nlmech/algebraic/typed/typed_path.hpp"

namespace nlmech::algebraic {
namespace {

TypedSystem system_of(const std::string& text, const SystemInput& input = {}) {
  return TypedSystem(program::SourceText("--equation", text), input);
}

TEST(TypedSystem, UnknownsAreTheNamesThatNothingDefines) {
  const TypedSystem system =
      system_of("b x + y = r; r = a^2; x y = t; t + x = 1; b = 2", {.settings = {{"a", 3}}});
  EXPECT_EQ(system.names(), (std::vector<std::string>{"x", "y", "t"}));
  Eigen::VectorXd f;
  system.residual(Eigen::Vector3d(1, 2, 5), f);
  EXPECT_EQ(f, Eigen::Vector3d(2 + 2 - 9, 2 - 5, 5 + 1 - 1));
}

TEST(TypedSystem, ADefinitionOfAnUnknownIsAnEquation) {
  EXPECT_EQ(system_of("x = cos(x)").names(), std::vector<std::string>{"x"});
  EXPECT_EQ(system_of("y = x^2; x + y = 6").names(), std::vector<std::string>{"x"});
  EXPECT_EQ(system_of("y = x^2; x + y = 6", {.unknowns = {"y"}}).names().size(), 2U);
  EXPECT_EQ(system_of("y = x^2; x + y = 6; y(0) = 1").names().size(), 2U);
  EXPECT_EQ(system_of("x = y/2 + 1; y = x/2").names(), std::vector<std::string>{"x"});  // a circle of two
}

TEST(TypedSystem, DerivativesAreThoseOfTheFormulas) {
  const TypedSystem system = system_of("exp(x y) + y^3 = 2; sin(x)/y = 0");
  const double x = 0.7, y = 1.3;
  Eigen::MatrixXd j;
  system.derivative(Eigen::Vector2d(x, y), j);
  Eigen::Matrix2d known;
  known << y * std::exp(x * y), x * std::exp(x * y) + 3 * y * y, std::cos(x) / y, -std::sin(x) / (y * y);
  EXPECT_LE((j - known).cwiseAbs().maxCoeff(), 1e-14);  // entries up to 8, a few roundings
}

TEST(TypedSystem, AnEnergyGivesItsGradientAndHessian) {
  const TypedSystem system = system_of("energy = k (x^2 - 1)^2 + x y + y^2; k = 2");
  ASSERT_TRUE(system.has_energy());
  const Eigen::Vector2d at(0.5, -1);
  Eigen::VectorXd f;
  Eigen::MatrixXd j;
  system.residual(at, f);
  system.derivative(at, j);
  EXPECT_DOUBLE_EQ(system.energy(at), 2 * 0.5625 - 0.5 + 1);
  EXPECT_DOUBLE_EQ(f[0], 8 * 0.5 * (0.25 - 1) - 1);
  EXPECT_DOUBLE_EQ(f[1], 0.5 - 2);
  EXPECT_DOUBLE_EQ(j(0, 0), 8 * (3 * 0.25 - 1));
  EXPECT_DOUBLE_EQ(j(0, 1), 1);
  EXPECT_DOUBLE_EQ(j(1, 1), 2);
}

TEST(TypedSystem, StartValuesOfTheCallComeBeforeThoseOfTheText) {
  const TypedSystem system = system_of("x^2 = y; y = x + 1; x(0) = 3; y(0) = 1");
  EXPECT_EQ(system.start("--start", "x=1/4"), Eigen::Vector2d(0.25, 1));
}

/// The roots in the cube of half width @p half about 0 are complete, with these first unknowns.
void expect_all(const std::string& text, double half, const std::vector<double>& known) {
  const TypedSystem system = system_of(text, {.unknowns = {"x"}});
  const AllRoots all = all_roots(system, Box(static_cast<std::size_t>(system.size()), {-half, half}));
  EXPECT_TRUE(all.status.ok()) << text << ": " << all.status.text();
  ASSERT_EQ(all.boxes.size(), known.size()) << text;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const program::Interval& x = all.boxes[i].box[0];
    EXPECT_TRUE(all.boxes[i].is_proved) << text;
    EXPECT_LE(x.width(), 1e-12 * half) << text;
    EXPECT_NEAR(x.low + x.width() / 2, known[i], 1e-12 * half) << text;
  }
}

TEST(AllRoots, AreThoseOfClosedForms) {
  expect_all("x + y + z = 6; x y + y z + z x = 11; x y z = 6", 10, {1, 1, 2, 2, 3, 3});
  expect_all("x^2 = 4", 2, {-2, 2});  // on the edges
  expect_all("abs(x) = 1", 5, {-1, 1});
  expect_all("exp(x) = 0", 700, {});
  expect_all("sqrt(x - 1) = 3 - x", 10, {2});
  expect_all("log(x) = 1", 5, {std::numbers::e});
  expect_all("x^1.5 + x + 0.01 = 0", 0.1,
             {});  // the tangent at 0 has a root at -0.01, where x^1.5 is no number
}

TEST(AllRoots, SayWhatIsUndecided) {
  for (const char* const text : {"x^2 = 0", "abs(x) = 0", "sign(x) = 0.5", "x^2 - 2 x + 1 = 0"}) {
    const TypedSystem system = system_of(text);
    const AllRoots all = all_roots(system, Box{{-5, 4}});
    EXPECT_FALSE(all.status.ok()) << text;
    ASSERT_EQ(all.boxes.size(), 1U) << text;
    EXPECT_FALSE(all.boxes[0].is_proved);
    EXPECT_LE(all.boxes[0].box[0].width(), 1e-5) << text;
  }
  const TypedSystem many = system_of("x - y = 0; 2 x - 2 y = 0");  // a line of roots
  EXPECT_EQ(all_roots(many, Box{{-5, 4}, {-5, 4}}, {.boxes = 1000}).status.outcome(), Outcome::step_limit);
}

TEST(TypedPath, FollowsTheBranchesOfAPitchfork) {
  const TypedSystem system = system_of("energy = x^4/4 - a x^2/2", {.parameter = "a"});
  const TypedPaths paths =
      follow_paths(system, Eigen::VectorXd::Zero(1), {.from = -1, .until = 1, .branches = 2});
  ASSERT_TRUE(paths.status.ok()) << paths.status.text();
  EXPECT_EQ(paths.unfollowed, 0);
  int forks = 0;
  for (const TypedPathPoint& p : paths.points) {
    if (p.kind == PointKind::bifurcation) {
      EXPECT_NEAR(p.parameter, 0, 1e-14);
      ++forks;
    }
    EXPECT_NEAR(p.branch == 0 ? p.x[0] : p.x[0] * p.x[0] - p.parameter, 0, 1e-12);
  }
  EXPECT_EQ(forks, 3);  // also the first point of both branches
  EXPECT_EQ(paths.points.back().branch, 2);
  EXPECT_EQ(paths.points.back().parameter, 1);
}

}  // namespace
}  // namespace nlmech::algebraic

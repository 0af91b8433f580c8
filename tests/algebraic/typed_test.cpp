// Typed equations F(x) = 0: reading, derivatives, roots and points that are none.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "nlmech/algebraic/typed/all_roots.hpp"
#include "nlmech/algebraic/typed/solve_typed.hpp"
#include "nlmech/algebraic/typed/typed_path.hpp"
#include "tests/thrown.hpp"

namespace nlmech::algebraic {
namespace {

using Kind = CheckedRoot::Kind;

TypedSystem system_of(const std::string& text, const SystemInput& input = {}) {
  return TypedSystem(program::SourceText("--equation", text), input);
}
TypedSolution solved(const std::string& text, const std::string& start) {
  const TypedSystem system = system_of(text, {.unknowns = assigned_names("--start", start)});
  int tried = 0;
  return solve_by_several(system, system.start("--start", start), 1e-10, 1000, tried);
}
/// A proved root, within its bound of the known one.
void expect_root(const std::string& text, const std::string& start, const Eigen::VectorXd& known) {
  const TypedSolution found = solved(text, start);
  ASSERT_TRUE(found.status.ok()) << text << ": " << found.status.text();
  EXPECT_EQ(found.root.kind, Kind::proved) << text;
  for (Eigen::Index i = 0; i < known.size(); ++i) {
    // One rounding for the known root.
    EXPECT_LE(std::abs(found.root.x[i] - known[i]), found.root.bound[i] + 3e-16 * std::abs(known[i])) << text;
    EXPECT_LE(found.root.bound[i], 1e-10 * found.typical[i]) << text;
  }
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

TEST(TypedSystem, MistakesAreNamed) {
  const auto message = [](const std::string& text, const SystemInput& input = {}) {
    return tests::thrown<InputError>([&] { return system_of(text, input); });
  };
  EXPECT_NE(message("x + y = 1").find("1 equation for 2 unknowns (x, y)"), std::string::npos);
  EXPECT_NE(message("x^2 = e^x").find("exp(x)"), std::string::npos);
  EXPECT_NE(message("a = 3").find("no unknown"), std::string::npos);
  EXPECT_NE(message("x' = x").find("rbf_inverse bvp"), std::string::npos);
  EXPECT_NE(message("x^2 = 2; 1 + 1 = 2").find("no unknown"), std::string::npos);
  EXPECT_NE(message("x^2 = 2", {.settings = {{"b", 1}}}).find("--set b"), std::string::npos);
  EXPECT_NE(message("x^2 = 2", {.parameter = "b"}).find("--parameter b"), std::string::npos);
  const TypedSystem system = system_of("x^2 = y; y = x + 1; x >= 0; y(0) = 1");
  const auto start = [&](const std::string& text) {
    return tests::thrown<InputError>([&] { return system.start("--start", text); });
  };
  EXPECT_NE(start("y=1").find("x is missing"), std::string::npos);
  EXPECT_NE(start("x=-1").find("outside its bounds"), std::string::npos);
  EXPECT_NE(start("x=1, z=2").find("no unknown"), std::string::npos);
  EXPECT_EQ(system.start("--start", "x=1/4"), Eigen::Vector2d(0.25, 1));
}

TEST(Roots, AreThoseOfClosedForms) {
  expect_root("x^2 + y^2 = 5; x y = 2", "x=3, y=0.5", Eigen::Vector2d(2, 1));
  expect_root("x^3 = 2", "x=1", Eigen::VectorXd::Constant(1, std::cbrt(2.)));
  expect_root("cos(x) = 0", "x=1", Eigen::VectorXd::Constant(1, std::numbers::pi / 2));
  expect_root("10 (y - x^2) = 0; 1 - x = 0", "x=-1.2, y=1", Eigen::Vector2d(1, 1));
  expect_root("-13 + x + ((5 - y) y - 2) y = 0; -29 + x + ((y + 1) y - 14) y = 0", "x=0.5, y=-2",
              Eigen::Vector2d(5, 4));  // Freudenstein and Roth: from here |F| falls to a minimum
}

TEST(Roots, AreAsRightInAnyUnits) {
  expect_root("x^2 = 1e-20", "x=1", Eigen::VectorXd::Constant(1, 1e-10));
  expect_root("1e12 x^3 = 8e12", "x=1", Eigen::VectorXd::Constant(1, 2));
  expect_root("1e-200 (x - 3) = 0", "x=1", Eigen::VectorXd::Constant(1, 3));
  expect_root("x^2/1e30 = 4", "x=1e14", Eigen::VectorXd::Constant(1, 2e15));
  expect_root("x^2 = 4e300", "x=1", Eigen::VectorXd::Constant(1, 2e150));  // |F|^2 overflows
}

TEST(Roots, ThatAreNoneAreRefused) {
  for (const char* const text :
       {"x^2 + 1e-20 = 0", "abs(x) = -1e-13", "exp(x) = 0", "1/x = 0", "x^2 + 1 = 0", "1e-30 (x^2 + 1) = 0",
        "x^2 + 1e-300 = 0", "1/(1 + x^2) = 0", "x^2 - 2 x + 1 + 1e-12 = 0", "sqrt(x) = -1e-9",
        "exp(-x^2) = 0", "2 sign(x - 1.1) = 1", "1/(x - 1.1) = 0"}) {
    const TypedSolution found = solved(text, "x=1.1");
    EXPECT_FALSE(found.status.ok()) << text << " at " << found.root.x[0] << ' ' << to_string(found.root.kind);
    EXPECT_FALSE(found.status.sentence().empty());
  }
  EXPECT_NE(solved("x^2 + 1 = 0", "x=1").status.sentence().find("minimum that is no root"),
            std::string::npos);
}

TEST(Roots, ThatAreSingularAreNamedWithTheirMultiplicity) {
  const auto expect_singular = [](const std::string& text, const std::string& start, double known, int order,
                                  double accuracy) {
    const TypedSolution found = solved(text, start);
    ASSERT_TRUE(found.status.ok()) << text << ": " << found.status.text();
    EXPECT_EQ(found.root.kind, Kind::singular) << text;
    EXPECT_EQ(found.root.order, order) << text;
    EXPECT_NEAR(found.root.x[0], known, accuracy) << text;
    EXPECT_LE(std::abs(found.root.x[0] - known), found.root.bound[0] + 1e-300) << text;
  };
  expect_singular("(x - 3)^2 = 0", "x=1", 3, 2, 1e-14);
  expect_singular("x^2 = 0", "x=1", 0, 2, 1e-15);
  expect_singular("x^3 = 0", "x=1", 0, 3, 1e-15);
  expect_singular("x^2 - 2 x + 1 = 0", "x=2", 1, 2, 1e-7);  // half of the digits
  // Powell's singular function: rank 2 is lost, multiplicity 4.
  const TypedSolution powell =
      solved("x1 + 10 x2 = 0; sqrt(5) (x3 - x4) = 0; (x2 - 2 x3)^2 = 0; sqrt(10) (x1 - x4)^2 = 0",
             "x1=3, x2=-1, x3=0, x4=1");
  ASSERT_TRUE(powell.status.ok()) << powell.status.text();
  EXPECT_EQ(powell.root.kind, Kind::singular);
  EXPECT_EQ(powell.root.defect, 2);
  EXPECT_LE(powell.root.x.norm(), 1e-10);
}

TEST(Roots, StayWithinBounds) {
  TypedSystem system = system_of("x^2 = 4");
  system.add_bounds("--bounds", "x <= 0");
  int tried = 0;
  const TypedSolution found =
      solve_by_several(system, Eigen::VectorXd::Constant(1, -0.5), 1e-10, 1000, tried);
  ASSERT_TRUE(found.status.ok());
  EXPECT_DOUBLE_EQ(found.root.x[0], -2);
}

/// All roots in the cube of half width @p half about 0, which must be complete: their first unknowns.
std::vector<double> first_unknowns(const std::string& text, double half) {
  const TypedSystem system = system_of(text, {.unknowns = {"x"}});
  const AllRoots all = all_roots(system, Box(static_cast<std::size_t>(system.size()), {-half, half}));
  EXPECT_TRUE(all.status.ok()) << text << ": " << all.status.text();
  std::vector<double> x;
  for (const RootBox& root : all.boxes) {
    EXPECT_TRUE(root.is_proved) << text;
    EXPECT_LE(root.box[0].width(), 1e-12 * half) << text;
    x.push_back(root.box[0].low + root.box[0].width() / 2);
  }
  return x;
}
void expect_all(const std::string& text, double half, const std::vector<double>& known) {
  const std::vector<double> x = first_unknowns(text, half);
  ASSERT_EQ(x.size(), known.size()) << text;
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], known[i], 1e-12 * half) << text;
}

TEST(AllRoots, AreThoseOfClosedForms) {
  constexpr double pi = std::numbers::pi;
  expect_all("sin(x) = 0", 10, {-3 * pi, -2 * pi, -pi, 0, pi, 2 * pi, 3 * pi});
  expect_all("x^2 + y^2 = 5; x y = 2", 5, {-2, -1, 1, 2});
  expect_all("x + y + z = 6; x y + y z + z x = 11; x y z = 6", 10, {1, 1, 2, 2, 3, 3});
  expect_all("-13 + x + ((5 - y) y - 2) y = 0; -29 + x + ((y + 1) y - 14) y = 0", 20, {5});
  expect_all("x^2 = 4", 2, {-2, 2});  // on the edges
  expect_all("abs(x) = 1", 5, {-1, 1});
  expect_all("x^2 + 1 = 0", 100, {});
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

/// Points of one kind.
std::vector<TypedPathPoint> of_kind(const TypedPaths& paths, TypedPathPoint::Kind kind) {
  std::vector<TypedPathPoint> some;
  for (const TypedPathPoint& p : paths.points) {
    if (p.kind == kind) some.push_back(p);
  }
  return some;
}

TEST(TypedPath, GoesThroughFolds) {
  const TypedSystem system = system_of("x^2 + a = 1", {.parameter = "a"});
  const TypedPaths paths = follow_paths(system, Eigen::VectorXd::Ones(1), {.from = 0, .until = 2});
  ASSERT_TRUE(paths.status.ok()) << paths.status.text();
  const auto maxima = of_kind(paths, TypedPathPoint::Kind::maximum);
  ASSERT_EQ(maxima.size(), 1U);
  EXPECT_NEAR(maxima[0].parameter, 1, 1e-14);
  EXPECT_NEAR(maxima[0].x[0], 0, 1e-7);  // the square root of rounding
  EXPECT_NEAR(paths.points.back().parameter, 0, 1e-14);
  EXPECT_NEAR(paths.points.back().x[0], -1, 1e-14);
}

TEST(TypedPath, KeepsThePointsFoundWithinItsTime) {
  const TypedSystem system = system_of("x^2 + a = 1", {.parameter = "a"});
  const TypedPaths paths =
      follow_paths(system, Eigen::VectorXd::Ones(1), {.from = 0, .until = 2, .seconds = 0});
  EXPECT_EQ(paths.status.outcome(), Outcome::time_limit);
  ASSERT_FALSE(paths.points.empty());
  EXPECT_EQ(paths.points.front().x[0], 1);
}

TEST(TypedPath, GoesThroughFoldsOfOneEquationToTheLastBit) {
  const TypedSystem system = system_of("x^3 - x + a = 0", {.parameter = "a"});
  // x^3 - x = 2: x = 1.5213797068045676, a = -2; folds at x = -1/sqrt(3), 1/sqrt(3).
  const TypedPaths paths =
      follow_paths(system, Eigen::VectorXd::Constant(1, 1.5213797068045676), {.from = -2, .until = 2});
  ASSERT_TRUE(paths.status.ok()) << paths.status.text();
  const auto maxima = of_kind(paths, TypedPathPoint::Kind::maximum),
             minima = of_kind(paths, TypedPathPoint::Kind::minimum);
  ASSERT_EQ(maxima.size(), 1U);
  ASSERT_EQ(minima.size(), 1U);
  EXPECT_NEAR(maxima[0].parameter, 2 / std::sqrt(27.), 1e-14);
  EXPECT_NEAR(minima[0].parameter, -2 / std::sqrt(27.), 1e-14);
  EXPECT_NEAR(paths.points.back().x[0], -1.5213797068045676, 1e-13);
}

TEST(TypedPath, FollowsTheBranchesOfAPitchfork) {
  const TypedSystem system = system_of("energy = x^4/4 - a x^2/2", {.parameter = "a"});
  const TypedPaths paths =
      follow_paths(system, Eigen::VectorXd::Zero(1), {.from = -1, .until = 1, .branches = 2});
  ASSERT_TRUE(paths.status.ok()) << paths.status.text();
  EXPECT_EQ(paths.unfollowed, 0);
  const auto forks = of_kind(paths, TypedPathPoint::Kind::bifurcation);
  ASSERT_EQ(forks.size(), 3U);  // and as the first point of both branches
  for (const TypedPathPoint& p : forks) EXPECT_NEAR(p.parameter, 0, 1e-9);
  std::vector<double> ends;
  for (std::size_t i = 0; i < paths.points.size(); ++i) {
    if (i + 1 == paths.points.size() || paths.points[i + 1].branch != paths.points[i].branch)
      ends.push_back(paths.points[i].x[0]);
  }
  ASSERT_EQ(ends.size(), 3U);
  EXPECT_NEAR(ends[0], 0, 1e-14);
  EXPECT_NEAR(ends[1], -ends[2], 1e-12);
  EXPECT_NEAR(std::abs(ends[1]), 1, 1e-12);
}

}  // namespace
}  // namespace nlmech::algebraic

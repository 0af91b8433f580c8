/// Limit and branch points of Lee's frame, of arches and of the toggle, by path following.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "nlmech/algebraic/paths/path.hpp"
#include "nlmech/frames/loaded_frame.hpp"
#include "nlmech/frames/toggle.hpp"
#include "tests/frames/named_walks.hpp"

namespace nlmech::frames::structures_test {
namespace {

using algebraic::Path;
using algebraic::PathMethod;
using algebraic::PathPoint;
using Eigen::VectorXd;
using Kind = PathMethod::Kind;

/// What a path has.
struct Found {
  std::vector<PathPoint> folds;
  std::vector<PathPoint> branches;
};

/// Follows the path from rest through a number of limit points.
Found follow(algebraic::Loaded& equations, Kind kind, double first, std::size_t folds) {
  Found found;
  Path path({.kind = kind, .first = first}, equations, VectorXd::Zero(equations.size()), 0);
  EXPECT_TRUE(path.start().ok());
  for (int k = 0; k < 1500 && found.folds.size() < folds; ++k) {
    const Status status = path.advance();
    EXPECT_TRUE(status.ok()) << status.text();
    if (!status.ok()) break;
    PathPoint point;
    if (path.has_passed_branch()) {
      VectorXd direction;
      EXPECT_EQ(path.branch(point, direction), Outcome::success);
      found.branches.push_back(point);
    }
    if (path.has_passed_fold()) {
      EXPECT_EQ(path.fold(point), Outcome::success);
      // A limit point turns one eigenvalue, and no more.
      EXPECT_EQ(std::abs(path.now().negative - path.before().negative), 1);
      found.folds.push_back(point);
    }
  }
  EXPECT_EQ(found.folds.size(), folds);
  found.folds.resize(folds);
  return found;
}

class Structures : public testing::TestWithParam<Kind> {};

std::string name_of(const testing::TestParamInfo<Kind>& kind) {
  if (kind.param == Kind::riks) return "riks";
  return kind.param == Kind::crisfield ? "crisfield" : "gdc";
}

INSTANTIATE_TEST_SUITE_P(By, Structures, testing::Values(Kind::riks, Kind::crisfield, Kind::gdc), name_of);

// Tolerances are half a unit of the last digit and the rounding floor, which is 1e-10 of the load for 20
// elements. oracle: homotopy_frames Lee's frame of 5 *, Lee's frame of 10 *
TEST_P(Structures, LeesFrame) {
  const auto expect = [](int elements, double high, double low) {
    const NamedFrame f = build(models::lee(), elements / 5);
    LoadedFrame equations(f);
    Found found = follow(equations, GetParam(), 0.2, 2);
    EXPECT_NEAR(found.folds[0].load, high, 2e-10);
    EXPECT_NEAR(found.folds[1].load, low, 2e-10);
    EXPECT_TRUE(found.branches.empty());
    return found;
  };
  (void)expect(5, 1.8559563314, -0.9412607899);
  const Found found = expect(10, 1.8556922898, -0.9414308972);
  const NamedFrame f = build(models::lee(), 2);
  EXPECT_NEAR(found.folds[0].x[walks::unknown_of(f, "load.x")], 26.88148086, 1e-7);
  EXPECT_NEAR(-found.folds[0].x[walks::unknown_of(f, "load.y")], 48.73493660, 1e-7);
}

// oracle: homotopy_frames deep arch of 20 limit
TEST_P(Structures, DeepArch) {
  const NamedFrame f = build(models::arch(models::deep_arch), 10);
  LoadedFrame equations(f);
  EXPECT_NEAR(follow(equations, GetParam(), 40, 1).folds[0].load, 907.34075563, 1e-8);
}

// oracle: homotopy_frames shallow arch of 16 *
TEST_P(Structures, ShallowArch) {
  models::Arch arch = models::shallow_arch;
  const NamedFrame full = build(models::arch(arch), 8);
  arch.is_half = true;
  const NamedFrame half = build(models::arch(arch), 8);
  LoadedFrame of_full(full), of_half(half);
  const Found whole = follow(of_full, GetParam(), 2, 2), part = follow(of_half, GetParam(), 2, 2);
  for (const Found* found : {&whole, &part}) {
    EXPECT_NEAR(found->folds[0].load, 34.0917939208, 1e-9);
    EXPECT_NEAR(found->folds[1].load, 14.2528558990, 1e-9);
  }
  // Only the whole arch has antisymmetric motions.
  EXPECT_TRUE(part.branches.empty());
  ASSERT_EQ(whole.branches.size(), 2u);
  const Eigen::Index down = walks::unknown_of(full, "crown.y");
  EXPECT_GT(-whole.branches[0].x[down], 0.74);
  EXPECT_LT(-whole.branches[0].x[down], 0.76);
  EXPECT_LT(-whole.branches[1].x[down], 0.96);
}

// oracle: homotopy_frames toggle 0.44 of * m*imum, toggle 0.38 of 1 m*imum, toggle 0.38 of 4 m*, toggle 0.38
// of 16 m*, toggle 0.38 of 32 m*
TEST_P(Structures, TogglesOfAnyNumberOfElements) {
  const auto expect = [](double height, int elements, double high, double low) {
    const ToggleFrame t = make_frame({.height = height, .elements = elements});
    LoadedFrame equations(t.frame, t.load);
    const Found found = follow(equations, GetParam(), 4, 2);
    EXPECT_NEAR(found.folds[0].load, high, 2e-10) << elements;
    EXPECT_NEAR(found.folds[1].load, low, 2e-10) << elements;
  };
  expect(0.44, 1, 42.4354921204, 32.1242187548);
  expect(0.44, 2, 42.435492120383, 32.124218754757);  // as one element: an S is its own mirror image
  expect(0.44, 4, 42.4387099966, 32.1222520061);
  expect(0.44, 8, 42.4395092247, 32.1221881014);
  expect(0.44, 16, 42.4397089470, 32.1221702414);
  expect(0.44, 32, 42.4397589244, 32.1221656364);
  expect(0.38, 1, 33.1227976034, 31.1078083932);
  expect(0.38, 4, 33.1245598495, 31.1079063049);
  expect(0.38, 16, 33.1251635792, 31.1081783145);
  expect(0.38, 32, 33.1251939340, 31.1081922157);
}

// oracle: homotopy_williams Williams 0.?? maximum*, Williams 0.?? minimum*
TEST_P(Structures, WilliamsEquation) {
  const auto expect = [](double height, double delta_max, double high, double delta_min, double low) {
    LoadedWilliams equations({.height = height});
    const Found found = follow(equations, GetParam(), 4, 2);
    EXPECT_NEAR(found.folds[0].load, high, 1e-12);
    EXPECT_NEAR(found.folds[1].load, low, 1e-12);
    EXPECT_NEAR(found.folds[0].x[0], delta_max, 1e-12);
    EXPECT_NEAR(found.folds[1].x[0], delta_min, 1e-12);
  };
  expect(0.44, 0.22818821400337, 42.771896097273, 0.4947308255747, 30.363548710287);
  expect(0.38, 0.23287115497799, 33.278532607761, 0.3935882935498, 30.588387926087);
}

// At a height of 0.32 the load only grows: slope and eigenvalues are positive all the way.
TEST_P(Structures, TheLowToggleHasNoLimitPoint) {
  for (const int elements : {1, 8}) {
    const ToggleFrame t = make_frame({.height = 0.32, .elements = elements});
    LoadedFrame equations(t.frame, t.load);
    Path path({.kind = GetParam(), .first = 2}, equations, VectorXd::Zero(t.frame.size()), 0);
    ASSERT_TRUE(path.start().ok());
    for (int k = 0; k < 300 && -path.now().x[t.apex] < 0.6; ++k) {
      ASSERT_TRUE(path.advance().ok());
      EXPECT_GT(path.now().slope, 0);
      EXPECT_EQ(path.now().negative, 0);
      EXPECT_FALSE(path.has_passed_fold());
    }
    EXPECT_GE(-path.now().x[t.apex], 0.6);
  }
}

// Frames converge to the elastica like m^-2, so two of them extrapolate to m^-4: 1e-7 for 16 and 32 elements
// of this toggle, by the size of the next difference. oracle: homotopy_elastica elastica * maximum, elastica
// * minimum
TEST_P(Structures, ConvergeToTheElastica) {
  const auto expect = [](double height, double high, double low) {
    double loads[2][2] = {};
    for (const int i : {0, 1}) {
      const ToggleFrame t = make_frame({.height = height, .elements = 16 << i});
      LoadedFrame equations(t.frame, t.load);
      const Found found = follow(equations, GetParam(), 4, 2);
      for (const int j : {0, 1}) loads[i][j] = found.folds[static_cast<std::size_t>(j)].load;
    }
    EXPECT_NEAR((4 * loads[1][0] - loads[0][0]) / 3, high, 1e-7);
    EXPECT_NEAR((4 * loads[1][1] - loads[0][1]) / 3, low, 1e-7);
  };
  expect(0.44, 42.4397755886, 32.1221640887);
  expect(0.38, 33.1252040575, 31.1081968550);
}

TEST(Structures, RefuseWhatTheyCannotBuild) {
  const ToggleFrame t = make_frame(Toggle{});
  EXPECT_THROW(LoadedFrame(t.frame, VectorXd::Zero(2)), std::invalid_argument);
  EXPECT_THROW(LoadedWilliams({.height = -1}), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::frames::structures_test

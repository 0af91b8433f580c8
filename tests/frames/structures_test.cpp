/// Limit and branch points of Lee's frame, of arches and of toggles, by path following; equilibria by energy.
#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "nlmech/algebraic/newton/energy_trust_region.hpp"
#include "nlmech/algebraic/paths/path.hpp"
#include "nlmech/frames/equilibrium.hpp"
#include "nlmech/frames/loaded_frame.hpp"
#include "nlmech/frames/toggle.hpp"
#include "nlmech/frames/toggle_path.hpp"
#include "tests/frames/control.hpp"
#include "tests/frames/named_models.hpp"
#include "tests/frames/random_equilibria.hpp"

namespace nlmech::frames::structures_test {
namespace {

using algebraic::Path;
using algebraic::PathMethod;
using Eigen::VectorXd;
using Kind = PathMethod::Kind;

/// Critical points of a path.
struct Found {
  std::vector<algebraic::PathPoint> folds;
  std::vector<algebraic::PathPoint> branches;
};

/// Follows the path from rest through @p folds limit points.
Found follow(algebraic::Loaded& equations, Kind kind, double first, std::size_t folds) {
  Found found;
  Path path({.kind = kind, .first = first}, equations, VectorXd::Zero(equations.size()), 0);
  EXPECT_TRUE(path.start().ok());
  for (int k = 0; k < 1500 && found.folds.size() < folds; ++k) {
    const Status status = path.advance();
    EXPECT_TRUE(status.ok()) << status.text();
    if (!status.ok()) break;
    algebraic::PathPoint point;
    if (path.before().sign * path.now().sign < 0) {
      std::vector<algebraic::CriticalPoint> here;
      EXPECT_EQ(path.critical_points(here), Outcome::success);
      for (const auto& c : here) {
        if (c.kind == algebraic::CriticalPoint::Kind::bifurcation) found.branches.push_back(c.point);
      }
    }
    if (path.has_passed_fold()) {
      EXPECT_EQ(path.fold(point), Outcome::success);
      // At a limit point exactly one eigenvalue changes its sign.
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

// Tolerances: half a unit of the last digit, and rounding errors of 1e-10 of the load for 20 elements.
// oracle: homotopy_frames Lee's frame of 5 *, Lee's frame of 10 *
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
  EXPECT_NEAR(found.folds[0].x[models::unknown_of(f, "load.x")], 26.88148086, 1e-7);
  EXPECT_NEAR(-found.folds[0].x[models::unknown_of(f, "load.y")], 48.73493660, 1e-7);
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
  // The half arch excludes antisymmetric motions.
  EXPECT_TRUE(part.branches.empty());
  ASSERT_EQ(whole.branches.size(), 2u);
  const Eigen::Index down = models::unknown_of(full, "crown.y");
  EXPECT_GT(-whole.branches[0].x[down], 0.74);
  EXPECT_LT(-whole.branches[0].x[down], 0.76);
  EXPECT_LT(-whole.branches[1].x[down], 0.96);
}

// oracle: homotopy_frames toggle 0.44 of 4 m*imum, toggle 0.44 of 8 m*, toggle 0.44 of 16 m*, toggle 0.44 of
// 32 m*, toggle 0.38 of 4 m*, toggle 0.38 of 16 m*, toggle 0.38 of 32 m*
TEST_P(Structures, TogglesOfAnyNumberOfElements) {
  const auto expect = [](double height, int elements, double high, double low) {
    const ToggleFrame t = make_frame({.height = height, .elements = elements});
    LoadedFrame equations(t.frame, t.load);
    const Found found = follow(equations, GetParam(), 4, 2);
    EXPECT_NEAR(found.folds[0].load, high, 2e-10) << elements;
    EXPECT_NEAR(found.folds[1].load, low, 2e-10) << elements;
  };
  expect(0.44, 2, 42.435492120383,
         32.124218754757);  // as for one element: an S shape is its own mirror image
  expect(0.44, 4, 42.4387099966, 32.1222520061);
  expect(0.44, 8, 42.4395092247, 32.1221881014);
  expect(0.44, 16, 42.4397089470, 32.1221702414);
  expect(0.44, 32, 42.4397589244, 32.1221656364);
  expect(0.38, 4, 33.1245598495, 31.1079063049);
  expect(0.38, 16, 33.1251635792, 31.1081783145);
  expect(0.38, 32, 33.1251939340, 31.1081922157);
}

// oracle: homotopy_frames toggle 0.?? of 1 maximum*, toggle 0.?? of 1 minimum*
TEST_P(Structures, TogglesOfOneElement) {
  const auto expect = [](double height, double delta_max, double high, double delta_min, double low) {
    const ToggleFrame t = make_frame({.height = height});
    LoadedFrame equations(t.frame, t.load);
    const Found found = follow(equations, GetParam(), 4, 2);
    EXPECT_NEAR(found.folds[0].load, high, 1e-10);
    EXPECT_NEAR(found.folds[1].load, low, 1e-10);
    EXPECT_NEAR(-found.folds[0].x[t.apex], delta_max, 1e-10);
    EXPECT_NEAR(-found.folds[1].x[t.apex], delta_min, 1e-10);
  };
  expect(0.44, 0.22710546333003, 42.435492120383, 0.4800337802312, 32.124218754757);
  expect(0.38, 0.23387819214942, 33.122797603353, 0.38040896031666, 31.107808393235);
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

// At a height of 0.32 the load increases monotonically: slope and eigenvalues stay positive.
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

// ---- Limit points and bifurcations of toggles of any height, by eigenvalues of dense matrices.

using Critical = algebraic::CriticalPoint::Kind;

std::vector<ToggleEvent> events_of(const Toggle& toggle) {
  const TogglePath path = critical_points(toggle);
  EXPECT_TRUE(path.status.ok()) << path.status.text();
  EXPECT_GE(path.drop, 2.2 * toggle.height);
  return path.events;
}

/// The first limit load; NaN if there is none.
double first_maximum(const std::vector<ToggleEvent>& events) {
  const auto at = std::find_if(events.begin(), events.end(),
                               [](const ToggleEvent& e) { return e.kind == Critical::maximum; });
  return at == events.end() ? std::nan("") : at->load;
}

/// The whole toggle under displacement control of its apex, with the negative eigenvalues of its tangent.
struct Controlled {
  explicit Controlled(Toggle toggle)
      : frame(make_frame((toggle.full = true, toggle))), at{VectorXd::Zero(frame.frame.size()), 0, 1} {}
  void go_to(double drop, int steps, double rounding = 1e-9) {
    const double from = -at.x[frame.apex];
    for (int i = 1; i <= steps; ++i)
      at = control(frame.frame, frame.load, frame.apex, -(from + (drop - from) * i / steps), at, rounding);
  }
  /// Eigenvalues of the tangent, ascending.
  [[nodiscard]] VectorXd spectrum() const {
    Eigen::SparseMatrix<double> k;
    EXPECT_TRUE(frame.frame.tangent<double>(at.x, k).ok());
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(k), Eigen::EigenvaluesOnly)
        .eigenvalues();
  }
  [[nodiscard]] long negative() const { return (spectrum().array() < 0).count(); }
  ToggleFrame frame;
  PathPoint at;
};

// Recorded: 642.99 and 964.03; 258.7 and 266.7 for the half toggle, which excludes the antisymmetric
// bifurcation before them. Reference for such points: EventsAreWhereDenseEigenvaluesVanish.
TEST(TogglePath, HighTogglesBifurcateBeforeTheirLimit) {
  for (const auto& [height, bow, limit] : {std::array{2., 642.99, 964.03}, std::array{1., 258.7, 266.68}}) {
    const std::vector<ToggleEvent> events = events_of({.height = height, .elements = 8});
    ASSERT_GE(events.size(), 3u);
    EXPECT_EQ(events[0].kind, Critical::bifurcation);
    EXPECT_FALSE(events[0].is_symmetric);
    EXPECT_EQ(events[1].kind, Critical::bifurcation);
    EXPECT_TRUE(events[1].is_symmetric);
    EXPECT_NEAR(events[1].load, bow, 0.05);
    EXPECT_NEAR(first_maximum(events), limit, 0.005);
  }
}

// At each point one eigenvalue of the dense tangent or the slope under displacement control changes its sign;
// between the points none does. Displacements are controlled to 1e-9, loads follow with slopes of 4000 lb/in.
TEST(TogglePath, EventsAreWhereDenseEigenvaluesVanish) {
  for (const double height : {0.44, 1., 2.}) {
    const Toggle toggle{.height = height, .elements = 4};
    Controlled walk(toggle);
    long negative = 0;
    double last = 0;
    for (const ToggleEvent& e : events_of(toggle)) {
      ASSERT_GT(e.drop, last);  // at these heights no two events have the same drop
      walk.go_to(last + (e.drop - last) * 0.5, 20);
      EXPECT_EQ(walk.negative(), negative) << e.drop;
      walk.go_to(e.drop * (1 - 1e-5), 20);
      EXPECT_EQ(walk.negative(), negative) << e.drop;
      const double slope = walk.at.slope, load = walk.at.load;
      walk.go_to(e.drop * (1 + 1e-5), 1);
      EXPECT_EQ(std::abs(walk.negative() - negative), 1) << e.drop;
      EXPECT_EQ(e.kind != Critical::bifurcation, (slope > 0) != (walk.at.slope > 0)) << e.drop;
      EXPECT_NEAR(e.load, (load + walk.at.load) / 2, 1e-5 * std::abs(e.load) + 1e-8);
      negative = walk.negative();
      last = e.drop * (1 + 1e-5);
    }
    EXPECT_EQ(negative, 0);
  }
}

/// Two bifurcations that appear together at a certain height and apex displacement.
struct Pair {
  double height, drop;
  bool is_symmetric;
};

/// Loads of a pair: zeros of the eigenvalue of the dense tangent that vanishes at @p pair; empty if the
/// eigenvalue does not reach zero.
std::vector<double> pair_by_eigenvalues(const Toggle& toggle, const Pair& pair) {
  constexpr double wide = 0.01;  // in the drop: at least twice the distance of the zeros in these tests
  Controlled walk(toggle);
  walk.go_to(pair.drop, 200);
  Eigen::Index which = 0;
  walk.spectrum().cwiseAbs().minCoeff(&which);
  const auto value = [&](double drop) {
    // The tolerance applies to the direction of the zero eigenvalue, on which the eigenvalue depends
    // quadratically.
    walk.go_to(drop, 1, 1e-5);
    return walk.spectrum()[which];
  };
  const double sign = value(pair.drop - wide) > 0 ? 1 : -1;
  double least = pair.drop;
  for (double step = wide / 2; step > 1e-5; step /= 3) {  // the vertex of a parabola through three points
    const double a = value(least - step), b = value(least), c = value(least + step);
    least += step * (a - c) / (2 * (a - 2 * b + c));
  }
  std::vector<double> loads;
  if (sign * value(least) > 0) return loads;
  for (const double outside : {least - wide, least + wide}) {
    double in = least, out = outside;
    for (int i = 0; i < 16; ++i) (sign * value((in + out) / 2) > 0 ? out : in) = (in + out) / 2;
    // By linear interpolation: at the zero itself displacements along the other branch are undetermined.
    const double inner = value(in), load = walk.at.load, outer = value(out);
    loads.push_back(load + (walk.at.load - load) * inner / (inner - outer));
  }
  return loads;
}

// Just above the height at which a pair of bifurcations appears, the distance of the two grows as the square
// root of the excess height. Rounding of the node positions, 13 eps, changes a member's force by 2e-9 lb and
// its eigenvalues like a change of the height by up to 1e-9; the distance changes accordingly.
TEST(TogglePath, PairsOfBifurcationsFromWhereTheyBegin) {
  for (const Pair& pair : {Pair{0.762947553, 0.50896, true}, Pair{1.2335566333, 0.47466, false}}) {
    for (const double beyond : {-1e-5, -1e-6, -1e-7, 0., 1e-8, 3e-8, 1e-7, 3e-7, 6.4e-7, 1e-6, 2e-6, 1e-5}) {
      const Toggle toggle{.height = pair.height + beyond, .elements = 4};
      const TogglePath path = critical_points(toggle);
      if (beyond == 0 && !path.status.ok()) continue;
      ASSERT_TRUE(path.status.ok()) << toggle.height << path.status.text();
      std::vector<double> found;
      for (const ToggleEvent& e : path.events) {
        if (e.kind == Critical::bifurcation && e.is_symmetric == pair.is_symmetric &&
            std::abs(e.drop - pair.drop) < 0.01)
          found.push_back(e.load);
      }
      if (beyond == 0) continue;  // one point up to rounding
      const std::vector<double> expected = pair_by_eigenvalues(toggle, pair);
      ASSERT_EQ(expected.size(), beyond > 0 ? 2U : 0U) << beyond;
      ASSERT_EQ(found.size(), expected.size()) << toggle.height;
      for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_NEAR(found[i], expected[i],
                    1e-9 / beyond * std::abs(expected[0] - expected[1]) + 1e-7 * expected[i])
            << toggle.height;
    }
  }
}

// A symmetric bifurcation passes the maximum near a height of 0.8973 in. Reference loads and drops: an
// independent implementation of beam-columns in long double, by the inertia of the stiffness; printed to
// 1e-12.
TEST(TogglePath, ABifurcationPassesTheMaximum) {
  struct Neighbours {
    double height, branch, branch_drop, limit, limit_drop;
  };
  for (const Neighbours& n :
       {Neighbours{0.8973, 207.80746249118, 0.283527779227, 207.80746579889, 0.283489144019},
        Neighbours{0.8974, 207.86162346508, 0.283467765863, 207.86162508599, 0.283494806728},
        Neighbours{0.8975, 207.91577197940, 0.283407789315, 207.91579102495, 0.283500463636},
        Neighbours{0.89757437948912355, 207.95603929642, 0.283363202913, 207.95608368658, 0.283504667453},
        Neighbours{0.8976, 207.96990804915, 0.283347849537, 207.96996361431, 0.283506114743}}) {
    const auto events = events_of({.height = n.height, .elements = 4});
    ASSERT_GE(events.size(), 3U);
    const bool is_maximum_first = n.limit_drop < n.branch_drop;
    const ToggleEvent &limit = events[is_maximum_first ? 1 : 2], &branch = events[is_maximum_first ? 2 : 1];
    EXPECT_EQ(limit.kind, Critical::maximum);
    EXPECT_EQ(branch.kind, Critical::bifurcation);
    EXPECT_TRUE(branch.is_symmetric);
    // Path: near another critical point a bifurcation point is accurate to 1e-7 of a step, here of 0.05 in.
    EXPECT_NEAR(branch.drop, n.branch_drop, 5e-9) << n.height;
    EXPECT_NEAR(branch.load, n.branch, 5e-9) << n.height;
    EXPECT_NEAR(limit.load, n.limit, 1e-10 * n.limit) << n.height;
  }
}

// The first step from rest may be three hundred times too long. With four elements per member the slope under
// displacement control changes its sign at the first limit point.
TEST(TogglePath, VeryHighTogglesStayOnTheirPath) {
  const Toggle toggle{.height = 10, .elements = 4};
  const std::vector<ToggleEvent> events = events_of(toggle);
  EXPECT_NEAR(first_maximum(events), 6698.82, 0.005);
  EXPECT_EQ(std::count_if(events.begin(), events.end(),
                          [](const ToggleEvent& e) { return e.kind == Critical::maximum; }),
            1);
  Controlled walk(toggle);
  walk.go_to(0.0510, 51);
  EXPECT_LT(walk.at.slope, 0);  // derivative by the upward displacement
  walk.go_to(0.0520, 1);
  EXPECT_GT(walk.at.slope, 0);
  EXPECT_NEAR(walk.at.load, first_maximum(events), 0.5);
}

// The path succeeds for two or more elements; limit loads converge, and their differences decrease by more
// than half.
TEST(TogglePath, EveryNumberOfElementsGetsThrough) {
  for (const double height : {5., 12.5}) {
    std::vector<double> loads;
    for (const int elements : {2, 4, 8, 16})
      loads.push_back(first_maximum(events_of({.height = height, .elements = elements})));
    EXPECT_LT(std::abs(loads[3] - loads[2]), 0.5 * std::abs(loads[2] - loads[1])) << height;
    EXPECT_NEAR(loads[1], loads[3], 2e-3 * loads[3]) << height;
  }
}

TEST(TogglePath, TheFirstPointBeforeALoad) {
  const Toggle toggle{.height = 2, .elements = 4};
  EXPECT_TRUE(first_critical_point(toggle, 300).events.empty());
  EXPECT_TRUE(first_critical_point(toggle, -300).events.empty());
  EXPECT_TRUE(first_critical_point(toggle, 0).events.empty());
  for (const double load : {400., 660., 1e4}) {
    const TogglePath path = first_critical_point(toggle, load);
    ASSERT_EQ(path.events.size(), 1u) << load;
    EXPECT_EQ(path.events[0].load, events_of(toggle)[0].load);
  }
  // At 300 lb the drop equals that of the minimum of the energy.
  const ToggleFrame half = make_frame(toggle);
  Equilibrium equations(half.frame, half.load, 300);
  VectorXd x = VectorXd::Zero(half.frame.size());
  ASSERT_TRUE(find_root(algebraic::EnergyTrustRegion{}, equations, x).status.ok());
  EXPECT_NEAR(first_critical_point(toggle, 300).drop, -x[half.apex], 1e-12);
  EXPECT_EQ(unstable_motions(toggle, x), 0);
  // Just below the limit load of a low toggle the last step passes the limit point.
  const TogglePath near = first_critical_point(Toggle{.height = 0.44}, 42.435492120383 * (1 - 1e-9));
  EXPECT_TRUE(near.events.empty());
  EXPECT_NEAR(near.drop, 0.22710546333003, 2e-5);
  EXPECT_LT(near.drop, 0.22710546333003);
  equations.set_load(500);  // above the antisymmetric bifurcation, below the symmetric one
  ASSERT_TRUE(find_root(algebraic::EnergyTrustRegion{}, equations, x).status.ok());
  EXPECT_EQ(unstable_motions(toggle, x), 1);
  EXPECT_THROW((void)first_critical_point(toggle, NAN), std::invalid_argument);
  EXPECT_THROW((void)unstable_motions(toggle, VectorXd::Zero(2)), std::invalid_argument);
}

// Bifurcations at tan x = x and 4 pi^2; the known limit points, and sign changes of the slope in long double.
TEST(TogglePath, OfWilliamsEquation) {
  const Williams low{.height = 0.44}, high{.height = 0.9}, ends{.height = 1};
  const auto of_low = critical_points(low).events;
  ASSERT_EQ(of_low.size(), 2u);
  EXPECT_NEAR(of_low[0].load, 42.771896097273, 1e-11);
  EXPECT_NEAR(of_low[1].load, 30.363548710287, 1e-11);
  for (const Williams& w : {high, ends}) {
    for (const ToggleEvent& e : critical_points(w).events) {
      if (e.kind != Critical::bifurcation) {
        const auto slope = [&](long double part) { return w.stiffness<long double>(e.drop * part); };
        EXPECT_LT(slope(1 - 1e-9L) * slope(1 + 1e-9L), 0);
        continue;
      }
      const double root = std::sqrt(w.compression(e.drop) * w.length * w.length / w.ei);
      EXPECT_NEAR(e.is_symmetric ? std::sin(root / 2) : std::tan(root) - root, 0, 1e-11);
    }
  }
  // The compression reaches the pole of d_5; the load decreases without bound.
  const TogglePath path = critical_points(ends);
  EXPECT_LT(path.drop, 1);
  EXPECT_EQ(path.events.back().kind, Critical::maximum);
  EXPECT_LT(ends.load(path.drop * (1 - 1e-9)), -1e6);
  EXPECT_EQ(first_critical_point(ends, 1000).events.size(), 1u);
  EXPECT_TRUE(first_critical_point(low, 40).events.empty());
  EXPECT_NEAR(low.load(first_critical_point(low, 40).drop), 40, 1e-12);
  EXPECT_NEAR(low.load(first_critical_point(low, -40).drop), -40, 1e-12);
  EXPECT_EQ(unstable_motions(ends, 0.01), 0);
  EXPECT_GT(unstable_motions(ends, 0.9 * path.drop), 0);
  EXPECT_THROW((void)critical_points(Williams{.height = -1}), std::invalid_argument);
}

// ---- Equilibria of the toggle by energy and by arc length: near and above the limit load, from unstable and
// snapped initial guesses, with very many elements.

using algebraic::ArcLength;
using algebraic::EnergyTrustRegion;
using algebraic::Report;

constexpr Kind kinds[] = {Kind::riks, Kind::crisfield, Kind::gdc};

TEST(Equilibria, OfRandomToggles) { expect_equilibria_of_random_toggles(200, 1); }

/// Drop of the apex at a solution from rest.
template <class Method>
double drop(const Method& method, const Toggle& toggle, double load) {
  const ToggleFrame t = make_frame(toggle);
  Equilibrium equations(t.frame, t.load, load);
  VectorXd x = VectorXd::Zero(t.frame.size());
  const Report report = find_root(method, equations, x);
  EXPECT_TRUE(report.status.ok()) << report.status.text();
  expect_equilibrium(equations, x, false, toggle.elements <= 4);
  return -x[t.apex];
}

// Just below the limit load there are two equilibria, 0.227120 and 0.227139; a finite step past both reaches
// the far branch at 0.6143.
// oracle: homotopy_frames toggle 0.44 of 4 maximum, toggle 0.44 of 4 drop *
TEST(Equilibria, NextToTheLimitLoad) {
  const Toggle toggle{.height = 0.44, .elements = 4};
  const double limit = 42.4387099966;
  // The drop is within 1e-5 of that at the limit load; the last digit of the limit load, 5e-11, changes it by
  // a thousandth of that.
  EXPECT_NEAR(drop(EnergyTrustRegion{}, toggle, limit * (1 - 1e-9)), 0.2271202, 2e-7);
  EXPECT_NEAR(drop(EnergyTrustRegion{}, toggle, limit * (1 + 1e-9)), 0.614300816, 2e-9);
  for (const Kind kind : kinds) {
    EXPECT_NEAR(drop(ArcLength{{.kind = kind}}, toggle, limit * (1 - 1e-9)), 0.2271202, 2e-7);
    EXPECT_NEAR(drop(ArcLength{{.kind = kind}}, toggle, limit * (1 + 1e-9)), 0.614300816, 2e-9);
  }
}

// oracle: homotopy_frames toggle 0.44 of 1 drop under *
TEST(Equilibria, PastTheLimitLoadAreSnapped) {
  for (const double load : {43.79, 44.}) {
    const double expected = load == 44 ? 0.623070489 : 0.621922545486;
    EXPECT_NEAR(drop(EnergyTrustRegion{}, {.height = 0.44}, load), expected, 5e-10);
    for (const Kind kind : kinds)
      EXPECT_NEAR(drop(ArcLength{{.kind = kind}}, {.height = 0.44}, load), expected, 5e-10);
  }
}

// An equilibrium on the descending branch is a root of F but no minimum of V: minimisation from there leads
// to one of the two stable equilibria. From the snapped shape it finds the snapped equilibrium, from rest the
// other.
TEST(Equilibria, FromUnstableAndSnappedStarts) {
  const ToggleFrame t = make_frame({.height = 0.44, .elements = 4});
  LoadedFrame path_equations(t.frame, t.load);
  algebraic::Path path({.first = 4}, path_equations, VectorXd::Zero(t.frame.size()), 0);
  ASSERT_TRUE(path.start().ok());
  while (path.now().negative == 0) ASSERT_TRUE(path.advance().ok());
  Equilibrium equations(t.frame, t.load, path.now().load);
  VectorXd x = path.now().x;
  Report report = find_root(EnergyTrustRegion{}, equations, x);
  ASSERT_TRUE(report.status.ok()) << report.status.text();
  expect_equilibrium(equations, x, true, true);
  EXPECT_TRUE(-x[t.apex] < 0.2271 || -x[t.apex] > 0.4802) << x[t.apex];
  // Limit loads are 42.4 and 32.1: at 36 there are two stable equilibria.
  equations.set_load(100);
  ASSERT_TRUE(find_root(EnergyTrustRegion{}, equations, x).status.ok());
  equations.set_load(36);
  ASSERT_TRUE(find_root(EnergyTrustRegion{}, equations, x).status.ok());
  EXPECT_GT(-x[t.apex], 0.4802);
  expect_equilibrium(equations, x, true, true);
  x.setZero();
  ASSERT_TRUE(find_root(EnergyTrustRegion{}, equations, x).status.ok());
  EXPECT_LT(-x[t.apex], 0.2271);
  expect_equilibrium(equations, x, true, true);
}

// 1000 elements: rounding errors of F are 1e-4 of the load, and the increments still meet the tolerance.
TEST(Equilibria, OfAThousandElements) {
  EXPECT_NEAR(drop(EnergyTrustRegion{}, {.height = 0.44, .elements = 1000}, 44),
              drop(EnergyTrustRegion{}, {.height = 0.44, .elements = 64}, 44), 1e-6);
}

}  // namespace
}  // namespace nlmech::frames::structures_test

/// Limit points and bifurcations of toggles of any height, by eigenvalues of dense matrices.
#include "nlmech/frames/toggle_path.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "nlmech/algebraic/newton/energy_trust_region.hpp"
#include "nlmech/frames/equilibrium.hpp"
#include "tests/frames/control.hpp"

namespace nlmech::frames::toggle_path_test {
namespace {

using Eigen::VectorXd;
using Kind = algebraic::CriticalPoint::Kind;

std::vector<ToggleEvent> events_of(const Toggle& toggle) {
  const TogglePath path = critical_points(toggle);
  EXPECT_TRUE(path.status.ok()) << path.status.text();
  EXPECT_GE(path.drop, 2.2 * toggle.height);
  return path.events;
}

/// Its first limit point; NaN if there is none.
double first_maximum(const std::vector<ToggleEvent>& events) {
  const auto at = std::find_if(events.begin(), events.end(),
                               [](const ToggleEvent& e) { return e.kind == Kind::maximum; });
  return at == events.end() ? std::nan("") : at->load;
}

/// The whole toggle under displacement control of its apex, and its tangent's negative eigenvalues.
struct Controlled {
  explicit Controlled(Toggle toggle)
      : frame(make_frame((toggle.full = true, toggle))), at{VectorXd::Zero(frame.frame.size()), 0, 1} {}
  void go_to(double drop, int steps, double rounding = 1e-9) {
    const double from = -at.x[frame.apex];
    for (int i = 1; i <= steps; ++i)
      at = control(frame.frame, frame.load, frame.apex, -(from + (drop - from) * i / steps), at, rounding);
  }
  /// Eigenvalues of the tangent, rising.
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

// Recorded: 642.99 and 964.03, 258.7 and 266.7 of the half toggle. Half a toggle does not show that the apex
// turns before. EventsAreWhereDenseEigenvaluesVanish judges such points.
TEST(TogglePath, HighTogglesBifurcateBeforeTheirLimit) {
  for (const auto& [height, bow, limit] : {std::array{2., 642.99, 964.03}, std::array{1., 258.7, 266.68}}) {
    const std::vector<ToggleEvent> events = events_of({.height = height, .elements = 8});
    ASSERT_GE(events.size(), 3u);
    EXPECT_EQ(events[0].kind, Kind::bifurcation);
    EXPECT_FALSE(events[0].is_symmetric);
    EXPECT_EQ(events[1].kind, Kind::bifurcation);
    EXPECT_TRUE(events[1].is_symmetric);
    EXPECT_NEAR(events[1].load, bow, 0.05);
    EXPECT_NEAR(first_maximum(events), limit, 0.005);
  }
}

// At each point one eigenvalue of the dense tangent changes its sign, or the slope under displacement control
// does; between them none. Displacements are controlled to 1e-9, loads follow by slopes of 4000 lb/in.
TEST(TogglePath, EventsAreWhereDenseEigenvaluesVanish) {
  for (const double height : {0.44, 1., 2.}) {
    const Toggle toggle{.height = height, .elements = 4};
    Controlled walk(toggle);
    long negative = 0;
    double last = 0;
    for (const ToggleEvent& e : events_of(toggle)) {
      ASSERT_GT(e.drop, last);  // no drop twice at these heights
      walk.go_to(last + (e.drop - last) * 0.5, 20);
      EXPECT_EQ(walk.negative(), negative) << e.drop;
      walk.go_to(e.drop * (1 - 1e-5), 20);
      EXPECT_EQ(walk.negative(), negative) << e.drop;
      const double slope = walk.at.slope, load = walk.at.load;
      walk.go_to(e.drop * (1 + 1e-5), 1);
      EXPECT_EQ(std::abs(walk.negative() - negative), 1) << e.drop;
      EXPECT_EQ(e.kind != Kind::bifurcation, (slope > 0) != (walk.at.slope > 0)) << e.drop;
      EXPECT_NEAR(e.load, (load + walk.at.load) / 2, 1e-5 * std::abs(e.load) + 1e-8);
      negative = walk.negative();
      last = e.drop * (1 + 1e-5);
    }
    EXPECT_EQ(negative, 0);
  }
}

/// Two bifurcations that come into being at a height, both at a drop.
struct Pair {
  double height, drop;
  bool is_symmetric;
};

/// Loads of a pair: of the roots of the eigenvalue of the dense tangent that vanishes at their drop; none if
/// it does not come down to zero.
std::vector<double> pair_by_eigenvalues(const Toggle& toggle, const Pair& pair) {
  constexpr double wide = 0.01;  // of the drop: twice as far as the roots of these tests are apart, at least
  Controlled walk(toggle);
  walk.go_to(pair.drop, 200);
  Eigen::Index which = 0;
  walk.spectrum().cwiseAbs().minCoeff(&which);
  const auto value = [&](double drop) {
    // Along the vanishing direction alone, on which the eigenvalue depends by its square.
    walk.go_to(drop, 1, 1e-5);
    return walk.spectrum()[which];
  };
  const double sign = value(pair.drop - wide) > 0 ? 1 : -1;
  double least = pair.drop;
  for (double step = wide / 2; step > 1e-5; step /= 3) {  // the vertex of a parabola through three places
    const double a = value(least - step), b = value(least), c = value(least + step);
    least += step * (a - c) / (2 * (a - 2 * b + c));
  }
  std::vector<double> loads;
  if (sign * value(least) > 0) return loads;
  for (const double outside : {least - wide, least + wide}) {
    double in = least, out = outside;
    for (int i = 0; i < 16; ++i) (sign * value((in + out) / 2) > 0 ? out : in) = (in + out) / 2;
    // By a chord: at the root itself displacements along the other branch are not determined.
    const double inner = value(in), load = walk.at.load, outer = value(out);
    loads.push_back(load + (walk.at.load - load) * inner / (inner - outer));
  }
  return loads;
}

// Near the height where a pair of bifurcations begins its roots are close together, at a distance that grows
// like the root of the height beyond. Rounding of the nodes' places, 13 eps, changes a member's force by 2e-9
// lb, and its eigenvalues like a height that is up to 1e-9 in another one: by so much less or more the roots
// are apart.
TEST(TogglePath, PairsOfBifurcationsFromWhereTheyBegin) {
  for (const Pair& pair : {Pair{0.762947553, 0.50896, true}, Pair{1.2335566333, 0.47466, false}}) {
    for (const double beyond : {-1e-5, -1e-6, -1e-7, 0., 1e-8, 3e-8, 1e-7, 3e-7, 6.4e-7, 1e-6, 2e-6, 1e-5}) {
      const Toggle toggle{.height = pair.height + beyond, .elements = 4};
      const TogglePath path = critical_points(toggle);
      if (beyond == 0 && !path.status.ok()) continue;
      ASSERT_TRUE(path.status.ok()) << toggle.height << path.status.text();
      std::vector<double> found;
      for (const ToggleEvent& e : path.events) {
        if (e.kind == Kind::bifurcation && e.is_symmetric == pair.is_symmetric &&
            std::abs(e.drop - pair.drop) < 0.01)
          found.push_back(e.load);
      }
      if (beyond == 0) continue;  // one place but for rounding
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

// Where a symmetric bifurcation passes the maximum, near a height of 0.8973 in. Loads and drops of both are
// those of beam-columns written anew in long double, by the inertia of their stiffness; printed there to
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
    EXPECT_EQ(limit.kind, Kind::maximum);
    EXPECT_EQ(branch.kind, Kind::bifurcation);
    EXPECT_TRUE(branch.is_symmetric);
    // Path: next to another point a branch point is right to 1e-7 of a step, of 0.05 in here.
    EXPECT_NEAR(branch.drop, n.branch_drop, 5e-9) << n.height;
    EXPECT_NEAR(branch.load, n.branch, 5e-9) << n.height;
    EXPECT_NEAR(limit.load, n.limit, 1e-10 * n.limit) << n.height;
  }
}

// The first step from rest may be three hundred times too long; the first fold of four elements a member is
// where the slope under displacement control changes its sign.
TEST(TogglePath, VeryHighTogglesStayOnTheirPath) {
  const Toggle toggle{.height = 10, .elements = 4};
  const std::vector<ToggleEvent> events = events_of(toggle);
  EXPECT_NEAR(first_maximum(events), 6698.82, 0.005);
  EXPECT_EQ(std::count_if(events.begin(), events.end(),
                          [](const ToggleEvent& e) { return e.kind == Kind::maximum; }),
            1);
  Controlled walk(toggle);
  walk.go_to(0.0510, 51);
  EXPECT_LT(walk.at.slope, 0);  // by the displacement upwards
  walk.go_to(0.0520, 1);
  EXPECT_GT(walk.at.slope, 0);
  EXPECT_NEAR(walk.at.load, first_maximum(events), 0.5);
}

// Any number of elements from two finds the way through; limit loads converge, differences falling by more
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
  // Under 300 lb the drop is that of the shape of least energy.
  const ToggleFrame half = make_frame(toggle);
  Equilibrium equations(half.frame, half.load, 300);
  VectorXd x = VectorXd::Zero(half.frame.size());
  ASSERT_TRUE(find_root(algebraic::EnergyTrustRegion{}, equations, x).status.ok());
  EXPECT_NEAR(first_critical_point(toggle, 300).drop, -x[half.apex], 1e-12);
  EXPECT_EQ(unstable_motions(toggle, x), 0);
  // Just below the limit load of a low toggle the step that reaches it has passed the limit point.
  const TogglePath near = first_critical_point(Toggle{.height = 0.44}, 42.435492120383 * (1 - 1e-9));
  EXPECT_TRUE(near.events.empty());
  EXPECT_NEAR(near.drop, 0.22710546333003, 2e-5);
  EXPECT_LT(near.drop, 0.22710546333003);
  equations.set_load(500);  // past the antisymmetric bifurcation, before the symmetric one
  ASSERT_TRUE(find_root(algebraic::EnergyTrustRegion{}, equations, x).status.ok());
  EXPECT_EQ(unstable_motions(toggle, x), 1);
  EXPECT_THROW((void)first_critical_point(toggle, NAN), std::invalid_argument);
  EXPECT_THROW((void)unstable_motions(toggle, VectorXd::Zero(2)), std::invalid_argument);
}

// tan x = x and 4 pi^2; the known limit points, and where the slope of long double changes its sign.
TEST(TogglePath, OfWilliamsEquation) {
  const Williams low{.height = 0.44}, high{.height = 0.9}, ends{.height = 1};
  const auto of_low = critical_points(low).events;
  ASSERT_EQ(of_low.size(), 2u);
  EXPECT_NEAR(of_low[0].load, 42.771896097273, 1e-11);
  EXPECT_NEAR(of_low[1].load, 30.363548710287, 1e-11);
  for (const Williams& w : {high, ends}) {
    for (const ToggleEvent& e : critical_points(w).events) {
      if (e.kind != Kind::bifurcation) {
        const auto slope = [&](long double part) { return w.stiffness<long double>(e.drop * part); };
        EXPECT_LT(slope(1 - 1e-9L) * slope(1 + 1e-9L), 0);
        continue;
      }
      const double root = std::sqrt(w.compression(e.drop) * w.length * w.length / w.ei);
      EXPECT_NEAR(e.is_symmetric ? std::sin(root / 2) : std::tan(root) - root, 0, 1e-11);
    }
  }
  // The compression reaches the pole of d_5, and the load falls without bound.
  const TogglePath path = critical_points(ends);
  EXPECT_LT(path.drop, 1);
  EXPECT_EQ(path.events.back().kind, Kind::maximum);
  EXPECT_LT(ends.load(path.drop * (1 - 1e-9)), -1e6);
  EXPECT_EQ(first_critical_point(ends, 1000).events.size(), 1u);
  EXPECT_TRUE(first_critical_point(low, 40).events.empty());
  EXPECT_NEAR(low.load(first_critical_point(low, 40).drop), 40, 1e-12);
  EXPECT_NEAR(low.load(first_critical_point(low, -40).drop), -40, 1e-12);
  EXPECT_EQ(unstable_motions(ends, 0.01), 0);
  EXPECT_GT(unstable_motions(ends, 0.9 * path.drop), 0);
  EXPECT_THROW((void)critical_points(Williams{.height = -1}), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::frames::toggle_path_test

/// Load stepping: its solutions are on the path, and it jumps at limit points of the path.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "chapters/homotopy/solvers/load_stepping.hpp"
#include "tests/chapters/homotopy/toggle_oracle.hpp"

namespace nlmech::chapters::homotopy::load_stepping_test {
namespace {

/// The homotopy without a limit on iterations, which a jump might exceed.
Stepped patient_steps(Model model, double height, double step) {
  Stepping how{.model = model, .height = height, .step = step};
  how.iteration.limit = 1'000'000;
  return step_loads(how);
}

// |F| is half of the error of the load; the oracle has 50 digits.
TEST(LoadStepping, FoundPointsCarryTheirLoads) {
  for (const double height : heights) {
    for (const Model model : {Model::williams, Model::element}) {
      const auto load = model == Model::williams ? oracle::williams_load : oracle::element_load;
      const Stepped steps = patient_steps(model, height, 2.5);
      EXPECT_EQ(steps.up.size(), 20U);
      EXPECT_EQ(steps.down.size(), 19U);
      for (const auto* points : {&steps.up, &steps.down}) {
        for (const LoadPoint& p : *points) {
          ASSERT_TRUE(p.found) << height << " in, " << p.load << " lb";
          EXPECT_NEAR(static_cast<double>(load(height, p.deflection)), p.load, 2.001e-6);
        }
      }
    }
  }
}

// The slope of the distance bound: dF/ddelta is half of the stiffness.
TEST(LoadStepping, SlopeAtFoundPointsIsAtLeastFive) {
  for (const double height : heights) {
    for (const Model model : {Model::williams, Model::element}) {
      const auto curve = model == Model::williams ? williams_curve(height) : element_curve(height);
      for (const double step : {1.0, 0.5}) {
        const Stepped steps = patient_steps(model, height, step);
        for (const auto* points : {&steps.up, &steps.down})
          for (const LoadPoint& p : *points) EXPECT_GT(curve->stiffness(p.deflection) / 2, 5) << p.load;
      }
    }
  }
}

TEST(LoadStepping, JumpsAtTheFirstLoadPastTheLimit) {
  for (const double height : {0.38, 0.44}) {
    for (const bool williams : {true, false}) {
      const Stepped steps = patient_steps(williams ? Model::williams : Model::element, height, 1);
      const LimitPoints limits = known_limits_of(height, williams).value();
      const auto up = jumps(steps, true), down = jumps(steps, false);
      ASSERT_EQ(up.size(), 1U);
      ASSERT_EQ(down.size(), 1U);
      EXPECT_LT(up[0].before.load, limits.maximum.load);
      EXPECT_GT(up[0].after.load, limits.maximum.load);
      EXPECT_EQ(up[0].after.branch, Branch::far);
      EXPECT_GT(down[0].before.load, limits.minimum.load);
      EXPECT_LT(down[0].after.load, limits.minimum.load);
      EXPECT_EQ(down[0].after.branch, Branch::first);
    }
  }
  for (const bool up : {true, false}) EXPECT_TRUE(jumps(patient_steps(Model::williams, 0.32, 1), up).empty());
}

// The path is concave up to the smallest stiffness and convex beyond: hence no step passes a root on a rising
// branch.
TEST(LoadStepping, StiffnessFallsAndThenGrows) {
  for (const double height : heights) {
    for (const bool williams : {true, false}) {
      const auto curve = williams ? williams_curve(height) : element_curve(height);
      const double least = least_stiff_point(*curve).deflection;
      for (int i = 0; i < 70; ++i) {
        const double a = 0.01 * i, b = a + 0.01;
        if (a < least && b > least) continue;
        EXPECT_EQ(curve->stiffness(a) > curve->stiffness(b), b <= least) << a;
      }
    }
  }
}

// From below on the concave branch, from above on the convex one; steps of fictitious time below 2.
RC_GTEST_PROP(LoadStepping, NoIteratePassesTheRoot, ()) {
  const bool williams = *rc::gen::arbitrary<bool>(), up = *rc::gen::arbitrary<bool>();
  const double height = *rc::gen::element(0.38, 0.44), euler = *rc::gen::inRange(30, 200) * 0.01;
  const auto curve = williams ? williams_curve(height) : element_curve(height);
  const LimitPoints at = known_limits_of(height, williams).value();
  const double low = up ? 0 : at.minimum.deflection, high = up ? at.maximum.deflection : 0.75;
  const double one = low + (high - low) * *rc::gen::inRange(1, 999) * 1e-3;
  const double other = low + (high - low) * *rc::gen::inRange(1, 999) * 1e-3;
  const double start = up ? std::min(one, other) : std::max(one, other);
  const double root = up ? std::max(one, other) : std::min(one, other);
  LoadedToggle toggle(williams ? Model::williams : Model::element, height, curve->load(root));
  std::vector<IterationRecord> trace;
  const Count count = iterate(
      toggle, {.scheme = Scheme::fixed_point, .step = euler, .tolerance = 1e-6, .start = start}, &trace);
  RC_ASSERT(count.converged);
  for (const IterationRecord& t : trace) RC_ASSERT((up ? 1 : -1) * (t.deflection - root) <= 1e-12);
}

TEST(LoadStepping, GivenUpLoadsAreLeftOut) {
  const LoadPoint first{1, true, 0.1, 1e-8, Branch::first}, lost{2, false, 0.7, NAN, Branch::falling},
      far{3, true, 0.6, 2e-8, Branch::far};
  const Stepped steps{{}, {first, lost, far}, {far, first}};
  const auto up = jumps(steps, true), down = jumps(steps, false);
  ASSERT_EQ(up.size(), 1U);
  EXPECT_EQ(up[0].before.load, 1);
  EXPECT_EQ(up[0].after.load, 3);
  EXPECT_EQ(down.size(), 1U);
  EXPECT_EQ(unsolved(steps.up), 1);
  EXPECT_EQ(points_on(steps.up, Branch::falling), 0);
  EXPECT_EQ(greatest_distance(steps), 2e-8);
}

// The change of branch at the first decreasing load is detected.
TEST(LoadStepping, UnloadingStartsWhereLoadingEnded) {
  const LoadPoint far{3, true, 0.6, 0, Branch::far}, first{2, true, 0.1, 0, Branch::first};
  ASSERT_EQ(jumps({{}, {far}, {first}}, false).size(), 1U);
  EXPECT_EQ(jumps({{}, {far}, {first}}, false)[0].before.load, 3);
}

// With too few iterations every load fails, and each load starts from rest again.
TEST(LoadStepping, StartsFromTheLastDeflectionFound) {
  Stepping how{.step = 10};
  how.iteration.limit = 0;
  const Stepped steps = step_loads(how);
  EXPECT_EQ(unsolved(steps.up), 5);
  EXPECT_EQ(unsolved(steps.down), 4);
  for (const LoadPoint& p : steps.up) EXPECT_EQ(p.deflection, 0);
  EXPECT_EQ(greatest_distance(steps), 0);
}

TEST(LoadCurves, DeflectionBetween) {
  const auto curve = element_curve(0.44);
  const double falling = deflection_between(*curve, 35, 0.23, 0.48);
  EXPECT_NEAR(curve->load(falling), 35, 1e-11);
  EXPECT_TRUE(falling > 0.23 && falling < 0.48);
  EXPECT_TRUE(std::isnan(deflection_between(*curve, 43, 0, 0.48)));
}

}  // namespace
}  // namespace nlmech::chapters::homotopy::load_stepping_test

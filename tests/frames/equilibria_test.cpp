/// Equilibria of the toggle by energy and by arc length: near the limit load, past it, from unstable and
/// snapped starts, with very many elements.
#include <gtest/gtest.h>

#include "nlmech/algebraic/paths/path.hpp"
#include "nlmech/frames/loaded_frame.hpp"
#include "tests/frames/random_equilibria.hpp"

namespace nlmech::frames::equilibria_test {
namespace {

using algebraic::ArcLength;
using algebraic::EnergyTrustRegion;
using algebraic::PathMethod;
using algebraic::Report;
using Eigen::VectorXd;
using Kind = PathMethod::Kind;

constexpr Kind kinds[] = {Kind::riks, Kind::crisfield, Kind::gdc};

TEST(Equilibria, OfRandomToggles) { expect_equilibria_of_random_toggles(200, 1); }

/// Drop of the apex after a solution from rest.
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

// Just below the limit load lie two equilibria, 0.227120 and 0.227139; a finite step over both of them ends
// on the far branch at 0.6143. oracle: homotopy_frames toggle 0.44 of 4 maximum, toggle 0.44 of 4 drop *
TEST(Equilibria, NextToTheLimitLoad) {
  const Toggle toggle{.height = 0.44, .elements = 4};
  const double limit = 42.4387099966;
  // The drop there is within 1e-5 of that at the limit; the limit load's own last digit, 5e-11, shifts it by
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

// An equilibrium on the falling branch is a root of F but no minimum of V: from there the energy leads on to
// one of the two stable ones. From the snapped shape it finds the snapped one, from rest the other.
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
  // Limit loads are 42.4 and 32.1: at 36 there are two stable shapes.
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

// 1000 elements: the floor of F is 1e-4 of the load, and increments still end the iteration.
TEST(Equilibria, OfAThousandElements) {
  EXPECT_NEAR(drop(EnergyTrustRegion{}, {.height = 0.44, .elements = 1000}, 44),
              drop(EnergyTrustRegion{}, {.height = 0.44, .elements = 64}, 44), 1e-6);
}

}  // namespace
}  // namespace nlmech::frames::equilibria_test

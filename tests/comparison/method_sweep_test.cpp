/// Sweeps of step sizes and tolerances: their settings, order and names.
#include "nlmech/comparison/cost/method_sweep.hpp"

#include <gtest/gtest.h>

#include "nlmech/peers/ivp/registry.hpp"

namespace nlmech::comparison::contenders_test {
namespace {

std::vector<std::string> texts(const MethodSweep& sweep) {
  std::vector<std::string> all;
  for (const Setting& setting : sweep.settings) all.push_back(setting.text);
  return all;
}

TEST(MethodSweep, SweepTolerancesFromCoarseToFine) {
  const MethodSweep full = by_tolerances("ode45", Kind::explicit_, false);
  ASSERT_EQ(full.settings.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    const double expected = std::pow(10, -4 - static_cast<int>(i));
    EXPECT_DOUBLE_EQ(full.settings[i].settings.tolerance.value(), expected);
    EXPECT_FALSE(full.settings[i].settings.step.has_value());
  }
  EXPECT_EQ(texts(by_tolerances("ode45", Kind::explicit_, true)),
            (std::vector<std::string>{"tolerance 1e-04", "tolerance 1e-08"}));
}

TEST(MethodSweep, SweepStepsAsMultiplesOfAScale) {
  const std::vector<double> factors = {1, 0.5, 0.25};
  const MethodSweep full = by_steps("rk4", {}, Kind::classical, 0.2, factors, false);
  EXPECT_EQ(texts(full), (std::vector<std::string>{"step 0.2", "step 0.1", "step 0.05"}));
  EXPECT_FALSE(full.settings[0].settings.shape.has_value());
  EXPECT_EQ(texts(by_steps("rk4", {}, Kind::classical, 0.2, factors, true)),
            (std::vector<std::string>{"step 0.2", "step 0.05"}));
}

// The product of shape parameter and step size is constant in a sweep, because it determines the flatness of
// the radial functions over a step.
TEST(MethodSweep, KeepTheShapeOfRadialFunctionsAStep) {
  const MethodSweep c = by_steps("rbf-coll", 9, Kind::source, 2, std::vector<double>{1, 0.125}, false, 3);
  for (const Setting& s : c.settings) EXPECT_DOUBLE_EQ(s.settings.shape.value() * s.settings.step.value(), 3);
  EXPECT_EQ(c.label(), "rbf-coll, N = 9");
}

TEST(MethodSweep, AreNamedByWhatTellsThemApart) {
  MethodSweep c{"mtl", {}, Kind::classical, {}};
  EXPECT_EQ(c.label(), "mtl");
  c.points = 3;
  EXPECT_EQ(c.label(), "mtl, p = 3");
}

TEST(MethodSweep, AreAllPeersExplicitOnesFirst) {
  const std::vector<MethodSweep> all = all_peers(true);
  EXPECT_EQ(all.size(), peers::all_peer_names().size());
  bool implicit = false;
  for (const MethodSweep& peer : all) {
    EXPECT_GE(peer.kind == Kind::implicit, implicit) << peer.name;
    implicit = peer.kind == Kind::implicit;
    EXPECT_EQ(implicit, peers::peer_info(peer.name).family == ivp::Family::implicit) << peer.name;
    EXPECT_EQ(peer.settings.empty(), !peers::peer_info(peer.name).is_available()) << peer.name;
  }
}

}  // namespace
}  // namespace nlmech::comparison::contenders_test

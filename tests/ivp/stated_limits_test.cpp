// Solutions are checked against the bounds and conserved quantities that their problem declares.
#include "nlmech/ivp/stated_limits.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "nlmech/ivp/collocation/adaptive_collocation.hpp"
#include "nlmech/ivp/runge_kutta/dormand_prince.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/ivp/series/series.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/typed.hpp"

namespace nlmech::ivp::stated_limits_test {
namespace {

AdaptiveCollocation to(double tolerance) {
  return {.relative_tolerance = tolerance, .absolute_tolerance = tolerance};
}

// y2 is 8e-14 at t = 1e11 and 8e-17 at 1e14. With a much larger tolerance it becomes negative; then
// concentrations of both signs grow without bound while their sum is conserved.
TEST(StatedLimits, RobertsonDoesNotRunAway) {
  const System system(problems::TextProblem("robertson"));
  const auto x0 = problems::TextProblem("robertson").initial_state();
  int refused = 0;
  for (const double end : {1e11, 1e12, 1e14}) {
    for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6, 1e-9}) {
      double lowest = 0;
      const Observer look = [&](const Step& step) {
        lowest = std::min(lowest, step.x1.minCoeff() / tolerance);
        return true;
      };
      const auto s = integrate(system, x0, 0, end, to(tolerance), look);
      EXPECT_GE(lowest, -20) << "a step that was shown breaks the bound: " << end << ' ' << tolerance;
      if (s.status.ok()) {
        EXPECT_GE(s.x.minCoeff(), -20 * tolerance) << end << ' ' << tolerance;
        continue;
      }
      ++refused;
      EXPECT_EQ(s.status.outcome(), Outcome::spurious_root) << s.status.text();
      EXPECT_NE(s.status.sentence().find("smaller absolute tolerance"), std::string::npos) << s.status.text();
      EXPECT_LT(s.t, end);
    }
  }
  EXPECT_GT(refused, 0) << "none of these runs tests anything";
  const auto fine = integrate(system, x0, 0, 1e11,
                              AdaptiveCollocation{.relative_tolerance = 1e-6, .absolute_tolerance = 1e-14});
  EXPECT_TRUE(fine.status.ok()) << fine.status.text();
}

TEST(StatedLimits, BoundsHoldForwardsAndFromWithin) {
  const System system(problems::TextProblem("robertson"));
  // In negative time concentrations do become negative; from negative initial values the bounds are not
  // checked.
  const auto back = integrate(system, {0.5, 1e-5, 0.5}, 1, 0.9, to(1e-8));
  EXPECT_NE(back.status.outcome(), Outcome::spurious_root) << back.status.text();
  const auto outside = integrate(system, {1, -1e-6, 0}, 0, 1e-3, to(1e-9));
  EXPECT_TRUE(outside.status.ok()) << outside.status.text();
}

/// A damped oscillator that declares its energy as conserved.
System boast(double damping = 0) {
  return testing::typed(fmt::format("x'' = -x - {} x'; conserved x^2 + x'^2", damping));
}

// Over ten units of time c = 1e-4 dissipates a thousandth of the energy, a million tolerances.
TEST(StatedLimits, EnergyThatMovesIsNoSuccess) {
  for (const auto& s : {integrate(boast(1e-4), State{1, 0}, 0, 10, to(1e-9)),
                        integrate(boast(1e-4), State{1, 0}, 0, 10, Ode45{}),
                        integrate(boast(1e-4), State{1, 0}, 0, -10, Ode45{}),
                        integrate(boast(1e-4), State{1, 0}, 0, 10, Series{})}) {
    EXPECT_EQ(s.status.outcome(), Outcome::spurious_root) << s.status.text();
    EXPECT_NE(s.status.sentence().find("conserves"), std::string::npos) << s.status.text();
  }
  // Fixed steps have no tolerance for the invariants to be checked against.
  EXPECT_TRUE(integrate(boast(1e-4), State{1, 0}, 0, 10, Rk4{.step = 0.1}).status.ok());
  EXPECT_TRUE(integrate(boast(1e-4), State{1, 0}, 0, 10, Series{.order = 4, .step = 0.1}).status.ok());
}

TEST(StatedLimits, HonestRunsPass) {
  for (const double tolerance : {1e-2, 1e-4, 1e-8, 1e-12}) {
    const Ode45 ode45{.relative_tolerance = tolerance, .absolute_tolerance = tolerance};
    for (const double end : {0.1, 10., 1000.}) {
      for (const auto& s :
           {integrate(boast(), State{1, 0}, 0, end, to(tolerance)),
            integrate(boast(), State{1, 0}, 0, end, ode45),
            integrate(System(problems::TextProblem("duffing")), State{3, 1}, 0, end, to(tolerance)),
            integrate(System(problems::TextProblem("duffing")), State{0, 1e-3}, 0, end, ode45)})
        EXPECT_TRUE(s.status.ok()) << end << ' ' << tolerance << ' ' << s.status.text();
    }
    const auto hires = integrate(
        System(problems::TextProblem("hires")), problems::TextProblem("hires").initial_state(), 0,
        problems::TextProblem("hires").final_time,
        AdaptiveCollocation{.relative_tolerance = tolerance, .absolute_tolerance = 1e-4 * tolerance});
    EXPECT_TRUE(hires.status.ok()) << hires.status.text();
  }
}

}  // namespace
}  // namespace nlmech::ivp::stated_limits_test

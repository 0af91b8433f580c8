/// Systems with switches: dry friction, arcs of parabolas with corners, infinitely many switches.
#include "nlmech/ivp/switching.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/program/switches.hpp"
#include "tests/ivp/typed.hpp"

namespace nlmech::tests::switching_test {
namespace {

using ivp::State;
constexpr double pi = std::numbers::pi;

/// q'' = -stiffness q - force sign(q) - friction sign(v).
struct Corners {
  double stiffness = 0, force = 0, friction = 0;
  [[nodiscard]] ivp::System system() const {
    return ivp::testing::typed(
        fmt::format("q'' = -{} q - {} sign(q) - {} sign(q')", stiffness, force, friction));
  }
};

/// Adaptive methods of every kind.
const std::vector<std::string> methods = {"ode45", "dop853", "series", "adaptive-collocation"};

ivp::Solution run(const Corners& problem, const std::string& method, const State& x0, double t1,
                  double tolerance, const ivp::Observer& observer = {}) {
  return ivp::named_integrator(method, {.tolerance = tolerance})(problem.system(), x0, 0, t1, observer, {});
}

// Each half swing with friction mu ends 2 mu closer to 0; a turning point within mu of 0 is the last: 1,
// -0.7, 0.4, -0.1. Bound: a thousand tolerances, for the errors of three half swings and of the times of
// their turning points.
TEST(Switching, DryFrictionComesToRest) {
  const Corners friction{.stiffness = 1, .friction = 0.15};
  for (const std::string& method : methods) {
    SCOPED_TRACE(method);
    const auto moving = run(friction, method, {1, 0}, 2 * pi + 1, 1e-10);
    ASSERT_TRUE(moving.status.ok()) << moving.status.text();
    EXPECT_NEAR(moving.x[0], 0.15 + 0.25 * std::cos(1), 1e-7);
    EXPECT_NEAR(moving.x[1], -0.25 * std::sin(1), 1e-7);
    const auto rest = run(friction, method, {1, 0}, 20, 1e-10);
    ASSERT_TRUE(rest.status.ok()) << rest.status.text();
    EXPECT_NEAR(rest.x[0], -0.1, 1e-7);
    EXPECT_NEAR(rest.x[1], 0, 1e-9);
  }
}

// Both sides of x = 0 lead to it: 0.3 - 1 from above, 0.3 + 1 from below. The share of the upper side is
// 0.65, for which a further expression sign(x) is 0.3. For x' = 2 - sign(x) they do not.
TEST(Switching, TheModeAtAPoint) {
  const State zero{0}, errors{1e-9};
  const ivp::System sliding = ivp::testing::typed("x' = 0.3 - sign(x)");
  EXPECT_EQ(ivp::mode_at(sliding, 0, zero, errors), ivp::Mode({0}));
  EXPECT_EQ(ivp::mode_at(sliding, 0, State{-1e-10}, errors), ivp::Mode({0}));
  EXPECT_EQ(ivp::mode_at(sliding, 0, State{-1e-8}, errors), ivp::Mode({-1}));
  EXPECT_EQ(ivp::mode_at(sliding, 0, State{1}, errors), ivp::Mode({1}));
  EXPECT_EQ(ivp::mode_at(ivp::testing::typed("x' = 2 - sign(x)"), 0, zero, errors), ivp::Mode({1}));
  program::Equations equations({"test", "x' = 0.3 - sign(x)"});
  const program::NodeId sign = equations.expression("column", "sign(x)");
  const program::Switches switches(equations.graph(), equations.slopes(), {sign});
  double value = 0;
  switches.in_mode({0})->run(0., zero, 3, 4, [&value](int, double v) { value = v; });
  EXPECT_NEAR(value, 0.3, 1e-15);
}

// Arcs of parabolas with period 4 sqrt(2 q0); the observer receives whole steps between the corners.
TEST(Switching, StepsEndAtCorners) {
  const double quarter = std::sqrt(2.0);
  for (const std::string& method : methods) {
    SCOPED_TRACE(method);
    std::vector<double> corners;
    double last = 0;
    const auto watch = [&](const ivp::Step& step) {
      EXPECT_EQ(step.t0, last);
      EXPECT_NEAR(step.at(step.t0)[0], step.x0[0], 1e-9);
      last = step.t1;
      if (std::abs(step.x1[0]) < 1e-7) corners.push_back(step.t1);
      return true;
    };
    const auto end = run({.force = 1}, method, {1, 0}, 8 * quarter, 1e-12, watch);
    ASSERT_TRUE(end.status.ok()) << end.status.text();
    EXPECT_EQ(last, 8 * quarter);
    EXPECT_NEAR(end.x[0], 1, 1e-9);
    EXPECT_NEAR(end.x[1], 0, 1e-9);
    ASSERT_EQ(corners.size(), 4U);
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(corners[k], static_cast<double>(2 * k + 1) * quarter, 1e-9);
  }
}

// With a constant slope a step may be as long as the remaining interval, over many switches and whole
// periods.
TEST(Switching, LongStepsMissNoSwitch) {
  for (const std::string& method : methods) {
    const auto end_of = [&](const std::string& equation, double t1) {
      const auto run = ivp::named_integrator(method, {.tolerance = 1e-10});
      const auto end = run(ivp::testing::typed(equation), State::Zero(1), 0, t1, {}, {});
      EXPECT_TRUE(end.status.ok()) << end.status.text();
      return end.x[0];
    };
    SCOPED_TRACE(method);
    EXPECT_NEAR(end_of("x' = sign(sin(pi t))", 160.5), 0.5, 1e-8);
    EXPECT_NEAR(end_of("x' = sign(sin(pi t))", 160), 0, 1e-8);
    // The slope is 1 while the sine exceeds 0.9.
    EXPECT_NEAR(end_of("x' = max(sign(sin(2 pi t) - 0.9), 0)", 32), 32 * (0.5 - std::asin(0.9) / pi), 1e-8);
  }
}

// sign(x) is constant on each side, so max(sign(x), 0) switches where x does: a relay, which holds x at 0.
TEST(Switching, AChoiceOfAChoiceIsOneSwitch) {
  const ivp::System relay = ivp::testing::typed("x' = 1 - 2 max(sign(x), 0)");
  EXPECT_EQ(relay.switches(), 1);
  for (const double x0 : {1.0, -1.0}) {
    const auto end = ivp::named_integrator("dop853", {.tolerance = 1e-10})(relay, State{x0}, 0, 3, {}, {});
    ASSERT_TRUE(end.status.ok()) << end.status.text();
    EXPECT_NEAR(end.x[0], 0, 1e-12);
  }
  // The value is 1 above and 0 below, whatever the choice on the surface.
  const auto step = ivp::named_integrator("series", {.tolerance = 1e-10})(
      ivp::testing::typed("x' = sign(max(sign(sin(t)), 0))"), State{0}, 0, 3 * pi, {}, {});
  ASSERT_TRUE(step.status.ok()) << step.status.text();
  EXPECT_NEAR(step.x[0], 2 * pi, 1e-9);
}

// A rounded function has a cell between any two integers, and a surface at each.
TEST(Switching, TheModeOfARoundedFunction) {
  const ivp::System sliding = ivp::testing::typed("x' = 0.5 - floor(x)");
  const State errors{1e-9};
  EXPECT_EQ(ivp::mode_at(sliding, 0, State{1.5}, errors), ivp::Mode({3}));
  EXPECT_EQ(ivp::mode_at(sliding, 0, State{-0.5}, errors), ivp::Mode({-1}));
  EXPECT_EQ(ivp::mode_at(sliding, 0, State{1 - 1e-10}, errors), ivp::Mode({2}));
  EXPECT_EQ(ivp::mode_at(sliding, 0, State{2}, errors), ivp::Mode({5}));
  EXPECT_EQ(ivp::testing::typed("x' = floor(x) + 2 ceil(x) - frac(x) + mod(x, 1)").switches(), 1);
}

/// A solution of one equation with floor, ceil, frac or mod of the state.
struct Rounded {
  const char* equation;
  double x0, t1, x1;
};

// Between two integers each of these equations has constant coefficients: the slope of stairs is a constant,
// and with u = mod(x, 1), u' = 1 + u takes log(2) for a turn. Bound: a thousand tolerances, for the errors of
// five cells.
TEST(Switching, RoundedStatesHaveClosedForms) {
  const double turn = std::log(2.0), wave = 2 * (pi - std::asin(1. / 3) - std::asin(2. / 3));
  const std::vector<Rounded> all = {{"x' = floor(x)", 1.5, 1.5, 4 + 4 * (1.5 - 0.5 - 1. / 2 - 1. / 3)},
                                    {"x' = ceil(x)", 0.5, 1.5, 3 + 4 * (1.5 - 0.5 - 1. / 2 - 1. / 3)},
                                    {"x' = -1 - floor(-x)", 1.5, 1.5, 4 + 4 * (1.5 - 0.5 - 1. / 2 - 1. / 3)},
                                    {"x' = floor(x)", -0.5, 1.2, -2 - 3 * (1.2 - 0.5 - 1. / 2)},
                                    {"x' = 0.5 - floor(x)", 2.2, 5, 1},   // both sides lead to 1
                                    {"x' = -floor(2 x)/2", 1.2, 5, 0.5},  // the side below 0.5 is at rest
                                    {"x' = 1 + mod(x, 1)", 0, 3.5 * turn, 2 + std::sqrt(2.0)},
                                    {"x' = 1 + mod(x, 1)", 3, -1.5 * turn, std::sqrt(2.0)},
                                    {"x' = 1 + frac(x/3)*3", 0, std::log(4.0) * 2, 6},
                                    {"x' = 1 + if(mod(x, 1) < 0.25, 1, 0)", 0, 3.5 * 0.875, 3.5625},
                                    {"x' = 1 + if(floor(x) > 1, 1, 0) - if(floor(x) >= 3, 1, 0)", 0, 4, 4.5},
                                    {"x' = floor(3 sin(t))", 0, pi, wave},
                                    {"x' = floor(3 sin(t))", 0, 2 * pi, -pi}};
  for (const Rounded& r : all) {
    for (const std::string& method : methods) {
      SCOPED_TRACE(fmt::format("{} from {} by {}", r.equation, r.x0, method));
      const auto end = ivp::named_integrator(method, {.tolerance = 1e-10})(ivp::testing::typed(r.equation),
                                                                           State{r.x0}, 0, r.t1, {}, {});
      ASSERT_TRUE(end.status.ok()) << end.status.text();
      EXPECT_NEAR(end.x[0], r.x1, 1e-7);
    }
  }
}

// At an integer floor has the value of the upper side, where the solution may stay; beyond 1e9 there are no
// cells.
TEST(Switching, RoundedFunctionsAtTheStart) {
  const auto run = ivp::named_integrator("dop853", {.tolerance = 1e-10});
  const auto end_of = [&run](const std::string& equation, double x0) {
    return run(ivp::testing::typed(equation), State{x0}, 0, 1, {}, {});
  };
  EXPECT_EQ(end_of("x' = floor(x)", 0).x[0], 0);
  EXPECT_NEAR(end_of("x' = floor(x) - 1", 0).x[0], -2 - 4 * (1 - 1. / 2 - 1. / 3), 1e-7);
  const auto far = end_of("x' = floor(x)", 2e9);
  EXPECT_EQ(far.status.outcome(), Outcome::outside_validity);
  EXPECT_NE(far.status.text().find("beyond 1e+09 periods"), std::string::npos) << far.status.text();
}

TEST(Switching, RunsBackwardsWhereItHasAPast) {
  const auto there = run({.force = 1}, "series", {1, 0.3}, 5, 1e-13);
  ASSERT_TRUE(there.status.ok());
  const auto back = ivp::named_integrator("series", {.tolerance = 1e-13})(Corners{.force = 1}.system(),
                                                                          there.x, 5, 0, {}, {});
  ASSERT_TRUE(back.status.ok());
  EXPECT_NEAR(back.x[0], 1, 1e-11);
  EXPECT_NEAR(back.x[1], 0.3, 1e-11);
  // At rest under dry friction the earlier motion is undetermined.
  const auto rest = ivp::named_integrator("series", {.tolerance = 1e-9})(
      Corners{.stiffness = 1, .friction = 0.5}.system(), {0.1, 0}, 5, 0, {}, {});
  EXPECT_EQ(rest.status.outcome(), Outcome::outside_validity);
  EXPECT_NE(rest.status.text().find("cannot be integrated backwards"), std::string::npos)
      << rest.status.text();
}

// Each return to q = 0 is slower by a constant factor: infinitely many switches before t = 3.5. Steps shrink
// to the spacing of the numbers; then the motion rests at the origin or the integration fails.
TEST(Switching, SwitchesWithoutEndEnd) {
  for (const std::string& method : methods) {
    const auto end = run({.force = 1, .friction = 0.5}, method, {1, 0}, 20, 1e-9);
    if (end.status.ok()) {
      EXPECT_NEAR(end.x.norm(), 0, 1e-6) << method;
      EXPECT_EQ(end.t, 20) << method;
    } else {
      EXPECT_NE(end.status.outcome(), Outcome::time_limit) << method << ": " << end.status.text();
      EXPECT_LT(end.t, 12) << method;
    }
  }
}

/// x'' = 1, and 1001 where x < 0.
ivp::System grazing() { return ivp::testing::typed("x'' = 501 - 500 sign(x)"); }

// A stop with a thousand times the force, reached with speed v: contact lasts 2 v/1001, and the motion leaves
// with the same speed.
TEST(Switching, MeetsWhatLastsLessThanAStep) {
  for (const std::string& method : methods) {
    SCOPED_TRACE(method);
    for (const double speed : {1e-2, 1e-3, 1e-5}) {
      // x = ((t - 1)^2 - speed^2)/2 until it reaches the stop at 0.
      const State x0{0.5 - speed * speed / 2, -1};
      const double meets = 1 - speed, leaves = meets + 2 * speed / 1001, end = 2;
      std::vector<double> ends;
      const auto run = ivp::named_integrator(method, {.tolerance = 1e-11})(grazing(), x0, 0, end,
                                                                           [&](const ivp::Step& step) {
                                                                             ends.push_back(step.t1);
                                                                             return true;
                                                                           },
                                                                           {});
      ASSERT_TRUE(run.status.ok()) << run.status.text();
      const double rest = end - leaves;
      // An error of the switching times, some 1e-11, changes the speed after the contact by a thousand times
      // as much.
      EXPECT_NEAR(run.x[0], speed * rest + rest * rest / 2, 1e-7) << speed;
      const auto nearest = [&](double t) {
        double best = 1;
        for (const double e : ends) best = std::min(best, std::abs(e - t));
        return best;
      };
      EXPECT_LE(nearest(meets), 1e-10 / speed) << speed;
      EXPECT_LE(nearest(leaves), 1e-10 / speed) << speed;
    }
    // Turning point half a unit above the stop: a smooth motion without a switch.
    const auto above = ivp::named_integrator(method, {.tolerance = 1e-11})(grazing(), {1, -1}, 0, 2, {}, {});
    ASSERT_TRUE(above.status.ok());
    EXPECT_NEAR(above.x[0], 1, 1e-9);
  }
}

// The switching function is not a number for x > 3.
TEST(Switching, SaysWhereAFunctionIsNone) {
  for (const std::string method : {"ode45", "series"}) {
    const auto run = ivp::named_integrator(method, {.tolerance = 1e-9})(
        ivp::testing::typed("x' = sign(sqrt(3 - x) + 1)"), State{1.0}, 0, 5, {}, {});
    EXPECT_EQ(run.status.outcome(), Outcome::non_finite) << method;
    EXPECT_NE(run.status.text().find("switching function 1 is not a number"), std::string::npos)
        << run.status.text();
  }
}

TEST(Switching, KeepsToItsLimits) {
  const auto end = ivp::named_integrator("ode45", {.tolerance = 1e-12})(Corners{.force = 1}.system(), {1, 0},
                                                                        0, 1000, {}, {.steps = 50});
  EXPECT_EQ(end.status.outcome(), Outcome::step_limit) << end.status.text();
  EXPECT_LE(end.statistics.steps + end.statistics.rejected, 60);
}

TEST(Switching, StopsWhenToldTo) {
  int steps = 0;
  const auto end = run({.force = 1}, "ode45", {1, 0}, 10, 1e-9, [&steps](const ivp::Step&) {
    ++steps;
    return steps < 3;
  });
  EXPECT_EQ(steps, 3);
  EXPECT_EQ(end.status.outcome(), Outcome::interrupted);
}

}  // namespace
}  // namespace nlmech::tests::switching_test

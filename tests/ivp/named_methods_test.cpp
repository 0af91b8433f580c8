/// Methods by name: each name gives its method, and wrong settings are refused.
#include "nlmech/ivp/named/named_methods.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "nlmech/ivp/collocation/collocation.hpp"
#include "nlmech/ivp/collocation/picard.hpp"
#include "nlmech/ivp/hermitian/hermitian.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/ivp/structural/alpha_family.hpp"
#include "nlmech/ivp/transversal/mtl.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/oracle.hpp"

namespace nlmech::ivp::named_methods_test {
namespace {

using problems::TextProblem;

Solution duffing(std::string_view name, const Settings& settings, double until) {
  return named_integrator(name, settings)(System(TextProblem("duffing")), State{1, 0}, 0, until, {}, {});
}

std::string complaint(std::string_view name, const Settings& settings) {
  try {
    static_cast<void>(named_integrator(name, settings));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(NamedMethods, AreThoseOfTheCommandLine) {
  std::set<std::string> names;
  for (const MethodInfo& m : named_methods()) {
    EXPECT_TRUE(names.emplace(m.name).second) << m.name;
    EXPECT_EQ(&method_info(m.name), &m);
    EXPECT_FALSE(m.meaning.empty()) << m.name;
    EXPECT_FALSE(m.has(shape_setting) && !m.has(nodes_setting)) << m.name;
  }
  EXPECT_EQ(names, (std::set<std::string>{"euler",
                                          "backward-euler",
                                          "explicit",
                                          "rk4",
                                          "rk6",
                                          "ode45",
                                          "dop853",
                                          "rkn1210",
                                          "series",
                                          "newmark",
                                          "hht",
                                          "generalized-alpha",
                                          "mcpi",
                                          "rbf-coll",
                                          "lgl-coll",
                                          "radau-coll",
                                          "adaptive-collocation",
                                          "mtl",
                                          "laier",
                                          "argyris",
                                          "hoff",
                                          "bazzi"}));
}

TEST(NamedMethods, UnknownNameListsTheKnownOnes) {
  const std::string words = complaint("runge-kutta", {});
  EXPECT_NE(words.find("'runge-kutta'"), std::string::npos) << words;
  for (const MethodInfo& m : named_methods()) EXPECT_NE(words.find(m.name), std::string::npos) << words;
}

// A method by name with a step size and the aggregate of that method give bitwise equal results.
TEST(NamedMethods, StepIsPassedOn) {
  const System system(TextProblem("duffing"));
  const State x0 = State{1, 0};
  const auto same = [&](std::string_view name, const Settings& settings, const auto& method) {
    const Solution a = duffing(name, settings, 3), b = integrate(system, x0, 0, 3, method);
    EXPECT_TRUE(a.status.ok()) << a.status.text();
    EXPECT_EQ(a.x, b.x) << name;
    EXPECT_EQ(a.statistics.right_hand_sides, b.statistics.right_hand_sides) << name;
  };
  same("euler", {.step = 0.1}, Euler{.step = 0.1});
  same("rk4", {.step = 0.1}, Rk4{.step = 0.1});
  same("rk6", {.step = 0.1}, Rk6{.step = 0.1});
  same("newmark", {.step = 0.1}, Newmark{.step = 0.1});
  same("mcpi", {.step = 0.5}, Mcpi{.step = 0.5});
  same("mcpi", {.step = 0.5, .nodes = 13}, Mcpi{.step = 0.5, .order = 12});
  same("rbf-coll", {.step = 0.5, .nodes = 9, .shape = 0.8},
       RbfCollocation{.step = 0.5, .nodes = 9, .shape = 0.8});
  same("rbf-coll", {.step = 0.5}, RbfCollocation{.step = 0.5});
  same("lgl-coll", {.step = 0.5, .nodes = 9}, PolynomialCollocation{.step = 0.5, .nodes = 9});
  same("laier", {.step = 0.1}, Hermitian{.step = 0.1});
  same("argyris", {.step = 0.1}, Hermitian{.operators = argyris, .step = 0.1});
  same("mtl", {.step = 0.1}, Mtl{.step = 0.1});
  same("mtl", {.step = 0.1, .points = 5}, Mtl{.step = 0.1, .points = 5});
  same("radau-coll", {.step = 0.5},
       PolynomialCollocation{.step = 0.5, .points = collocation::NodeFamily::left_end_and_radau});
}

TEST(NamedMethods, DefaultToleranceIsOneInAMilliard) {
  for (const char* name : {"ode45", "dop853", "rkn1210"})
    EXPECT_EQ(duffing(name, {}, 5).x, duffing(name, {.tolerance = 1e-9}, 5).x) << name;
}

// Gaussians whose shape follows the step size do not reproduce linear functions, however short the step:
// their time has a constant relative error. For N = 7 and c h = 1.5 it is 1.3e-3, and the state at t = 5 is
// that of time 5 (1 - 1.3e-3).
TEST(NamedMethods, GaussiansThatFollowTheStepDoNotConverge) {
  const Solution coarse = duffing("rbf-coll", {.step = 5.0 / 512}, 5);
  const Solution fine = duffing("rbf-coll", {.step = 5.0 / 1024}, 5);
  EXPECT_LT(oracle::distance(coarse.x, fine.x), 1e-4);
  EXPECT_GT(oracle::distance(fine.x, oracle::duffing(5)), 1e-2);
  EXPECT_LT(oracle::distance(fine.x, oracle::duffing(5 * (1 - 1.34e-3))), 1e-4);
}

TEST(NamedMethods, SettingsThatCannotBeMeantAreNamed) {
  const auto says = [](std::string_view name, const Settings& settings, const std::string& word) {
    const std::string words = complaint(name, settings);
    EXPECT_TRUE(words.starts_with(name)) << words;
    EXPECT_NE(words.find(word), std::string::npos) << words;
  };
  says("rk4", {.step = 0.1, .tolerance = 1e-3}, "not both");
  says("rk4", {}, "give a step");
  says("rk4", {.tolerance = 1e-3}, "a method with adaptive steps");
  says("rk4", {.step = 0.0}, "step must be positive and finite, not 0");
  says("rk4", {.tolerance = -1.0}, "tolerance must be positive and finite, not -1");
  says("rk4", {.tolerance = NAN}, "nan");
  says("rk4", {.nodes = 7}, "no setting nodes");
  says("lgl-coll", {.shape = 1.0}, "no setting shape");
  says("rk4", {.points = 3}, "no setting points");
  says("mtl", {.points = 9}, "from 1 to 8, not 9");
  says("rbf-coll", {.shape = -1.0}, "shape must be positive");
  says("rbf-coll", {.nodes = 1}, "from 2 to 200, not 1");
  says("mcpi", {.nodes = 201}, "from 2 to 200, not 201");
  says("ode45", {.step = 0.1}, "give a tolerance");
  says("ode45", {.tolerance = 1e-16}, "1e-16");
}

// A method for second-order equations refuses a first-order system when it runs.
TEST(NamedMethods, AccelerationsAreAskedFor) {
  const System decay(TextProblem("blow-up"));
  for (const MethodInfo& m : named_methods()) {
    const auto run = named_integrator(m.name, m.fixed_step() ? Settings{.step = 0.1} : Settings{});
    if (m.second_order_only) {
      EXPECT_THROW(static_cast<void>(run(decay, {1}, 0, 0.2, {}, {})), std::invalid_argument) << m.name;
    } else {
      EXPECT_NO_THROW(static_cast<void>(run(decay, {1}, 0, 0.2, {}, {}))) << m.name;
    }
  }
}

}  // namespace
}  // namespace nlmech::ivp::named_methods_test

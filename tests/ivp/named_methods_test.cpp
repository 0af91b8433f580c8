/// Methods by name: that each name is its method, what settings are refused, and the search for a step.
#include "nlmech/ivp/named/named_methods.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>
#include <string>

#include "nlmech/ivp/collocation/collocation.hpp"
#include "nlmech/ivp/collocation/picard.hpp"
#include "nlmech/ivp/hermitian/hermitian.hpp"
#include "nlmech/ivp/named/step_search.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/ivp/structural/alpha_family.hpp"
#include "nlmech/ivp/transversal/mtl.hpp"
#include "nlmech/problems/blow_up.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "tests/ivp/oracle.hpp"

namespace nlmech::ivp::named_methods_test {
namespace {

using problems::BlowUp;
using problems::Duffing;

Solution duffing(std::string_view name, const Settings& settings, double until, const Observer& observer = {},
                 const Limits& limits = {}) {
  return named_integrator(name, settings)(System(Duffing{}), Duffing::initial_state(), 0, until, observer,
                                          limits);
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

// What a success says of the end: nothing with a step, else errors of steps or the difference of runs.
TEST(NamedMethods, SayWhatTheyControl) {
  for (const MethodInfo& m : named_methods()) {
    EXPECT_EQ(controlled(m, {.step = 0.1}), Controlled::step_size) << m.name;
    EXPECT_EQ(controlled(m, {.tolerance = 1e-6}),
              m.fixed_step() ? Controlled::difference_of_runs : Controlled::local_error)
        << m.name;
  }
  EXPECT_EQ(to_string(Controlled::step_size), "step_size");
  EXPECT_EQ(to_string(Controlled::local_error), "local_error");
  EXPECT_EQ(to_string(Controlled::difference_of_runs), "difference_of_runs");
}

// Each name with a step is the aggregate of that method: the same doubles.
TEST(NamedMethods, StepIsPassedOn) {
  const System system(Duffing{});
  const State x0 = Duffing::initial_state();
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

// Error at t = 5 against the elliptic functions, for tolerances that the order can reach. The difference of
// the two last runs is the error of the coarser one times 1 - 2^-order, so the error of the finer is at most
// the tolerance (order 1) if the order shows, and twice that leaves room for where it barely does. ode45
// controls errors of single steps: some hundred of them, and ten times what they sum to.
TEST(NamedMethods, ToleranceIsMet) {
  const State truth = oracle::duffing(5);
  for (const MethodInfo& m : named_methods()) {
    const int order = m.order.value_or(6);
    Settings settings{.tolerance = order == 1             ? 1e-3
                                   : order == 2           ? 1e-5
                                   : m.has(shape_setting) ? 1e-6
                                                          : 1e-9};
    if (m.has(shape_setting)) settings.shape = 1;
    const Solution s = duffing(m.name, settings, 5);
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_EQ(s.t, 5);
    const double room = (m.fixed_step() ? 2 : 1e3) * *settings.tolerance;
    for (int i = 0; i < 2; ++i)
      EXPECT_LE(std::abs(s.x[i] - truth[i]), room * (1 + std::abs(truth[i]))) << m.name;
  }
}

TEST(NamedMethods, DefaultToleranceIsOneInAMilliard) {
  EXPECT_EQ(duffing("rk6", {}, 5).x, duffing("rk6", {.tolerance = 1e-9}, 5).x);
  EXPECT_EQ(duffing("ode45", {}, 5).x, duffing("ode45", {.tolerance = 1e-9}, 5).x);
  EXPECT_EQ(duffing("dop853", {}, 5).x, duffing("dop853", {.tolerance = 1e-9}, 5).x);
  EXPECT_EQ(duffing("rkn1210", {}, 5).x, duffing("rkn1210", {.tolerance = 1e-9}, 5).x);
}

TEST(NamedMethods, SettingsThatCannotBeMeantAreNamed) {
  const auto says = [](std::string_view name, const Settings& settings, const std::string& word) {
    const std::string words = complaint(name, settings);
    EXPECT_TRUE(words.starts_with(name)) << words;
    EXPECT_NE(words.find(word), std::string::npos) << words;
  };
  says("rk4", {.step = 0.1, .tolerance = 1e-3}, "not both");
  says("rk4", {.step = 0.0}, "step must be positive and finite, not 0");
  says("rk4", {.tolerance = -1.0}, "tolerance must be positive and finite, not -1");
  says("rk4", {.tolerance = NAN}, "nan");
  says("rk4", {.nodes = 7}, "no nodes");
  says("lgl-coll", {.shape = 1.0}, "no shape");
  says("rk4", {.points = 3}, "no points");
  says("mtl", {.points = 9}, "from 1 to 8, not 9");
  says("rbf-coll", {.shape = -1.0}, "shape must be positive");
  says("rbf-coll", {.nodes = 1}, "from 2 to 200, not 1");
  says("mcpi", {.nodes = 201}, "from 2 to 200, not 201");
  says("ode45", {.step = 0.1}, "give a tolerance");
  says("ode45", {.tolerance = 1e-16}, "1e-16");
}

// A method for accelerations refuses what has none when it runs.
TEST(NamedMethods, AccelerationsAreAskedFor) {
  const System decay(BlowUp{});
  for (const MethodInfo& m : named_methods()) {
    const auto run = named_integrator(m.name, m.fixed_step() ? Settings{.step = 0.1} : Settings{});
    if (m.second_order_only) {
      EXPECT_THROW(static_cast<void>(run(decay, {1}, 0, 0.2, {}, {})), std::invalid_argument) << m.name;
    } else {
      EXPECT_NO_THROW(static_cast<void>(run(decay, {1}, 0, 0.2, {}, {}))) << m.name;
    }
  }
}

// Counts of steps double and differ in parity; the last run is the one that is shown, and the work is that of
// all runs and of the reference, whose some ten steps are long.
TEST(StepSearch, ObserverSeesTheLastRunAloneAndWorkIsCounted) {
  std::int64_t steps = 0;
  double end = 0;
  const Solution s = duffing("rk4", {.tolerance = 1e-6}, 5, [&](const Step& step) {
    EXPECT_EQ(step.index, ++steps);
    EXPECT_EQ(step.t0, end);
    end = step.t1;
    return true;
  });
  EXPECT_EQ(end, 5);
  std::int64_t before = 0, count = 16, sum = 16;
  for (; count < steps; sum += count) {
    before = count;
    count = detail::SearchAccount::next_count(count);
  }
  EXPECT_EQ(count, steps);
  EXPECT_GT(s.statistics.steps, sum + steps);
  EXPECT_LT(s.statistics.steps, sum + steps + 20);
  const Solution direct = duffing("rk4", {.step = 5.0 / static_cast<double>(steps)}, 5);
  EXPECT_EQ(s.x, direct.x);
  const Solution coarser = duffing("rk4", {.step = 5.0 / static_cast<double>(before)}, 5);
  EXPECT_LE(oracle::distance(s.x, coarser.x), 2e-6);
}

TEST(StepSearch, ObserverEndsIt) {
  const Solution s = duffing("rk4", {.tolerance = 1e-6}, 5, [](const Step& step) { return step.t1 < 2; });
  EXPECT_EQ(s.status.outcome(), Outcome::interrupted);
}

TEST(StepSearch, GoesBackwards) {
  const Solution there = duffing("radau-coll", {.tolerance = 1e-11}, -7);
  ASSERT_TRUE(there.status.ok()) << there.status.text();
  EXPECT_LE(oracle::distance(there.x, oracle::duffing(-7)), 1e-10);
}

TEST(StepSearch, NoWayToGoIsNoFailure) {
  const auto method = named_integrator("rk4", {});
  const Solution s = method(System(Duffing{}), {1, 0}, 2, 2, {}, {});
  EXPECT_TRUE(s.status.ok());
  EXPECT_EQ(s.x, (State{1, 0}));
  EXPECT_EQ(method(System(Duffing{}), {NAN, 0}, 0, 1, {}, {}).status.outcome(), Outcome::non_finite);
  EXPECT_THROW(static_cast<void>(method(System(Duffing{}), {1, 0}, 0, NAN, {}, {})), std::invalid_argument);
}

// Newmark's error at t = 500 is 3e-3 for P/500 and falls with the square: 1e-9 would take 1e8 steps.
TEST(StepSearch, ForeseesThatAToleranceIsOutOfReach) {
  const Solution s = duffing("newmark", {.tolerance = 1e-9}, 500);
  EXPECT_EQ(s.status.outcome(), Outcome::not_converged) << s.status.text();
  EXPECT_NE(s.status.sentence().find("newmark"), std::string::npos) << s.status.text();
  EXPECT_NE(s.status.sentence().find("16777216 steps"), std::string::npos) << s.status.text();
  EXPECT_LT(s.statistics.steps, 1'000'000);
}

// Gaussians whose shape follows the step do not contain the linear functions, however short the step: runs
// agree with each other, on a solution whose time is wrong by a fixed share. For N = 7 and c h = 1.5 that
// share is 1.3e-3, and the state at t = 5 is the one that belongs to 5 (1 - 1.3e-3).
TEST(StepSearch, RunsThatAgreeOnTheWrongSolutionAreNotTrusted) {
  const State truth = oracle::duffing(5);
  const Solution coarse = duffing("rbf-coll", {.step = 5.0 / 512}, 5);
  const Solution fine = duffing("rbf-coll", {.step = 5.0 / 1024}, 5);
  EXPECT_LT(oracle::distance(coarse.x, fine.x), 1e-4);
  EXPECT_GT(oracle::distance(fine.x, truth), 1e-2);
  EXPECT_LT(oracle::distance(fine.x, oracle::duffing(5 * (1 - 1.34e-3))), 1e-4);

  const Solution s = duffing("rbf-coll", {.tolerance = 1e-4}, 5);
  EXPECT_EQ(s.status.outcome(), Outcome::not_converged) << s.status.text();
  EXPECT_NE(s.status.sentence().find("another shape"), std::string::npos) << s.status.text();
  // At rest there is no rate to be wrong: the end tells.
  const auto from_rest = named_integrator("rbf-coll", {.tolerance = 1e-4})(System(problems::ImpactDuffing{}),
                                                                           State::Zero(2), 0, 5, {}, {});
  EXPECT_EQ(from_rest.status.outcome(), Outcome::not_converged) << from_rest.status.text();
}

// A fixed shape flattens with the step until rounding takes the digits: no success is claimed.
TEST(StepSearch, NoticesWhereRoundingEndsConvergence) {
  const Solution flat = duffing("rbf-coll", {.tolerance = 1e-11, .shape = 1.5}, 5);
  EXPECT_FALSE(flat.status.ok());
  EXPECT_FALSE(flat.status.sentence().empty());
  const Solution rounded = duffing("rk4", {.tolerance = 1e-17}, 5);
  EXPECT_EQ(rounded.status.outcome(), Outcome::not_converged) << rounded.status.text();
  EXPECT_NE(rounded.status.sentence().find("larger tolerance"), std::string::npos) << rounded.status.text();
}

// y' = y^3 from 1 ends at t = 1/2: the run's own failure, found there.
TEST(StepSearch, SolutionThatEndsIsReported) {
  for (const std::string name : {"rk4", "radau-coll", "backward-euler"}) {
    const auto method = named_integrator(name, {.tolerance = 1e-8});
    const Solution s = method(System(BlowUp{}), BlowUp::initial_state(), 0, 1, {}, {});
    EXPECT_FALSE(s.status.ok()) << name;
    EXPECT_EQ(s.status.sentence().find("no step was found"), std::string::npos) << s.status.text();
    EXPECT_NEAR(s.t, 0.5, 1e-2) << s.status.text();
  }
}

TEST(StepSearch, LimitsHoldForAllRunsTogether) {
  const Solution s = duffing("rk4", {.tolerance = 1e-12}, 50, {}, {.steps = 5000});
  EXPECT_EQ(s.status.outcome(), Outcome::step_limit) << s.status.text();
  EXPECT_LE(s.statistics.steps, 5000);
  EXPECT_NE(s.status.sentence().find("5000"), std::string::npos) << s.status.text();
  const Solution late = duffing("rk4", {.tolerance = 1e-12}, 50, {}, {.seconds = 1e-9});
  EXPECT_EQ(late.status.outcome(), Outcome::time_limit) << late.status.text();
}

// The force begins at t = 0 and its slope jumps at 1/2 and 1: samples lie within steps there.
TEST(StepSearch, MeetsTheToleranceAcrossDiscontinuities) {
  const System system(problems::ImpactDuffing{});
  const State x0 = State::Zero(2);
  const problems::ReferenceTrajectory<long double, problems::ImpactDuffing> reference(
      {}, Vector<long double, 2>::Zero(), 0, 5);
  ASSERT_TRUE(reference.status().ok()) << reference.status().text();
  const State truth = reference(5).cast<double>();
  for (const std::string name : {"rk4", "lgl-coll", "mcpi"}) {
    const auto s = named_integrator(name, {.tolerance = 1e-9})(system, x0, 0, 5, {}, {});
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_LE(oracle::distance(s.x, truth), 2e-9) << name;
  }
}

// Any amplitude and tolerance: the promise on the end state, with room for where the order barely shows.
RC_GTEST_PROP(StepSearch, MeetsAnyTolerance, ()) {
  const double amplitude = *rc::gen::inRange(1, 40) * 0.05;
  const double tolerance = std::pow(10, -*rc::gen::inRange(3, 10));
  const State x0{amplitude, 0};
  const auto s = named_integrator("rk6", {.tolerance = tolerance})(System(Duffing{}), x0, 0, 4, {}, {});
  RC_ASSERT(s.status.ok());
  RC_ASSERT(oracle::distance(s.x, oracle::duffing(4, {}, amplitude)) <= 6 * tolerance);
}

}  // namespace
}  // namespace nlmech::ivp::named_methods_test

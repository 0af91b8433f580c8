// Features of a problem, the rules of the choice, and the chosen methods.
#include "nlmech/comparison/choice/choice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/support/errors.hpp"
#include "tests/ivp/typed.hpp"

namespace nlmech::comparison::choice_test {
namespace {

template <class Problem>
ChoiceRequest request(const Problem& problem, double end) {
  return {ivp::System(problem), problem.initial_state(), problem.initial_time, end};
}

ChoiceRequest typed(const std::string& text, const ivp::State& x0, double end) {
  return {ivp::testing::typed(text), x0, 0, end};
}

Features features(const ChoiceRequest& q) { return probe_problem(q).features; }

// On the slow branches the fast rate is 3 mu = 3000; the drift along them takes 807 units of time.
TEST(Probe, SeesStiffness) {
  EXPECT_GT(features(request(problems::TextProblem("van-der-pol", {{"mu", 1000}}), 500)).stiffness, 100);
}

// Heat conduction in a rod of 200 points: the coarse steps start small and grow for a long time.
TEST(Probe, SeesStiffnessOfManyComponents) {
  std::string text;
  ivp::State x0 = ivp::State::Zero(200);
  for (int i = 1; i <= 200; ++i) {
    const auto u = [](int k) { return k < 1 || k > 200 ? std::string("0") : "u" + std::to_string(k); };
    text += "u" + std::to_string(i) + "' = 40401*(" + u(i - 1) + " - 2 " + u(i) + " + " + u(i + 1) + ");";
    x0[i - 1] = std::sin(i * 3.141592653589793 / 201);
  }
  EXPECT_GT(features(typed(text, x0, 50)).stiffness, 100);
}

TEST(Probe, ReadsVelocitiesOffTheEquations) {
  EXPECT_FALSE(features(typed("x'' = -x - exp(-(t - 500)^2) x'", {1, 0}, 1000)).velocity_free);
  EXPECT_FALSE(features(typed("x'' = -x - t x'", {1, 0}, 1)).velocity_free);
  EXPECT_TRUE(features(typed("x'' = -x/sqrt(1 - x^2)", {0.95, 0}, 0.1)).velocity_free);
}

// Steps of about one unit of time, at any frequency.
TEST(Probe, AnOscillatorIsNotStiff) {
  for (const double k : {1., 1e6})
    EXPECT_LT(features(typed("x'' = -" + std::to_string(k) + " x", {1, 0}, 50 / std::sqrt(k))).stiffness, 10)
        << k;
}

// Above 32 components the fastest rate comes from powers of the Jacobian: 17 oscillators of equal frequency.
TEST(Probe, SeesTheFastestMotionOfManyComponents) {
  std::string text = "x0'' = -x0";
  for (const char* i :
       {"1", "2", "3", "4", "5", "6", "7", "8", "9", "10", "11", "12", "13", "14", "15", "16"})
    text += std::string("; x") + i + "'' = -x" + i;
  const double one = features(typed("x'' = -x", {1, 1}, 20)).stiffness;
  const double many = features(typed(text, ivp::State(ivp::State::Ones(34)), 20)).stiffness;
  EXPECT_NEAR(many / one, 1, 0.3);  // of fewer steps
}

TEST(Probe, TellsVelocitiesAndSwitches) {
  EXPECT_FALSE(features(request(problems::TextProblem("lorenz"), 1)).velocity_free);
  EXPECT_FALSE(features(request(problems::TextProblem("forced-duffing"), 1)).velocity_free);
  EXPECT_TRUE(features(request(problems::TextProblem("duffing"), 1)).velocity_free);
  EXPECT_FALSE(features(request(problems::TextProblem("duffing"), 1)).switches);
  EXPECT_TRUE(features(typed("x'' + x + sign(x')/8 = 0", {2.5, 0}, 10)).switches);
}

TEST(Probe, SaysThatASolutionEnds) {
  const auto q = request(problems::TextProblem("blow-up"), problems::TextProblem("blow-up").final_time);
  const MethodChoice none = choose(q, 9, examine(q));
  EXPECT_FALSE(none.status.ok());
  EXPECT_TRUE(none.ranked.empty());
  EXPECT_THROW(static_cast<void>(choice_rows(none)), Failure);
  EXPECT_EQ(method_for(q, 1e-9), "");
}

TEST(Rules, TheFirstThatHoldsDecides) {
  const auto first = [](const Features& f, double digits) { return choice_rule(f, digits).methods.front(); };
  EXPECT_EQ(first({.operations = 13}, 3), "series");
  EXPECT_EQ(first({.operations = 14}, 10), "dop853");
  EXPECT_EQ(first({.operations = 14}, 11), "series");
  EXPECT_EQ(first({.operations = 0}, 12), "dop853");
  EXPECT_EQ(first({.velocity_free = true, .operations = 3}, 9), "rkn1210");
  EXPECT_EQ(first({.velocity_free = true, .switches = true, .operations = 3}, 9), "series");
  EXPECT_EQ(first({.velocity_free = true, .operations = 3, .stiffness = 31}, 9), "adaptive-collocation");
}

// Each method is adaptive, with an estimate that includes forces of time alone; each rule has one method for
// any problem.
TEST(Rules, NameMethodsThatAreFit) {
  for (const Rule& rule : choice_rules()) {
    for (const std::string_view name : rule.methods) {
      if (name.empty()) continue;
      const ivp::MethodInfo info = any_method(name);
      EXPECT_FALSE(info.fixed_step()) << name;
      EXPECT_FALSE(info.estimate_misses_time) << name;
    }
    EXPECT_NE(std::ranges::find(rule.methods, "adaptive-collocation"), rule.methods.end()) << rule.name;
  }
}

TEST(Choice, IsRepeatableAndFitsTheProblem) {
  const auto first = [](const ChoiceRequest& q) {
    const MethodChoice c = choose(q, 9, examine(q)), again = choose(q, 9, examine(q));
    EXPECT_TRUE(c.status.ok()) << c.status.text();
    EXPECT_EQ(c.ranked.size(), again.ranked.size());
    for (std::size_t i = 0; i < c.ranked.size(); ++i) {
      EXPECT_EQ(c.ranked[i].method, again.ranked[i].method);
      EXPECT_EQ(c.ranked[i].tolerance, again.ranked[i].tolerance);
      EXPECT_EQ(c.ranked[i].right_hand_sides, again.ranked[i].right_hand_sides);
    }
    std::string method = c.ranked.empty() ? "none" : c.ranked.front().method;
    EXPECT_EQ(method, method_for(q, 1e-9));
    return method;
  };
  EXPECT_EQ(first(request(problems::TextProblem("duffing"), 100)), "rkn1210");
  EXPECT_EQ(first(request(problems::TextProblem("lorenz"), 10)), "series");
  EXPECT_EQ(first(request(problems::TextProblem("van-der-pol", {{"mu", 1000}}), 2000)),
            "adaptive-collocation");
}

TEST(Choice, KeepsToTheMethodsThatMayBeChosen) {
  auto q = request(problems::TextProblem("duffing"), 20);
  q.methods = {"ode45", "series", "adaptive-collocation"};
  EXPECT_EQ(method_for(q, 1e-9), "series");
  q.methods = {"ode45"};
  EXPECT_EQ(method_for(q, 1e-9), "");
}

// A series has no first step at a branch point; the next method of the rule is chosen.
TEST(Choice, PassesOverMethodsThatFail) {
  const auto q = typed("x' = sqrt(t)", ivp::State(ivp::State::Zero(1)), 1);
  EXPECT_EQ(choice_rule(features(q), 9).methods.front(), "series");
  EXPECT_EQ(method_for(q, 1e-9), "dop853");
}

TEST(Choice, MoreDigitsTakeTighterTolerances) {
  const auto q = request(problems::TextProblem("duffing"), 50);
  const MethodChoice examined = examine(q);
  double last = 1;
  for (const double digits : {3., 6., 9.}) {
    const MethodChoice c = choose(q, digits, examined);
    ASSERT_FALSE(c.ranked.empty());
    EXPECT_LT(c.ranked.front().tolerance, std::min(last, std::pow(10, -digits)));
    last = c.ranked.front().tolerance;
  }
}

// For x' = x an error grows as e^t like x itself: its relative size is constant. For x'' = x from (1, -1) the
// solution decays and an error grows as e^t.
TEST(Condition, IsTheGrowthOfErrors) {
  const MethodChoice c = examine(typed("x'' = x", {1, -1}, 5));
  EXPECT_EQ(c.growth.covered, 1);
  EXPECT_GT(c.condition, std::exp(5) / 3);
  EXPECT_LT(c.condition, std::exp(5) * 10);
}

TEST(ShellLine, QuotesWhatAShellWouldRead) {
  EXPECT_EQ(shell_line({"a", "--b=1e-3,x", "x'' = -x"}), "a --b=1e-3,x \"x'' = -x\"");
  EXPECT_EQ(shell_line({"$x'"}), "'$x'\\'''");
  EXPECT_EQ(shell_line({""}), "\"\"");
}

}  // namespace
}  // namespace nlmech::comparison::choice_test

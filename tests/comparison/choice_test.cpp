// What is seen of a problem, what evidence says of methods, and which of them is chosen.
#include "nlmech/comparison/choice/choice.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "nlmech/comparison/choice/choice_rows.hpp"
#include "nlmech/comparison/choice/expectation.hpp"
#include "nlmech/problems/blow_up.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/forced_duffing.hpp"
#include "nlmech/problems/linear_oscillator.hpp"
#include "nlmech/problems/lorenz.hpp"
#include "nlmech/problems/van_der_pol.hpp"
#include "nlmech/program/problem.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::comparison::choice_test {
namespace {

template <class Problem>
Question question(const Problem& problem, double end) {
  return {ivp::System(problem), problem.initial_state(), Problem::initial_time, end};
}

template <class Problem>
Features features(const Problem& problem, double end) {
  const auto q = question(problem, end);
  return look_at_problem(q.system, q.x0, q.t0, q.t1).features;
}

Features typed(const std::string& text, const ivp::State& x0, double end) {
  const program::Equations equations(program::SourceText("equation", text));
  return look_at_problem(ivp::System(program::Problem(equations)), x0, 0, end).features;
}

// The fast rate is 3 mu = 3000 on the branches, and the drift along them takes 807 units of time.
TEST(Look, SeesWhatIsStiff) {
  const Features f = features(problems::VanDerPol{.mu = 1000}, 500);
  EXPECT_GT(f.stiffness, 2);
  EXPECT_GT(f.decay, 0.9);
}

// Steps of a unit of time or so, at any frequency.
TEST(Look, AnOscillatorIsNotStiff) {
  for (const double k : {1., 1e6}) {
    const Features f = typed("x'' = -" + std::to_string(k) + " x", {1, 0}, 50 / std::sqrt(k));
    EXPECT_LT(f.stiffness, 1) << k;
    EXPECT_LT(f.decay, 0.01) << k;
    EXPECT_LT(f.variation, 0.3) << k;
  }
}

TEST(Look, TellsFormsAndSwitches) {
  EXPECT_EQ(features(problems::Lorenz{}, 1).form, Form::first_order);
  EXPECT_EQ(features(problems::ForcedDuffing{}, 1).form, Form::accelerations);
  EXPECT_EQ(features(problems::Duffing{}, 1).form, Form::conservative);
  EXPECT_FALSE(features(problems::Duffing{}, 1).switches);
  EXPECT_TRUE(typed("x'' + x + sign(x')/8 = 0", {2.5, 0}, 10).switches);
}

TEST(Look, SaysThatASolutionEnds) {
  const auto q = question(problems::BlowUp{}, problems::BlowUp::final_time);
  const Look look = look_at_problem(q.system, q.x0, q.t0, q.t1);
  EXPECT_FALSE(look.status.ok());
  EXPECT_LT(look.seen, 1);
  const Chosen none = choose(q, 9, read_evidence(), looked_at(q, read_evidence()));
  EXPECT_TRUE(none.ranked.empty());
  EXPECT_THROW(static_cast<void>(choice_rows(none)), Failure);
}

TEST(Evidence, LiesBetweenRunsThatDeliverLessAndMore) {
  SolvedProblem p{"none", {}, 1, {{"ode45", {{1e-3, 2, 10, 70, 100}, {1e-5, 4, 100, 700, 400}}}}};
  EXPECT_DOUBLE_EQ(p.measured("ode45", 1)->cost, 100);
  const Measured middle = *p.measured("ode45", 3);
  EXPECT_NEAR(middle.cost, 200, 1e-9);  // geometric means
  EXPECT_NEAR(middle.tolerance, 1e-4, 1e-16);
  EXPECT_NEAR(middle.right_hand_sides, 70 * std::sqrt(10), 1e-9);
  EXPECT_FALSE(p.measured("ode45", 4.5));
  EXPECT_FALSE(p.measured("series", 1));
}

TEST(Evidence, JudgesAProblemWithoutItself) {
  const Evidence all = read_evidence(), rest = all.without("duffing");
  const auto count = [](const Evidence& e, const std::string& name) {
    return std::ranges::count(e.problems, name, &SolvedProblem::name);
  };
  EXPECT_EQ(count(all, "duffing"), 1);
  EXPECT_EQ(count(all, "duffing-10000"), 1);
  EXPECT_EQ(count(rest, "duffing"), 0);
  EXPECT_EQ(count(rest, "duffing-10000"), 0);  // the same on a longer way
  EXPECT_EQ(count(rest, "duffing-1e6"), 1);
}

TEST(Expectation, MethodsAreForTheirEquations) {
  Features f{.components = 2, .form = Form::conservative, .operations = 3};
  EXPECT_TRUE(suits("rkn1210", f));
  EXPECT_TRUE(suits("laier", f));
  f.form = Form::accelerations;
  EXPECT_FALSE(suits("rkn1210", f));
  EXPECT_TRUE(suits("laier", f));
  f.form = Form::first_order;
  EXPECT_FALSE(suits("laier", f));
  EXPECT_TRUE(suits("series", f));
  f.operations = 0;
  EXPECT_FALSE(suits("series", f));
}

TEST(Expectation, MoreDigitsTakeTighterTolerances) {
  const Evidence evidence = read_evidence();
  const Features f = features(problems::Duffing{}, 50);
  EXPECT_EQ(distance(f, f), 0);
  double last = 1;
  for (const double level : {5., 8., 11.}) {
    for (const Expectation& e : expectations(evidence, f, level)) {
      if (e.method != "rkn1210") continue;
      EXPECT_LT(e.tolerance, last);
      EXPECT_GT(e.step, e.cost);  // 17 right-hand sides a step
      last = e.tolerance;
    }
  }
  EXPECT_LT(last, 1);
}

// By counts: asked twice, it answers the same.
TEST(Choice, IsRepeatableAndFitsTheProblem) {
  const Evidence evidence = read_evidence();
  const auto first = [&](const auto& q) {
    const Features f = look_at_problem(q.system, q.x0, q.t0, q.t1).features;
    Status status, again;
    const auto ranked = rank_methods(q, f, evidence, status), second = rank_methods(q, f, evidence, again);
    EXPECT_TRUE(status.ok()) << status.text();
    EXPECT_EQ(ranked.size(), second.size());
    for (std::size_t i = 0; i < ranked.size(); ++i) {
      EXPECT_EQ(ranked[i].method, second[i].method);
      EXPECT_EQ(ranked[i].cost, second[i].cost);
    }
    return ranked.empty() ? "none" : ranked.front().method;
  };
  EXPECT_EQ(first(question(problems::Duffing{}, 100)), "rkn1210");
  EXPECT_EQ(first(question(problems::Lorenz{}, 10)), "series");
  EXPECT_EQ(first(question(problems::VanDerPol{.mu = 1000}, 2000)), "adaptive-collocation");
}

TEST(Choice, KeepsToTheMethodsThatMayBeChosen) {
  auto q = question(problems::Duffing{}, 20);
  q.among.methods = {"ode45", "adaptive-collocation"};
  Status status;
  const auto f = features(problems::Duffing{}, 20);
  for (const Ranked& r : rank_methods(q, f, read_evidence(), status))
    EXPECT_TRUE(q.among.has(r.method)) << r.method;
}

// Along x' = x an error grows by e^t; relative to x, which grows as well, it keeps its size. x'' = x from (1,
// -1) decays, and an error grows by e^t.
TEST(Condition, IsTheGrowthOfErrors) {
  const program::Equations equations(program::SourceText("equation", "x'' = x"));
  const Question q{ivp::System(program::Problem(equations)), {1, -1}, 0, 5};
  const Chosen c = looked_at(q, read_evidence());
  EXPECT_EQ(c.condition_seen, 1);
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

// Basis of the scenes of the problem set: the set, digits, times for digits, silent failures.
#include "chapters/integrators/sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "nlmech/ivp/collocation/adaptive_collocation.hpp"
#include "nlmech/ivp/series/series.hpp"

namespace nlmech::chapters::integrators::sweep_test {
namespace {

TEST(ProblemSet, HasNamesOfItsOwnAndSolutionsAtSixteenTimes) {
  std::set<std::string> names;
  int solved = 0;
  for (const SetProblem& p : problem_set()) {
    EXPECT_TRUE(names.insert(p.name).second) << p.name;
    EXPECT_EQ(p.times.size(), 16U) << p.name;
    EXPECT_EQ(p.times.back(), p.t1) << p.name;
    EXPECT_TRUE(p.reference.size() == 16 || p.reference.empty()) << p.name;
    solved += p.has_solution() ? 1 : 0;
  }
  EXPECT_EQ(names.size(), 25U);
  EXPECT_EQ(solved, 22);
}

/// A method that is independent of the reference's: collocation if that is a series, and vice versa.
double miss(const SetProblem& p) {
  const double tolerance = 1e-11, absolute = tolerance * p.absolute;
  ivp::Solution s;
  if (p.kind == Kind::stiff)
    s = ivp::integrate(
        p.system, p.x0, p.t0, p.t1,
        ivp::AdaptiveCollocation{.relative_tolerance = tolerance, .absolute_tolerance = absolute});
  else
    s = ivp::integrate(p.system, p.x0, p.t0, p.t1,
                       ivp::Series{.relative_tolerance = tolerance, .absolute_tolerance = absolute});
  if (!s.status.ok()) return HUGE_VAL;
  return p.error(s.x, p.times.size() - 1) / (tolerance * p.tolerance_condition);
}

// A hundred tolerances for errors that add up over some hundred steps, each times the condition number.
TEST(ProblemSet, EndsWhereTheLibrarysMethodsEnd) {
  for (const SetProblem& p : problem_set()) {
    if (p.has_solution() && p.kind != Kind::extreme) {
      EXPECT_LT(miss(p), 100) << p.name;
    }
  }
}

TEST(ProblemSet, ErrorsAreRelativeOrBySize) {
  SetProblem p{"none", Kind::smooth, 1, 1, ivp::System(problems::TextProblem("duffing")), {1, 0}, 0,
               1,      {1.0}};
  p.reference.push_back({2, 0.5});
  p.flagged = {0, 4};
  EXPECT_EQ(p.error({2.5, 0.5}, 0), 0.25);
  EXPECT_EQ(p.error({2, 3.5}, 0), 0.75);
  EXPECT_TRUE(std::isnan(p.error({NAN, 0.5}, 0)));
}

Trial trial(double tolerance, double error, double seconds) {
  return {tolerance, "success", error, {}, {seconds, seconds, seconds, 1}};
}

TEST(Trials, TimeForDigitsLiesBetweenRunsThatDeliverLessAndMore) {
  MethodTrials m{"none", false, true, {trial(1e-3, 1e-2, 1), trial(1e-5, 1e-4, 4), trial(1e-7, 1e-8, 16)}};
  EXPECT_DOUBLE_EQ(*m.seconds_for(2), 1);
  EXPECT_DOUBLE_EQ(*m.seconds_for(3), 2);  // half way between 2 and 4 digits: the geometric mean of 1 and 4
  EXPECT_DOUBLE_EQ(*m.seconds_for(6), 8);
  EXPECT_FALSE(m.seconds_for(8.5));
  m.trials[1].status = "time_limit";
  EXPECT_DOUBLE_EQ(*m.seconds_for(6), 16);
}

TEST(Trials, SuccessWithFewerThanHalfOfItsDigitsIsASilentFailure) {
  ProblemTrials p{"none", Kind::smooth, true, 1, 100, {}};
  EXPECT_NEAR(p.digits_to_expect(1e-8), 6, 1e-6);
  EXPECT_NEAR(p.digits_to_expect(1e-30), -std::log10(0x1p-48), 1e-6);  // 16 roundings
  p.length = 100;
  EXPECT_NEAR(p.digits_to_expect(1e-8), 4, 1e-6);
  p.length = 1;
  EXPECT_TRUE(p.silent_failure(trial(1e-8, 2e-3, 1)));
  EXPECT_FALSE(p.silent_failure(trial(1e-8, 0.5e-3, 1)));
  EXPECT_FALSE(p.silent_failure(trial(1e-3, 1, 1)));  // a single digit to expect
  Trial failed = trial(1e-8, 1, 1);
  failed.status = "step_limit";
  EXPECT_FALSE(p.silent_failure(failed));
  p.has_solution = false;
  EXPECT_TRUE(p.silent_failure(trial(1e-8, 1e-9, 1)));
}

// For fixed steps no number of digits is claimed, so there is no silent failure; beyond the end of a solution
// a success is wrong.
TEST(Trials, EqualStepsAreJudgedByTheEndAlone) {
  Trial equal = trial(0, 1, 1);
  equal.step = 0.25;
  EXPECT_EQ(equal.setting(), "h = 0.25");
  EXPECT_EQ(trial(1e-5, 1, 1).setting(), "1e-05");
  ProblemTrials p{"none", Kind::smooth, true, 1, 100, {}};
  EXPECT_FALSE(p.silent_failure(equal));
  p.has_solution = false;
  EXPECT_TRUE(p.silent_failure(equal));
  const MethodTrials m{"none", false, false, {trial(0, 1e-4, 1)}};
  EXPECT_FALSE(m.seconds_for(3));
}

}  // namespace
}  // namespace nlmech::chapters::integrators::sweep_test

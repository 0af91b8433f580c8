/// Work-precision diagrams: which points and numbers are drawn where, and what the table says of runs that
/// fail and of methods that a build lacks.
#include "nlmech/scene/work_precision.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace nlmech::scene::work_precision_test {
namespace {

/// Two lines with points, one that failed altogether, one that this build has not.
std::vector<ProblemLines> one_problem() {
  const Timing fast{1e-3, 0.9e-3, 2e-3, 9}, slow{0.1, 0.1, 0.1, 1};
  const Attempt failed{"step 10", "non_finite", {}, fast, {3}}, coarse{"step 1", "success", 1e-3, fast, {10}},
      fine{"step 0.1", "success", 1e-7, slow, {100}}, exact{"", "success", 0., fast, {1}};
  return {{"",
           {{"one", 1, {failed, coarse, fine}},
            {"failing", 1, {failed}},
            {"absent", 0, {}},
            {"two", 0, {exact}}}}};
}

Showing shown(WorkPrecision what, const std::vector<ProblemLines>& problems) {
  what.heading = "heading";
  what.work = {"right-hand sides"};
  what.groups = {{"front", "#000000", 7, 2}, {"back", "#D55E00", 5}};
  Show show(false);
  show_work_precision(what, problems, show);
  return show.take();
}
bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(WorkPrecision, DataHaveARowARunOfMethodsWithPoints) {
  const Showing showing = shown({}, one_problem());
  EXPECT_EQ(
      showing.figure->data.csv(),
      "line,problem,group,number,digits,time_s,time_low_s,time_high_s,best,status,method,setting,"
      "right-hand sides\n"
      "1,1,2,1,,0.001,0.00089999999999999998,0.002,0,non_finite,one,step 10,3\n"
      "1,1,2,1,3,0.001,0.00089999999999999998,0.002,0,success,one,step 1,10\n"
      "1,1,2,1,7,0.10000000000000001,0.10000000000000001,0.10000000000000001,1,success,one,step 0.1,100\n"
      "\n"
      "2,1,1,2,15.954589770191003,0.001,0.00089999999999999998,0.002,1,success,two,,1\n")
      << "an error of zero has the digits of half an epsilon";
}

TEST(WorkPrecision, ForemostGroupsAreDrawnLast) {
  const std::string script = shown({}, one_problem()).figure->script;
  const auto front = script.find("linecolor rgb '#000000'"), back = script.find("linecolor rgb '#D55E00'");
  ASSERT_NE(front, std::string::npos) << script;
  ASSERT_NE(back, std::string::npos) << script;
  EXPECT_LT(back, front);
  EXPECT_TRUE(holds(script, "label 'one' at")) << script;
  EXPECT_TRUE(holds(script, "label bold('front') at")) << script;
  EXPECT_FALSE(holds(script, "failing")) << "a method without a point has no number in the picture";
  EXPECT_FALSE(holds(script, "condition times rounding"));
}

TEST(WorkPrecision, OneProblemHasAPanelOfWork) {
  const std::string script = shown({.work_label = "evaluations"}, one_problem()).figure->script;
  EXPECT_TRUE(holds(script, "set xlabel 'evaluations'"));
  EXPECT_TRUE(holds(script, "data using \"right-hand sides\":\"digits\" every :::0::0")) << script;
  EXPECT_FALSE(holds(shown({}, one_problem()).figure->script, "using \"right-hand sides\""));
}

TEST(WorkPrecision, SeveralProblemsHaveAPanelEach) {
  std::vector<ProblemLines> two = {one_problem()[0], one_problem()[0]};
  two[0].problem = "low load";
  two[1].problem = "high load";
  const Showing showing = shown({.work_label = "evaluations"}, two);
  for (const char* part : {"'low load'", "'high load'", "every :::3::3"})
    EXPECT_TRUE(holds(showing.figure->script, part)) << part;
  EXPECT_FALSE(holds(showing.figure->script, "every :::4::4"));
  EXPECT_EQ(showing.table->columns()[0].name, "problem");
  EXPECT_EQ(showing.table->rows().size(), 12U);
}

TEST(WorkPrecision, RoundingIsALine) {
  const std::string script = shown({.rounding = 1e-12}, one_problem()).figure->script;
  EXPECT_TRUE(holds(script, "condition times rounding"));
  EXPECT_TRUE(holds(script, "first 12 to graph 1, first 12")) << script;
}

TEST(WorkPrecision, TheTableHasARowARunAndOneForWhatIsAbsent) {
  const std::string digits = shown({}, one_problem()).table->markdown();
  for (const char* row : {"| one | step 10 | non_finite |  | 1 | 0.9 | 2 | 3 |",
                          "| one | step 0.1 | success | 7 | 100 | 100 | 100 | 100 |",
                          "| failing | step 10 | non_finite |", "| absent |  | not in this build |  |"})
    EXPECT_TRUE(holds(digits, row)) << row << " is not in\n" << digits;
  const std::string error = shown({.error = "error of x", .unit = "ns"}, one_problem()).table->markdown();
  EXPECT_TRUE(holds(error, "| one | step 1 | success | 1e-3 | 1e6 |") ||
              holds(error, "| one | step 1 | success | 0.001 | 1e6 |"))
      << error;
}

TEST(WorkPrecision, LeastErrorsAreFoundByName) {
  const ProblemLines problem = one_problem()[0];
  EXPECT_EQ(problem.of("one").least_error(), 1e-7);
  EXPECT_EQ(problem.of("failing").least_error(), HUGE_VAL);
  EXPECT_THROW(static_cast<void>(problem.of("three")), std::out_of_range);
}

TEST(WorkPrecision, AnAttemptIsJudgedAndTimed) {
  int calls = 0;
  const auto compute = [&calls] { return ++calls; };
  const auto judge = [](int call) -> Ending { return {Status(), 0.5 * call}; };
  const Attempt quick = attempt("step 1", compute, judge, true);
  EXPECT_EQ(quick.status, "success");
  EXPECT_EQ(quick.error, 0.5);
  EXPECT_EQ(quick.time.repeats, 1);
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(attempt("step 1", compute, judge, false).time.repeats, 9);
  const Ending stalled{Status::failure(Outcome::not_converged, "stalled"), {}};
  EXPECT_EQ(attempt(
                "step 1", compute, [&](int) { return stalled; }, true)
                .status,
            "not_converged");
}

}  // namespace
}  // namespace nlmech::scene::work_precision_test

/// Work-precision diagrams: curves and labels, fastest methods, and the table's entries for failed runs and
/// methods that the build lacks.
#include "nlmech/scene/work_precision.hpp"
#include "tests/thrown.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace nlmech::scene::work_precision_test {
namespace {

/// Two curves with points, one method that failed always, and one that this build lacks.
std::vector<ProblemLines> one_problem() {
  const Timing fast{1e-3, 0.9e-3, 2e-3, 9}, slow{0.1, 0.1, 0.1, 1};
  const Attempt failed{"step 10", "non_finite", {}, fast, {3}}, coarse{"step 1", "success", 1e-3, fast, {10}},
      fine{"step 0.1", "success", 1e-7, slow, {100}}, exact{"", "success", 0., fast, {1}};
  return {{"",
           {{"one", 1, {failed, coarse, fine}, Side::peer},
            {"failing", 1, {failed}},
            {"absent", 0, {}},
            {"two", 0, {exact}, Side::subject}}}};
}

Showing shown(WorkPrecision what, const std::vector<ProblemLines>& problems) {
  what.heading = "heading";
  what.work = {"right-hand sides"};
  what.groups = {{"front", 0}, {"back", 1}};
  Show show(false);
  show_work_precision(what, problems, show);
  return show.take();
}
/// The same with nine more methods, more than there are colours.
std::vector<ProblemLines> crowd() {
  std::vector<ProblemLines> problems = one_problem();
  const Attempt late{"step 1", "success", 1e-3, {1, 1, 1, 1}, {10}};
  for (int i = 0; i < 9; ++i) problems[0].lines.push_back({"bystander " + std::to_string(i), 1, {late}});
  return problems;
}

TEST(WorkPrecision, DataHaveARowARunOfMethodsWithPointsThenWhoIsFastest) {
  std::string data = shown({}, one_problem()).figure->data.csv();
  const std::string six = "3,1,front,1,6,0.001,,,fastest,two,,one,";
  const auto row = data.find(six);
  ASSERT_NE(row, std::string::npos) << data;
  EXPECT_NEAR(std::stod(data.substr(row + six.size())), std::pow(10, 1.5), 1e-12) << "one takes 10^-1.5 s";
  data.erase(row, data.find('\n', row) + 1 - row);
  EXPECT_EQ(data,
            "line,problem,kind,colour,digits,time_s,time_low_s,time_high_s,status,method,setting,next,factor,"
            "right-hand sides\n"
            "1,1,back,2,,0.001,0.00089999999999999998,0.002,non_finite,one,step 10,,,3\n"
            "1,1,back,2,3,0.001,0.00089999999999999998,0.002,success,one,step 1,,,10\n"
            "1,1,back,2,7,0.10000000000000001,0.10000000000000001,0.10000000000000001,success,one,step "
            "0.1,,,100\n"
            "\n"
            "2,1,front,1,15.954589770191003,0.001,0.00089999999999999998,0.002,success,two,,,,1\n"
            "\n"
            "3,1,back,2,3,0.001,,,fastest,one,,two,1,\n"
            "3,1,front,1,9,0.001,,,fastest,two,,,,\n"
            "3,1,front,1,12,0.001,,,fastest,two,,,,\n")
      << "an error of zero has the digits of half an epsilon";
}

TEST(WorkPrecision, CurvesAreNamedAtTheirEndsAndSayTheirNames) {
  const std::string script = shown({}, one_problem()).figure->script;
  EXPECT_TRUE(tests::holds(script, "set label 'one' at graph 1.03, first 7 "));
  EXPECT_TRUE(tests::holds(script, "title 'one' noenhanced"));
  EXPECT_FALSE(tests::holds(script, "failing")) << "a method without a point is not drawn";
  const auto subject = script.find("every :::1::1"), peer = script.find("every :::0::0");
  EXPECT_LT(peer, subject) << "the subject of the page lies above the others";
  EXPECT_TRUE(tests::holds(script, "Solid: this suite.  Dashed: peers."));
  EXPECT_FALSE(tests::holds(script, "Grey:")) << "two curves are no crowd";
  EXPECT_EQ(shown({}, one_problem()).figure->variables.at("answers"), "curves");
}

TEST(WorkPrecision, WhatIsNeitherFastNorOfInterestIsGreyAndUnnamed) {
  const std::string script = shown({}, crowd()).figure->script;
  EXPECT_TRUE(tests::holds(script, "Grey: 9 other methods."));
  EXPECT_TRUE(tests::holds(script, "title 'bystander 3' noenhanced"));
  EXPECT_FALSE(tests::holds(script, "set label 'bystander 3'"));
  EXPECT_LT(script.find("title 'bystander 3'"), script.find("title 'one'")) << "behind those in colour";
}

TEST(WorkPrecision, AStripSaysWhoIsFastest) {
  const std::string script = shown({}, one_problem()).figure->script;
  EXPECT_TRUE(tests::holds(script, "set label '32 times as fast as one'"));
  EXPECT_TRUE(tests::holds(script, "set label 'as fast as two'"));
  EXPECT_TRUE(tests::holds(script, "set label 'alone'"));
  std::vector<ProblemLines> coarse = one_problem();
  coarse[0].lines.pop_back();
  EXPECT_TRUE(tests::holds(shown({}, coarse).figure->script, "set label 'no method'"));
}

TEST(WorkPrecision, OneProblemHasAPanelOfWork) {
  const std::string script = shown({.work_label = "evaluations"}, one_problem()).figure->script;
  EXPECT_TRUE(tests::holds(script, "set xlabel 'evaluations'"));
  EXPECT_TRUE(tests::holds(script, "data using \"right-hand sides\":\"digits\" every :::0::0"));
  EXPECT_FALSE(tests::holds(shown({}, one_problem()).figure->script, "using \"right-hand sides\""));
}

TEST(WorkPrecision, SeveralProblemsHaveAPanelEach) {
  std::vector<ProblemLines> two = {one_problem()[0], one_problem()[0]};
  two[0].problem = "low load";
  two[1].problem = "high load";
  const Showing showing = shown({.work_label = "evaluations"}, two);
  for (const char* part : {"'low load'", "'high load'", "every :::3::3"})
    EXPECT_TRUE(tests::holds(showing.figure->script, part));
  EXPECT_FALSE(tests::holds(showing.figure->script, "every :::4::4"));
  EXPECT_EQ(showing.table->columns()[0].name, "problem");
  EXPECT_EQ(showing.table->rows().size(), 12U);
}

TEST(WorkPrecision, RoundingIsALevelThatSaysWhatItIs) {
  const std::string script = shown({.rounding = 1e-12}, one_problem()).figure->script;
  EXPECT_TRUE(tests::holds(script, "one rounding of the data"));
  EXPECT_TRUE(tests::holds(script, "rounding errors below the worst case")) << "two has no error at all";
  EXPECT_TRUE(tests::holds(script, "first 12 to graph 1, first 12"));
  EXPECT_FALSE(tests::holds(shown({}, one_problem()).figure->script, "rounding"));
}

TEST(WorkPrecision, TheTextOfTheLevelCoversNoPointAndNoLeader) {
  const auto script = [](double rounding) {
    return shown({.rounding = rounding}, one_problem()).figure->script;
  };
  EXPECT_TRUE(tests::holds(script(1e-12), "data' at graph 0.01, first 12 left offset 0,0.5"));
  EXPECT_TRUE(tests::holds(script(1e-3), "data' at graph 0.99, first 3 right offset 0,0.5"))
      << "a point at 3";
  EXPECT_TRUE(tests::holds(script(2e-15), "data' at graph 0.01, first 14.699 left offset 0,-0.5"))
      << "the leader of two is above it from left to right";
}

TEST(WorkPrecision, TheTableHasARowARunAndOneForWhatIsAbsent) {
  const std::string digits = shown({}, one_problem()).table->markdown();
  for (const char* row : {"| one | step 10 | non_finite |  | 1 | 0.9 | 2 | 3 |",
                          "| one | step 0.1 | success | 7 | 100 | 100 | 100 | 100 |",
                          "| failing | step 10 | non_finite |", "| absent |  | not in this build |  |"})
    EXPECT_TRUE(tests::holds(digits, row));
  const std::string error = shown({.error = "error of x", .unit = "ns"}, one_problem()).table->markdown();
  EXPECT_TRUE(tests::holds(error, "| one | step 1 | success | 1e-3 | 1e6 |") ||
              tests::holds(error, "| one | step 1 | success | 0.001 | 1e6 |"))
      << error;
}

TEST(WorkPrecision, AnAttemptIsJudgedAndTimed) {
  int calls = 0;
  const auto compute = [&calls] { return ++calls; };
  const auto ending_of = [](int call) -> Ending { return {Status(), 0.5 * call}; };
  const Attempt quick = attempt("step 1", compute, ending_of, true);
  EXPECT_EQ(quick.status, "success");
  EXPECT_EQ(quick.error, 0.5);
  EXPECT_EQ(quick.time.repeats, 1);
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(attempt("step 1", compute, ending_of, false).time.repeats, 5);
  Ending stalled{Status::failure(Outcome::not_converged, "stalled"), {}};
  EXPECT_EQ(attempt(
                "step 1", compute, [&](int) { return stalled; }, true)
                .status,
            "not_converged");
}

}  // namespace
}  // namespace nlmech::scene::work_precision_test

/// `integrators integrate` and `compare` on the library's problems as a user types them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/chapters/integrators/run.hpp"
#include "tests/ivp/oracle.hpp"

namespace nlmech::integrators_commands_test {
namespace {

const std::vector<std::string> duffing_columns = {"t", "x", "x'"};

scene::NumberColumns trajectory(const std::string& words, const std::vector<std::string>& columns) {
  const Finished f = run("integrate " + words);
  EXPECT_EQ(f.exit_code, 0) << words << ": " << f.errors;
  EXPECT_EQ(f.errors, "") << words;
  std::string header;
  for (const std::string& name : columns) header += (header.empty() ? "" : ",") + name;
  EXPECT_TRUE(f.output.starts_with(header + "\n")) << f.output;
  return scene::parse_numbers(f.output, "output", columns);
}

/// max |e_i| of the last row against (x, v).
double last_error(const scene::NumberColumns& rows, const Vector<double, 2>& truth) {
  return std::max(std::abs(rows.column[1].back() - truth[0]), std::abs(rows.column[2].back() - truth[1]));
}

TEST(Integrate, FirstAndLastRowWithoutEvery) {
  const auto rows =
      trajectory("--problem duffing --until 20 --method radau-coll --step 0.1", duffing_columns);
  ASSERT_EQ(rows.rows(), 2U);
  EXPECT_EQ(rows.column[0], (std::vector<double>{0, 20}));
  EXPECT_EQ(rows.column[1][0], 1);
  EXPECT_EQ(rows.column[2][0], 0);
  EXPECT_LE(last_error(rows, oracle::duffing(20)),
            2e-9);  // 0.1^12 in each of 200 steps, times ten for what the motion makes of them
}

TEST(Integrate, TheTextMaySayTheEnd) {
  const auto kepler = trajectory("--problem kepler", {"t", "x", "y", "x'", "y'"});
  EXPECT_EQ(kepler.column[0], (std::vector<double>{0, 16}));
  // Kepler's equation, by Newton's iteration, for the anomaly of 16 units of time.
  double anomaly = 16;
  for (int i = 0; i < 50; ++i)
    anomaly -= (anomaly - 0.7 * std::sin(anomaly) - 16) / (1 - 0.7 * std::cos(anomaly));
  // The tolerance times the condition of errors of one tolerance, 914 (tables/reference).
  EXPECT_NEAR(kepler.column[1].back(), std::cos(anomaly) - 0.7, 1e-6);
  const auto sooner = trajectory("--problem kepler --until 1", {"t", "x", "y", "x'", "y'"});
  EXPECT_EQ(sooner.column[0].back(), 1);
  const auto typed = trajectory("--equation x'_=_-x;_x(0)_=_1;_t_<=_2", {"t", "x"});
  EXPECT_EQ(typed.column[0].back(), 2);
}

TEST(Integrate, HoldsARunToWhatTheTextSays) {
  const Finished kept =
      run("integrate --equation x''_=_-x;_x(0)_=_1;_x'(0)_=_0;_t_<=_9;_conserved_x^2_+_x'^2");
  EXPECT_EQ(kept.exit_code, 0) << kept.errors;
  const Finished lost = run("integrate --equation x'_=_-x;_x(0)_=_1;_t_<=_1;_conserved_x");
  EXPECT_EQ(lost.exit_code, 1);
  EXPECT_NE(lost.errors.find("quantity 1 that this problem conserves"), std::string::npos) << lost.errors;
  const Finished left = run("integrate --equation x'_=_-1;_x(0)_=_1;_t_<=_2;_x_>=_0");
  EXPECT_EQ(left.exit_code, 1);
  EXPECT_NE(left.errors.find("stay above 0"), std::string::npos) << left.errors;
  const Finished without =
      run("integrate --equation x'_=_-x;_x(0)_=_1;_t_<=_1;_conserved_x;_conserved_1/(1_-_x)");
  EXPECT_EQ(without.exit_code, 1) << "a quantity that is infinite at the start hides the others";
}

// The ball is at the ground when its step would lead below it; the spring takes over before the mass is
// there.
TEST(Integrate, StepsThatAreCutBreakNoBound) {
  const Finished lands =
      run("integrate --equation h''_=_-9.81;_h(0)_=_1;_h'(0)_=_0;_h_>=_0;_t_<=_2 "
          "--event h_=_0_falling_end");
  EXPECT_EQ(lands.exit_code, 0) << lands.errors;
  const Finished bounces =
      run("integrate --equation x''_=_-1_+_100_max(0,0.2-x);_x(0)_=_1;_x'(0)_=_0;_t_<=_5;_x_>=_0");
  EXPECT_EQ(bounces.exit_code, 0) << bounces.errors;
}

TEST(Integrate, HoldsARunThatSwitchesToTheWholeText) {
  const Finished lost =
      run("integrate --equation x''_=_-sign(x)_-_1e-3_x';_x(0)_=_1;_x'(0)_=_0;_t_<=_20;"
          "_conserved_x'^2/2_+_abs(x)");
  EXPECT_EQ(lost.exit_code, 1);
  EXPECT_NE(lost.errors.find("and was 1 at the start"), std::string::npos) << lost.errors;
  const Finished kept =
      run("integrate --equation x''_=_-sign(x);_x(0)_=_1;_x'(0)_=_0;_t_<=_20;_conserved_x'^2/2_+_abs(x)");
  EXPECT_EQ(kept.exit_code, 0) << kept.errors;
}

TEST(Integrate, AnEndBeforeTheStartIsNotRunTo) {
  const Finished f = run("integrate --equation x'_=_-x;_x(0)_=_1;_t_<=_10 --from 12");
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_NE(f.errors.find("ends at t = 10, before the start at 12"), std::string::npos) << f.errors;
}

TEST(Integrate, ListsProblemsThatAreTextsByName) {
  const Finished f = run("integrate --help");
  for (const char* name : {"kepler: ", "arenstorf: ", "spring-pendulum: "})
    EXPECT_NE(f.output.find(std::string("\n  ") + name), std::string::npos) << name;
}

// Every method reaches the end exactly; each with a step at which its order leaves some digits: the error of
// Newmark's method, the least accurate of order 2 here, is 4e-4 at P/500 (recorded:
// 3e-3 at t = 500), those of order 1 are three digits worse.
TEST(Integrate, EveryMethodOfOursArrives) {
  const Vector<double, 2> truth = oracle::duffing(5);
  const std::vector<std::pair<std::string, double>> methods = {{"euler --step 1e-4", 1e-2},
                                                               {"backward-euler --step 1e-4", 1e-2},
                                                               {"explicit --step 0.01", 1e-3},
                                                               {"rk4 --step 0.01", 1e-7},
                                                               {"rk6 --step 0.02", 1e-9},
                                                               {"ode45 --tolerance 1e-9", 1e-6},
                                                               {"newmark --step 0.01", 1e-3},
                                                               {"hht --step 0.01", 1e-3},
                                                               {"generalized-alpha --step 0.01", 1e-3},
                                                               {"mcpi --step 0.5", 1e-5},
                                                               {"rbf-coll --step 0.4768 --shape 0.77", 1e-5},
                                                               {"lgl-coll --step 0.2", 1e-6},
                                                               {"radau-coll --step 0.5", 1e-6}};
  for (const auto& [method, bound] : methods) {
    const auto rows = trajectory("--problem duffing --until 5 --method " + method, duffing_columns);
    EXPECT_EQ(rows.column[0].back(), 5) << method;
    EXPECT_LE(last_error(rows, truth), bound) << method;
  }
}

TEST(Integrate, PeersAnswerOrSayThatTheyAreAbsent) {
  for (const std::string peer : {"cvode-adams", "arkode-erk", "gsl-rk8pd", "odeint-dopri5"}) {
    const Finished f = run("integrate --problem duffing --until 5 --method " + peer);
    if (f.exit_code == 0) {
      const auto rows = scene::parse_numbers(f.output, "output", duffing_columns);
      EXPECT_LE(last_error(rows, oracle::duffing(5)), 1e-6) << peer;  // 1e-9 in some hundred steps
    } else {
      EXPECT_EQ(f.exit_code, 2) << peer;
      EXPECT_NE(f.errors.find(peer + " is not in this build"), std::string::npos) << f.errors;
    }
  }
}

// The test set's digits; the second species is 8e-14, so that it needs an absolute tolerance of its own.
// Asked: two digits less than the tolerance has.
TEST(Integrate, AbsoluteToleranceOfItsOwn) {
  const auto rows = trajectory(
      "--problem robertson --until 1e11 --method adaptive-collocation --tolerance 1e-9 --absolute-tolerance "
      "1e-17",
      {"t", "y1", "y2", "y3"});
  EXPECT_NEAR(rows.column[1].back() / 0.2083340149701255e-7, 1, 1e-7);
  EXPECT_NEAR(rows.column[2].back() / 0.8333360770334713e-13, 1, 1e-7);
  EXPECT_NEAR(rows.column[3].back() / 0.9999999791665050, 1, 1e-7);
}

TEST(Integrate, EveryGivesRowsByDenseOutput) {
  const auto rows = trajectory("--problem duffing --until 2.25 --method radau-coll --step 0.2 --every 0.5",
                               duffing_columns);
  EXPECT_EQ(rows.column[0], (std::vector<double>{0, 0.5, 1, 1.5, 2, 2.25}));
  for (std::size_t i = 0; i < rows.rows(); ++i) {
    const Vector<double, 2> truth = oracle::duffing(rows.column[0][i]);
    // Within a step a polynomial of degree 6 through values right to 1e-9.
    EXPECT_NEAR(rows.column[1][i], truth[0], 1e-6);
    EXPECT_NEAR(rows.column[2][i], truth[1], 1e-6);
  }
}

// 0.1 ten times is not 1 in binary: still no second row for the end.
TEST(Integrate, EveryThatDividesTheWayRepeatsNoRow) {
  const auto rows =
      trajectory("--problem duffing --until 1 --method rk4 --step 0.3 --every 0.1", duffing_columns);
  ASSERT_EQ(rows.rows(), 11U);
  EXPECT_EQ(rows.column[0].back(), 1);
  const auto longer =
      trajectory("--problem duffing --until 1 --method rk4 --step 0.3 --every 7", duffing_columns);
  EXPECT_EQ(longer.column[0], (std::vector<double>{0, 1}));
}

TEST(Integrate, BackwardsInTime) {
  const auto rows =
      trajectory("--problem duffing --until -5 --method rk6 --step 0.01 --every 2", duffing_columns);
  EXPECT_EQ(rows.column[0], (std::vector<double>{0, -2, -4, -5}));
  EXPECT_LE(last_error(rows, oracle::duffing(-5)), 1e-10);  // 0.01^6 a unit of time, times the motion's rates
  // There and back, from a state with a negative component.
  const auto there =
      trajectory("--problem duffing --initial -1,-0.5 --from -1 --until 2.5 --method radau-coll --step 0.1",
                 duffing_columns);
  const auto back =
      trajectory("--problem duffing --from 2.5 --until -1 --method radau-coll --step 0.1 --initial " +
                     fmt::format("{:.17g},{:.17g}", there.column[1].back(), there.column[2].back()),
                 duffing_columns);
  EXPECT_LE(last_error(back, {-1, -0.5}), 1e-8);
}

TEST(Integrate, ParametersAreSet) {
  // Without hardening a harmonic oscillator.
  const auto rows = trajectory(
      "--problem duffing --set hardening=0 --set natural__frequency=2 --until 3 --method rk6 --step 0.01",
      duffing_columns);
  EXPECT_LE(last_error(rows, {std::cos(6), -2 * std::sin(6)}), 1e-10);  // (0.01 2)^6 is 6e-11
}

TEST(Integrate, ColumnsFollowTheProblem) {
  const auto chain = trajectory("--problem three-dof --until 1 --method rk4 --step 0.1",
                                {"t", "x1", "x2", "x3", "x1'", "x2'", "x3'"});
  EXPECT_EQ(chain.rows(), 2U);
  const auto blow = trajectory("--problem blow-up --until 0.25 --method rk6 --step 0.001", {"t", "y"});
  EXPECT_NEAR(blow.column[1].back(), 1 / std::sqrt(0.5), 1e-12);
  EXPECT_EQ(trajectory("--problem van-der-pol --until 1 --method ode45", duffing_columns).rows(), 2U);
  EXPECT_EQ(trajectory("--problem impact --until 2 --method hht --step 0.1", duffing_columns).rows(), 2U);
}

TEST(Integrate, NoWayToGo) {
  const auto rows =
      trajectory("--problem duffing --from 3 --until 3 --method rk4 --step 0.1", duffing_columns);
  EXPECT_EQ(rows.column[0], (std::vector<double>{3, 3}));
  EXPECT_EQ(rows.column[1], (std::vector<double>{1, 1}));
}

struct BadWords {
  std::string words;
  Words says;
};

// Exit code 2, nothing on standard output, and a message with option, value and what there is.
TEST(OwnWork, BadInputIsNamed) {
  const std::string good = " --problem duffing --until 1";
  const std::vector<BadWords> cases = {
      {"integrate --problem pendulum --until 1 --method rk4",
       {"--problem pendulum", "duffing", "three-dof", "blow-up"}},
      {"integrate --method magic" + good, {"--method", "'magic'", "rbf-coll", "odeint-dopri5"}},
      {"compare --methods rk4,magic" + good, {"--methods", "'magic'", "rbf-coll"}},
      {"compare --methods rk4," + good, {"--methods", "''"}},
      {"integrate --method rk4 --set stiffness=2" + good, {"--set stiffness", "hardening"}},
      {"integrate --method rk4 --set hardening" + good, {"--set hardening", "name=value"}},
      {"integrate --method rk4 --set hardening=two" + good, {"--set hardening=two", "number"}},
      {"integrate --method rk4 --initial 1" + good,
       {"--initial 1", "1 numbers", "x,x'", "x'' = -natural_frequency^2 x"}},
      {"integrate --method rk4 --initial 1,2,3" + good, {"--initial 1,2,3", "3 numbers"}},
      {"integrate --method rk4 --initial 1,two" + good, {"--initial 1,two", "'two'"}},
      {"integrate --method rk4 --initial 1,nan" + good, {"--initial", "'nan'"}},
      {"integrate --problem duffing --method rk4 --until inf", {"--until inf"}},
      {"integrate --problem duffing --method rk4 --until 1e999", {"--until 1e999"}},
      {"integrate --problem duffing --method rk4 --until soon", {"--until soon"}},
      {"integrate --method rk4 --from -x" + good, {"-x"}},
      {"integrate --method rk4 --step 0" + good, {"--step 0", "positive"}},
      {"integrate --method rk4 --step -0.1" + good, {"--step -0.1", "positive"}},
      {"integrate --method rk4 --tolerance -1e-9" + good, {"--tolerance -1e-9", "positive"}},
      {"integrate --method rk4 --tolerance tight" + good, {"--tolerance tight"}},
      {"integrate --method ode45 --absolute-tolerance 0" + good, {"--absolute-tolerance 0", "positive"}},
      {"integrate --method rk4 --absolute-tolerance 1e-9" + good, {"rk4", "absolute tolerance"}},
      {"compare --methods rk4,radau-coll --absolute-tolerance 1e-9" + good,
       {"--absolute-tolerance 1e-09", "rk4,radau-coll"}},
      {"integrate --problem robertson --until 1 --method newmark --step 0.1", {"newmark", "acceleration"}},
      {"integrate --method rk4 --step 0.1 --tolerance 1e-9" + good,
       {"--step 0.1", "--tolerance 1e-09", "not both"}},
      {"integrate --method rk4" + good, {"--method", "rk4", "give a step", "series"}},
      {"integrate --method rk4 --tolerance 1e-9" + good, {"--method", "rk4", "give a step", "series"}},
      {"compare --methods ode45,series --step 0.1 --tolerance 1e-6" + good,
       {"--step 0.1", "ode45,series", "choose their steps"}},
      {"compare --methods rk4,rk6 --step 0.1 --tolerance 1e-6" + good,
       {"--tolerance 1e-06", "rk4,rk6", "chooses its steps"}},
      {"integrate --method rk4 --every 0" + good, {"--every 0", "positive"}},
      {"integrate --method rk4 --every 1e-12" + good, {"--every 1e-12", "rows"}},
      {"integrate --method rbf-coll --nodes 1" + good, {"--nodes 1", "2 to 200"}},
      {"integrate --method rbf-coll --nodes 201" + good, {"--nodes 201", "2 to 200"}},
      {"integrate --method rbf-coll --nodes 7.5" + good, {"--nodes 7.5", "whole"}},
      {"integrate --method rk4 --nodes 7" + good, {"--method", "rk4", "no nodes"}},
      {"integrate --method lgl-coll --shape 1" + good, {"lgl-coll", "no shape"}},
      {"integrate --method rbf-coll --shape 0" + good, {"--shape 0", "positive"}},
      {"integrate --method ode45 --step 0.1" + good, {"ode45", "tolerance, not a step"}},
      {"integrate --method ode45 --tolerance 1e-17" + good, {"ode45", "1e-17"}},
      {"compare --methods ode45,cvode-bdf --step 0.1" + good,
       {"--methods", "ode45", "tolerance, not a step"}},
      {"integrate --method rk4 --set hardening=2 --set hardening=3" + good,
       {"hardening=2", "hardening=3", "twice"}},
      {"integrate --method rk4 --set hardening=2 natural__frequency=1 hardening=2" + good,
       {"hardening", "twice"}},
      {"compare --methods rk4,ode45 --nodes 7" + good, {"--nodes 7", "rk4,ode45"}},
      {"compare --methods lgl-coll --shape 7" + good, {"--shape 7", "lgl-coll"}},
      {"integrate --problem blow-up --until 0.1 --method newmark --step 0.1", {"newmark", "acceleration"}},
      {"integrate --method rk4 --limit 0" + good, {"--limit 0", "positive"}},
      {"integrate --equation x'=-x --initial 1 --method rk4", {"--until"}},
      {"integrate --until 1 --method rk4", {"--problem"}},
      {"integrate --method rk4 --frobnicate 1" + good, {"--frobnicate"}},
  };
  for (const BadWords& bad : cases) {
    const Finished f = run(bad.words);
    EXPECT_EQ(f.exit_code, 2) << bad.words << ": " << f.errors;
    EXPECT_EQ(f.output, "") << bad.words;
    for (const std::string& word : bad.says)
      EXPECT_NE(f.errors.find(word), std::string::npos) << "no '" << word << "' in: " << f.errors;
  }
}

// Exit code 1, a sentence with method, place and what to change, and nothing on standard output.
TEST(Integrate, FailureSaysWhereAndWhatToChange) {
  const Finished blow = run("integrate --problem blow-up --until 1 --method rk4 --step 0.01 --every 0.1");
  EXPECT_EQ(blow.exit_code, 1);
  EXPECT_EQ(blow.output, "");
  for (const std::string word : {"rk4", "non_finite", "t = 0.5", "smaller step"})
    EXPECT_NE(blow.errors.find(word), std::string::npos) << blow.errors;
  const Finished late =
      run("integrate --problem duffing --until 1e6 --method euler --step 1e-6 --limit 0.05");
  EXPECT_EQ(late.exit_code, 1);
  EXPECT_NE(late.errors.find("time_limit"), std::string::npos) << late.errors;
}

struct Row {
  std::string method, setting, status, digits, seconds, evaluations, note;
};

std::vector<Row> comparison(const std::string& words, std::string& errors) {
  const Finished f = run("compare " + words);
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  errors = f.errors;
  const auto records = scene::parse_csv(f.output, "output");
  EXPECT_EQ(records.at(0).cells, (std::vector<std::string>{"method", "setting", "status", "digits", "seconds",
                                                           "right_hand_sides", "note"}));
  std::vector<Row> rows;
  for (std::size_t i = 1; i < records.size(); ++i) {
    const auto& c = records[i].cells;
    rows.push_back({c.at(0), c.at(1), c.at(2), c.at(3), c.at(4), c.at(5), c.at(6)});
    if (rows.back().status == "unsuitable") continue;
    EXPECT_GT(std::stod(rows.back().seconds), 0) << f.output;
    EXPECT_GE(std::stoll(rows.back().evaluations), 0) << f.output;
  }
  return rows;
}

// The digits, from what `integrate` prints and from the elliptic functions in 50 digits.
TEST(Compare, DigitsAreThoseOfTheEndState) {
  const Vector<double, 2> truth = oracle::duffing(20);
  std::string errors;
  const auto rows = comparison(
      "--problem duffing --until 20 --methods rk4,ode45,adaptive-collocation --step 0.01 --tolerance 1e-7",
      errors);
  EXPECT_NE(errors.find("reference: "), std::string::npos) << errors;
  ASSERT_EQ(rows.size(), 3U);
  for (const Row& row : rows) {
    EXPECT_EQ(row.status, "success");
    EXPECT_EQ(row.note, "");
    const bool fixed = row.method == "rk4";
    EXPECT_EQ(row.setting, fixed ? "step 0.01" : "tolerance 1e-07");
    const auto end =
        trajectory("--problem duffing --until 20 " + std::string(fixed ? "--step 0.01" : "--tolerance 1e-7") +
                       " --method " + row.method,
                   duffing_columns);
    double worst = 0;
    for (int i = 0; i < 2; ++i)
      worst = std::max(worst, std::abs(end.column[static_cast<std::size_t>(i) + 1].back() / truth[i] - 1));
    EXPECT_NEAR(std::stod(row.digits), -std::log10(worst), 0.01) << row.method;
    EXPECT_GT(std::stoll(row.evaluations), 100) << row.method;
  }
}

// Over eight periods the errors of steps add up to more than a hundred tolerances; a step that is given holds
// none.
TEST(Compare, SaysWhatAToleranceDidNotHold) {
  std::string errors;
  const auto rows = comparison("--problem duffing --until 50 --methods hoff,ode45 --tolerance 1e-8", errors);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_LT(std::stod(rows[0].digits), 4);
  EXPECT_TRUE(rows[0].note.starts_with("off by 1.")) << rows[0].note;
  EXPECT_NE(rows[0].note.find("holds the error of each step"), std::string::npos) << rows[0].note;
  EXPECT_EQ(rows[1].note, "");
  EXPECT_EQ(comparison("--problem duffing --until 50 --methods rk4 --step 0.1", errors).at(0).note, "");
}

TEST(Compare, SettingsGoToTheMethodsThatHaveThem) {
  std::string errors;
  const auto rows = comparison(
      "--problem duffing --until 5 --methods rk4,rbf-coll,lgl-coll --step 0.5 --nodes 9 --shape 1", errors);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].setting, "step 0.5");
  EXPECT_EQ(rows[1].setting, "step 0.5 nodes 9 shape 1");
  EXPECT_EQ(rows[2].setting, "step 0.5 nodes 9");
  EXPECT_EQ(rows[0].evaluations, "40");
}

TEST(Compare, FailuresKeepTheirRow) {
  std::string errors;
  const auto rows = comparison("--problem blow-up --until 1 --methods rk4,radau-coll --step 0.01", errors);
  ASSERT_EQ(rows.size(), 2U);
  for (const Row& row : rows) {
    EXPECT_NE(row.status, "success");
    EXPECT_EQ(row.digits, "");
    EXPECT_NE(errors.find(row.method + ": "), std::string::npos) << errors;
    EXPECT_NE(row.note.find("t = 0.5"), std::string::npos) << row.note;  // where the solution ends
  }
  EXPECT_EQ(rows[0].status, "non_finite");
  EXPECT_NE(errors.find("no reference"), std::string::npos) << errors;
}

// y' = y^3 the other way: 1/sqrt(1 - 2 t), which is below 1 for t < 0. And across the discontinuities of the
// impact, backwards from after them.
TEST(Compare, BackwardsHasAReferenceToo) {
  std::string errors;
  const auto blow = comparison("--problem blow-up --until -3 --methods dop853 --tolerance 1e-12", errors);
  ASSERT_EQ(blow.size(), 1U);
  EXPECT_GT(std::stod(blow[0].digits), 11) << errors;
  const auto end = trajectory("--problem blow-up --until -3 --method dop853 --tolerance 1e-12", {"t", "y"});
  EXPECT_NEAR(end.column[1].back(), 1 / std::sqrt(7.0), 1e-12);
  const auto impact = comparison(
      "--problem impact --from 3 --until -1 --initial 0.5,-0.25 --methods dop853,adaptive-collocation "
      "--tolerance 1e-12",
      errors);
  ASSERT_EQ(impact.size(), 2U);
  for (const Row& row : impact) EXPECT_GT(std::stod(row.digits), 10.5) << row.method << errors;
}

TEST(OwnWork, HelpNamesProblemsAndMethods) {
  for (const std::string command : {"integrate", "compare"}) {
    const Finished f = run(command + " --help");
    EXPECT_EQ(f.exit_code, 0);
    for (const std::string word : {"three-dof", "hardening=1", "van-der-pol", "radau-coll", "gsl-rk8pd",
                                   "--tolerance", "x'' = mu ((1 - x^2) x') - x"})
      EXPECT_NE(f.output.find(word), std::string::npos) << command << ": no " << word;
  }
}

}  // namespace
}  // namespace nlmech::integrators_commands_test

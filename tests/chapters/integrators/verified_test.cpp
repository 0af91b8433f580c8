/// `integrators integrate` holds runs by a tolerance to an independent one, and `compare` measures all
/// methods by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/chapters/integrators/run.hpp"
#include "tests/ivp/oracle.hpp"

namespace nlmech::integrators_commands_test {
namespace {

bool is_absent(const Finished& f) { return f.errors.find("is not in this build") != std::string::npos; }

void expect_says(const Finished& f, const std::vector<std::string>& words) {
  for (const std::string& word : words)
    EXPECT_NE(f.errors.find(word), std::string::npos) << "no '" << word << "' in: " << f.errors;
}

// Runs that end with success and are far off: multistep formulas and extrapolation that underrate the errors
// of their steps. The right ends: cn of the Duffing oscillator, cos 1e4 = -0.9521, and the leap of van der
// Pol's equation, each by two methods of other kinds.
TEST(IntegrateVerified, RefusesWhatIsFarOff) {
  for (const std::string words :
       {"--problem van-der-pol --set mu=266.85 --until 200 --tolerance 4.2e-10 --method gsl-msadams",
        "--problem duffing --set natural__frequency=1e4 --initial 1,0 --until 1 --tolerance 1e-6 --method "
        "gsl-bsimp",
        "--problem duffing --until 20 --method gsl-msbdf"}) {
    const Finished f = run("integrate " + words);
    if (is_absent(f)) continue;
    EXPECT_EQ(f.exit_code, 1) << words << f.output;
    EXPECT_EQ(f.output, "") << words;
    expect_says(f, {"not_converged", "verified by integration", "times the tolerance",
                    "the error of each step", "--tolerance 1e-", "another method", "--no-verify"});
  }
}

// Where the concentration that drives the others has become smaller than the absolute tolerance, a run may
// leave the physical states: rounding decides whether. It is refused then; a run that is printed is right to
// a hundred tolerances. Of the end the first two are below 1e-7 (Hairer and Wanner II, IV.10: x1 falls like
// 1/t).
TEST(IntegrateVerified, NoRunawayIsASuccess) {
  for (const auto& [words, tolerance] : {std::pair("adaptive-collocation --until 1e14", 1e-9),
                                         std::pair("cvode-bdf --until 1e11 --tolerance 1e-6", 1e-6),
                                         std::pair("gsl-msbdf --until 1e11 --tolerance 1e-6", 1e-6)}) {
    const Finished f = run("integrate --problem robertson --method " + std::string(words));
    if (is_absent(f)) continue;
    if (f.exit_code == 0) {
      const auto rows = scene::parse_numbers(f.output, "output", {"t", "y1", "y2", "y3"});
      EXPECT_NEAR(rows.column[1].back(), 0, 100 * tolerance) << words;
      EXPECT_NEAR(rows.column[2].back(), 0, 100 * tolerance) << words;
      EXPECT_NEAR(rows.column[3].back(), 1, 100 * tolerance) << words;
      continue;
    }
    EXPECT_EQ(f.exit_code, 1) << words << f.output;
    EXPECT_EQ(f.output, "") << words;
    EXPECT_NE(f.errors.find("take a smaller absolute tolerance"), std::string::npos) << words << f.errors;
  }
}

TEST(IntegrateVerified, PrintsTheRunAsItIsIfAsked) {
  const Finished f = run("integrate --problem duffing --until 20 --method gsl-msbdf --no-verify");
  if (is_absent(f)) GTEST_SKIP() << f.errors;
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  EXPECT_EQ(f.errors, "");
  const auto rows = scene::parse_numbers(f.output, "output", {"t", "x", "x'"});
  EXPECT_NEAR(rows.column[1].back(), oracle::duffing(20)[0], 1e-4);
}

// A step is the user's own, and its error what he asked for.
TEST(IntegrateVerified, LeavesFixedStepsAlone) {
  const Finished f = run("integrate --problem duffing --until 20 --method newmark --step 0.1");
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  EXPECT_EQ(f.errors, "");
}

// The rows too: the cubic between the steps of ARKODE is off by more than its tolerance, the ends of its
// steps are not.
TEST(IntegrateVerified, LooksAtRows) {
  const std::string words = "integrate --problem duffing --until 20 --method arkode-erk --tolerance 1e-6";
  const Finished ends = run(words);
  if (is_absent(ends)) GTEST_SKIP() << ends.errors;
  EXPECT_EQ(ends.exit_code, 0) << ends.errors;
  const Finished rows = run(words + " --every 0.37");
  double worst = 0;
  if (rows.exit_code == 0) {
    const auto all = scene::parse_numbers(rows.output, "output", {"t", "x", "x'"});
    for (std::size_t i = 0; i < all.rows(); ++i)
      worst = std::max(worst, std::abs(all.column[1][i] - oracle::duffing(all.column[0][i])[0]));
  }
  EXPECT_LE(worst, 2e-3)
      << rows.errors;  // a hundred tolerances, or ten of what the shear makes of one: 10 x 20
}

struct Row {
  std::string method, status, digits, note;
};

std::vector<Row> comparison(const std::string& words, std::string& errors) {
  const Finished f = run("compare " + words);
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  errors = f.errors;
  std::vector<Row> rows;
  const auto records = scene::parse_csv(f.output, "output");
  for (std::size_t i = 1; i < records.size(); ++i) {
    const auto& c = records[i].cells;
    rows.push_back({c.at(0), c.at(2), c.at(3), c.at(6)});
  }
  return rows;
}

TEST(CompareAll, AnUnsuitableMethodKeepsItsRow) {
  std::string errors;
  const auto rows = comparison(
      "--problem van-der-pol --until 1 --methods rkn1210,_rk4_,_ode45 --step 0.01 --tolerance 1e-9", errors);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].status, "unsuitable");
  EXPECT_NE(rows[0].note.find("depend on velocities"), std::string::npos) << rows[0].note;
  EXPECT_EQ(rows[1].method, "rk4");
  EXPECT_EQ(rows[1].status, "success");
  EXPECT_EQ(rows[2].status, "success");
  EXPECT_GT(std::stod(rows[2].digits), 6);
}

TEST(CompareAll, TakesAllMethodsOfThisBuild) {
  std::string errors;
  const auto rows =
      comparison("--problem duffing --until 1 --methods all --step 0.001 --tolerance 1e-4", errors);
  EXPECT_GE(rows.size(), 21U);  // ours
  for (const std::string name : {"euler", "rkn1210", "mtl", "adaptive-collocation"})
    EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [&](const Row& r) { return r.method == name; }))
        << name;
  for (const Row& r : rows) {
    if (r.status == "success") {
      EXPECT_GT(std::stod(r.digits), 1) << r.method;
    } else {
      EXPECT_NE(r.note, "") << r.method;
    }
  }
}

// No Taylor series in extended precision gets through these; the digits come from two methods that agree, and
// are no more than these have in common. Stored: the test set's end of Robertson's reaction (Hairer and
// Wanner II, IV.10).
TEST(CompareReference, StiffProblemsHaveDigits) {
  std::string errors;
  const auto robertson = comparison(
      "--problem robertson --until 1e11 --methods adaptive-collocation --tolerance 1e-8 --absolute-tolerance "
      "1e-16",
      errors);
  ASSERT_EQ(robertson.size(), 1U);
  if (errors.find("no two methods") != std::string::npos)
    GTEST_SKIP() << "this build has one stiff method alone";
  EXPECT_NE(errors.find(" agree to "), std::string::npos) << errors;
  EXPECT_GT(std::stod(robertson[0].digits), 6) << errors;
  EXPECT_LT(std::stod(robertson[0].digits), 13) << errors;
}

TEST(CompareReference, TheLimitIsThatOfTheWholeCommand) {
  std::string errors;
  const auto rows = comparison(
      "--problem three-dof --until 2000 --methods euler,backward-euler,newmark,hht --step 1e-5 --limit "
      "2",
      errors);
  ASSERT_EQ(rows.size(), 4U);
  for (const Row& r : rows) EXPECT_EQ(r.status, "time_limit");
}

}  // namespace
}  // namespace nlmech::integrators_commands_test

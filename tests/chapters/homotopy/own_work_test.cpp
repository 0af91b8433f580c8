/// `homotopy limit-points` and `homotopy solve` as a user types them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/process.hpp"
#include "tests/places.hpp"

namespace nlmech::own_work_test {
namespace {

using scene::Finished;

/// Runs a program with words separated by blanks.
Finished run(const std::string& program, const std::string& words) {
  std::vector<std::string> arguments = {NLMECH_BINARY_DIR "/bin/" + program};
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(' ', begin), words.size());
    if (end > begin) arguments.push_back(words.substr(begin, end - begin));
    begin = end + 1;
  }
  return scene::run_program(arguments, {});
}

Finished homotopy(const std::string& words) { return run("homotopy", words); }

/// The rows of `limit-points`, which has to succeed.
std::vector<scene::CsvRecord> limit_points(const std::string& words) {
  const Finished f = homotopy("limit-points " + words);
  EXPECT_EQ(f.exit_code, 0) << words << ": " << f.errors;
  EXPECT_TRUE(f.output.starts_with("kind,load,deflection,motion\n")) << f.output;
  auto rows = scene::parse_csv(f.output, "output");
  rows.erase(rows.begin());
  return rows;
}

double number(const std::string& text) {
  double value = NAN;
  EXPECT_TRUE(scene::parse_number(text, value)) << text;
  return value;
}

void expect_pair(const std::string& words, double maximum, double minimum, double relative) {
  const auto rows = limit_points(words);
  ASSERT_EQ(rows.size(), 2U) << words;
  EXPECT_EQ(rows[0].cells.at(0), "maximum");
  EXPECT_EQ(rows[1].cells.at(0), "minimum");
  EXPECT_NEAR(number(rows[0].cells.at(1)), maximum, relative * maximum) << words;
  EXPECT_NEAR(number(rows[1].cells.at(1)), minimum, relative * minimum) << words;
  EXPECT_LT(number(rows[0].cells.at(2)), number(rows[1].cells.at(2))) << words;
}

// oracle: homotopy_williams Williams 0.?? maximum, Williams 0.?? minimum
// oracle: homotopy_frames toggle 0.?? of 1 m*imum, toggle 0.44 of 4 m*, toggle 0.44 of 16 m*
TEST(LimitPoints, KnownLoads) {
  expect_pair("--height 0.44 --elements 1", 42.435492120383, 32.124218754757, 1e-10);
  expect_pair("--height 0.44", 42.4387099966, 32.1222520061, 1e-10);
  expect_pair("--height 0.44 --model element --elements 16", 42.4397089470, 32.1221702414, 1e-10);
  expect_pair("--height 0.44 --model williams", 42.771896097273, 30.363548710287, 1e-10);
  expect_pair("--height 0.38 --model williams", 33.278532607761, 30.588387926087, 1e-10);
  expect_pair("--height 0.38 --elements 1", 33.122797603353, 31.107808393235, 1e-10);
}

// The half toggle's two, and before them the one where the apex turns. Loads of a walk with short steps.
TEST(LimitPoints, BifurcationsAreNamed) {
  for (const auto& [words, bow, limit] : {std::tuple{"--height 2 --elements 8", 642.99, 964.03},
                                          std::tuple{"--height 1 --elements 8", 258.7, 266.7}}) {
    const auto rows = limit_points(words);
    ASSERT_GE(rows.size(), 4U);
    EXPECT_EQ(rows[0].cells.at(0), "bifurcation");
    EXPECT_EQ(rows[0].cells.at(3), "antisymmetric");
    EXPECT_EQ(rows[1].cells.at(0), "bifurcation");
    EXPECT_EQ(rows[1].cells.at(3), "symmetric");
    EXPECT_NEAR(number(rows[1].cells.at(1)), bow, 0.05);
    const auto at =
        std::find_if(rows.begin(), rows.end(), [](const auto& r) { return r.cells.at(0) == "maximum"; });
    ASSERT_NE(at, rows.end());
    EXPECT_NEAR(number(at->cells.at(1)), limit, 0.05);
  }
}

TEST(LimitPoints, HighTogglesAndWilliamsEquationToItsEnd) {
  const auto first = [](const std::vector<scene::CsvRecord>& rows) {
    double load = NAN;
    for (const auto& row : rows) {
      if (std::isnan(load) && row.cells.at(0) == "maximum") load = number(row.cells.at(1));
    }
    return load;
  };
  EXPECT_NEAR(first(limit_points("--height 10 --elements 4")), 6698.82, 0.01);  // a walk of short steps
  for (const char* elements : {"2", "4", "8", "16"})
    EXPECT_NEAR(first(limit_points(std::string("--height 5 --elements ") + elements)), 3112, 8);
  const Finished f = homotopy("limit-points --height 1 --model williams");
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  EXPECT_NE(f.errors.find("pole of d_5"), std::string::npos) << f.errors;
  EXPECT_EQ(f.output.find("minimum"), std::string::npos) << f.output;
}

TEST(LimitPoints, NoneAtTheLowestHeight) {
  EXPECT_TRUE(limit_points("--height 0.32").empty());
  EXPECT_TRUE(limit_points("--height 0.32 --model williams").empty());
  EXPECT_TRUE(limit_points("--height 0.32 --elements 1").empty());
}

struct Solved {
  std::string status;
  double deflection = NAN, residual = NAN, iterations = NAN, bound = NAN;
  std::string stability, critical_load;
  Finished finished;
};

Solved solve(const std::string& words) {
  Solved s;
  s.finished = homotopy("solve " + words);
  if (!s.finished.output.starts_with("status,deflection,residual,iterations,bound,stability,critical_load\n"))
    return s;
  const auto rows = scene::parse_csv(s.finished.output, "output");
  if (rows.size() != 2) return s;
  s.status = rows[1].cells.at(0);
  s.deflection = number(rows[1].cells.at(1));
  s.residual = number(rows[1].cells.at(2));
  s.iterations = number(rows[1].cells.at(3));
  s.bound = number(rows[1].cells.at(4));
  s.stability = rows[1].cells.at(5);
  s.critical_load = rows[1].cells.at(6);
  EXPECT_LE(s.residual, s.bound) << words;
  return s;
}

// Without --elements members bow: 161.0617, 258.7358 and 266.6795 lb for eight elements, and four are within
// m^-2 of 1e-3. One does not, and says so.
TEST(LimitPoints, MembersBowUnlessOneElementIsAskedFor) {
  const auto rows = limit_points("--height 1");
  ASSERT_GE(rows.size(), 3U);
  const std::vector<std::tuple<std::string, std::string, double>> known = {
      {"bifurcation", "antisymmetric", 161.0617},
      {"bifurcation", "symmetric", 258.7358},
      {"maximum", "symmetric", 266.6795}};
  for (std::size_t i = 0; i < known.size(); ++i) {
    const auto& [kind, motion, load] = known[i];
    EXPECT_EQ(rows[i].cells.at(0), kind);
    EXPECT_EQ(rows[i].cells.at(3), motion);
    EXPECT_NEAR(number(rows[i].cells.at(1)), load, 1e-3 / 4 * load);
  }
  EXPECT_EQ(homotopy("limit-points --height 1 --elements 1").exit_code, 1);
  EXPECT_EQ(solve("--height 1 --load 300").status, "success");
}

// |F| of the default tolerance over a stiffness of 15 lb/in and more.
// oracle: homotopy_williams Williams 0.?? drop under *
// oracle: homotopy_frames toggle 0.?? of 1 drop under *
TEST(Solve, KnownDeflections) {
  struct Case {
    std::string words;
    double deflection;
  };
  const std::vector<Case> cases = {
      {"--height 0.44 --load 43.79 --elements 1", 0.621922545486},
      {"--height 0.44 --load 44 --elements 1", 0.623070489},
      {"--height 0.32 --load 27.11 --elements 1", 0.265167973289},
      {"--height 0.44 --load 43.79 --elements 1 --solver newton", 0.621922545486},
      {"--height 0.32 --load 27.11 --elements 1 --solver newton", 0.265167973289},
      {"--height 0.44 --load 43.79 --model williams", 0.635331561089},
      {"--height 0.44 --load 44 --model williams", 0.636310193301},
      {"--height 0.32 --load 27.11 --model williams", 0.266690787315},
      {"--height 0.32 --load 27.11 --model williams --solver newton", 0.266690787315}};
  for (const Case& c : cases) {
    const Solved s = solve(c.words);
    EXPECT_EQ(s.finished.exit_code, 0) << c.words << ": " << s.finished.errors;
    EXPECT_EQ(s.status, "success") << c.words;
    EXPECT_NEAR(s.deflection, c.deflection, 2e-9) << c.words;
    EXPECT_GE(s.iterations, 1) << c.words;
  }
}

// With two elements a member as with one: the S is its own mirror image.
TEST(Solve, ElementsAMember) {
  const Solved one = solve("--height 0.44 --load 43.79 --elements 1"),
               two = solve("--height 0.44 --load 43.79 --elements 2");
  EXPECT_EQ(two.status, "success");
  EXPECT_NEAR(one.deflection, two.deflection, 1e-8);
}

// Stability is that of the whole toggle, and a shape beyond a bifurcation is not shown in silence.
TEST(Solve, SaysWhatLiesBetweenRestAndTheShape) {
  const Solved below = solve("--height 2 --elements 8 --load 300");
  EXPECT_EQ(below.stability, "stable");
  EXPECT_EQ(below.critical_load, "");
  EXPECT_EQ(below.finished.errors, "");
  const Solved between = solve("--height 2 --elements 8 --load 500");  // the half toggle has lost nothing yet
  EXPECT_EQ(between.stability, "unstable");
  EXPECT_NEAR(number(between.critical_load), 340.22, 0.01);
  const Solved snapped = solve("--height 2 --elements 8 --load 660");
  EXPECT_EQ(snapped.stability, "stable");
  EXPECT_GT(snapped.deflection, 3);
  EXPECT_NE(snapped.finished.errors.find("bifurcation"), std::string::npos) << snapped.finished.errors;
  EXPECT_EQ(solve("--height 2 --elements 8 --load 660 --solver riks").stability, "unstable");
  EXPECT_EQ(solve("--height 0.44 --load 36").critical_load, "");
  EXPECT_NEAR(number(solve("--height 0.44 --load 43.79 --elements 1").critical_load), 42.435492120383, 1e-9);
}

// With 1000 elements rounding of the displacements makes more of the residual than 1e-10.
TEST(Solve, NoResidualAboveTheToleranceIsASuccess) {
  for (const char* solver : {"energy-trust-region", "riks"}) {
    const std::string words = std::string("--height 0.44 --load 43.79 --elements 1000 --solver ") + solver;
    const Solved strict = solve(words + " --tolerance 1e-10");
    EXPECT_EQ(strict.finished.exit_code, 1);
    EXPECT_EQ(strict.finished.output, "");
    EXPECT_NE(strict.finished.errors.find("rounding"), std::string::npos) << strict.finished.errors;
    const Solved loose = solve(words);
    EXPECT_EQ(loose.status, "success") << loose.finished.errors;
    EXPECT_GT(loose.bound, 1e-10);
  }
}

// A solver that lets |F| fall is stuck at its minimum by the fold: it says so, and the command ends with 1.
TEST(Solve, FailureIsSaid) {
  const Solved s = solve("--height 0.44 --load 43.79 --solver damped-newton");
  EXPECT_EQ(s.finished.exit_code, 1);
  EXPECT_FALSE(s.finished.errors.empty());
  EXPECT_TRUE(s.finished.output.empty()) << s.finished.output;
}

TEST(OwnWork, WrongWordsAreRefused) {
  for (const std::string words :
       {"limit-points", "limit-points --height x", "limit-points --height -1", "limit-points --height 13",
        "limit-points --height 0.44 --model wooden", "limit-points --height 0.44 --elements 0", "solve",
        "solve --height 0.44", "solve --height 0.44 --load nan",
        "solve --height 0.44 --load 43 --solver magic", "solve --height 0.44 --load 43 --elements 1.5"}) {
    const Finished f = homotopy(words);
    EXPECT_EQ(f.exit_code, 2) << words;
    EXPECT_TRUE(f.output.empty()) << words;
    EXPECT_FALSE(f.errors.empty()) << words;
  }
}

TEST(Example, Runs) {
  const Finished f = run("homotopy_example", "");
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  EXPECT_NE(f.output.find("0.6219225"), std::string::npos) << f.output;
}

}  // namespace
}  // namespace nlmech::own_work_test

/// `algebraic_series integrate`, `compare` and `poincare` as a user types them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/process.hpp"
#include "tests/places.hpp"

namespace nlmech::own_work_test {
namespace {

using scene::Finished;

/// Runs the program with words separated by blanks.
Finished algebraic_series(const std::string& words) {
  std::vector<std::string> arguments = {NLMECH_BINARY_DIR "/bin/algebraic_series"};
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(' ', begin), words.size());
    arguments.push_back(words.substr(begin, end - begin));
    begin = end + 1;
  }
  return scene::run_program(arguments, {});
}

// Every problem, its own names, its last row at the asked time, and its value. The default tolerance is 1e-9;
// the bounds leave what each motion amplifies. oracle: algebraic_series_motions Lorenz u(20), Duffing u(50),
// oscillator x, projectile x, projectile lands at, bodies y of 4
TEST(Integrate, EveryProblemToItsReference) {
  struct Known {
    std::string words, header;
    std::size_t column;
    double end, value, bound;
  };
  const std::vector<Known> all = {
      {"lorenz --until 20 --tolerance 1e-14", "t,u,v,w", 1, 20, -1.356348984580380, 1e-5},
      {"forced-duffing --until 50", "t,u,v", 1, 50, 1.221946638567542, 1e-6},
      {"oscillator --until 378.14159265358979", "t,x,v", 1, 378.14159265358979, -0.302938936512582, 1e-6},
      {"projectile --until 9.84601516944855", "t,x,y,z,vx,vy,vz", 1, 9.84601516944855, 38476.6981780052,
       1e-4},
      {"bodies --until 3000 --tolerance 1e-13",
       "t,x1,y1,z1,x2,y2,z2,x3,y3,z3,x4,y4,z4,vx1,vy1,vz1,vx2,vy2,vz2,vx3,vy3,vz3,vx4,vy4,vz4", 11, 3000,
       3.071464269641001, 1e-6}};
  for (const Known& k : all) {
    const Finished f = algebraic_series("integrate --problem " + k.words);
    ASSERT_EQ(f.exit_code, 0) << f.errors;
    ASSERT_TRUE(f.output.starts_with(k.header + "\n")) << f.output;
    const auto records = scene::parse_csv(f.output, "output");
    ASSERT_EQ(records.size(), 3U);
    EXPECT_EQ(std::stod(records[2].cells.at(0)), k.end);
    EXPECT_NEAR(std::stod(records[2].cells.at(k.column)), k.value, k.bound) << k.words;
  }
}

// As published: T = 0.1 and N = 20 give another end than the solution.
// oracle: algebraic_series_motions Lorenz T = 0.1: u(20)
TEST(Integrate, PublishedStepAndOrder) {
  const Finished f = algebraic_series("integrate --problem lorenz --until 20 --step 0.1 --order 20");
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  EXPECT_NEAR(std::stod(scene::parse_csv(f.output, "output").at(2).cells.at(1)), -4.78, 0.005);
  const Finished same = algebraic_series("integrate --problem lorenz --until 20 --step 0.1");
  EXPECT_EQ(same.output, f.output);  // 20 is the order without one
}

TEST(Integrate, RowsAtEqualDistancesAndParameters) {
  const Finished f = algebraic_series(
      "integrate --problem forced-duffing --set damping=0 --set force=0 --initial 1,0 --until 1 --every "
      "0.25");
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  const auto rows = scene::parse_numbers(f.output, "output", {"t", "u", "v"});
  EXPECT_EQ(rows.column[0], (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
  // Energy v^2/2 + u^4/4 is kept.
  for (std::size_t i = 0; i < rows.rows(); ++i) {
    const double u = rows.column[1][i], v = rows.column[2][i];
    EXPECT_NEAR(v * v / 2 + u * u * u * u / 4, 0.25, 1e-8);
  }
}

TEST(Poincare, FirstSectionIsTheInitialState) {
  const Finished f = algebraic_series("poincare --sections 32");
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  const auto rows = scene::parse_numbers(f.output, "output", {"section", "x", "v"});
  ASSERT_EQ(rows.rows(), 32U);
  EXPECT_EQ(rows.column[1][0], -0.5);
  EXPECT_EQ(rows.column[2][0], 0);
  EXPECT_EQ(rows.column[0][31], 31);
  // After 31 sections the orbit is back on its island, 2.7e-4 by 4.7e-4 large
  // (chapters/algebraic_series/poincare.cpp).
  EXPECT_NEAR(rows.column[1][31], -0.5, 3e-4);
  EXPECT_NEAR(rows.column[2][31], 0, 3e-4);
  const Finished one = algebraic_series("poincare --sections 1 --initial 0.25,0.5");
  EXPECT_EQ(one.output, "section,x,v\n0,0.25,0.5\n");
}

TEST(Compare, SeriesBesideAPeer) {
  const Finished f =
      algebraic_series("compare --problem lorenz --until 5 --methods series,ode45 --tolerance 1e-10");
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  const auto records = scene::parse_csv(f.output, "output");
  ASSERT_EQ(records.size(), 3U);
  EXPECT_EQ(records[1].cells.at(0), "series");
  EXPECT_GT(std::stod(records[1].cells.at(3)), 7);  // e^(0.9 t) = 90 takes two of ten digits
}

struct Bad {
  std::string words;
  std::vector<std::string> says;
};

TEST(OwnWork, BadInputIsNamed) {
  const std::vector<Bad> cases = {
      {"integrate --problem forced-duffing --until 1 --order 101", {"--order", "101"}},
      {"integrate --problem forced-duffing --until 1 --order 1", {"--order", "1"}},
      {"integrate --problem forced-duffing --until 1 --order 2.5", {"--order", "2.5"}},
      {"integrate --problem forced-duffing --until 1 --step -1", {"--step", "-1"}},
      {"integrate --problem forced-duffing --until 1 --step 0.1 --tolerance 1e-9", {"--step", "--tolerance"}},
      {"integrate --problem duffin --until 1", {"--problem", "duffin", "forced-duffing"}},
      {"integrate --problem lorenz --until 1 --initial 1,2", {"--initial", "1,2", "u,v,w"}},
      {"integrate --problem lorenz --until 1 --set q=1", {"--set", "q=1"}},
      {"compare --problem lorenz --until 1 --methods ode45 --order 20", {"--order 20", "ode45"}},
      {"poincare --sections 0", {"--sections", "0"}},
      {"poincare --sections 1.5", {"--sections", "1.5"}},
      {"poincare --sections 3 --initial 1", {"--initial", "x,v"}},
      {"poincare", {"--sections"}}};
  for (const Bad& bad : cases) {
    const Finished f = algebraic_series(bad.words);
    EXPECT_EQ(f.exit_code, 2) << bad.words << ": " << f.errors;
    EXPECT_EQ(f.output, "") << bad.words;
    for (const std::string& word : bad.says)
      EXPECT_NE(f.errors.find(word), std::string::npos) << "no '" << word << "' in: " << f.errors;
  }
}

// A fixed step across a pole ends in a failure, or in nonsense that is finite; here in a failure.
TEST(Integrate, FailureSaysWhereAndWhatToChange) {
  const Finished f = algebraic_series("integrate --problem forced-duffing --until 100 --step 0.7 --order 80");
  EXPECT_EQ(f.exit_code, 1) << f.errors;
  EXPECT_EQ(f.output, "");
  for (const std::string word : {"series", "t = "})
    EXPECT_NE(f.errors.find(word), std::string::npos) << f.errors;
}

TEST(Example, OfThePageRuns) {
  const Finished f = scene::run_program({NLMECH_BINARY_DIR "/bin/algebraic_series_example"}, {});
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  ASSERT_TRUE(f.output.starts_with("success: x = ")) << f.output;
  const double x = std::stod(f.output.substr(13)),
               v = std::stod(f.output.substr(f.output.find(", v = ") + 6));
  // Energy v^2/2 - ln(1 - x^2)/2 is that of (0.9, 0).
  EXPECT_NEAR(v * v - std::log1p(-x * x), -std::log1p(-0.81), 1e-10);
}

}  // namespace
}  // namespace nlmech::own_work_test

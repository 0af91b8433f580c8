/// `algebraic_series poincare` as a user types it.
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

struct Bad {
  std::string words;
  std::vector<std::string> says;
};

TEST(OwnWork, BadInputIsNamed) {
  const std::vector<Bad> cases = {{"poincare --sections 0", {"--sections", "0"}},
                                  {"poincare --sections 1.5", {"--sections", "1.5"}},
                                  {"poincare --sections 3 --initial 1", {"--initial", "x,x'"}},
                                  {"poincare", {"--sections"}}};
  for (const Bad& bad : cases) {
    const Finished f = algebraic_series(bad.words);
    EXPECT_EQ(f.exit_code, 2) << bad.words << ": " << f.errors;
    EXPECT_EQ(f.output, "") << bad.words;
    for (const std::string& word : bad.says)
      EXPECT_NE(f.errors.find(word), std::string::npos) << "no '" << word << "' in: " << f.errors;
  }
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

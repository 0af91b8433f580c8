/// `transversal integrate` and `compare` as a user types them.
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
Finished transversal(const std::string& words) {
  std::vector<std::string> arguments = {NLMECH_BINARY_DIR "/bin/transversal"};
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(' ', begin), words.size());
    arguments.push_back(words.substr(begin, end - begin));
    begin = end + 1;
  }
  return scene::run_program(arguments, {});
}

// Every problem, its names, its last row at the asked time, and a value from elsewhere.
TEST(Integrate, EveryProblemToItsReference) {
  struct Known {
    std::string words, header;
    double end, value, bound;
  };
  const std::vector<Known> all = {
      // oracle: transversal_motions driven Duffing *, van der Pol *
      {"driven-duffing --until 50 --step 0.005 --points 5", "t,x1,v1", 50, 1.203734404401093, 1e-9},
      {"van-der-pol --until 40 --step 0.002", "t,x1,v1", 40, 1.872808279858090, 1e-6},
      // x = cos t, whatever the step.
      {"linear --until 30 --step 3 --points 2", "t,x1,v1", 30, std::cos(30.), 1e-13},
      // Moving as one: x = cos(sqrt(1.5) t) for k = 1.5 without the cubic terms.
      {"two-dof --set damping=0 --set hardening=0 --set force=0 --set stiffness=1.5 --initial 1,1,0,0 "
       "--until 4 "
       "--step 0.5 --points 8",
       "t,x1,x2,v1,v2", 4, std::cos(std::sqrt(1.5) * 4), 1e-13}};
  for (const Known& k : all) {
    const Finished f = transversal("integrate --problem " + k.words);
    ASSERT_EQ(f.exit_code, 0) << f.errors;
    ASSERT_TRUE(f.output.starts_with(k.header + "\n")) << f.output;
    const auto records = scene::parse_csv(f.output, "output");
    ASSERT_EQ(records.size(), 3U);
    EXPECT_EQ(std::stod(records[2].cells.at(0)), k.end);
    EXPECT_NEAR(std::stod(records[2].cells.at(1)), k.value, k.bound) << k.words;
  }
}

TEST(Integrate, RowsAtEqualDistancesWithinBlocks) {
  const Finished f = transversal("integrate --problem linear --until 1 --step 0.4 --points 2 --every 0.25");
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  const auto rows = scene::parse_numbers(f.output, "output", {"t", "x1", "v1"});
  EXPECT_EQ(rows.column[0], (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
  for (std::size_t i = 0; i < rows.rows(); ++i)
    EXPECT_NEAR(rows.column[1][i], std::cos(rows.column[0][i]), 1e-14);
}

TEST(Compare, BesideAPeer) {
  const Finished f = transversal("compare --problem driven-duffing --until 5 --methods mtl,rk6 --step 0.01");
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  const auto records = scene::parse_csv(f.output, "output");
  ASSERT_EQ(records.size(), 3U);
  EXPECT_EQ(records[1].cells.at(0), "mtl");
  EXPECT_GT(std::stod(records[1].cells.at(3)), 6);
}

struct Bad {
  std::string words;
  std::vector<std::string> says;
};

TEST(OwnWork, BadInputIsNamed) {
  const std::vector<Bad> cases = {
      {"integrate --problem driven-duffing --until 1 --step 0.1 --points 9", {"--points", "9"}},
      {"integrate --problem driven-duffing --until 1 --step 0.1 --points 0", {"--points", "0"}},
      {"integrate --problem driven-duffing --until 1 --step 0.1 --points 2.5", {"--points", "2.5"}},
      {"integrate --problem driven-duffing --until 1 --step -0.1", {"--step", "-0.1"}},
      {"integrate --problem driven-duffing --until 1 --step 0", {"--step", "0"}},
      {"integrate --problem driven-duffing --until 1 --tolerance 1e-8", {"mtl", "give a step"}},
      {"integrate --problem driven-duffing --until x --step 0.1", {"--until", "x"}},
      {"integrate --problem pendulum --until 1 --step 0.1", {"--problem", "pendulum", "two-dof"}},
      {"integrate --problem two-dof --until 1 --step 0.1 --initial 1,2", {"--initial", "1,2", "x1,x2,v1,v2"}},
      {"integrate --problem driven-duffing --until 1 --step 0.1 --set q=1", {"--set", "q=1"}},
      {"compare --problem driven-duffing --until 1 --methods rk4 --step 0.1 --points 3",
       {"--points 3", "rk4"}}};
  for (const Bad& bad : cases) {
    const Finished f = transversal(bad.words);
    EXPECT_EQ(f.exit_code, 2) << bad.words << ": " << f.errors;
    EXPECT_EQ(f.output, "") << bad.words;
    for (const std::string& word : bad.says)
      EXPECT_NE(f.errors.find(word), std::string::npos) << "no '" << word << "' in: " << f.errors;
  }
}

// What van der Pol's equation shows as linear grows like exp(mu t): over a block of 3 it overflows.
TEST(Integrate, FailureSaysWhereAndWhatToChange) {
  const Finished f = transversal("integrate --problem van-der-pol --set mu=1000 --until 10 --step 1");
  EXPECT_EQ(f.exit_code, 1) << f.errors;
  EXPECT_EQ(f.output, "");
  for (const std::string word : {"mtl", "t = ", "smaller step"})
    EXPECT_NE(f.errors.find(word), std::string::npos) << f.errors;
}

TEST(Example, OfThePageRuns) {
  const Finished f = scene::run_program({NLMECH_BINARY_DIR "/bin/transversal_example"}, {});
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  EXPECT_TRUE(f.output.starts_with("success: x = ")) << f.output;
}

}  // namespace
}  // namespace nlmech::own_work_test

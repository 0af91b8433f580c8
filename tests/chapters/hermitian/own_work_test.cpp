/// `hermitian integrate`, `compare` and `peak` as a user types them.
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
Finished hermitian(const std::string& words) {
  std::vector<std::string> arguments = {NLMECH_BINARY_DIR "/bin/hermitian"};
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(' ', begin), words.size());
    arguments.push_back(words.substr(begin, end - begin));
    begin = end + 1;
  }
  return scene::run_program(arguments, {});
}

struct Known {
  std::string words;
  double t, peak, bound;
};

// At h = 0.001 order 4 leaves rounding. oracle: hermitian_peaks Duffing Laier h = 0.2, Duffing Argyris h =
// 0.05, Duffing Newmark h = 0.1, van der Pol Newmark h = 0.2
TEST(Peak, IsThatOfTheLimitAndOfTheTables) {
  // oracle: transversal_motions Laier's *
  const std::vector<Known> all = {
      {"laier-duffing --method laier --step 0.001", 2.4505135743840013, 0.53826530480163, 2e-14},
      {"laier-duffing --method argyris --step 0.001", 2.4505135743840013, 0.53826530480163, 2e-14},
      {"laier-van-der-pol --method laier --step 0.001", 4.60362115304892, -0.31932967523380, 2e-14},
      {"laier-van-der-pol --method argyris --step 0.001", 4.60362115304892, -0.31932967523380, 2e-14},
      {"laier-duffing --method laier --step 0.2", 2.4505, 0.538264556, 1e-9},
      {"laier-duffing --method argyris --step 0.05", 2.4505, 0.538265305, 1e-9},
      {"laier-duffing --method newmark --step 0.1", 2.4525, 0.538046, 5e-7},
      {"laier-duffing --method hoff --step 0.1", 2.4525, 0.538046, 5e-7},
      {"laier-duffing --method bazzi --step 0.1", 2.4525, 0.538046, 5e-7},
      {"laier-van-der-pol --method newmark --step 0.2", 4.5895, -0.312725, 5e-7}};
  for (const Known& k : all) {
    const Finished f = hermitian("peak --problem " + k.words);
    ASSERT_EQ(f.exit_code, 0) << f.errors;
    const auto rows = scene::parse_numbers(f.output, "output", {"t", "peak"});
    ASSERT_EQ(rows.rows(), 1U);
    // At a maximum the time has half of the digits, but for the velocity's own.
    EXPECT_NEAR(rows.column[0][0], k.t, k.bound < 1e-12 ? 1e-9 : 1e-4) << k.words;
    EXPECT_NEAR(rows.column[1][0], k.peak, k.bound) << k.words;
  }
}

// The linear oscillator from (1, 0) is cos t: phase error z^4/720 a radian for Laier, z^2/12 for Newmark.
TEST(Integrate, LinearOscillatorAtTheAskedRows) {
  const Finished f = hermitian("integrate --problem linear --until 2 --step 0.1 --every 0.5");
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  const auto rows = scene::parse_numbers(f.output, "output", {"t", "x1", "v1"});
  EXPECT_EQ(rows.column[0], (std::vector<double>{0, 0.5, 1, 1.5, 2}));
  for (std::size_t i = 0; i < rows.rows(); ++i) {
    EXPECT_NEAR(rows.column[1][i], std::cos(rows.column[0][i]), 2 * 1e-4 / 720);
    EXPECT_NEAR(rows.column[2][i], -std::sin(rows.column[0][i]), 2 * 1e-4 / 720);
  }
  const Finished n = hermitian("integrate --problem linear --until 2 --step 0.1 --method newmark");
  const auto ends = scene::parse_numbers(n.output, "output", {"t", "x1", "v1"});
  EXPECT_NEAR(ends.column[1][1] - std::cos(2.0), std::sin(2.0) * 2 * 0.01 / 12, 1e-5);
}

// Every problem and every row of the table, to the same end: order 4 closely, order 2 roughly.
TEST(Integrate, EveryProblemByEveryOperator) {
  struct Asked {
    std::string words;
    std::vector<std::string> header;
  };
  const std::vector<Asked> all = {
      {"laier-duffing --until 10", {"t", "x1", "v1"}},
      {"laier-duffing --set damping=0 --set force=0 --initial 1,0 --until 5", {"t", "x1", "v1"}},
      {"laier-van-der-pol --until 5", {"t", "x1", "v1"}},
      {"laier-van-der-pol --set mu=3 --initial 2,0 --until 2", {"t", "x1", "v1"}},
      {"two-dof --until 10", {"t", "x1", "x2", "v1", "v2"}}};
  for (const Asked& a : all) {
    const Finished best = hermitian("integrate --problem " + a.words + " --tolerance 1e-10");
    ASSERT_EQ(best.exit_code, 0) << best.errors;
    const auto truth = scene::parse_numbers(best.output, "output", a.header);
    for (const std::string row : {"laier", "argyris", "newmark", "hoff", "bazzi"}) {
      const Finished f = hermitian("integrate --problem " + a.words + " --step 0.01 --method " + row);
      ASSERT_EQ(f.exit_code, 0) << f.errors;
      const auto rows = scene::parse_numbers(f.output, "output", a.header);
      ASSERT_EQ(rows.rows(), 2U);
      EXPECT_EQ(rows.column[0][1], truth.column[0][1]);
      for (std::size_t c = 1; c < a.header.size(); ++c)
        EXPECT_NEAR(rows.column[c][1], truth.column[c][1], row == "laier" || row == "argyris" ? 1e-7 : 2e-3)
            << a.words << row;
    }
  }
}

TEST(Compare, BesideAPeer) {
  const Finished f = hermitian(
      "compare --problem laier-duffing --until 10 --methods laier,ode45,newmark --step 0.01 --tolerance "
      "1e-8");
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  const auto records = scene::parse_csv(f.output, "output");
  ASSERT_EQ(records.size(), 4U);
  EXPECT_EQ(records[1].cells.at(0), "laier");
  EXPECT_GT(std::stod(records[1].cells.at(3)), 5);  // 1e-8 in each of some hundred steps
}

TEST(OwnWork, BadInputIsNamed) {
  struct Bad {
    std::string words;
    std::vector<std::string> says;
  };
  const std::vector<Bad> cases = {
      {"peak --problem laier-duffing --method laier --step 0", {"--step", "0"}},
      {"peak --problem laier-duffing --method laier --step x", {"--step", "x"}},
      {"peak --problem laier-duffing --method laire --step 0.1", {"--method", "laire", "argyris"}},
      {"peak --problem lorenz --method laier --step 0.1", {"--problem", "lorenz", "van-der-pol"}},
      {"peak --problem laier-duffing --step 0.1", {"--method"}},
      {"integrate --problem laier-duffing --until 1 --step 0.1 --method rk5", {"--method", "rk5", "laier"}},
      {"integrate --problem laier-duffing --until 1 --step -0.1", {"--step", "-0.1"}},
      {"integrate --problem laier-duffing --until 1 --step 0.1 --tolerance 1e-6", {"--step", "--tolerance"}},
      {"integrate --problem laier-duffing --until 1 --step 0.1 --set mass=2", {"--set", "mass=2", "damping"}},
      {"integrate --problem two-dof --until 1 --step 0.1 --initial 1,2", {"--initial", "1,2"}},
      {"integrate --problem dufing --until 1", {"--problem", "dufing", "two-dof"}},
      {"integrate --problem laier-duffing --until x", {"--until", "x"}}};
  for (const Bad& bad : cases) {
    const Finished f = hermitian(bad.words);
    EXPECT_EQ(f.exit_code, 2) << bad.words << ": " << f.errors;
    EXPECT_EQ(f.output, "") << bad.words;
    for (const std::string& word : bad.says)
      EXPECT_NE(f.errors.find(word), std::string::npos) << "no '" << word << "' in: " << f.errors;
  }
}

// A step that the leap of a stiff oscillator does not allow ends with the reason, where, and what to change.
TEST(Integrate, WrongBranchIsSaid) {
  const Finished f = hermitian(
      "integrate --problem laier-van-der-pol --set mu=1000 --initial 2,0 --until 2000 --step 0.125");
  EXPECT_EQ(f.exit_code, 1) << f.errors;
  EXPECT_EQ(f.output, "");
  for (const std::string word : {"wrong_branch", "laier", "t = 807", "smaller step"})
    EXPECT_NE(f.errors.find(word), std::string::npos) << f.errors;
}

TEST(Example, OfThePageRuns) {
  const Finished f = scene::run_program({NLMECH_BINARY_DIR "/bin/hermitian_example"}, {});
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  EXPECT_TRUE(f.output.starts_with("success: q = ")) << f.output;
}

}  // namespace
}  // namespace nlmech::own_work_test

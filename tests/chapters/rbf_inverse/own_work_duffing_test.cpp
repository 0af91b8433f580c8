/// `rbf_inverse duffing` as a user types it.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/control/duffing_runs.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/process.hpp"
#include "tests/places.hpp"

namespace nlmech::own_work_duffing_test {
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

/// cost, x1_0, x2_0, lambda1_0, lambda2_0, x1_T, x2_T, miss; empty if it failed.
std::vector<double> duffing(const std::string& words) {
  const Finished f = run("rbf_inverse", "duffing " + words);
  EXPECT_EQ(f.exit_code, 0) << words << ": " << f.errors;
  EXPECT_TRUE(f.output.starts_with("cost,x1_0,x2_0,lambda1_0,lambda2_0,x1_T,x2_T,miss\n")) << f.output;
  const auto rows = scene::parse_csv(f.output, "output");
  if (rows.size() != 2 || rows[1].cells.size() != 8) return {};
  std::vector<double> values(8);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_TRUE(scene::parse_number(rows[1].cells[i], values[i]));
  return values;
}

// All cases at all three times from the program's own starts: a cost no higher than the best known, initial
// values to ten digits, the integrated end to 1e-9. Independent Taylor method in 40 digits.
class Known : public testing::TestWithParam<double> {};
TEST_P(Known, ExtremalsAreFound) {
  for (const chapters::rbf_inverse::KnownExtremal& k : chapters::rbf_inverse::known_extremals()) {
    // The seventh is not solved in the text.
    if (k.final_time != GetParam() || k.which == bvp::DuffingCase::x2x2) continue;
    const std::string words = fmt::format("--case {} --final-time {:g} --beta {:g}", to_string(k.which),
                                          k.final_time, bvp::printed_beta(k.which));
    const std::vector<double> v = duffing(words);
    ASSERT_EQ(v.size(), 8U) << words;
    EXPECT_LE(v[0], k.cost * (1 + 1e-9)) << words;
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(v[1 + i], k.first[i], 1e-10 * std::max(1.0, std::abs(k.first[i]))) << words << ", " << i;
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_NEAR(v[5 + i], k.last[i], 1e-9 * std::max(1.0, std::abs(k.last[i]))) << words << ", " << i;
    EXPECT_LE(v[7], 1e-9) << words;
  }
}

INSTANTIATE_TEST_SUITE_P(Duffing, Known, testing::ValuesIn(chapters::rbf_inverse::final_times));

// No target in the cost, no force; and a linear oscillator has its answer in closed form: with beta = 0 and
// x(0) = 0 fixed, J = c^T W^-1 c/2, W the controllability Gramian of cos and sin.
TEST(Duffing, ClosedForms) {
  const std::vector<double> idle = duffing("--case free --final-time 2 --weights 0,0");
  ASSERT_EQ(idle.size(), 8U);
  EXPECT_LE(idle[0], 1e-18);
  const std::vector<double> v = duffing("--case fixed --final-time 2 --beta 0");
  ASSERT_EQ(v.size(), 8U);
  const double T = 2, a = T / 2 - std::sin(2 * T) / 4, b = std::sin(T) * std::sin(T) / 2,
               c = T / 2 + std::sin(2 * T) / 4, determinant = a * c - b * b;
  const double cost = (c * 25 - 2 * b * 10 + a * 4) / determinant / 2;
  EXPECT_NEAR(v[0], cost, 1e-9 * cost);
}

// |f| <= 15 costs more than no bound; recorded: 122.3004593 with its own smoothing.
TEST(Duffing, BoundCosts) {
  const std::vector<double> v = duffing("--case fixed --final-time 2 --bound 15");
  ASSERT_EQ(v.size(), 8U);
  EXPECT_NEAR(v[0], 122.3004593, 1e-4);
  EXPECT_GT(v[0], 122.0837680864659);
  EXPECT_LE(v[7], 1e-6);
}

// The linear oscillator in another unit: forces and co-states 1e-4 times as large, the cost 1e-8 times. What
// may differ is what the smoothing of the bound makes, 1e-5 of it; 1e-4 would be a third of the small bound.
TEST(Duffing, BoundsAreAsSharpInAnyUnit) {
  const std::string words = "--case fixed --final-time 2 --beta 0 --target ";
  const std::vector<double> large = duffing(words + "3,0 --bound 3"),
                            small = duffing(words + "3e-4,0 --bound 3e-4");
  ASSERT_EQ(large.size(), 8U);
  ASSERT_EQ(small.size(), 8U);
  EXPECT_NEAR(small[0] * 1e8, large[0], 1e-6 * large[0]);
  EXPECT_NEAR(small[4] * 1e4, large[4], 1e-4 * std::abs(large[4]));
}

TEST(Duffing, TooTightABoundIsAFailure) {
  const Finished f = run("rbf_inverse", "duffing --case fixed --final-time 1 --bound 3");
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_TRUE(f.output.empty());
  EXPECT_NE(f.errors.find("infeasible"), std::string::npos) << f.errors;
}

TEST(Duffing, WrongWordsAreNamed) {
  const auto expect = [](const std::string& words, const std::string& named) {
    const Finished f = run("rbf_inverse", "duffing " + words);
    EXPECT_EQ(f.exit_code, 2) << words;
    EXPECT_TRUE(f.output.empty()) << words;
    EXPECT_NE(f.errors.find(named), std::string::npos) << words << ": " << f.errors;
  };
  expect("--final-time 2", "--case");
  expect("--case free", "--final-time");
  expect("--case wrong --final-time 2", "--case wrong");
  expect("--case wrong --final-time 2", "final-only");
  expect("--case free --final-time 0", "--final-time 0");
  expect("--case free --final-time -1", "--final-time -1");
  expect("--case free --final-time nan", "--final-time nan");
  expect("--case free --final-time 2 --beta x", "--beta x");
  expect("--case free --final-time 2 --beta -1", "--beta -1");
  expect("--case free --final-time 2 --target 5", "--target 5");
  expect("--case free --final-time 2 --target 5,inf", "--target 5,inf");
  expect("--case harmonic --final-time 2 --target 5,2", "--target 5,2");
  expect("--case free --final-time 2 --weights 1,-1", "--weights 1,-1");
  expect("--case free --final-time 2 --weights 1;1", "--weights 1;1");
  for (const std::string whole : {"fixed", "harmonic", "final-only"})  // no miss to weight
    expect("--case " + whole + " --final-time 2 --weights 1,1", "--weights 1,1");
  expect("--case free --final-time 2 --bound 0", "--bound 0");
  expect("--case free --final-time 2 --bound many", "--bound many");
}

// f = 6 - 12 t moves by 1 in a second: J = 6.
TEST(Example, MovesACart) {
  const Finished f = run("rbf_inverse_example", "");
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  EXPECT_NE(f.output.find("cost 6.000000000, first force 6.000000000"), std::string::npos) << f.output;
}

}  // namespace
}  // namespace nlmech::own_work_duffing_test

/// `hermitian peak` as a user types it.
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
      {"peak --problem laier-duffing --step 0.1", {"--method"}}};
  for (const Bad& bad : cases) {
    const Finished f = hermitian(bad.words);
    EXPECT_EQ(f.exit_code, 2) << bad.words << ": " << f.errors;
    EXPECT_EQ(f.output, "") << bad.words;
    for (const std::string& word : bad.says)
      EXPECT_NE(f.errors.find(word), std::string::npos) << "no '" << word << "' in: " << f.errors;
  }
}

}  // namespace
}  // namespace nlmech::own_work_test

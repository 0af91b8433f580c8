/// Every arc of ten thousand random Lambert problems with up to twenty revolutions, counted and integrated.
#include <gtest/gtest.h>

#include <string>

#include "tests/orbit/lambert_problems.hpp"

namespace nlmech::orbit::all_arcs_test {
namespace {

using namespace oracle;

TEST(LambertArcs, AllOfTenThousandProblems) {
  std::mt19937_64 engine(11);
  long arcs = 0, refused = 0;
  double worst = 0;
  for (int i = 0; i < 10'000; ++i) {
    const LambertProblem p = random_problem(engine, i % 5);
    for (const bool long_way : {false, true}) {
      bool possible = true;
      for (int m = 0; m <= 20; ++m) {
        double axis = 0;
        for (const LambertBranch branch : {LambertBranch::low, LambertBranch::high}) {
          if (m == 0 && branch == LambertBranch::high) continue;
          const LambertSolution s = solve_lambert(p, {long_way, m, branch});
          if (s.status.outcome() == Outcome::infeasible) {
            ASSERT_GT(m, 0);
            refused += p.time >= least_time(p, long_way, m);
            possible = false;
            continue;
          }
          ASSERT_TRUE(possible) << i << ": " << m << " revolutions, but not fewer";
          ASSERT_TRUE(s.status.ok()) << i << " " << s.status.text();
          const double off = miss(p, s);
          worst = std::max(worst, off);
          EXPECT_LE(off, promised) << i << " " << m << " " << long_way;
          if (m > 0) {
            EXPECT_GE(1 / s.reciprocal_axis, axis * (1 - 1e-6));
          }
          axis = 1 / s.reciprocal_axis;
          ++arcs;
        }
      }
    }
  }
  RecordProperty("worst_in_kappa_eps", std::to_string(worst));
  RecordProperty("arcs", std::to_string(arcs));
  EXPECT_GT(arcs, 200'000);  // of 820 000 if there were always time for twenty revolutions
  EXPECT_EQ(refused, 0);     // times, ways and revolutions that exist and were not found
}

}  // namespace
}  // namespace nlmech::orbit::all_arcs_test

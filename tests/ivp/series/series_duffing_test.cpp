/// The Taylor series method on the forced Duffing oscillator of the sources, against computations in more
/// digits.
#include <gtest/gtest.h>

#include "nlmech/ivp/series/series.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/series.hpp"

namespace nlmech::ivp::series_duffing_test {
namespace {

using testing::with_tolerance;

// mpfr, 70 digits. T = 0.5 blows up, as the findings say; T = 0.1 is exact to 2e-12 times a few.
TEST(SeriesOnProblems, ForcedDuffing) {
  const problems::TextProblem duffing("forced-duffing");
  const State x0{3, 4}, truth{1.221946638567542, 5.565479787665349};
  const auto wild = integrate(System(duffing), x0, 0, 50, Series{.order = 20, .step = 0.5});
  EXPECT_FALSE(wild.status.ok() && (wild.x - truth).cwiseAbs().maxCoeff() < 1);
  EXPECT_TRUE(wild.x.allFinite());
  const auto tame = integrate(System(duffing), x0, 0, 50, Series{.order = 20, .step = 0.1});
  EXPECT_LT((tame.x - truth).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_EQ(tame.statistics.steps, 500);
  EXPECT_EQ(tame.statistics.right_hand_sides, 500 * 20);
  EXPECT_LT((integrate(System(duffing), x0, 0, 50, with_tolerance(1e-14)).x - truth).cwiseAbs().maxCoeff(),
            1e-11);
}

}  // namespace
}  // namespace nlmech::ivp::series_duffing_test

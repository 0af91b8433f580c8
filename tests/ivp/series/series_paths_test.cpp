/// The Taylor series method by its two paths: inlined, and by a tape.
#include <gtest/gtest.h>

#include "chapters/plain_equations.hpp"
#include "nlmech/ivp/series/series.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/series.hpp"

namespace nlmech::ivp::series_paths_test {
namespace {

using testing::reference;
using testing::with_tolerance;

// Both sum the same series in another order.
TEST(Series, InlinedAndTapedAgree) {
  const chapters::PlainLorenz lorenz;
  const State x0{0, 1, 0};
  const auto inlined = integrate(Direct(lorenz), x0, 0, 4, with_tolerance(1e-13));
  const auto taped = integrate(System(lorenz), x0, 0, 4, with_tolerance(1e-13));
  EXPECT_TRUE(inlined.status.ok() && taped.status.ok());
  // Errors of 1e-13 |x|, |x| to 50, grow by exp(0.9 4) = 37.
  EXPECT_LT((inlined.x - taped.x).cwiseAbs().maxCoeff(), 2e-10);
  EXPECT_LT((inlined.x - reference(lorenz, x0, 0, 4)).cwiseAbs().maxCoeff(), 2e-10);
  EXPECT_EQ(inlined.statistics.steps, taped.statistics.steps);
}

// Of what a tolerance chooses nothing is left to the tape; with a sanitizer fewer orders are unrolled.
TEST(Series, TightestToleranceHasTheHighestUnrolledOrder) {
  constexpr int with_sanitizer = 10;
  if (unrolled::most_order == with_sanitizer) GTEST_SKIP();
  EXPECT_EQ(unrolled::most_order, series_order(1e-18));
}

TEST(Series, ComesOutTheSameEveryTime) {
  for (int run = 0; run < 2; ++run) {
    const System system(problems::TextProblem("lorenz"));
    const auto one = integrate(system, State{0, 1, 0}, 0, 20, Series{});
    const auto two = integrate(system, State{0, 1, 0}, 0, 20, Series{});
    EXPECT_EQ(one.x, two.x);
  }
}

}  // namespace
}  // namespace nlmech::ivp::series_paths_test

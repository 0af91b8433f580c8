/// The Taylor series method across jumps of the right-hand side, announced or not.
#include <gtest/gtest.h>

#include "nlmech/ivp/series/series.hpp"
#include "tests/ivp/methods.hpp"

namespace nlmech::ivp::series_jumps_test {
namespace {

using testing::eps;

TEST(SeriesEdges, ExactAcrossAnnouncedJumpsInlined) {
  const testing::JumpingForce problem;
  for (const Series& method : {Series{}, Series{.order = 3, .step = 0.07}}) {
    const auto there = integrate(Direct(problem), State{0, 0}, 0, 1, method);
    EXPECT_LT((there.x - problem.exact(1)).cwiseAbs().maxCoeff(), 16 * eps);
    const auto back = integrate(Direct(problem), problem.exact(1), 1, 0, method);
    EXPECT_LT(back.x.cwiseAbs().maxCoeff(), 16 * eps);
  }
}

TEST(SeriesEdges, RefusesAnUnannouncedBranch) {
  const testing::Unannounced<testing::JumpingForce> problem;
  EXPECT_THROW(static_cast<void>(integrate(System(problem), State{0, 0}, 0, 1, Series{})),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(integrate(Direct(problem), State{0, 0}, 0, 1, Series{})),
               std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::ivp::series_jumps_test

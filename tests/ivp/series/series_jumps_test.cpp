/// The Taylor series method across jumps of the right-hand side, announced or not.
#include <gtest/gtest.h>

#include "nlmech/ivp/series/series.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "tests/ivp/methods.hpp"

namespace nlmech::ivp::series_jumps_test {
namespace {

using testing::eps;

TEST(SeriesEdges, ExactAcrossAnnouncedJumps) {
  const testing::JumpingForce problem;
  for (const Series& method : {Series{}, Series{.order = 3, .step = 0.07}}) {
    const auto there = integrate(System(problem), State{0, 0}, 0, 1, method);
    EXPECT_LT((there.x - problem.exact(1)).cwiseAbs().maxCoeff(), 16 * eps);
    const auto inlined = integrate(Direct(problem), State{0, 0}, 0, 1, method);
    EXPECT_LT((inlined.x - problem.exact(1)).cwiseAbs().maxCoeff(), 16 * eps);
    const auto back = integrate(Direct(problem), problem.exact(1), 1, 0, method);
    EXPECT_LT(back.x.cwiseAbs().maxCoeff(), 16 * eps);
    const auto begins = integrate(System(problem), problem.exact(0.3), 0.3, 1, method);
    EXPECT_LT((begins.x - problem.exact(1)).cwiseAbs().maxCoeff(), 16 * eps);
  }
}

TEST(SeriesEdges, ImpactForce) {
  const problems::ImpactDuffing problem;
  const problems::ReferenceTrajectory<long double, problems::ImpactDuffing> truth(
      problem, Vector<long double, 2>(0, 0), 0, 10);
  const Series method{.relative_tolerance = 1e-14, .absolute_tolerance = 1e-14};
  const State end = truth(10).cast<double>();
  EXPECT_LT((integrate(System(problem), State{0, 0}, 0, 10, method).x - end).cwiseAbs().maxCoeff(), 1e-13);
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

// adaptive-collocation where equations jump unannounced or make no sense. See also adaptive_methods_test.cpp.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "nlmech/ivp/collocation/adaptive_collocation.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/oracle.hpp"

namespace nlmech::ivp::adaptive_collocation_edges_test {
namespace {

using testing::nan;

AdaptiveCollocation to(double relative, double absolute) {
  return {.relative_tolerance = relative, .absolute_tolerance = absolute};
}

TEST(AdaptiveCollocationEdges, BackwardsTheStiffBranchRepels) {
  const auto decay =
      integrate(System(problems::TextProblem("van-der-pol", {{"mu", 100}})), {2, 0}, 1, 0.9, to(1e-6, 1e-6));
  EXPECT_TRUE(decay.status.ok() || decay.t < 1);
}

/// x' = w cos(w t) - (x - sin(w t)): x = sin(w t) from 0.
struct Driven {
  static constexpr int dimension = 1;
  double frequency;
  template <class T>
  void operator()(const T& t, const Vector<T, 1>& x, Vector<T, 1>& f) const {
    using std::cos;
    using std::sin;
    f[0] = frequency * cos(frequency * t) - (x[0] - sin(frequency * t));
  }
};

// A step starts from the polynomial of the one before, which twice as far on may be a thousand times as large
// as any state. A tolerance relative to that guess would let errors grow from step to step.
TEST(AdaptiveCollocationEdges, NoToleranceFollowsAGuess) {
  for (const double tolerance : {1e-2, 1e-3, 1e-5, 1e-7}) {
    for (int k = 0; k < 60; ++k) {
      const double frequency = 5 + 0.41 * k, end = 14.2;
      const auto s = integrate(System(Driven{frequency}), State{0.0}, 0, end, to(tolerance, tolerance));
      ASSERT_TRUE(s.status.ok()) << s.status.text();
      // Errors fade in a unit of time, in which there is a step of two tolerances (|x| <= 1) or a few.
      EXPECT_LT(std::abs(s.x[0] - std::sin(frequency * end)), 10 * tolerance)
          << frequency << ' ' << tolerance;
    }
  }
}

// An unannounced jump makes the estimate shorten steps around it, and costs no more than the tolerance.
TEST(AdaptiveCollocationEdges, FindsUnannouncedJumps) {
  const testing::Unannounced<testing::JumpingForce> problem;
  const auto s = integrate(System(problem), State{0, 0}, 0, 1, to(1e-8, 1e-8));
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_GT(s.statistics.rejected, 0);
  EXPECT_LT(oracle::distance(s.x, testing::JumpingForce{}.exact(1)), 1e-7);
}

TEST(AdaptiveCollocationEdges, OptionsOutOfRangeAreNamed) {
  using testing::refusal;
  EXPECT_NE(refusal(AdaptiveCollocation{.nodes = 8}).find("nodes must be 9, 13 or 17"), std::string::npos);
  EXPECT_NE(refusal(AdaptiveCollocation{.relative_tolerance = 0.2}).find("relative_tolerance"),
            std::string::npos);
  EXPECT_NE(refusal(AdaptiveCollocation{.absolute_tolerance = nan}).find("absolute_tolerance"),
            std::string::npos);
  EXPECT_NE(refusal(AdaptiveCollocation{.largest_step = -1}).find("largest_step"), std::string::npos);
  EXPECT_EQ(refusal(AdaptiveCollocation{.relative_tolerance = 0}), "accepted");
}

// There and back on the free oscillator, whatever amplitude, stiffness and interval.
RC_GTEST_PROP(AdaptiveCollocationEdges, ThereAndBack, ()) {
  const double amplitude = *rc::gen::inRange(1, 300) / 100.0, end = *rc::gen::inRange(-2000, 2000) / 100.0;
  const problems::TextProblem problem("duffing", {{"hardening", *rc::gen::inRange(0, 500) / 100.0}});
  const auto method = to(1e-11, 1e-11);
  const State x0{amplitude, 0};
  const auto there = integrate(System(problem), x0, 0, end, method);
  const auto back = integrate(System(problem), there.x, end, 0, method);
  RC_ASSERT(there.status.ok() && back.status.ok());
  // Every step errs by a tolerance of the size (velocities up to 3 sqrt(1 + 5 * 9) = 20), times the growth of
  // a frequency's error: d omega/d x0 of at most sqrt(5) over the whole time.
  const double steps = static_cast<double>(there.statistics.steps + back.statistics.steps);
  RC_ASSERT(oracle::distance(back.x, x0) <= steps * 21e-11 * (1 + 2.3 * std::abs(end)) * 20);
}

}  // namespace
}  // namespace nlmech::ivp::adaptive_collocation_edges_test

// adaptive-collocation where equations jump, end or make no sense.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "nlmech/ivp/collocation/adaptive_collocation.hpp"
#include "nlmech/problems/blow_up.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/van_der_pol.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/oracle.hpp"

namespace nlmech::ivp::adaptive_collocation_edges_test {
namespace {

using testing::eps;
using testing::infinity;
using testing::Manufactured;
using testing::nan;

AdaptiveCollocation to(double relative, double absolute) {
  return {.relative_tolerance = relative, .absolute_tolerance = absolute};
}

TEST(AdaptiveCollocationEdges, GoesBackwards) {
  const Manufactured problem;
  const auto there = integrate(System(problem), problem.exact(3), 3, -4, to(1e-12, 1e-12));
  EXPECT_TRUE(there.status.ok());
  EXPECT_EQ(there.t, -4);
  EXPECT_LT(oracle::distance(there.x, problem.exact(-4)), 1e-8);  // damping backwards enlarges by e^2
  const auto decay = integrate(System(problems::VanDerPol{.mu = 100}), {2, 0}, 1, 0.9, to(1e-6, 1e-6));
  EXPECT_TRUE(decay.status.ok() || decay.t < 1) << "backwards its branch repels";
}

TEST(AdaptiveCollocationEdges, IntervalsWithoutLengthAndTheShortestOne) {
  const System system(testing::Oscillator{});
  EXPECT_EQ(integrate(system, State{1, 2}, 5, 5, AdaptiveCollocation{}).x, (State{1, 2}));
  const double end = std::nextafter(1.0, 2.0);
  const auto s = integrate(system, State{1, 0}, 1, end, AdaptiveCollocation{});
  EXPECT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_EQ(s.t, end);
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

TEST(AdaptiveCollocationEdges, ObserverSeesEveryStep) {
  const Manufactured problem;
  double t = 0;
  std::int64_t count = 0;
  const auto look = [&](const Step& step) {
    EXPECT_EQ(step.index, ++count);
    EXPECT_EQ(step.t0, t);
    t = step.t1;
    State x(2);
    step.dense.at(step.t0, x);
    EXPECT_EQ(x, step.x0);
    step.dense.at(step.t1, x);
    EXPECT_LT(oracle::distance(x, step.x1), 8 * eps);
    EXPECT_EQ(step.times.back(), step.t1);
    EXPECT_EQ(State(step.states.col(0)), step.x1);
    return step.index < 5;
  };
  const auto s = integrate(System(problem), problem.exact(0), 0, 10, AdaptiveCollocation{}, look);
  EXPECT_EQ(s.status.outcome(), Outcome::interrupted);
  EXPECT_EQ(s.t, t);
  EXPECT_EQ(count, 5);
}

TEST(AdaptiveCollocationEdges, ExactAcrossAnnouncedJumps) {
  const testing::JumpingForce problem;
  const AdaptiveCollocation method;
  for (const auto& s : {integrate(System(problem), State{0, 0}, 0, 1, method),
                        integrate(System(problem), State{0, 0}, 0, 1, method),
                        integrate(System(problem), problem.exact(0.3), 0.3, 1, method)})
    EXPECT_LT(oracle::distance(s.x, problem.exact(1)), 16 * eps);
  EXPECT_LT(integrate(System(problem), problem.exact(1), 1, 0, method).x.cwiseAbs().maxCoeff(), 16 * eps);
}

// An unannounced jump makes the estimate shorten steps around it, and costs no more than the tolerance.
TEST(AdaptiveCollocationEdges, FindsUnannouncedJumps) {
  const testing::Unannounced<testing::JumpingForce> problem;
  const auto s = integrate(System(problem), State{0, 0}, 0, 1, to(1e-8, 1e-8));
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_GT(s.statistics.rejected, 0);
  EXPECT_LT(oracle::distance(s.x, testing::JumpingForce{}.exact(1)), 1e-7);
}

TEST(AdaptiveCollocationEdges, ImpactForce) {
  const problems::ImpactDuffing problem;
  const problems::ReferenceTrajectory<long double, problems::ImpactDuffing> truth(
      problem, Vector<long double, 2>(0, 0), 0, 10);
  const State end = truth(10).cast<double>();
  const auto s = integrate(System(problem), State{0, 0}, 0, 10, to(1e-13, 1e-13));
  EXPECT_LT(oracle::distance(s.x, end), static_cast<double>(s.statistics.steps) * 1e-13 * 11);
}

TEST(AdaptiveCollocationEdges, Limits) {
  const System system(Manufactured{});
  const auto few = integrate(system, State{1, 0}, 0, 100, AdaptiveCollocation{}, {}, {.steps = 3});
  EXPECT_EQ(few.status.outcome(), Outcome::step_limit);
  EXPECT_LE(few.statistics.steps + few.statistics.rejected, 3);
  EXPECT_EQ(
      integrate(system, State{1, 0}, 0, 1e5, AdaptiveCollocation{}, {}, {.seconds = 1e-6}).status.outcome(),
      Outcome::time_limit);
  const auto bound = integrate(system, State{1, 0}, 0, 1, AdaptiveCollocation{.largest_step = 0.0625});
  EXPECT_GE(bound.statistics.steps, 16);
}

// A pole of the solution and a NaN of the right-hand side end in a sentence, shortly before.
TEST(AdaptiveCollocationEdges, FailuresSayWhatHappened) {
  const problems::BlowUp problem;
  const auto pole = integrate(System(problem), problem.initial_state(), 0, 10, to(1e-9, 1e-9));
  EXPECT_FALSE(pole.status.ok());
  EXPECT_NE(pole.status.sentence().find("adaptive-collocation"), std::string::npos);
  EXPECT_TRUE(pole.x.allFinite());
  for (const double value : {nan, infinity}) {
    const testing::Poisoned poisoned{.at = 0.5, .value = value};
    const auto s = integrate(System(poisoned), State{1, 0}, 0, 1, AdaptiveCollocation{});
    EXPECT_FALSE(s.status.ok());
    EXPECT_TRUE(s.x.allFinite());
    EXPECT_LE(s.t, 0.5);
    EXPECT_GT(s.t, 0.49);
    const auto at_once = integrate(System(poisoned), State{1, 0}, 0.75, 1, AdaptiveCollocation{});
    EXPECT_EQ(at_once.status.outcome(), Outcome::non_finite);
    EXPECT_EQ(at_once.t, 0.75);
  }
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
  const problems::Duffing problem{.hardening = *rc::gen::inRange(0, 500) / 100.0};
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

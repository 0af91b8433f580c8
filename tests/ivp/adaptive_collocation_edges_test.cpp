// adaptive-collocation where equations are stiff, jump, end or make no sense.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <fstream>
#include <sstream>

#include "nlmech/ivp/adaptive_collocation.hpp"
#include "nlmech/problems/blow_up.hpp"
#include "nlmech/problems/hires.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/robertson.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "nlmech/problems/van_der_pol.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/oracle.hpp"
#include "tests/places.hpp"

namespace nlmech::ivp {
namespace {

using testing::eps;
using testing::infinity;
using testing::Manufactured;
using testing::nan;

AdaptiveCollocation to(double relative, double absolute) {
  return {.relative_tolerance = relative, .absolute_tolerance = absolute};
}

/// End state of a problem of the test set, as published.
std::vector<double> published(const std::string& problem) {
  std::ifstream in(NLMECH_SOURCE_DIR "/tables/reference/ivp_test_set.csv");
  std::vector<double> values;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(problem + ",", 0) == 0) values.push_back(std::stod(line.substr(line.rfind(',') + 1)));
  }
  return values;
}

/// Digits of the largest error relative to each component.
template <class X>
double digits(const X& x, const std::vector<double>& exact) {
  double error = 1e-16;
  for (std::size_t i = 0; i < exact.size(); ++i)
    error = std::max(error, std::abs(x[static_cast<Eigen::Index>(i)] / exact[i] - 1));
  return -std::log10(error);
}

// Published to 16 digits. Asked: the digits of the tolerance less two, which stiff problems of many steps
// cost every code of the test set's tables.
TEST(StiffAdaptiveCollocation, Robertson) {
  const auto exact = published("Robertson");
  ASSERT_EQ(exact.size(), 3U);
  for (int d = 4; d <= 12; ++d) {
    const double tolerance = std::pow(10., -d);
    const auto s = integrate(System<3>(problems::Robertson{}), problems::Robertson::initial_state(), 0, 1e11,
                             to(tolerance, 1e-8 * tolerance));
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_GT(digits(s.x, exact), d - 2) << tolerance;
    EXPECT_NEAR(s.x.sum(), 1, 64 * eps) << "a linear invariant is kept by Newton's iteration";
  }
}

TEST(StiffAdaptiveCollocation, VanDerPolThousand) {
  auto exact = published("van der Pol");
  ASSERT_EQ(exact.size(), 2U);
  exact[1] /= 1000;  // the test set's time is t/mu
  for (int d = 4; d <= 13; ++d) {
    const double tolerance = std::pow(10., -d);
    const auto s = integrate(System<2>(problems::VanDerPol{.mu = 1000}), {2, 0}, 0, 2000,
                             to(tolerance, 1e-3 * tolerance));
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_GT(digits(s.x, exact), d - 2) << tolerance;
    EXPECT_GT(s.statistics.jacobians, 0) << "sweeps cannot do this";
    EXPECT_LT(s.statistics.steps, 1000) << tolerance;
  }
}

// Components of 1e-4 to 1e-2 under an absolute tolerance a hundredth of the smallest.
TEST(StiffAdaptiveCollocation, Hires) {
  const auto exact = published("HIRES");
  ASSERT_EQ(exact.size(), 8U);
  for (int d = 4; d <= 12; ++d) {
    const double tolerance = std::pow(10., -d);
    const auto s = integrate(System<Eigen::Dynamic>(problems::Hires{}), problems::Hires::initial_state(), 0,
                             problems::Hires::final_time, to(tolerance, 1e-6 * tolerance));
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_GT(digits(s.x, exact), std::min(d - 4, 11)) << tolerance;
  }
}

// The stiff spring and the hardest oscillator against Taylor series and Jacobi's functions.
TEST(StiffAdaptiveCollocation, StructuresThatVibrateFast) {
  problems::ThreeMassChain chain;
  chain.k1 = 1e8;
  const problems::ReferenceTrajectory<long double, problems::ThreeMassChain> truth(
      chain, Vector<long double, 6>::Zero(), 0, 2);
  const State<6> end = truth(2).cast<double>();
  const problems::Duffing hard{.hardening = 1e6};
  for (int d = 4; d <= 12; d += 2) {
    const double tolerance = std::pow(10., -d);
    const auto slow = integrate(System<6>(chain), State<6>::Zero(), 0, 2, to(tolerance, tolerance));
    ASSERT_TRUE(slow.status.ok()) << slow.status.text();
    EXPECT_LT(oracle::distance(slow.x, end), 100 * tolerance) << tolerance;
    const double P = hard.period(1.0);
    const auto fast = integrate(System<2>(hard), {1, 0}, 0, 10 * P, to(tolerance, tolerance));
    ASSERT_TRUE(fast.status.ok()) << fast.status.text();
    const State<2> exact = oracle::duffing(10 * P, hard);
    // In the units of the motion, time 1/sqrt(eta), this is ten periods of an oscillator like Table 4.1's.
    const double bound = static_cast<double>(fast.statistics.steps) * (tolerance + eps) * 75;
    EXPECT_LT(std::abs(fast.x[0] - exact[0]), bound) << tolerance;
  }
}

// Sweeps before the leap, Newton on the branch, and back again: a stiff problem that becomes gentle.
struct StiffThenGentle {
  static constexpr int dimension = 1;
  template <class T>
  void operator()(const T& t, const Vector<T, 1>& x, Vector<T, 1>& f) const {
    using std::cos;
    using std::exp;
    using std::sin;
    const T rate = 1e5 * exp(-t);
    f[0] = cos(t) - rate * (x[0] - sin(t));
  }
};
TEST(StiffAdaptiveCollocation, ComesBackToSweeps) {
  const System<1> system(StiffThenGentle{});
  const auto stiff = integrate(system, State<1>(0.0), 0, 10, to(1e-8, 1e-8));
  ASSERT_TRUE(stiff.status.ok()) << stiff.status.text();
  EXPECT_GT(stiff.statistics.jacobians, 0);
  const auto all = integrate(system, State<1>(0.0), 0, 100, to(1e-8, 1e-8));
  ASSERT_TRUE(all.status.ok()) << all.status.text();
  EXPECT_NEAR(all.x[0], std::sin(100.), 1e-6);  // 1e-8 in each of some hundred steps
  const auto late = all.statistics.factorisations - stiff.statistics.factorisations;
  EXPECT_LT(late, 40) << "Newton's iteration went on where sweeps suffice";
}

TEST(AdaptiveCollocationEdges, GoesBackwards) {
  const Manufactured problem;
  const auto there = integrate(Direct(problem), problem.exact(3), 3, -4, to(1e-12, 1e-12));
  EXPECT_TRUE(there.status.ok());
  EXPECT_EQ(there.x, integrate(System(problem), problem.exact(3), 3, -4, to(1e-12, 1e-12)).x);
  EXPECT_EQ(there.t, -4);
  EXPECT_LT(oracle::distance(there.x, problem.exact(-4)), 1e-8);  // damping backwards enlarges by e^2
  const auto decay = integrate(System<2>(problems::VanDerPol{.mu = 100}), {2, 0}, 1, 0.9, to(1e-6, 1e-6));
  EXPECT_TRUE(decay.status.ok() || decay.t < 1) << "backwards its branch repels";
}

TEST(AdaptiveCollocationEdges, IntervalsWithoutLengthAndTheShortestOne) {
  const System system(testing::Oscillator{});
  EXPECT_EQ(integrate(system, State<2>(1, 2), 5, 5, AdaptiveCollocation{}).x, State<2>(1, 2));
  const double end = std::nextafter(1.0, 2.0);
  const auto s = integrate(system, State<2>(1, 0), 1, end, AdaptiveCollocation{});
  EXPECT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_EQ(s.t, end);
}

TEST(AdaptiveCollocationEdges, ObserverSeesEveryStep) {
  const Manufactured problem;
  double t = 0;
  std::int64_t count = 0;
  const auto look = [&](const Step<2>& step) {
    EXPECT_EQ(step.index, ++count);
    EXPECT_EQ(step.t0, t);
    t = step.t1;
    State<2> x;
    step.dense.at(step.t0, x);
    EXPECT_EQ(x, step.x0);
    step.dense.at(step.t1, x);
    EXPECT_LT(oracle::distance(x, step.x1), 8 * eps);
    EXPECT_EQ(step.times.back(), step.t1);
    EXPECT_EQ(State<2>(step.states.col(0)), step.x1);
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
  for (const auto& s : {integrate(System(problem), State<2>(0, 0), 0, 1, method),
                        integrate(System(problem), State<2>(0, 0), 0, 1, method),
                        integrate(System(problem), problem.exact(0.3), 0.3, 1, method)})
    EXPECT_LT(oracle::distance(s.x, problem.exact(1)), 16 * eps);
  EXPECT_LT(integrate(System(problem), problem.exact(1), 1, 0, method).x.cwiseAbs().maxCoeff(), 16 * eps);
}

// An unannounced jump makes the estimate shorten steps around it, and costs no more than the tolerance.
TEST(AdaptiveCollocationEdges, FindsUnannouncedJumps) {
  const testing::Unannounced<testing::JumpingForce> problem;
  const auto s = integrate(System(problem), State<2>(0, 0), 0, 1, to(1e-8, 1e-8));
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_GT(s.statistics.rejected, 0);
  EXPECT_LT(oracle::distance(s.x, testing::JumpingForce{}.exact(1)), 1e-7);
}

TEST(AdaptiveCollocationEdges, ImpactForce) {
  const problems::ImpactDuffing problem;
  const problems::ReferenceTrajectory<long double, problems::ImpactDuffing> truth(
      problem, Vector<long double, 2>(0, 0), 0, 10);
  const State<2> end = truth(10).cast<double>();
  const auto s = integrate(System(problem), State<2>(0, 0), 0, 10, to(1e-13, 1e-13));
  EXPECT_LT(oracle::distance(s.x, end), static_cast<double>(s.statistics.steps) * 1e-13 * 11);
}

TEST(AdaptiveCollocationEdges, Limits) {
  const System system(Manufactured{});
  const auto few = integrate(system, State<2>(1, 0), 0, 100, AdaptiveCollocation{}, {}, {.steps = 3});
  EXPECT_EQ(few.status.outcome(), Outcome::step_limit);
  EXPECT_LE(few.statistics.steps + few.statistics.rejected, 3);
  EXPECT_EQ(integrate(system, State<2>(1, 0), 0, 1e5, AdaptiveCollocation{}, {}, {.seconds = 1e-6})
                .status.outcome(),
            Outcome::time_limit);
  const auto bound = integrate(system, State<2>(1, 0), 0, 1, AdaptiveCollocation{.largest_step = 0.0625});
  EXPECT_GE(bound.statistics.steps, 16);
}

// A pole of the solution and a NaN of the right-hand side end in a sentence, shortly before.
TEST(AdaptiveCollocationEdges, FailuresSayWhatHappened) {
  const problems::BlowUp problem;
  const auto pole = integrate(System<1>(problem), problem.initial_state(), 0, 10, to(1e-9, 1e-9));
  EXPECT_FALSE(pole.status.ok());
  EXPECT_NE(pole.status.sentence().find("adaptive-collocation"), std::string::npos);
  EXPECT_TRUE(pole.x.allFinite());
  for (const double value : {nan, infinity}) {
    const testing::Poisoned poisoned{.at = 0.5, .value = value};
    const auto s = integrate(System(poisoned), State<2>(1, 0), 0, 1, AdaptiveCollocation{});
    EXPECT_FALSE(s.status.ok());
    EXPECT_TRUE(s.x.allFinite());
    EXPECT_LE(s.t, 0.5);
    EXPECT_GT(s.t, 0.49);
    const auto at_once = integrate(System(poisoned), State<2>(1, 0), 0.75, 1, AdaptiveCollocation{});
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
  const State<2> x0(amplitude, 0);
  const auto there = integrate(System(problem), x0, 0, end, method);
  const auto back = integrate(System(problem), there.x, end, 0, method);
  RC_ASSERT(there.status.ok() && back.status.ok());
  // Every step errs by a tolerance of the size (velocities up to 3 sqrt(1 + 5 * 9) = 20), times the growth of
  // a frequency's error: d omega/d x0 of at most sqrt(5) over the whole time.
  const double steps = static_cast<double>(there.statistics.steps + back.statistics.steps);
  RC_ASSERT(oracle::distance(back.x, x0) < steps * 21e-11 * (1 + 2.3 * std::abs(end)) * 20);
}

}  // namespace
}  // namespace nlmech::ivp

/// Following a smooth turn: against the numerical inverse of the exact transfer functions, limits of slow and
/// fast turns, derivatives, late times.
#include "nlmech/spacecraft/control/tracking.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "nlmech/spacecraft/control/inverse_laplace.hpp"

namespace nlmech::spacecraft::tracking_test {
namespace {

constexpr std::array<double, 1> tip = {4};

TEST(SmoothTurn, IsAtRestAtBothEnds) {
  for (int m = 1; m <= 6; ++m) {
    const SmoothTurn turn(0.7, 3, m);
    // Coefficients up to 1e4 alternate and add up to 1.
    EXPECT_NEAR(turn.value(3 * (1 - 1e-16)), 0.7, 1e-11);
    EXPECT_NEAR(turn.value(1.5), 0.35, 1e-12);
    EXPECT_EQ(turn.value(5), 0.7);
    EXPECT_EQ(turn.value(-1), 0);
    for (int order = 1; order <= m; ++order) {
      EXPECT_EQ(turn.value(0, order), 0);
      EXPECT_NEAR(turn.value(3 - 1e-9, order), 0, 1e-5) << m << " " << order;
    }
    const double h = 1e-5;
    EXPECT_NEAR((turn.value(1 + h) - turn.value(1 - h)) / (2 * h), turn.value(1, 1), 1e-8);
    EXPECT_NEAR((turn.value(1 + h, 2) - turn.value(1 - h, 2)) / (2 * h), turn.value(1, 3), 1e-6);
  }
  EXPECT_THROW(SmoothTurn(1, 0), std::invalid_argument);
  EXPECT_THROW(SmoothTurn(1, 1, 7), std::invalid_argument);
  EXPECT_THROW(SmoothTurn(std::nan(""), 1), std::invalid_argument);
}

/// Transform of r(t) by that of r'; Gauss's rule with 2 points on pieces of 0.005 s, right to 1e-10 of the
/// angle.
Complex reference(const SmoothTurn& turn, Complex s) {
  constexpr int pieces = 400;
  const double h = turn.duration() / pieces;
  Complex sum = 0;
  for (int i = 0; i < pieces; ++i) {
    for (const double side : {-0.57735026918962576, 0.57735026918962576}) {
      const double t = (i + 0.5 + side / 2) * h;
      sum += h / 2 * turn.value(t, 1) * std::exp(-s * t);
    }
  }
  return sum / s;
}

TEST(Tracking, IsTheNumericalInverse) {
  const SmoothTurn turn(1, 2, 3);
  const std::array<double, 3> times = {0.8, 2.5, 7};
  for (const Gains& g : {designed_gains, Gains{12, 1.5, 16}}) {
    const ClosedLoop loop(table_3_1(), g);
    const Parameters& p = loop.parameters();
    for (const TrackingLaw law : {TrackingLaw::regulator, TrackingLaw::feedforward}) {
      const Tracking tracking(loop, turn, law, tip);
      ASSERT_TRUE(tracking.status().ok());
      const auto numerator = [&](Complex s) {
        const double rigid = p.hub_inertia + loop.kappa() * p.appendage_inertia();
        return law == TrackingLaw::regulator ? Complex(g.k1) : s * s * rigid + g.k3 * s + g.k1;
      };
      // r falls like s^-5 beyond 1/T: at W = 400 what is left out is 1e-10 of the angle.
      const BromwichOptions options{.half_period = 20, .shift = 0.75, .frequency = 400};
      const auto theta = bromwich(
          [&](Complex s) { return loop.response(s).theta / g.k1 * numerator(s) * reference(turn, s); }, times,
          options);
      const auto y = bromwich(
          [&](Complex s) {
            return loop.response(s, 4).deflection / g.k1 * numerator(s) * reference(turn, s);
          },
          times, options);
      for (std::size_t i = 0; i < times.size(); ++i) {
        const TrackedMotion motion = tracking.at(times[i]);
        EXPECT_NEAR(motion.theta, theta[i].value, 1e-7);
        EXPECT_NEAR(motion.deflection[0], y[i].value, 1e-7);
      }
    }
  }
}

TEST(Tracking, RateIsTheDerivative) {
  const ClosedLoop loop(table_3_1(), designed_gains);
  for (const TrackingLaw law : {TrackingLaw::regulator, TrackingLaw::feedforward}) {
    for (int m = 1; m <= 6; ++m) {
      const Tracking tracking(loop, SmoothTurn(1, 4, m), law, {});
      for (const double t : {0.5, 1.7, 3.9, 4.5}) {
        const double h = 1e-4, quotient = (tracking.at(t + h).theta - tracking.at(t - h).theta) / (2 * h);
        // h^2/6 theta''' with theta''' up to 40.
        EXPECT_NEAR(tracking.at(t).theta_dot, quotient, 1e-6) << m << " at " << t;
      }
    }
  }
}

// Slow turns: the regulator lags by k3/k1 r', the fed torque leaves kappa strain/k1 r'''', and the appendages
// bend quasi-statically.
TEST(Tracking, OfSlowTurnsHasItsLimits) {
  for (const Gains& g : {designed_gains, Gains{12, 1.5, 16}}) {
    const ClosedLoop loop(table_3_1(), g);
    const SmoothTurn turn(1, 1000, 6);
    const Tracking lagging(loop, turn, TrackingLaw::regulator, tip),
        fed(loop, turn, TrackingLaw::feedforward, tip);
    const double strain = statics(loop.parameters(), 0).strain;
    for (const double t : {300., 400., 700.}) {
      EXPECT_NEAR(lagging.at(t).error / (-g.k3 / g.k1 * turn.value(t, 1)), 1, 0.02);
      // The next term is (k3/k1) d/dt: 1.3 s against the 100 s in which r'''' changes.
      const double predicted = loop.kappa() * strain / g.k1 * turn.value(t, 4);
      EXPECT_NEAR(fed.at(t).error / predicted, 1, 0.1);
      const double bend =
          loop.plant().static_deflection(4) * loop.parameters().total_inertia() * turn.value(t, 2);
      EXPECT_NEAR(fed.at(t).deflection[0] / bend, 1, 1e-3);
    }
  }
}

// A turn in no time is a step.
TEST(Tracking, OfFastTurnsIsTheStepResponse) {
  const ClosedLoop loop(table_3_1(), designed_gains);
  const TimeResponse step = step_response(loop, 1, tip);
  for (const double duration : {1e-3, 1e-6, 1e-9}) {
    const Tracking tracking(loop, SmoothTurn(1, duration, 3), TrackingLaw::regulator, tip);
    for (const double t : {0.3, 2., 9.}) {
      // As if the step came half the duration late.
      EXPECT_NEAR(tracking.at(t).theta, step.theta.value(t - duration / 2), 1e-6 * duration + 1e-9);
      EXPECT_NEAR(tracking.at(t).deflection[0], step.deflection[0].value(t - duration / 2),
                  1e-2 * duration + 1e-8);
    }
  }
}

TEST(Tracking, BeginsAtRestAndArrives) {
  const ClosedLoop loop(table_3_1(), unit_gains);
  for (const TrackingLaw law : {TrackingLaw::regulator, TrackingLaw::feedforward}) {
    for (int m = 1; m <= 6; ++m) {
      const Tracking tracking(loop, SmoothTurn(0.5, 10, m), law, tip);
      const TrackedMotion start = tracking.at(0), end = tracking.at(5000);
      EXPECT_EQ(start.theta, 0);
      EXPECT_EQ(start.theta_dot, 0);
      EXPECT_EQ(start.deflection[0], 0);
      // High modes are hardly damped.
      EXPECT_NEAR(end.theta, 0.5, 1e-8);
      EXPECT_NEAR(end.deflection[0], 0, 1e-4);
    }
  }
}

// The fed torque makes the error 100 times smaller, at the same gains.
TEST(Tracking, IsBetterWithTorqueFedForward) {
  const ClosedLoop loop(table_3_1(), designed_gains);
  const SmoothTurn turn(1, 10, 3);
  const Tracking lagging(loop, turn, TrackingLaw::regulator, {}),
      fed(loop, turn, TrackingLaw::feedforward, {});
  double lag = 0, left = 0;
  for (int i = 0; i <= 300; ++i) {
    lag = std::max(lag, std::abs(lagging.at(0.05 * i).error));
    left = std::max(left, std::abs(fed.at(0.05 * i).error));
  }
  EXPECT_GT(lag, 0.3);
  EXPECT_LT(left, lag / 100);
}

TEST(Tracking, RefusesBadInput) {
  const SmoothTurn turn(1, 2);
  const ClosedLoop loop(table_3_1(), designed_gains);
  EXPECT_THROW(Tracking(ClosedLoop(table_3_1(), {0, 0, 1}), turn, TrackingLaw::regulator, {}),
               std::invalid_argument);
  const std::array<double, 1> outside = {5};
  EXPECT_THROW(Tracking(loop, turn, TrackingLaw::regulator, outside), std::invalid_argument);
  const Tracking tracking(loop, turn, TrackingLaw::regulator, {});
  EXPECT_THROW((void)tracking.at(-1), std::invalid_argument);
  EXPECT_THROW((void)tracking.at(std::numeric_limits<double>::infinity()), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::spacecraft::tracking_test

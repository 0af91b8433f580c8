/// Motion in time: the numerical inverse of the exact transfer functions, initial and late times, nearly
/// double poles, torque steps. The chapter's scenes hold peaks and settling times with the gains of the
/// source.
#include "nlmech/spacecraft/response.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "nlmech/spacecraft/plant/poles.hpp"
#include "tests/spacecraft/oracle.hpp"
#include "tests/spacecraft/time_oracle.hpp"

namespace nlmech::spacecraft::response_test {
namespace {

constexpr std::array<double, 2> places = {2, 4};

TimeResponse designed(int pairs) {
  return step_response(ClosedLoop(table_3_1(), designed_gains), 1, places, {.pairs = pairs});
}

// After 1e5 radians of a hub that hardly damps, where finite elements have another phase with each mesh:
// Newton's iteration and residues by differences, of a characteristic function in 110 digits.
TEST(StepResponse, IsTheSumOfExactPolesAtALateTime) {
  Parameters p = table_3_1();
  p.hub_inertia = 18.4, p.mass_per_length = 0.0425, p.length = 25.05, p.hub_radius = 7.91;
  p.second_moment = 3.88e-7, p.tip_mass = 0.919, p.tip_inertia = 0.00272;
  const Gains g{1.01e6, 1.785, 0.3225};
  const auto characteristic = [&](Complex s) {
    const Complex load = 1. / oracle::by_exponentials(p, s, p.length).theta, hub = s * s * p.hub_inertia;
    return hub + (1 + g.k2 / 2) * (load - hub) + g.k3 * s + g.k1;
  };
  const auto slope = [&](Complex s) {
    const double h = 1e-7 * std::abs(s);
    return (characteristic(s + h) - characteristic(s - h)) / (2 * h);
  };
  constexpr int pairs = 30;
  constexpr double time = 1268;
  const TimeResponse r = step_response(ClosedLoop(p, g), 1, places, {.pairs = pairs});
  ASSERT_TRUE(r.status.ok()) << r.status.text();
  double theta = 1, envelope = 0;
  for (Complex s : r.theta.poles()) {
    for (int i = 0; i < 2; ++i) s -= characteristic(s) / slope(s);
    const Complex weight = g.k1 / (s * slope(s));
    theta += 2 * (weight * std::exp(s * time)).real();
    envelope += 2 * std::abs(weight);
  }
  // Poles to 1e-15 of themselves; slopes to 1e-10: (1e-7 over a gap of 0.02)^2, and roundings over 1e-7.
  EXPECT_NEAR(r.theta.value(time), theta, 1e-9 * envelope);
  EXPECT_GT(std::abs(theta - 1), 1e-3);  // it still swings
}

// Ten digits of a sum over the same 25 pairs. oracle: gss_control_loop 25 pairs *
TEST(StepResponse, AgreesWithASumOf25Pairs) {
  const TimeResponse r = designed(25);
  ASSERT_TRUE(r.status.ok()) << r.status.text();
  EXPECT_NEAR(r.theta.value(4.508), 1.136136788, 1e-9);
  EXPECT_NEAR(r.deflection[0].value(0.4315), -0.08167666738, 1e-11);
  EXPECT_NEAR(r.deflection_dot[0].value(0.69), 0.3345334764, 1e-10);
  EXPECT_NEAR(r.deflection_dot[0].value(0.264), -0.3025500021, 1e-10);
}

TEST(StepResponse, IsTheNumericalInverse) {
  const std::array<double, 3> times = {1, 5, 20};
  for (const Gains& g : {designed_gains, unit_gains}) {
    const ClosedLoop loop(table_3_1(), g);
    const TimeResponse r = step_response(loop, 1, places);
    const oracle::BromwichLine options{.half_period = 60, .shift = 0.25, .frequency = 6000};
    const auto theta =
        oracle::bromwich([&](Complex s) { return loop.response(s).theta / s; }, times, options);
    const auto rate = oracle::bromwich([&](Complex s) { return loop.response(s).theta; }, times, options);
    const auto y =
        oracle::bromwich([&](Complex s) { return loop.response(s, 2).deflection / s; }, times, options);
    for (std::size_t i = 0; i < times.size(); ++i) {
      // Aliasing e^-30 = 1e-13; beyond W each is of the order k1/(I_hub W^2) e^(t/4) or less, resonances
      // included.
      EXPECT_NEAR(theta[i], r.theta.value(times[i]), 5e-11);
      EXPECT_NEAR(y[i], r.deflection[0].value(times[i]), 5e-8);
      EXPECT_NEAR(rate[i], r.theta_dot.value(times[i]), 1e-6);
    }
  }
}

// The bounds hold against a sum of eight times as many pairs, and are no wild overestimate for theta.
TEST(StepResponse, BoundsWhatIsLeftOut) {
  for (const Gains& g : {designed_gains, unit_gains, Gains{12, 4.83, 31.9}, Gains{12, -1.5, 16}}) {
    const ClosedLoop loop(table_3_1(), g);
    const TimeResponse few = step_response(loop, 1, places, {.pairs = 16});
    const TimeResponse many = step_response(loop, 1, places, {.pairs = 128});
    double theta = 0, rate = 0, y = 0, y_rate = 0;
    for (const double t : {0., 0.01, 0.3, 1., 3., 10.}) {
      theta = std::max(theta, std::abs(few.theta.value(t) - many.theta.value(t)));
      rate = std::max(rate, std::abs(few.theta_dot.value(t) - many.theta_dot.value(t)));
      y = std::max(y, std::abs(few.deflection[0].value(t) - many.deflection[0].value(t)));
      y_rate = std::max(y_rate, std::abs(few.deflection_dot[0].value(t) - many.deflection_dot[0].value(t)));
    }
    EXPECT_LT(theta, few.bounds.theta);
    EXPECT_LT(rate, few.bounds.theta_dot);
    EXPECT_LT(y, few.bounds.deflection[0]);
    EXPECT_LT(y_rate, few.bounds.deflection_dot[0]);
    EXPECT_LT(few.bounds.theta, 1e-8);
  }
}

TEST(StepResponse, ChoosesPairsByTheBound) {
  const ClosedLoop loop(table_3_1(), designed_gains);
  const TimeResponse rough = step_response(loop, 1, places, {.tolerance = 1e-5});
  const TimeResponse fine = step_response(loop, 1, places, {.tolerance = 1e-11});
  EXPECT_LT(rough.theta.poles().size(), fine.theta.poles().size());
  EXPECT_LT(fine.bounds.deflection[0], 1e-11);
  EXPECT_NEAR(rough.deflection[0].value(1), fine.deflection[0].value(1), 1e-6);
}

// At t = 0 everything is at rest; soon after theta = k1 t^2/(2 I_hub), since the hub is felt first. Late it
// has arrived.
TEST(StepResponse, BeginsAtRestAndArrives) {
  for (const Gains& g : {designed_gains, unit_gains}) {
    const TimeResponse r = step_response(ClosedLoop(table_3_1(), g), 0.5, places, {.pairs = 400});
    EXPECT_NEAR(r.theta.value(0), 0, 1e-14);
    EXPECT_NEAR(r.theta_dot.value(0), 0, 1e-13);
    EXPECT_NEAR(r.deflection[1].value(0), 0, 1e-13);
    EXPECT_NEAR(r.deflection_dot[1].value(0), 0, 1e-11);
    const double t = 1e-4, early = 0.5 * g.k1 * t * t / (2 * table_3_1().hub_inertia);
    // The appendages take part as B(1/t)/I_hub: 2 % of the hub.
    EXPECT_NEAR(r.theta.value(t), early, 0.03 * early);
    // High modes are hardly damped: what is left is within their moduli.
    EXPECT_LT(std::abs(r.theta.value(1e4) - 0.5), r.theta.envelope(1e4) + 1e-15);
    EXPECT_LT(r.theta.envelope(1e4), 1e-8);
    EXPECT_LT(std::abs(r.deflection[1].value(1e6)), 1e-8);
    EXPECT_EQ(r.theta.value(1e12), 0.5);
  }
}

// u of the residues is the control law's, where that needs theta and theta' alone.
TEST(StepResponse, TorqueIsTheControlLaws) {
  const TimeResponse r = designed(64);
  for (const double t : {0., 0.1, 1., 7.}) {
    const double law = -12 * (r.theta.value(t) - 1) - 16 * r.theta_dot.value(t);
    EXPECT_NEAR(r.torque.value(t), law, 1e-6) << t;
  }
}

/// k3 at which the slow pair of k1 = 12, k2 = 0 becomes real.
double critical_k3() {
  double a = 16, b = 60;
  for (int i = 0; i < 60; ++i) {
    const double middle = (a + b) / 2;
    const LoopPoles poles = ClosedLoop(table_3_1(), {12, 0, middle}).poles(1);
    (poles.s[0].imag() > 0 ? a : b) = middle;
  }
  return a;
}

// A double pole has no residue of its own. The response is the numerical inverse nevertheless, at it and near
// it.
TEST(StepResponse, StandsNearlyDoublePoles) {
  const double critical = critical_k3();
  const std::array<double, 3> times = {0.5, 3, 10};
  for (const double factor : {1., 1 - 1e-12, 1 + 1e-9, 1 - 1e-7, 1 + 1e-5, 1 - 1e-3}) {
    const ClosedLoop loop(table_3_1(), {12, 0, critical * factor});
    const TimeResponse r = step_response(loop, 1, places, {.pairs = 64});
    ASSERT_TRUE(r.status.ok()) << factor << r.status.text();
    EXPECT_NEAR(r.theta.value(0), 0, 1e-10) << factor;
    const auto theta =
        oracle::bromwich([&](Complex s) { return loop.response(s).theta / s; }, times, {.frequency = 2000});
    for (std::size_t i = 0; i < times.size(); ++i)
      EXPECT_NEAR(r.theta.value(times[i]), theta[i], 2e-9) << factor << " at " << times[i];
  }
}

TEST(StepResponse, WithoutAngleFeedbackNothingMoves) {
  const TimeResponse r = step_response(ClosedLoop(table_3_1(), {0, 1, 1}), 1, places);
  EXPECT_TRUE(r.status.ok());
  EXPECT_EQ(r.theta.value(3), 0);
  EXPECT_EQ(r.deflection_dot[1].value(3), 0);
}

TEST(TorqueResponse, BeginsAtRestAndIsTheNumericalInverse) {
  for (const Parameters& p : {table_3_1(), without_tip(table_3_1())}) {
    const Plant plant(p);
    const TimeResponse r = torque_response(plant, 2, places, {.pairs = 200});
    ASSERT_TRUE(r.status.ok());
    // The constant from the static strain energy against the sum of the residues: independent of each other.
    EXPECT_NEAR(r.theta.value(0), 0, 1e-14);
    EXPECT_NEAR(r.deflection[0].value(0), 0, 1e-12);
    const std::array<double, 2> times = {0.7, 6};
    const auto theta = oracle::bromwich([&](Complex s) { return 2. * plant.response(s).theta / s; }, times,
                                        {.half_period = 20, .shift = 0.8, .frequency = 2000});
    const auto y = oracle::bromwich([&](Complex s) { return 2. * plant.response(s, 2).deflection / s; },
                                    times, {.half_period = 20, .shift = 0.8, .frequency = 6000});
    for (std::size_t i = 0; i < times.size(); ++i) {
      EXPECT_NEAR(r.theta.value(times[i]), theta[i], 1e-8);
      EXPECT_NEAR(r.deflection[0].value(times[i]), y[i], 1e-6);
    }
  }
}

// 15 digits. oracle: gss_control_plant statics *
TEST(Statics, AreTheClosedForms) {
  const Parameters p = table_3_1();
  EXPECT_NEAR(statics(p, 2).square, 7.48287762891742e-4, 1e-17);
  EXPECT_NEAR(statics(p, 4).square, 7.4743411811217e-3, 1e-15);
  EXPECT_NEAR(statics(p, 4).green, 64 / (3 * p.bending_stiffness()), 1e-15);
  // B(s) = B(0) - strain s^2 at small s, where s is large enough for the difference to have 8 digits.
  const Appendage appendage(p);
  const double s = 1e-2, difference = p.appendage_inertia() - appendage.inertia(Complex(s)).real();
  EXPECT_NEAR(statics(p, 0).strain * s * s / difference, 1, 1e-4);
  EXPECT_THROW((void)statics(p, -0.1), std::invalid_argument);
}

TEST(TimeResponses, RefuseBadInput) {
  const ClosedLoop loop(table_3_1(), designed_gains);
  const std::array<double, 1> outside = {4.5};
  EXPECT_THROW((void)step_response(loop, 1, outside), std::invalid_argument);
  EXPECT_THROW((void)step_response(loop, std::nan(""), places), std::invalid_argument);
  EXPECT_THROW((void)step_response(loop, 1, places, {.pairs = -1}), std::invalid_argument);
  EXPECT_THROW((void)step_response(loop, 1, places, {.tolerance = 0}), std::invalid_argument);
  EXPECT_THROW((void)torque_response(loop.plant(), 1, outside), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::spacecraft::response_test

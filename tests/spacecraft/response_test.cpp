/// Motion in time: numerical inverse of the exact transfer functions, initial and late times, torque. The
/// chapter's scenes record peaks and settling times with the gains of the source.
#include "nlmech/spacecraft/response.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>

#include "nlmech/spacecraft/plant/poles.hpp"
#include "tests/spacecraft/oracle.hpp"
#include "tests/spacecraft/time_oracle.hpp"
#include "tests/thrown.hpp"

namespace nlmech::spacecraft::response_test {
namespace {

constexpr std::array<double, 2> places = {2, 4};

TimeResponse designed(int pairs) {
  return step_response(ClosedLoop(table_3_1(), designed_gains), 1, places, {.pairs = pairs});
}

// After 1e5 radians of a weakly damped hub, where finite elements have another phase for each mesh.
// Reference: Newton's iteration and residues by differences, of a characteristic function in 110 digits.
TEST(StepResponse, IsTheSumOfExactPolesAtALateTime) {
  Parameters p = table_3_1();
  p.hub_inertia = 18.4, p.mass_per_length = 0.0425, p.length = 25.05, p.hub_radius = 7.91;
  p.second_moment = 3.88e-7, p.tip_mass = 0.919, p.tip_inertia = 0.00272;
  const Gains g{1.01e6, 1.785, 0.3225};
  const auto characteristic = [&](Complex s) { return oracle::characteristic(p, g, s); };
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
  // Poles are accurate to 1e-15; slopes to 1e-10: (1e-7 over a gap of 0.02)^2, and rounding errors over 1e-7.
  EXPECT_NEAR(r.theta.value(time), theta, 1e-9 * envelope);
  EXPECT_GT(std::abs(theta - 1), 1e-3);  // it still oscillates
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

// The bounds hold against a sum of eight times as many pairs, and do not overestimate theta excessively.
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

// Rest at t = 0; for small t theta = k1 t^2/(2 I_hub), because the hub responds first; for large t the final
// value.
TEST(StepResponse, BeginsAtRestAndArrives) {
  for (const Gains& g : {designed_gains, unit_gains}) {
    const TimeResponse r = step_response(ClosedLoop(table_3_1(), g), 0.5, places, {.pairs = 400});
    EXPECT_NEAR(r.theta.value(0), 0, 1e-14);
    EXPECT_NEAR(r.theta_dot.value(0), 0, 1e-13);
    EXPECT_NEAR(r.deflection[1].value(0), 0, 1e-13);
    EXPECT_NEAR(r.deflection_dot[1].value(0), 0, 1e-11);
    const double t = 1e-4, early = 0.5 * g.k1 * t * t / (2 * table_3_1().hub_inertia);
    // The appendages contribute B(1/t)/I_hub: 2 % of the hub.
    EXPECT_NEAR(r.theta.value(t), early, 0.03 * early);
    // High modes are weakly damped: the remainder is within their moduli.
    EXPECT_LT(std::abs(r.theta.value(1e4) - 0.5), r.theta.envelope(1e4) + 1e-15);
    EXPECT_LT(r.theta.envelope(1e4), 1e-8);
    EXPECT_LT(std::abs(r.deflection[1].value(1e6)), 1e-8);
    EXPECT_EQ(r.theta.value(1e12), 0.5);
  }
}

// The torque of the residues equals the control law where that needs theta and theta' only.
TEST(StepResponse, TorqueIsTheControlLaws) {
  const TimeResponse r = designed(64);
  for (const double t : {0., 0.1, 1., 7.}) {
    const double law = -12 * (r.theta.value(t) - 1) - 16 * r.theta_dot.value(t);
    EXPECT_NEAR(r.torque.value(t), law, 1e-6) << t;
  }
}

/// The angle is the numerical inverse of its transform.
void expect_inverse(const ClosedLoop& loop, const TimeResponse& r, std::span<const double> times,
                    const oracle::BromwichLine& line, double tolerance) {
  const auto theta = oracle::bromwich([&](Complex s) { return loop.response(s).theta / s; }, times, line);
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_NEAR(r.theta.value(times[i]), theta[i], tolerance) << times[i];
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
    SCOPED_TRACE(factor);
    expect_inverse(loop, r, times, {.frequency = 2000}, 2e-9);
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
    // The constant from the static strain energy against the independent sum of the residues.
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
  // B(s) = B(0) - strain s^2 for small s; s is large enough for 8 digits of the difference.
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

// ---- Step response with poles that coincide, nearly coincide, are close to s = 0 or far to the left,
// against finite elements in time, the numerical inverse, and initial values.

/// Expects agreement with finite elements at some times: within ten times the change from half as many
/// elements, and 1e-9 of the largest value.
void expect_as_elements(const Parameters& p, const Gains& g, double x, std::initializer_list<double> times) {
  const std::array<double, 1> place = {x};
  const TimeResponse r = step_response(ClosedLoop(p, g), 1, place);
  ASSERT_TRUE(r.status.ok()) << g.k1 << ' ' << g.k2 << ' ' << g.k3 << ": " << r.status.text();
  const oracle::StepByElements coarse(p, g, x, 4), fine(p, g, x, 8);
  for (const double t : times) {
    const oracle::Moved a = coarse.at(t), b = fine.at(t);
    const double theta = r.theta.value(t), rate = r.theta_dot.value(t), y = r.deflection[0].value(t);
    EXPECT_NEAR(theta, b.theta, 10 * std::abs(a.theta - b.theta) + 1e-9)
        << g.k1 << ' ' << g.k3 << " at " << t;
    EXPECT_NEAR(rate, b.theta_dot, 10 * std::abs(a.theta_dot - b.theta_dot) + 1e-4 * r.theta_dot.envelope(0))
        << g.k1 << ' ' << g.k3 << " at " << t;
    EXPECT_NEAR(y, b.deflection,
                10 * std::abs(a.deflection - b.deflection) + 1e-4 * r.deflection[0].envelope(0))
        << g.k1 << ' ' << g.k3 << " at " << t;
  }
}

TEST(TimeResponses, OfOtherEndsAgreeWithElements) {
  for (const auto& [root, tip] : {std::pair{6., TipSupport::free},
                                  {700., TipSupport::pinned},
                                  {0., TipSupport::guided},
                                  {HUGE_VAL, TipSupport::clamped}}) {
    Parameters p = table_3_1();
    p.root_stiffness = root;
    p.tip_support = tip;
    expect_as_elements(p, designed_gains, 2, {0.5, 4});
    expect_as_elements(p, unit_gains, 2, {2});
  }
}

// A slow real pole near s = 0 must not be treated as a pair with it, which gave theta(0) = 1.
TEST(NearPoles, ASlowRealPoleBesideZero) {
  for (const Gains& g : {Gains{5, 0, 90}, Gains{1, 0, 100}, Gains{12, 0, 150}, Gains{0.01, 0, 16}}) {
    const std::array<double, 1> place = {2};
    const TimeResponse r = step_response(ClosedLoop(table_3_1(), g), 1, place);
    // The sum of a hundred terms of order one.
    EXPECT_NEAR(r.theta.value(0), 0, 1e-13) << g.k1 << ' ' << g.k3;
    expect_as_elements(table_3_1(), g, 2, {0.3, 10});
  }
}

// For any k1: for small k1 the angle is k1/k3 (t - J/k3 ...), and its digits must not come from 1 - 1.
TEST(NearPoles, PolesFarSlowerThanTheModes) {
  for (const double k1 : {1e-6, 1e-12, 1e-40}) {
    const LoopPoles poles = ClosedLoop(table_3_1(), {k1, 0, 16}).poles(3);
    ASSERT_TRUE(poles.status.ok()) << poles.status.text();
    // -k1/k3 (1 + J k1/k3^2 + ...).
    EXPECT_NEAR(poles.s[0].real() / (-k1 / 16), 1, 1e-12 + 0.1 * k1) << k1;
    EXPECT_EQ(poles.s[0].imag(), 0);
  }
  // Two slow poles of equal size: s^2 J + k3 s + k1 = 0, (s + 1e-9)(s + 2e-9) J.
  const double j = table_3_1().total_inertia();
  const LoopPoles poles = ClosedLoop(table_3_1(), {2e-18 * j, 0, 3e-9 * j}).poles(3);
  ASSERT_TRUE(poles.status.ok()) << poles.status.text();
  EXPECT_NEAR(poles.s[0].real(), -1e-9, 1e-20);
  EXPECT_NEAR(poles.s[1].real(), -2e-9, 1e-20);
}

// A real pole near -k3/I_hub = -3125 is faster than 800 modes of an appendage of 400 ft: without it the
// initial rate of the hub is 4e-5.
TEST(NearPoles, AFastRealPoleIsNotLeftOut) {
  Parameters p = table_3_1();
  p.length = 400;
  const ClosedLoop loop(p, {1, 0, 25000});
  const std::array<double, 1> place = {400};
  const TimeResponse r = step_response(loop, 1, place);
  ASSERT_TRUE(r.status.ok()) << r.status.text();
  // Truncation after 800 pairs, for largest rates of 4e-5 rad/s and 0.016 ft/s.
  EXPECT_NEAR(r.theta_dot.value(0), 0, 4e-8);
  EXPECT_NEAR(r.deflection_dot[0].value(0), 0, 2e-5);
  const std::array<double, 2> times = {1e-4, 1e-3};
  const oracle::BromwichLine options{.half_period = 0.01, .shift = 1000, .frequency = 1e7};
  expect_inverse(loop, r, times, options, 1e-11);
}

// Without a hub and with strong rate feedback theta' rises from 0 to theta_f k1/k3 within 2e-16 s, 1/|p| of a
// real pole p = -5e15 1/s. The sum over the lowest modes lacks that boundary layer: its theta and y converge,
// but its theta' starts with -theta_f k1/k3.
TEST(NearPoles, ABoundaryLayerIsRefused) {
  Parameters p = table_3_1();
  p.hub_inertia = 0;
  p.mass_per_length = 0.0027187500000000002;
  p.youngs_modulus = 1584000000;
  p.length = 40;
  p.hub_radius = 0.10500192038491871;
  p.second_moment = 2.3393754031498719e-07;
  p.tip_mass = 0.69102922019098867;
  p.tip_inertia = 0.0053309941673492329;
  const ClosedLoop loop(p, {2.1928089690592794, -0.438268658879716, 92978.324489340695});
  const std::array<double, 1> place = {32};
  for (const int most : {100, 800, 1600}) {
    const TimeResponse r = step_response(loop, 1, place, {.most = most});
    EXPECT_EQ(r.status.outcome(), Outcome::not_converged) << most << r.status.text();
  }
}

// Gains that move this pole ever farther out, where the search must end in time, and a spacecraft without a
// hub, where the pole is near -(k3/c)^2.
TEST(NearPoles, FastPolesHaveNoLimit) {
  for (const double k3 : {1e4, 1e7, 1e12, 1e20}) {
    const LoopPoles poles = ClosedLoop(table_3_1(), {12, 0, k3}).poles(4, PoleOrder::frequency);
    ASSERT_TRUE(poles.status.ok()) << k3 << poles.status.text();
    double fastest = 0;
    for (const Complex s : poles.s) fastest = std::min(fastest, s.real());
    // I_hub s + 2 B s + k3 = 0 with 2 B = c/sqrt(s) of the order 1e0.
    EXPECT_NEAR(fastest / (-k3 / 8), 1, 10 / std::sqrt(k3)) << k3;
  }
  Parameters light = table_3_1();
  light.hub_inertia = 0;
  const LoopPoles poles = ClosedLoop(light, {1, 0, 1e5}).poles(4, PoleOrder::frequency);
  ASSERT_TRUE(poles.status.ok()) << poles.status.text();
  double fastest = 0;
  for (const Complex s : poles.s) fastest = std::min(fastest, s.real());
  EXPECT_LT(fastest, -1e8);
}

/// s^2 B on the real axis.
double load(const Parameters& p, double s) { return s * s * Appendage(p).inertia(Complex(s)).real(); }

// A triple real pole: with P'' = 0 for kappa, P' = 0 for k3 and P = 0 for k1, and near it.
TEST(NearPoles, ThreeRealPolesCoincide) {
  const Parameters p = table_3_1();
  const std::array<double, 1> place = {2};
  for (const double at : {-3., -5.}) {
    const double h = 1e-3;
    const double curvature = (load(p, at + h) - 2 * load(p, at) + load(p, at - h)) / (h * h);
    const double kappa = -2 * p.hub_inertia / curvature;
    const auto inertia = [&](double s) { return s * s * p.hub_inertia + kappa * load(p, s); };
    const double k3 = -(inertia(at + h) - inertia(at - h)) / (2 * h), k1 = -inertia(at) - k3 * at;
    for (const double factor : {1., 1 + 1e-8, 1 + 1e-3}) {
      const ClosedLoop loop(p, {k1 * factor, kappa - 2, k3});
      const TimeResponse r = step_response(loop, 1, place);
      ASSERT_TRUE(r.status.ok()) << at << ' ' << factor << r.status.text();
      EXPECT_NEAR(r.theta.value(0), 0, 1e-9) << factor;
      EXPECT_NEAR(r.theta_dot.value(0), 0, 1e-8) << factor;
      const std::array<double, 3> times = {0.5, 3, 10};
      SCOPED_TRACE(factor);
      expect_inverse(loop, r, times, {.frequency = 2000}, 2e-8);
    }
  }
}

// A real pole near two coincident ones, within a fifteenth of their size: as a separate pole it has a residue
// of 433, and 7e-9 of rounding. Truncation is within its bound, rounding within eps times the sum of terms.
TEST(NearPoles, ARealPoleBesideADoublePole) {
  Parameters p = table_3_1();
  p.hub_inertia = 1.3710700596399703, p.mass_per_length = 0.081182670798906023, p.length = 8.9743403732411409;
  p.hub_radius = 2.4914600457797231, p.second_moment = 1.7152810914248605e-08, p.tip_mass = p.tip_inertia = 0;
  const ClosedLoop loop(p, {320.03070077993152, 80.54873714825888, 1884.3912052735893});
  const std::array<double, 1> place = {6.64};
  for (const int pairs : {0, 256, 1024}) {
    const TimeResponse r = step_response(loop, 1, place, {.pairs = pairs});
    ASSERT_TRUE(r.status.ok()) << r.status.text();
    EXPECT_NEAR(r.theta.value(0), 0, r.bounds.theta + 2e-12 * r.theta.envelope(0)) << pairs;
    EXPECT_LT(r.theta.envelope(0), 200) << pairs;
  }
}

// Two pairs of complex poles that coincide, k2 = 0: the gains solve P = P' = 0 to all their
// digits; recorded.
TEST(NearPoles, TwoComplexPairsCoincide) {
  const std::array<double, 1> place = {2};
  for (const double factor : {1., 1 - 1e-8, 1 + 1e-4}) {
    const ClosedLoop loop(table_3_1(), {158.83060235789 * factor, 0, 78.86861803122});
    const TimeResponse r = step_response(loop, 1, place);
    ASSERT_TRUE(r.status.ok()) << factor << r.status.text();
    EXPECT_NEAR(r.theta.value(0), 0, 1e-11) << factor;
    EXPECT_NEAR(r.deflection_dot[0].value(0), 0, 1e-8) << factor;
    const std::array<double, 3> times = {0.5, 3, 10};
    SCOPED_TRACE(factor);
    expect_inverse(loop, r, times, {.frequency = 4000}, 1e-9);
  }
}

}  // namespace
}  // namespace nlmech::spacecraft::response_test

/// The controlled spacecraft: poles to 12 digits and none missed, transfer functions against 110 digits,
/// stability, extreme parameters.
#include "nlmech/spacecraft/control/closed_loop.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "nlmech/spacecraft/plant/poles.hpp"
#include "tests/spacecraft/oracle.hpp"
#include "tests/spacecraft/random_spacecraft.hpp"
#include "tests/thrown.hpp"

namespace nlmech::spacecraft::closed_loop_test {
namespace {

/// Relative distance of a pole from a zero: |P/(s P')|. The slope is only a scale and may come from the
/// library.
double distance(const Parameters& p, const Gains& g, Complex s) {
  const LoopTerms terms = ClosedLoop(p, g).terms(s, {});
  const Complex slope = terms.characteristic.slope / terms.determinant;
  return std::abs(oracle::characteristic(p, g, s) / (s * slope));
}

struct Published {
  Gains gains;
  std::array<Complex, 8> poles;
};

// oracle: gss_control_loop * pole *
const std::array<Published, 2>& published() {
  static const std::array<Published, 2> both = {Published{unit_gains,
                                                          {Complex{-0.0215431643409, 0.206601321049},
                                                           {-0.0374926186383, 7.23504114918},
                                                           {-0.00239379018593, 52.418196469},
                                                           {-4.71164950957e-4, 156.311402416},
                                                           {-1.74599236997e-4, 297.735227428},
                                                           {-9.98750559e-5, 466.83277181},
                                                           {-6.95182884e-5, 698.031770179},
                                                           {-4.7657903e-5, 1006.45140733}}},
                                                Published{designed_gains,
                                                          {Complex{-0.435108439861, 0.689954756969},
                                                           {-0.527468041156, 6.42057934175},
                                                           {-0.0259638869961, 52.0811790701},
                                                           {-0.00505426852263, 156.114528064},
                                                           {-0.00186883590681, 297.596386207},
                                                           {-0.00106797595351, 466.708297805},
                                                           {-7.43041752588e-4, 697.902246064},
                                                           {-5.09214616514e-4, 1006.32339848}}}};
  return both;
}

TEST(ClosedLoopPoles, AreThoseOfTheSourcesGains) {
  for (const Published& p : published()) {
    const LoopPoles poles = ClosedLoop(table_3_1(), p.gains).poles(8);
    ASSERT_TRUE(poles.status.ok()) << poles.status.text();
    ASSERT_EQ(poles.s.size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) {
      // Half a unit of the twelfth digit, at most.
      EXPECT_NEAR(poles.s[i].real(), p.poles[i].real(), 1e-12 * std::abs(p.poles[i]));
      EXPECT_NEAR(poles.s[i].imag(), p.poles[i].imag(), 5e-12 * std::abs(p.poles[i]));
    }
  }
}

RC_GTEST_PROP(ClosedLoopPoles, AreZerosOfTheExactCharacteristic, ()) {
  const Parameters p = *random_spacecraft();
  const Gains g{std::pow(10, *between(-2, 3)), *between(-1.9, 6), std::pow(10, *between(-2, 3))};
  const LoopPoles poles = ClosedLoop(p, g).poles(6);
  RC_ASSERT(poles.status.ok());
  for (const Complex s : poles.s) RC_ASSERT(s.real() < 0);
  // Near a double pole P' is small, and few digits are determined.
  const std::size_t i = *rc::gen::inRange<std::size_t>(0, 6);
  RC_ASSERT(distance(p, g, poles.s[i]) < 2e-12);
}

RC_GTEST_PROP(ClosedLoopPoles, OfOtherEndsAreZerosToo, ()) {
  Parameters p = *random_spacecraft();
  p.root_stiffness = p.bending_stiffness() / p.length * std::pow(10, *between(-3, 3));
  p.tip_support = static_cast<TipSupport>(*rc::gen::inRange(0, 4));
  const Gains g{std::pow(10, *between(-2, 2)), *between(-1.9, 6), std::pow(10, *between(-2, 2))};
  const LoopPoles poles = ClosedLoop(p, g).poles(5);
  if (poles.status.outcome() == Outcome::outside_validity) return;  // a pole may be far to the left
  RC_ASSERT(poles.status.ok());
  for (const Complex s : poles.s) RC_ASSERT(s.real() < 0);
  RC_ASSERT(distance(p, g, poles.s[*rc::gen::inRange<std::size_t>(0, 5)]) < 5e-12);
}

// Between two successive hub-locked resonances beyond k3/I_hub there is one pole with positive imaginary
// part: up to a high hub-locked resonance there are as many as resonances, or one more or less near the axis.
TEST(ClosedLoopPoles, NoneIsMissed) {
  for (const Gains& g :
       {unit_gains, designed_gains, Gains{12, 0, 1000}, Gains{1e-3, 50, 1e-3}, Gains{1e4, -1.9, 100}}) {
    const ClosedLoop loop(table_3_1(), g);
    const LoopPoles poles = loop.poles(60);
    ASSERT_TRUE(poles.status.ok()) << poles.status.text();
    const Frequencies locked = hub_zeros(loop.plant(), 60);
    for (std::size_t n = 20; n + 1 < 50; ++n) {
      int between_them = 0;
      for (const Complex s : poles.s) {
        if (s.imag() > locked.omega[n] && s.imag() < locked.omega[n + 1]) ++between_them;
      }
      EXPECT_EQ(between_them, 1) << g.k1 << " " << g.k2 << " " << g.k3 << " above " << locked.omega[n];
    }
  }
}

// The damping of high modes of the model without tip: (1 + k2/2) k3 4 sqrt(rho EI) (r + 1/q)^2/(L I_hub^2
// omega), a first order perturbation with the next order left out, about 1 % at n = 5.
TEST(ClosedLoopPoles, AreLessAndLessDamped) {
  const Parameters p = without_tip(table_3_1());
  for (const Gains& g : {unit_gains, designed_gains}) {
    const LoopPoles poles = ClosedLoop(p, g).poles(12);
    for (std::size_t n = 5; n < 12; ++n) {
      const double omega = poles.s[n].imag();
      const double q = std::pow(omega * omega * p.mass_per_length / p.bending_stiffness(), 0.25);
      const double predicted =
          (1 + g.k2 / 2) * g.k3 * 4 * std::sqrt(p.mass_per_length * p.bending_stiffness()) *
          std::pow(p.hub_radius + 1 / q, 2) / (p.length * p.hub_inertia * p.hub_inertia * omega);
      EXPECT_NEAR(-poles.s[n].real() / predicted, 1, 0.02) << n;
    }
  }
}

TEST(ClosedLoopResponse, AgreesWithTheExactPlant) {
  const Parameters p = table_3_1();
  for (const Gains& g : {unit_gains, designed_gains}) {
    const ClosedLoop loop(p, g);
    for (const Complex s : {Complex(0, 1e-8),
                            {0, 1e-3},
                            {0, 1},
                            {0, 52.4},
                            {0, 1e3},
                            {0, 1e5},
                            {0, 1e8},
                            {3, 0},
                            {-200, 0},
                            {-1, 25},
                            {1e-6, 0}}) {
      const oracle::Exact exact = oracle::by_exponentials(p, s, 2);
      const Complex doubled = 1. / (s * s * exact.theta) - p.hub_inertia;
      const Complex load = s * s * (p.hub_inertia + (1 + g.k2 / 2) * doubled),
                    denominator = load + g.k3 * s + g.k1;
      const Complex theta = g.k1 / denominator, y = theta * exact.deflection / exact.theta;
      // Both sides have the rounding error of I_hub + 2B times the condition number.
      const double amplified = (std::abs(load) + std::abs(s * s) * p.hub_inertia) / std::abs(denominator);
      const double allowed = 1e-12 * std::max(1., amplified * exact.theta_condition);
      const LoopResponse response = loop.response(s, 2);
      EXPECT_EQ(response.outcome, Outcome::success);
      EXPECT_LT(std::abs(response.theta - theta), allowed * std::abs(theta)) << s;
      EXPECT_LT(std::abs(response.deflection - y),
                (allowed + 1e-12 * exact.deflection_condition) * std::abs(y))
          << s;
    }
  }
}

TEST(ClosedLoopResponse, ReportsPolesAndBadInput) {
  const ClosedLoop loop(table_3_1(), {1, 0, 0});
  // k3 = 0: the poles lie on the axis.
  const Complex pole = loop.poles(2).s[1];
  EXPECT_NEAR(pole.real(), 0, 1e-13);
  const LoopResponse at = loop.response(Complex(0, pole.imag()));
  EXPECT_TRUE(at.outcome == Outcome::at_pole || std::abs(at.theta) > 1e10);
  EXPECT_EQ(loop.response(Complex(std::nan(""), 0)).outcome, Outcome::non_finite);
  EXPECT_THROW((void)loop.response(1., 4.1), std::invalid_argument);
  EXPECT_EQ(loop.response(0.).theta, Complex(1));
}

/// Zeros of D_0 P with a positive real part, up to 1000 rad/s, for any k2.
int to_the_right(const Gains& g) {
  const Plant plant(table_3_1());
  const AnalyticFunction f = [&](Complex s) {
    const Motion<Jet> motion = plant.appendage().motion_with_slope(s);
    const Jet z = Jet::variable(s);
    return z * z * plant.effective_inertia(motion, 2 + g.k2) + (g.k3 * z + Jet(g.k1)) * motion.determinant;
  };
  const RootCount count = count_roots(f, {1e-7, 300, -10, 1000});
  EXPECT_TRUE(count.status.ok()) << count.status.text();
  return count.count;
}

// Stability condition by counting: the source's k2 > -1 is not necessary, k2 > -2 is.
TEST(Stability, IsWhatTheArgumentPrincipleCounts) {
  EXPECT_EQ(to_the_right({12, 0, 16}), 0);
  EXPECT_EQ(to_the_right({12, -1.5, 16}), 0);
  EXPECT_EQ(to_the_right({12, -1.99, 16}), 0);
  EXPECT_GE(to_the_right({12, -2.01, 16}), 6);
  EXPECT_GE(to_the_right({12, -3, 16}), 6);
}

TEST(ClosedLoop, RefusesBadGainsByName) {
  const auto message = [](const Gains& g) {
    return tests::thrown<std::invalid_argument>([&] { return ClosedLoop(table_3_1(), g); });
  };
  EXPECT_TRUE(tests::holds(message({-1, 0, 1}), "k1 = -1"));
  EXPECT_TRUE(tests::holds(message({1, -2, 1}), "k2 = -2"));
  EXPECT_TRUE(tests::holds(message({1, 0, -0.5}), "k3 = -0.5"));
  EXPECT_TRUE(tests::holds(message({1, std::numeric_limits<double>::infinity(), 1}), "k2"));
  EXPECT_THROW((void)ClosedLoop(table_3_1(), unit_gains).poles(0), std::invalid_argument);
}

// Extreme parameters: all poles are found, none in the right half plane, each a zero of the exact
// characteristic function.
TEST(ClosedLoop, StandsExtremes) {
  struct Case {
    const char* name;
    Parameters parameters;
    Gains gains;
  };
  const auto with = [](double Parameters::*field, double value) {
    Parameters p = table_3_1();
    p.*field = value;
    return p;
  };
  const Case cases[] = {{"no tip", without_tip(table_3_1()), designed_gains},
                        {"tip of 1e6 slug", with(&Parameters::tip_mass, 1e6), designed_gains},
                        {"hub of 1e-9", with(&Parameters::hub_inertia, 1e-9), designed_gains},
                        {"no hub", with(&Parameters::hub_inertia, 0), unit_gains},
                        {"hub of 1e9", with(&Parameters::hub_inertia, 1e9), designed_gains},
                        {"appendage of 400 ft", with(&Parameters::length, 400), designed_gains},
                        {"appendage of 0.04 ft", with(&Parameters::length, 0.04), designed_gains},
                        {"k2 next to -2", table_3_1(), {12, -2 + 1e-9, 16}},
                        {"k2 of 1e6", table_3_1(), {12, 1e6, 16}},
                        {"k3 of 1e6", table_3_1(), {12, 0, 1e6}},
                        {"k1 of 1e6", table_3_1(), {1e6, 0, 1}}};
  for (const Case& c : cases) {
    const LoopPoles poles = ClosedLoop(c.parameters, c.gains).poles(8);
    ASSERT_TRUE(poles.status.ok()) << c.name << ": " << poles.status.text();
    for (const Complex s : poles.s) {
      EXPECT_LT(s.real(), 1e-13 * std::abs(s)) << c.name << " " << s;
      EXPECT_LT(distance(c.parameters, c.gains, s), 1e-10) << c.name << " " << s;
    }
  }
}

TEST(ClosedLoop, WithoutGainsHasThePlantsPoles) {
  const ClosedLoop loop(table_3_1(), {0, 0, 0});
  const LoopPoles poles = loop.poles(5);
  const Frequencies open = spacecraft::poles(loop.plant(), 5);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(poles.s[i].imag(), open.omega[i], 1e-12 * open.omega[i]);
    EXPECT_NEAR(poles.s[i].real(), 0, 1e-13 * open.omega[i]);
  }
}

}  // namespace
}  // namespace nlmech::spacecraft::closed_loop_test

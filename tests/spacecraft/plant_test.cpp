/// Exact transfer functions against 110 digits, their properties, extreme parameters; frequencies with
/// Timoshenko's beam. The scenes of figures 3.3 to 3.8 record known values.
#include "nlmech/spacecraft/plant/plant.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "nlmech/spacecraft/plant/poles.hpp"
#include "nlmech/spacecraft/plant/timoshenko.hpp"
#include "tests/spacecraft/oracle.hpp"
#include "tests/spacecraft/random_spacecraft.hpp"
#include "tests/thrown.hpp"

namespace nlmech::spacecraft::plant_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Error bound of the class: 1e-14 of the value, times its condition number if that exceeds 1; the rounding
/// error of a few dozen operations.
void expect_exact(const Plant& plant, Complex s, double x) {
  const oracle::Exact e = oracle::by_exponentials(plant.parameters(), s, x);
  const Response r = plant.response(s, x);
  EXPECT_EQ(r.outcome, Outcome::success) << s << " " << x;
  EXPECT_LE(std::abs(r.theta - e.theta), 1e-14 * std::max(1., e.theta_condition) * std::abs(e.theta)) << s;
  EXPECT_LE(std::abs(r.deflection - e.deflection),
            1e-14 * std::max(1., e.deflection_condition) * std::abs(e.deflection))
      << s << " " << x;
}

std::array<Parameters, 2> both() { return {without_tip(table_3_1()), table_3_1()}; }

TEST(Plant, TwoOraclesAgree) {
  for (const Parameters& p : both()) {
    for (const Complex s :
         {Complex(0, 0.1), Complex(0, 1000), Complex(3, 0), Complex(-200, 0), Complex(-1, 25)}) {
      const auto a = oracle::by_exponentials(p, s, 2), b = oracle::by_hyperbolics(p, s, 2);
      // Two roundings to double.
      EXPECT_LE(std::abs(a.theta - b.theta), 4e-16 * std::abs(a.theta)) << s;
      EXPECT_LE(std::abs(a.deflection - b.deflection), 4e-16 * std::abs(a.deflection)) << s;
    }
  }
}

TEST(Plant, IsExactOnTheImaginaryAxis) {
  for (const Parameters& p : both()) {
    const Plant plant(p);
    for (int i = -24; i <= 24; ++i) {
      const double omega = std::pow(10, i / 3.), x = i % 3 == 0 ? 4 : i % 3 == 1 ? 2 : 1e-3;
      expect_exact(plant, {0, omega}, x);
    }
  }
}

TEST(Plant, IsExactForRealSOfBothSigns) {
  for (const Parameters& p : both()) {
    const Plant plant(p);
    for (int i = -12; i <= 16; ++i) {
      const double s = std::pow(10, i / 2.);
      expect_exact(plant, i % 2 == 0 ? s : -s, i % 3 == 0 ? 4 : 2);
    }
  }
}

TEST(Plant, IsExactInThePlane) {
  for (const Parameters& p : both()) {
    const Plant plant(p);
    for (int i = 0; i <= 32; ++i) {
      const double size = std::pow(10, -8 + i / 2.), angle = 0.1 + 2.399963 * i;
      expect_exact(plant, std::polar(size, angle), i % 3 == 0 ? 4 : 1.7);
    }
    // Both sides of the change from series to waves, |beta|^(1/4) L = 2.5.
    const double change = 6.25 / std::sqrt(plant.appendage().beta_unit());
    for (const double near : {0.999, 1.001})
      for (const double angle : {0., 0.7, 1.5}) expect_exact(plant, std::polar(near * change, angle), 2);
  }
}

RC_GTEST_PROP(Plant, OfAnySpacecraftIsExact, ()) {
  const Plant plant(*random_spacecraft());
  const double unit = 1 / std::sqrt(plant.appendage().beta_unit());
  const double size = unit * std::pow(10, *between(-4, 4)), angle = *between(0, 6.28);
  const Complex s = *rc::gen::arbitrary<bool>() ? Complex(0, size) : std::polar(size, angle);
  const double x = *between(0.01, 1) * plant.parameters().length;
  const oracle::Exact e = oracle::by_exponentials(plant.parameters(), s, x);
  const Response r = plant.response(s, x);
  RC_ASSERT(std::abs(r.theta - e.theta) <= 1e-14 * std::max(1., e.theta_condition) * std::abs(e.theta));
  RC_ASSERT(std::abs(r.deflection - e.deflection) <=
            1e-14 * std::max(1., e.deflection_condition) * std::abs(e.deflection));
}

// B and g_3 depend on s^2 only and are real for real s: bitwise.
RC_GTEST_PROP(Plant, IsEvenAndReal, ()) {
  const Plant plant(*random_spacecraft());
  const Complex s = std::polar(std::pow(10, *between(-3, 4)), *between(0.1, 1.5));
  const double x = *between(0, 1) * plant.parameters().length;
  const Response r = plant.response(s, x), minus = plant.response(-s, x),
                 mirror = plant.response(std::conj(s), x);
  RC_ASSERT(minus.theta == r.theta);
  RC_ASSERT(minus.deflection == r.deflection);
  RC_ASSERT(std::abs(mirror.theta - std::conj(r.theta)) <= 1e-13 * std::abs(r.theta));
  RC_ASSERT(std::abs(mirror.deflection - std::conj(r.deflection)) <= 1e-12 * std::abs(r.deflection));
}

// The polynomial that follows from four integrations of rho (r + x)/J and the loads of the tip.
TEST(Plant, HasTheStaticLimits) {
  for (const Parameters& p : both()) {
    const Plant plant(p);
    const double l = p.length, r = p.hub_radius, m = p.tip_mass, rho = p.mass_per_length,
                 j = p.total_inertia();
    EXPECT_NEAR(j, p.has_tip() ? 18.0961 : 10.2475, 1e-13 * j);
    EXPECT_NEAR(p.appendage_inertia(), p.has_tip() ? 5.04805 : 1.12375, 1e-14);
    for (const double x : {0., 1e-6, 0.5, 2., 4.}) {
      const double y = -x * x *
                       (60 * p.tip_inertia + 20 * l * l * l * rho + 60 * l * l * m + 30 * l * l * r * rho -
                        10 * l * l * rho * x + 60 * l * m * r - 20 * l * m * x - 20 * l * r * rho * x -
                        20 * m * r * x + 5 * r * rho * x * x + rho * x * x * x) /
                       (120 * p.bending_stiffness() * j);
      EXPECT_NEAR(plant.static_deflection(x), y, 8e-16 * std::abs(y)) << x;
      EXPECT_NEAR(plant.at_frequency(1e-8, x).deflection, y, 8e-16 * std::abs(y)) << x;
    }
    EXPECT_EQ(plant.rigid_gain(), 1 / j);
    EXPECT_NEAR(plant.at_frequency(1e-7, 2).theta * -1e-14 * j, 1, 4e-15);
  }
}

TEST(Plant, WithoutTipIsTheLimitOfASmallTip) {
  const Plant none(without_tip(table_3_1()));
  for (const double share : {1e-6, 1e-9}) {
    Parameters small = table_3_1();
    small.tip_mass *= share;
    small.tip_inertia *= share;
    for (const double omega : {0.1, 10., 1000.}) {
      const AxisResponse a = none.at_frequency(omega, 2), b = Plant(small).at_frequency(omega, 2);
      // The masses change by 1.5 share of a beam's, the response by that times its condition, below 60 here.
      EXPECT_NEAR(b.theta / a.theta, 1, 100 * share) << omega;
      EXPECT_NEAR(b.deflection / a.deflection, 1, 100 * share) << omega;
    }
  }
  // A tip of mass 0 is evaluated without tip terms: no 0 times infinity.
  Parameters zero = table_3_1();
  zero.tip_mass = zero.tip_inertia = 0;
  EXPECT_EQ(Plant(zero).at_frequency(1e8, 2).theta, none.at_frequency(1e8, 2).theta);
}

// Real and complex arithmetic on the axis; |s G'/G| is below 100 at these frequencies.
TEST(Plant, RealAndComplexArithmeticAgree) {
  for (const Parameters& p : both()) {
    const Plant plant(p);
    for (const double omega : {1e-3, 1., 30., 90., 500.}) {
      const AxisResponse a = plant.at_frequency(omega, 3);
      const Motion<Complex> m = plant.appendage().motion({0, omega});
      const Complex sum = plant.effective_inertia(m);
      EXPECT_LE(std::abs(m.determinant / (-omega * omega * sum) / a.theta - 1.), 1e-13) << omega;
      EXPECT_LE(std::abs(plant.appendage().deflection(m, 3) / sum / a.deflection - 1.), 1e-13) << omega;
    }
  }
}

// Both evaluations are accurate where the ranges meet; outside its range each loses digits.
TEST(Plant, SeriesAndWavesMeet) {
  for (const Parameters& p : both()) {
    const Appendage a(p);
    const auto difference = [&](Complex s) {
      const Motion<Complex> series = a.motion(s, Evaluation::krylov), waves = a.motion(s, Evaluation::waves);
      const Complex y1 = a.deflection(series, 3) / series.determinant,
                    y2 = a.deflection(waves, 3) / waves.determinant;
      return std::abs(y1 / y2 - 1.);
    };
    const double unit = 1 / std::sqrt(a.beta_unit());
    for (const double q : {2., 2.5, 3.2})
      for (const double angle : {0., 0.8, 1.4, 2.9})
        EXPECT_LE(difference(std::polar(q * q * unit, angle)), 1e-12);
    EXPECT_GT(difference(std::polar(1e-8 * unit, 0.8)), 1e-9);
    EXPECT_GT(difference(std::polar(400 * unit, 1.4)), 1e-6);
  }
}

TEST(Plant, MomentAndShearHoldTheBoundaryConditions) {
  for (const Parameters& p : both()) {
    const Appendage a(p);
    for (const Complex s : {Complex(0, 0.01), Complex(0, 40), Complex(7, 3), Complex(-2, 400)}) {
      const Complex z = s * s, root = (p.hub_radius * a.shear(s, 0) - a.moment(s, 0)) / z, b = a.inertia(s);
      // 256 eps of the terms: condition numbers are below 100.
      EXPECT_LE(std::abs(root - b), 6e-14 * std::abs(b)) << s;
      const Complex w = p.hub_radius + p.length + a.deflection(s, p.length), turn = 1. + a.slope(s, p.length);
      EXPECT_LE(std::abs(a.shear(s, p.length) - z * p.tip_mass * w), 1e-12 * std::abs(a.shear(s, 0))) << s;
      EXPECT_LE(std::abs(a.moment(s, p.length) + z * p.tip_inertia * turn), 1e-12 * std::abs(a.moment(s, 0)))
          << s;
      // Slope, moment and shear are derivatives of the quantity before: central differences with errors h^2
      // and eps/h.
      const double h = 1e-4, x = 1.7;
      const auto slope = (a.deflection(s, x + h) - a.deflection(s, x - h)) / (2 * h);
      EXPECT_LE(std::abs(slope - a.slope(s, x)), 1e-6 * std::abs(slope)) << s;
      const auto bend = p.bending_stiffness() * (a.slope(s, x + h) - a.slope(s, x - h)) / (2 * h);
      EXPECT_LE(std::abs(bend - a.moment(s, x)), 1e-6 * std::abs(a.moment(s, 0))) << s;
      const auto force = (a.moment(s, x + h) - a.moment(s, x - h)) / (2 * h);
      EXPECT_LE(std::abs(force - a.shear(s, x)), 1e-6 * std::abs(a.shear(s, 0))) << s;
    }
  }
}

// d/ds by Jet against the limit of differences.
TEST(Plant, SlopesAreDerivatives) {
  const Plant plant(table_3_1());
  for (const Complex s : {Complex(0.3, 5), Complex(-20, 100), Complex(0, 700)}) {
    const Motion<Jet> m = plant.appendage().motion_with_slope(s);
    const Jet theta = m.determinant / (Jet::variable(s) * Jet::variable(s) * plant.effective_inertia(m));
    const Jet y = plant.appendage().deflection(m, 2) / plant.effective_inertia(m);
    const oracle::Exact e = oracle::by_exponentials(plant.parameters(), s, 2);
    EXPECT_NEAR(std::abs(s * theta.slope / theta.value) / e.theta_condition, 1, 1e-11) << s;
    EXPECT_NEAR(std::abs(s * y.slope / y.value) / e.deflection_condition, 1, 1e-11) << s;
  }
}

TEST(Plant, KnowsItsPoles) {
  const Plant plant(table_3_1());
  const Response zero = plant.response(0., 2);
  EXPECT_EQ(zero.outcome, Outcome::at_pole);
  EXPECT_EQ(std::abs(zero.theta), infinity);
  EXPECT_NEAR(zero.deflection.real(), plant.static_deflection(2), 1e-18);
  EXPECT_EQ(plant.response({0, 1e-170}, 2).outcome, Outcome::at_pole);
  EXPECT_EQ(plant.response(1e-170, 2).outcome, Outcome::at_pole);
  for (const double omega : {6.4529599657490975, 52.081778965979}) {
    // The double nearest to the pole, by bisection of the sign change.
    double low = omega * (1 - 1e-10), high = omega * (1 + 1e-10);
    const bool rising = plant.at_frequency(low, 2).theta < plant.at_frequency(high, 2).theta;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      ((plant.at_frequency(middle, 2).theta > 0) == rising ? high : low) = middle;
    }
    EXPECT_EQ(plant.at_frequency(high, 2).outcome, Outcome::at_pole) << omega;
    EXPECT_EQ(plant.response({0, high}, 2).outcome, Outcome::at_pole) << omega;
    EXPECT_EQ(plant.at_frequency(omega * (1 + 1e-9), 2).outcome, Outcome::success) << omega;
    const Status status = plant.status(Outcome::at_pole, {0, high});
    EXPECT_TRUE(tests::holds(status.sentence(), "pole"));
  }
}

// At a resonance of the locked hub B and g_3 are infinite; theta/u is 0, y/u is not.
TEST(Plant, PassesTheResonancesOfTheLockedHub) {
  const Plant plant(table_3_1());
  const double omega = 51.39836909583;
  expect_exact(plant, {0, omega}, 2);
  EXPECT_LT(std::abs(plant.at_frequency(omega, 2).theta), 1e-15);
  EXPECT_GT(std::abs(plant.at_frequency(omega, 2).deflection), 1e-5);
}

TEST(Plant, TakesSeveralPlaces) {
  const Plant plant(table_3_1());
  const std::array<double, 3> x = {0., 1.3, 4.};
  std::array<Complex, 3> y;
  Complex theta;
  for (const Complex s : {Complex(0, 33), Complex(-0.5, 33)}) {
    EXPECT_EQ(plant.response(s, x, theta, y), Outcome::success);
    EXPECT_EQ(y[0], Complex(0));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(y[i], plant.response(s, x[i]).deflection);
    EXPECT_EQ(theta, plant.response(s).theta);
  }
  EXPECT_THROW((void)plant.response(1., x, theta, std::span(y).first(2)), std::invalid_argument);
}

TEST(Plant, StandsExtremeData) {
  for (const double mass : {0., 1e-12, 1e6}) {
    for (const double hub : {0., 1e9}) {
      for (const double length : {1e-3, 1e4}) {
        Parameters p = table_3_1();
        p.tip_mass = mass;
        p.hub_inertia = hub;
        p.length = length;
        const Plant plant(p);
        const double unit = 1 / std::sqrt(plant.appendage().beta_unit());
        for (const double q : {1e-3, 2.4, 2.6, 300.}) {
          expect_exact(plant, {0, q * q * unit}, length / 2);
          expect_exact(plant, std::polar(q * q * unit, 0.8), length);
        }
      }
    }
  }
}

TEST(Plant, ReportsWhatIsNotFinite) {
  const Plant plant(table_3_1());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Complex s :
       {Complex(0, nan), Complex(nan, 1), Complex(0, infinity), Complex(1, 1e200), Complex(0, 1e200)}) {
    const Response r = plant.response(s, 2);
    EXPECT_EQ(r.outcome, Outcome::non_finite) << s;
    EXPECT_FALSE(plant.status(r.outcome, s).ok());
  }
}

TEST(Plant, RefusesUnphysicalDataByName) {
  const auto refused = [](double Parameters::*field, double value, const std::string& name) {
    Parameters p = table_3_1();
    p.*field = value;
    EXPECT_TRUE(tests::holds(tests::thrown<std::invalid_argument>([&] { return Plant(p); }), name)) << value;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {-1., nan, infinity}) {
    refused(&Parameters::hub_inertia, bad, "hub_inertia");
    refused(&Parameters::mass_per_length, bad, "mass_per_length");
    refused(&Parameters::youngs_modulus, bad, "youngs_modulus");
    refused(&Parameters::length, bad, "length");
    refused(&Parameters::hub_radius, bad, "hub_radius");
    refused(&Parameters::second_moment, bad, "second_moment");
    refused(&Parameters::tip_mass, bad, "tip_mass");
    refused(&Parameters::tip_inertia, bad, "tip_inertia");
  }
  refused(&Parameters::length, 0, "length");
  refused(&Parameters::second_moment, 0, "second_moment");
  const Plant plant(table_3_1());
  for (const double x : {-1e-9, 4.0001, nan}) {
    EXPECT_THROW((void)plant.response({0, 1}, x), std::invalid_argument);
    EXPECT_THROW((void)plant.at_frequency(1, x), std::invalid_argument);
    EXPECT_THROW((void)plant.appendage().moment({0, 1}, x), std::invalid_argument);
  }
}

// ---- Timoshenko's beam: its limit, an independent transition matrix, and the frequency shift.

using Wide = long double;

/// Aluminium: 5.24 slug/ft^3 and nu = 0.33, a strip.
ShearBeam strip(const Parameters& p) { return solid_section(p, 5.24, 0.33, 5. / 6); }

/// (I_hub + 2B) times the determinant of the tip conditions at s = j omega: no poles, and 0 at the
/// frequencies. Transition matrix of (w, psi, M, V) by the classical Runge-Kutta method in long double; B
/// from the momentum of all parts, whose integral is the fifth state.
Wide characteristic(const Parameters& p, const ShearBeam& b, double omega, int steps) {
  using State = std::array<Wide, 5>;
  const Wide z = -Wide(omega) * omega, ei = Wide(p.youngs_modulus) * p.second_moment;
  const auto derivative = [&](const State& a, Wide x) {
    return State{a[1] + a[3] / b.shear_stiffness, a[2] / ei, z * b.rotary_inertia * a[1] - a[3],
                 z * p.mass_per_length * a[0],
                 p.mass_per_length * (p.hub_radius + x) * a[0] + b.rotary_inertia * a[1]};
  };
  const auto plus = [](State u, const State& v, Wide f) {
    for (std::size_t k = 0; k < 5; ++k) u[k] += f * v[k];
    return u;
  };
  const auto at_tip = [&](State a) {
    const Wide h = Wide(p.length) / steps;
    for (int i = 0; i < steps; ++i) {
      const Wide x = i * h;
      const State k1 = derivative(a, x), k2 = derivative(plus(a, k1, h / 2), x + h / 2),
                  k3 = derivative(plus(a, k2, h / 2), x + h / 2), k4 = derivative(plus(a, k3, h), x + h);
      a = plus(plus(plus(plus(a, k1, h / 6), k2, h / 3), k3, h / 3), k4, h / 6);
    }
    return a;
  };
  const State rigid = at_tip({p.hub_radius, 1, 0, 0, 0}), moment = at_tip({0, 0, 1, 0, 0}),
              shear = at_tip({0, 0, 0, 1, 0});
  const auto of_moment = [&](const State& a) { return a[2] + z * p.tip_inertia * a[1]; };
  const auto of_shear = [&](const State& a) { return a[3] + z * p.tip_mass * a[0]; };
  const Wide determinant = of_moment(moment) * of_shear(shear) - of_moment(shear) * of_shear(moment);
  const Wide m0 = of_moment(shear) * of_shear(rigid) - of_moment(rigid) * of_shear(shear),
             v0 = of_moment(rigid) * of_shear(moment) - of_moment(moment) * of_shear(rigid);
  const auto momentum = [&](const State& a) {
    return a[4] + p.tip_mass * Wide(p.hub_radius + p.length) * a[0] + p.tip_inertia * a[1];
  };
  return determinant * (p.hub_inertia + 2 * momentum(rigid)) +
         2 * (m0 * momentum(moment) + v0 * momentum(shear));
}

// A strip, and beams with so little shear stiffness and so much rotary inertia that neither is a correction,
// and the second kind of wave propagates, above sqrt(50/0.02) = 50 rad/s.
TEST(Timoshenko, FrequenciesAreThoseOfTheTransitionMatrix) {
  for (const Parameters& p : {table_3_1(), without_tip(table_3_1())}) {
    for (const ShearBeam& b : {strip(p), ShearBeam{30, 0.01}, ShearBeam{10, 0.}, ShearBeam{50, 0.02}}) {
      const std::vector<double> found = timoshenko_frequencies(p, b, 7, 1e4);
      ASSERT_EQ(found.size(), 7U) << b.shear_stiffness;
      // Classical Runge and Kutta with wave numbers up to 15 per length: (15/4000)^4/120 and a condition of
      // 100.
      for (const double omega : std::span(found).first(6))
        EXPECT_LT(
            characteristic(p, b, omega * (1 - 1e-9), 4000) * characteristic(p, b, omega * (1 + 1e-9), 4000),
            0)
            << omega << " " << b.shear_stiffness;
      // No frequency is missed: the number of sign changes up to the middle of the last two.
      const double step = (found[5] + found[6]) / 2 / 400;
      int changes = 0;
      for (int i = 1; i < 400; ++i)
        changes += characteristic(p, b, i * step, 200) * characteristic(p, b, (i + 1) * step, 200) < 0;
      EXPECT_EQ(changes, 6) << b.shear_stiffness;
    }
  }
}

TEST(Timoshenko, TendsToEulerAndBernoulli) {
  for (const Parameters& p : {table_3_1(), without_tip(table_3_1())}) {
    const std::vector<double> exact = poles(Plant(p), 10).omega,
                              found = timoshenko_frequencies(p, {1e18, 0}, 10, 1e5);
    ASSERT_EQ(found.size(), 10U);
    for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(found[i] / exact[i], 1, 1e-12) << i;
    // Linear in both terms: a tenth of them gives a tenth of the shift.
    const ShearBeam b = strip(p), tenth{10 * b.shear_stiffness, b.rotary_inertia / 10};
    const std::vector<double> one = timoshenko_frequencies(p, b, 10, 1e5),
                              part = timoshenko_frequencies(p, tenth, 10, 1e5);
    for (std::size_t i = 0; i < 10; ++i)
      EXPECT_NEAR((part[i] - exact[i]) / (one[i] - exact[i]), 0.1, 1e-3) << i;
  }
}

// For a free wave omega = omega_EB (1 - q^2 (rho_I/rho + EI/(kappa G A))/2), q the wave number: without tip
// high modes come near it.
TEST(Timoshenko, ShiftsHighModesAsAWave) {
  const Parameters p = without_tip(table_3_1());
  const ShearBeam b = strip(p);
  const std::vector<double> exact = poles(Plant(p), 20).omega, found = timoshenko_frequencies(p, b, 20, 1e5);
  ASSERT_EQ(found.size(), 20U);
  const double square = exact[19] * std::sqrt(p.mass_per_length / p.bending_stiffness());
  const double shift =
      -square / 2 * (b.rotary_inertia / p.mass_per_length + p.bending_stiffness() / b.shear_stiffness);
  EXPECT_NEAR((found[19] / exact[19] - 1) / shift, 1, 0.1);
  EXPECT_NEAR(found[9] / exact[9] - 1, -1e-3, 2e-4);
}

TEST(Timoshenko, RefusesUnphysicalDataByName) {
  const Parameters p = table_3_1();
  const auto refused = [](const auto& make, const char* name) {
    EXPECT_TRUE(tests::holds(tests::thrown<std::invalid_argument>(make), name));
  };
  refused([&] { return timoshenko_frequencies(p, {0, 0}, 1, 1); }, "shear_stiffness");
  refused([&] { return timoshenko_frequencies(p, {1, -1}, 1, 1); }, "rotary_inertia");
  refused([&] { return timoshenko_frequencies(p, strip(p), 0, 1); }, "0 frequencies");
  refused([&] { return solid_section(p, 0, 0.3, 1); }, "density");
  refused([&] { return solid_section(p, 5, 0.7, 1); }, "Poisson");
  refused([&] { return solid_section(p, 5, 0.3, 0); }, "shear_coefficient");
}

}  // namespace
}  // namespace nlmech::spacecraft::plant_test

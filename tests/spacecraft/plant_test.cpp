/// Exact transfer functions: 110 digits, properties, extremes. The scenes of figures 3.3 to 3.8 hold known
/// values.
#include "nlmech/spacecraft/plant/plant.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>

#include "tests/spacecraft/oracle.hpp"
#include "tests/spacecraft/random_spacecraft.hpp"

namespace nlmech::spacecraft::plant_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What the class promises, 1e-14 of the value, times its condition where that is above 1: the rounding of a
/// few dozen operations.
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
    // Either side of the change from series to waves, |beta|^(1/4) L = 2.5.
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

// B and g_3 depend on s^2 alone and are real for real s: bit by bit.
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
  // And a tip of mass 0 is evaluated without any tip term: not even a tip of 0 times infinity.
  Parameters zero = table_3_1();
  zero.tip_mass = zero.tip_inertia = 0;
  EXPECT_EQ(Plant(zero).at_frequency(1e8, 2).theta, none.at_frequency(1e8, 2).theta);
}

// On the axis two programs, in real and in complex arithmetic; |s G'/G| is below 100 at these frequencies.
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

// Where they meet both evaluations are right; far from there each loses what the other keeps.
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
      // 256 eps of the terms: conditions of these quantities are below 100.
      EXPECT_LE(std::abs(root - b), 6e-14 * std::abs(b)) << s;
      const Complex w = p.hub_radius + p.length + a.deflection(s, p.length), turn = 1. + a.slope(s, p.length);
      EXPECT_LE(std::abs(a.shear(s, p.length) - z * p.tip_mass * w), 1e-12 * std::abs(a.shear(s, 0))) << s;
      EXPECT_LE(std::abs(a.moment(s, p.length) + z * p.tip_inertia * turn), 1e-12 * std::abs(a.moment(s, 0)))
          << s;
      // Slope, moment and shear are derivatives of what comes before: central differences, error h^2 and
      // eps/h.
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

// d/ds by Jet against the limit of differences of the same functions.
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
    // The double nearest to the pole: found by halving the bracket of the sign change.
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
    EXPECT_NE(status.sentence().find("pole"), std::string::npos);
  }
}

// On a resonance of the locked hub B and g_3 are infinite, theta/u is 0 and y/u is not.
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
  EXPECT_THROW(static_cast<void>(plant.response(1., x, theta, std::span(y).first(2))), std::invalid_argument);
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
    try {
      const Plant plant(p);
      ADD_FAILURE() << name << " = " << value << " was accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
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
    EXPECT_THROW(static_cast<void>(plant.response({0, 1}, x)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(plant.at_frequency(1, x)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(plant.appendage().moment({0, 1}, x)), std::invalid_argument);
  }
}

}  // namespace
}  // namespace nlmech::spacecraft::plant_test

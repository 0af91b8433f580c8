/// Timoshenko's beam: its limit, an independent transition matrix, the size of the shift.
#include "nlmech/spacecraft/plant/timoshenko.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "nlmech/spacecraft/plant/poles.hpp"
#include "tests/spacecraft/random_spacecraft.hpp"

namespace nlmech::spacecraft::timoshenko_test {
namespace {

using Wide = std::complex<long double>;

/// Aluminium: 5.24 slug/ft^3 and nu = 0.33, a strip.
ShearBeam strip(const Parameters& p) { return solid_section(p, 5.24, 0.33, 5. / 6); }

/// theta/u and y(x)/u from the transition matrix of (w, psi, M, V), by steps of Taylor's series in long
/// double, and the balance of the hub by the momentum of all parts: w and psi are integrated as fifth and
/// sixth state.
std::array<Wide, 2> by_transition(const Parameters& p, const ShearBeam& b, std::complex<double> s,
                                  double place) {
  const Wide z = Wide(s.real(), s.imag()) * Wide(s.real(), s.imag());
  const long double ei = static_cast<long double>(p.youngs_modulus) * p.second_moment;
  using State = std::array<Wide, 5>;
  const auto derivative = [&](const State& a, long double x) {
    return State{a[1] + a[3] / static_cast<long double>(b.shear_stiffness), a[2] / ei,
                 z * static_cast<long double>(b.rotary_inertia) * a[1] - a[3],
                 z * static_cast<long double>(p.mass_per_length) * a[0],
                 static_cast<long double>(p.mass_per_length) * (p.hub_radius + x) * a[0] +
                     static_cast<long double>(b.rotary_inertia) * a[1]};
  };
  const auto carry = [&](State a, double end) {
    // Gauss's implicit rule would do; the classical one of order 4 in 4000 steps leaves 1e-12.
    const int steps = 4000;
    const long double h = static_cast<long double>(end) / steps;
    for (int i = 0; i < steps; ++i) {
      const long double x = i * h;
      const auto plus = [](const State& u, const State& v, long double f) {
        State sum = u;
        for (std::size_t k = 0; k < 5; ++k) sum[k] += f * v[k];
        return sum;
      };
      const State k1 = derivative(a, x), k2 = derivative(plus(a, k1, h / 2), x + h / 2),
                  k3 = derivative(plus(a, k2, h / 2), x + h / 2), k4 = derivative(plus(a, k3, h), x + h);
      for (std::size_t k = 0; k < 5; ++k) a[k] += h / 6 * (k1[k] + 2.L * k2[k] + 2.L * k3[k] + k4[k]);
    }
    return a;
  };
  const State rigid = {Wide(p.hub_radius), 1, 0, 0, 0}, moment = {0, 0, 1, 0, 0}, shear = {0, 0, 0, 1, 0};
  const auto m = static_cast<long double>(p.tip_mass), j = static_cast<long double>(p.tip_inertia);
  const auto end = [&](const State& a) {
    return std::array<Wide, 2>{a[2] + z * j * a[1], a[3] + z * m * a[0]};
  };
  const State e0 = carry(rigid, p.length), e1 = carry(moment, p.length), e2 = carry(shear, p.length);
  const auto r0 = end(e0), r1 = end(e1), r2 = end(e2);
  const Wide determinant = r1[0] * r2[1] - r2[0] * r1[1];
  const Wide m0 = (r2[0] * r0[1] - r0[0] * r2[1]) / determinant,
             v0 = (r0[0] * r1[1] - r1[0] * r0[1]) / determinant;
  const auto total = [&](std::size_t k) { return e0[k] + m0 * e1[k] + v0 * e2[k]; };
  const Wide one = total(4) + m * static_cast<long double>(p.hub_radius + p.length) * total(0) + j * total(1);
  const Wide theta = 1.L / (z * (static_cast<long double>(p.hub_inertia) + 2.L * one));
  const Wide w = carry(rigid, place)[0] + m0 * carry(moment, place)[0] + v0 * carry(shear, place)[0];
  return {theta, (w - static_cast<long double>(p.hub_radius + place)) * theta};
}

TEST(Timoshenko, IsTheSolutionOfItsEquations) {
  for (const Parameters& p : {table_3_1(), without_tip(table_3_1())}) {
    // A strip, and a beam so soft in shear and heavy in rotation that neither is a correction.
    for (const ShearBeam& b : {strip(p), ShearBeam{30, 0.01}, ShearBeam{10, 0.}}) {
      const TimoshenkoPlant plant(p, b);
      for (const Complex s :
           {Complex(0, 0.3), Complex(0, 20), Complex(0, 70), Complex(4, 0), Complex(-15, 35)}) {
        const Response r = plant.response(s, 2.5);
        const auto e = by_transition(p, b, s, 2.5);
        const Complex theta(static_cast<double>(e[0].real()), static_cast<double>(e[0].imag())),
            y(static_cast<double>(e[1].real()), static_cast<double>(e[1].imag()));
        // Classical Runge and Kutta with wave numbers up to 15 per length: (15/4000)^4/120 and a condition of
        // 100.
        EXPECT_LE(std::abs(r.theta / theta - 1.), 1e-9) << s << " " << b.shear_stiffness;
        EXPECT_LE(std::abs(r.deflection / y - 1.), 1e-8) << s << " " << b.shear_stiffness;
      }
    }
  }
}

TEST(Timoshenko, TendsToEulerAndBernoulli) {
  for (const Parameters& p : {table_3_1(), without_tip(table_3_1())}) {
    const Plant thin(p);
    const TimoshenkoPlant rigid(p, {1e18, 0});
    for (const Complex s :
         {Complex(0, 1e-6), Complex(0, 17), Complex(0, 300), Complex(5, 0), Complex(-100, 50)}) {
      const Response a = rigid.response(s, 2), b = thin.response(s, 2);
      EXPECT_LE(std::abs(a.theta / b.theta - 1.), 1e-12) << s;
      EXPECT_LE(std::abs(a.deflection / b.deflection - 1.), 1e-12) << s;
    }
    const std::vector<double> exact = poles(thin, 10).omega, found = rigid.poles(10, 1e5);
    ASSERT_EQ(found.size(), 10U);
    for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(found[i] / exact[i], 1, 1e-12) << i;
    // Linearly in both terms: a tenth of them is a tenth of the shift.
    const ShearBeam b = strip(p), tenth{10 * b.shear_stiffness, b.rotary_inertia / 10};
    const std::vector<double> one = TimoshenkoPlant(p, b).poles(10, 1e5),
                              part = TimoshenkoPlant(p, tenth).poles(10, 1e5);
    for (std::size_t i = 0; i < 10; ++i)
      EXPECT_NEAR((part[i] - exact[i]) / (one[i] - exact[i]), 0.1, 1e-3) << i;
  }
}

// For a free wave omega = omega_EB (1 - q^2 (rho_I/rho + EI/(kappa G A))/2), q the wave number: without tip
// high modes come near it.
TEST(Timoshenko, ShiftsHighModesAsAWave) {
  const Parameters p = without_tip(table_3_1());
  const ShearBeam b = strip(p);
  const std::vector<double> exact = poles(Plant(p), 20).omega, found = TimoshenkoPlant(p, b).poles(20, 1e5);
  ASSERT_EQ(found.size(), 20U);
  const double square = exact[19] * std::sqrt(p.mass_per_length / p.bending_stiffness());
  const double shift =
      -square / 2 * (b.rotary_inertia / p.mass_per_length + p.bending_stiffness() / b.shear_stiffness);
  EXPECT_NEAR((found[19] / exact[19] - 1) / shift, 1, 0.1);
  EXPECT_NEAR(found[9] / exact[9] - 1, -1e-3, 2e-4);
}

// Between two poles lies one resonance of the locked hub: I_hub + 2 B changes sign upwards once at every
// pole.
TEST(Timoshenko, PolesAreSignChanges) {
  const Parameters p = table_3_1();
  const TimoshenkoPlant plant(p, {50, 0.02});
  const std::vector<double> found = plant.poles(15, 1e4);
  ASSERT_EQ(found.size(), 15U);
  for (const double omega : found) {
    const auto sum = [&](double w) { return p.hub_inertia + 2 * plant.inertia({0, w}).real(); };
    EXPECT_LT(sum(omega * (1 - 1e-9)), 0);
    EXPECT_GT(sum(omega * (1 + 1e-9)), 0);
  }
  EXPECT_NEAR(plant.cutoff(), 50, 1e-12);
  EXPECT_EQ(plant.response(0., 2).outcome, Outcome::at_pole);
}

TEST(Timoshenko, RefusesUnphysicalDataByName) {
  const Parameters p = table_3_1();
  const auto sentence = [&](const auto& make) {
    try {
      make();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto has = [&](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(sentence([&] { TimoshenkoPlant(p, {0, 0}); }), "shear_stiffness"));
  EXPECT_TRUE(has(sentence([&] { TimoshenkoPlant(p, {1, -1}); }), "rotary_inertia"));
  EXPECT_TRUE(has(sentence([&] { static_cast<void>(solid_section(p, 0, 0.3, 1)); }), "density"));
  EXPECT_TRUE(has(sentence([&] { static_cast<void>(solid_section(p, 5, 0.7, 1)); }), "Poisson"));
  EXPECT_TRUE(has(sentence([&] { static_cast<void>(solid_section(p, 5, 0.3, 0)); }), "shear_coefficient"));
  EXPECT_THROW(static_cast<void>(TimoshenkoPlant(p, strip(p)).response({0, 1}, 9)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(TimoshenkoPlant(p, strip(p)).poles(0, 1)), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::spacecraft::timoshenko_test

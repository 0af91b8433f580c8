/// Timoshenko's beam: its limit, an independent transition matrix, the size of the shift.
#include "nlmech/spacecraft/plant/timoshenko.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "nlmech/spacecraft/plant/poles.hpp"

namespace nlmech::spacecraft::timoshenko_test {
namespace {

using Wide = long double;

/// Aluminium: 5.24 slug/ft^3 and nu = 0.33, a strip.
ShearBeam strip(const Parameters& p) { return solid_section(p, 5.24, 0.33, 5. / 6); }

/// (I_hub + 2B) times the determinant of the tip's conditions at s = j omega: without poles, and 0 at the
/// frequencies. From the transition matrix of (w, psi, M, V), by the classical Runge-Kutta rule in long
/// double; B by the momentum of all parts, whose integral is the fifth state.
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

// A strip, and beams so soft in shear and heavy in rotation that neither is a correction and the second kind
// of wave travels, above sqrt(50/0.02) = 50 rad/s.
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
      // None is missed: as many changes of sign up to the middle between the last two.
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
    // Linearly in both terms: a tenth of them is a tenth of the shift.
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
    try {
      static_cast<void>(make());
      ADD_FAILURE() << name << " was accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  };
  refused([&] { return timoshenko_frequencies(p, {0, 0}, 1, 1); }, "shear_stiffness");
  refused([&] { return timoshenko_frequencies(p, {1, -1}, 1, 1); }, "rotary_inertia");
  refused([&] { return timoshenko_frequencies(p, strip(p), 0, 1); }, "0 frequencies");
  refused([&] { return solid_section(p, 0, 0.3, 1); }, "density");
  refused([&] { return solid_section(p, 5, 0.7, 1); }, "Poisson");
  refused([&] { return solid_section(p, 5, 0.3, 0); }, "shear_coefficient");
}

}  // namespace
}  // namespace nlmech::spacecraft::timoshenko_test

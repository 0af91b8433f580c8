/// Silent failures of the spacecraft: motion against finite elements and the Bromwich integral, poles and
/// margins against 110 digits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "nlmech/spacecraft/control/margins.hpp"
#include "nlmech/spacecraft/control/optimal_gains.hpp"
#include "nlmech/spacecraft/plant/poles.hpp"
#include "nlmech/spacecraft/response.hpp"
#include "tests/randomised/randomised.hpp"
#include "tests/spacecraft/oracle.hpp"
#include "tests/spacecraft/time_oracle.hpp"

namespace nlmech::spacecraft::spacecraft_test {
namespace {

using randomised::Case;
using randomised::Draw;
using randomised::randomised_test;

constexpr double eps = std::numeric_limits<double>::epsilon();

Parameters drawn_craft(Draw& draw, double decades) {
  Parameters p = table_3_1();
  for (double Parameters::*const field :
       {&Parameters::hub_inertia, &Parameters::mass_per_length, &Parameters::length, &Parameters::hub_radius,
        &Parameters::second_moment, &Parameters::tip_mass, &Parameters::tip_inertia})
    p.*field *= std::pow(10, draw.uniform(-decades, decades));
  if (draw.chance(0.3)) p = without_tip(p);
  if (draw.chance(0.1)) p.hub_radius = 0;
  if (draw.chance(0.05)) p.hub_inertia = 0;
  return p;
}

/// Frequency scale of the appendage.
double rate_of(const Parameters& p) {
  return std::sqrt(p.bending_stiffness() / (p.mass_per_length * std::pow(p.length, 4)));
}

/// Gains from slow to overdamped, or such that two real poles coincide or nearly coincide.
Gains drawn_gains(Draw& draw, const Parameters& p) {
  const double j = p.total_inertia(), rate = rate_of(p);
  Gains g{j * rate * rate * draw.log_uniform(1e-8, 1e4), draw.chance(0.5) ? 0. : draw.uniform(-1.9, 5),
          j * rate * draw.log_uniform(1e-4, 1e4)};
  if (draw.chance(0.1)) g.k2 = draw.log_uniform(1, 1e4);
  if (!draw.chance(0.4)) return g;
  // P = P' = 0 at s = -a: k3 and k1 follow from k2.
  const double a = rate * draw.log_uniform(1e-2, 1e2), h = 1e-4 * a;
  const Appendage appendage(p);
  const auto inertia = [&](double s) {
    return s * s * (p.hub_inertia + (2 + g.k2) * appendage.inertia(Complex(s)).real());
  };
  const double k3 = (inertia(a + h) - inertia(a - h)) / (2 * h), k1 = k3 * a - inertia(a);
  if (!(k1 > 0) || !(k3 > 0)) return g;
  const double off = draw.chance(0.3) ? 0. : draw.signed_log(1e-14, 1e-1);
  return {k1 * (1 + off), g.k2, k3};
}

std::string text_of(const Parameters& p, const Gains& g) {
  return fmt::format(
      "hub {:.17g} rho {:.17g} E {:.17g} L {:.17g} r {:.17g} I {:.17g} m {:.17g} j {:.17g} gains "
      "{:.17g},{:.17g},{:.17g}",
      p.hub_inertia, p.mass_per_length, p.youngs_modulus, p.length, p.hub_radius, p.second_moment, p.tip_mass,
      p.tip_inertia, g.k1, g.k2, g.k3);
}

/// Angle and deflection by another method, with their uncertainties from coarser settings.
struct Known {
  double theta, bent, theta_doubt, bent_doubt;

  [[nodiscard]] std::optional<Known> if_sure() const {
    const bool sure = theta_doubt < 1e-3 * std::abs(theta) && bent_doubt < 0.1 * std::abs(bent);
    return sure ? std::optional(*this) : std::nullopt;
  }
};

/// For early times: the Bromwich integral up to 1000 times the appendage's frequency, which includes ten
/// modes. The truncated part decreases as n^-5 and oscillates with the end of the integral: integrals up to a
/// half and a third must agree, because two may agree by chance. It fails for late times, when weakly damped
/// high modes dominate.
std::optional<Known> by_bromwich(const Parameters& p, const Gains& g, double x, double t) {
  const ClosedLoop loop(p, g);
  const std::array<double, 1> times = {t};
  const auto at = [&](double share) {
    const oracle::BromwichLine line{
        .half_period = 4 * t, .shift = 3 / t, .frequency = share * std::max(1e3 * rate_of(p), 1e3 / t)};
    return std::pair(
        oracle::bromwich([&](Complex s) { return loop.response(s).theta / s; }, times, line)[0],
        oracle::bromwich([&](Complex s) { return loop.response(s, x).deflection / s; }, times, line)[0]);
  };
  const auto [theta, bent] = at(1);
  const auto [half, half_bent] = at(1. / 2);
  const auto [third, third_bent] = at(1. / 3);
  return Known{theta, bent, std::max(std::abs(theta - half), std::abs(theta - third)),
               std::max(std::abs(bent - half_bent), std::abs(bent - third_bent))}
      .if_sure();
}

/// Uncertainty of the oscillations of a mesh of @p elements: the phase error of each from the frequency
/// difference of the two meshes; and all modes above the mesh, where mode n contributes at most n^-5, without
/// decay, because high modes decay last.
oracle::Moved unknown_oscillations(const oracle::StepByElements& mesh, const oracle::StepByElements& coarser,
                                   int elements, double t) {
  const std::vector<oracle::Mode> fine = mesh.modes(), coarse = coarser.modes();
  oracle::Moved unknown{}, strength{};
  for (std::size_t i = 0; i < fine.size(); ++i) {
    double off = HUGE_VAL;
    for (const oracle::Mode& other : coarse) off = std::min(off, std::abs(other.pole - fine[i].pole));
    const double left = std::exp(fine[i].pole.real() * t) * std::min(2., off * t);
    unknown.theta += fine[i].theta * left;
    unknown.deflection += fine[i].deflection * left;
    const double number = static_cast<double>(i) + 1;
    if (number > elements) continue;  // the upper half of a mesh's modes does not approximate the beam
    strength.theta = std::max(strength.theta, fine[i].theta * std::pow(number, 5));
    strength.deflection = std::max(strength.deflection, fine[i].deflection * std::pow(number, 5));
  }
  const double above = 1 / (4 * std::pow(2. * elements, 4));  // remainder of the sum of n^-5
  return {unknown.theta + strength.theta * above, 0, unknown.deflection + strength.deflection * above, 0};
}

/// By finite elements. Two or three meshes with different phases may agree by chance, also in y if the modes
/// that decay last are missing in all of them.
std::optional<Known> by_elements(const Parameters& p, const Gains& g, double x, double t) {
  const oracle::StepByElements mesh(p, g, x, 12), coarser(p, g, x, 8);
  const oracle::Moved a = oracle::StepByElements(p, g, x, 4).at(t), b = coarser.at(t), c = mesh.at(t),
                      unknown = unknown_oscillations(mesh, coarser, 12, t);
  return Known{c.theta, c.deflection,
               std::max({std::abs(a.theta - c.theta), std::abs(b.theta - c.theta), unknown.theta}),
               std::max({std::abs(a.deflection - c.deflection), std::abs(b.deflection - c.deflection),
                         unknown.deflection})}
      .if_sure();
}

// After 2268 s of slow control y has decayed except for modes near the 30th, of 400 to 2000 rad/s, which 12
// elements cannot represent; three meshes agreed by chance to 6.17e-13. Exact poles (mpmath, 40 digits:
// Newton's method on the characteristic function of the beam, residues of 260 pairs) sum to 6.41867e-13.
TEST(SpacecraftOracle, DoesNotKnowModesThatItsMeshLacks) {
  Parameters p = table_3_1();
  p.hub_inertia = 2.6847384549831825;
  p.mass_per_length = 0.035943032513412909;
  p.length = 17.210919530911653;
  p.hub_radius = 0.3837966599145522;
  p.second_moment = 8.9134812944455911e-09;
  p.tip_mass = p.tip_inertia = 0;
  const Gains g{2.7643539413616882e-05, 0, 101.50119777487994};
  const double x = 1.9915827240902859, t = 2267.716361585989;
  EXPECT_FALSE(by_elements(p, g, x, t));
  EXPECT_TRUE(by_elements(p, g, x, 5));
  const std::array<double, 1> places = {x};
  EXPECT_NEAR(step_response(ClosedLoop(p, g), 1, places).deflection[0].value(t), 6.4187e-13, 1e-16);
}

TEST(RandomisedSpacecraft, StepsAgreeWithElements) {
  randomised_test({.quick = 8, .full = 1500, .least_right = 0.3}, [](Draw& draw) {
    const Parameters p = drawn_craft(draw, 1);
    const Gains g = drawn_gains(draw, p);
    const double x = p.length * draw.uniform(0.1, 1);
    const double t = draw.log_uniform(1e-2, 1e3) / rate_of(p);
    const std::array<double, 1> places = {x};
    const TimeResponse r = step_response(ClosedLoop(p, g), 1, places);
    if (!r.status.ok()) return Case::refused(r.status.text());
    if (const Status s = certain_at(r, t); !s.ok()) return Case::refused(s.text());
    const double start = std::max(std::abs(r.theta.value(0)) / 1e-8,
                                  std::abs(r.theta_dot.value(0)) / (1e-2 * r.theta_dot.envelope(0) + 1e-300));
    const double theta = r.theta.value(t), y = r.deflection[0].value(t);
    std::optional<Known> known;
    if (t * rate_of(p) < 10) known = by_bromwich(p, g, x, t);
    if (!known) known = by_elements(p, g, x, t);
    if (!known) return Case::undecided();
    const double ratio =
        std::max({start,
                  std::abs(theta - known->theta) /
                      (30 * known->theta_doubt + 3e-3 * std::abs(known->theta) + 4e-16 * r.theta.envelope(0)),
                  std::abs(y - known->bent) / (30 * known->bent_doubt + 3e-3 * std::abs(known->bent) +
                                               1e-9 * r.deflection[0].envelope(0))});
    return Case::judged(ratio, 1,
                        fmt::format("{} x {:.17g} t {:.17g}: theta {:.10g}, known {:.10g}; y {:.6g}, {:.6g}",
                                    text_of(p, g), x, t, theta, known->theta, y, known->bent));
  });
}

// Poles are zeros of a characteristic function in 110 digits.
TEST(RandomisedSpacecraft, ClosedLoopPolesAreZeros) {
  randomised_test({.quick = 30, .full = 2000, .least_right = 0.5}, [](Draw& draw) {
    const Parameters p = drawn_craft(draw, 1.5);
    const Gains g = drawn_gains(draw, p);
    const ClosedLoop loop(p, g);
    const int count = draw.whole(1, 12);
    const LoopPoles poles = loop.poles(count, draw.chance(0.5) ? PoleOrder::frequency : PoleOrder::modulus);
    if (!poles.status.ok()) return Case::refused(poles.status.text());
    const Complex s = poles.s[static_cast<std::size_t>(draw.whole(0, static_cast<int>(poles.s.size()) - 1))];
    const Complex load = 1. / oracle::by_exponentials(p, s, p.length).theta;  // s^2 (I_hub + 2B)
    const Complex hub = s * s * p.hub_inertia, beams = (1 + g.k2 / 2) * (load - hub);
    const Complex value = hub + beams + g.k3 * s + g.k1;
    const double size = std::abs(hub) + std::abs(load) + std::abs(beams) + std::abs(g.k3 * s) + g.k1;
    // The slope is only a scale and may come from the library; near a double pole it is small.
    const LoopTerms terms = loop.terms(s, {});
    const double slope = std::abs(terms.characteristic.slope / terms.determinant);
    return Case::judged(s.real() > 1e-12 * std::abs(s) ? HUGE_VAL : std::abs(value) / slope,
                        2e-11 * std::abs(s) + 1e-13 * size / slope,
                        fmt::format("{} pole {:.17g}{:+.17g}i", text_of(p, g), s.real(), s.imag()));
  });
}

// Natural frequencies against meshes of twelve and twenty-four elements.
TEST(RandomisedSpacecraft, FrequenciesAreThoseOfElements) {
  randomised_test({.quick = 40, .full = 20'000, .least_right = 0.5}, [](Draw& draw) {
    const Parameters p = drawn_craft(draw, 2);
    const Frequencies f = poles(Plant(p), 4);
    if (!f.status.ok()) return Case::refused(f.status.text());
    const ModalModel a = diagonalise(finite_elements(p, 6)), b = diagonalise(finite_elements(p, 12));
    double ratio = 0;
    for (Eigen::Index i = 0; i < 4; ++i) {
      const double doubt = std::abs(a.omega[i] - b.omega[i]);
      ratio = std::max(ratio, std::abs(f.omega[static_cast<std::size_t>(i)] - b.omega[i]) /
                                  (0.3 * doubt + 1e-8 * b.omega[i]));
    }
    return Case::judged(ratio, 1, text_of(p, {}));
  });
}

// With a delay equal to its margin the loop has a pole on the axis: 1 + L e^(-j omega tau) = 0, L in 110
// digits.
TEST(RandomisedSpacecraft, DelayMarginsReachTheAxis) {
  randomised_test({.quick = 30, .full = 2000, .least_right = 0.3}, [](Draw& draw) {
    const Parameters p = drawn_craft(draw, 1);
    const Gains g = drawn_gains(draw, p);
    const ClosedLoop loop(p, g);
    const Margins m = margins(loop, draw.whole(1, 6));
    if (!m.status.ok()) return Case::refused(m.status.text());
    if (m.crossovers.empty()) return Case::undecided("|L| is above 1 over all the modes looked at");
    double least = HUGE_VAL;
    for (const Crossover& c : m.crossovers) least = std::min(least, c.delay);
    const Crossover& c = draw.one_of(m.crossovers);
    const Complex s(0, c.omega);
    const auto gain = [&](Complex z) {
      const Complex load = 1. / oracle::by_exponentials(p, z, p.length).theta;
      const Complex doubled = load / (z * z) - p.hub_inertia;
      return (g.k1 + g.k3 * z + g.k2 / 2 * z * z * doubled) / load;
    };
    const Complex l = gain(s);
    // |omega dL/domega|, also near a pole, where L changes within a small part of any longer step. omega and
    // some thirty intermediate numbers are rounded to double.
    double condition = 0;
    for (const double step : {1e-7, 1e-9, 1e-11, 1e-13})
      condition = std::max(condition, std::abs(gain(s * (1 + step)) - l) / step);
    const double off = std::abs(1. + l * std::exp(Complex(0, -c.omega * c.delay)));
    if (least < m.delay_margin * (1 - 1e-12)) return Case::wrong(text_of(p, g) + ": not the smallest delay");
    return Case::judged(off, 1e-9 + 32 * eps * condition,
                        fmt::format("{} omega {:.17g}", text_of(p, g), c.omega));
  });
}

// No other gains have a smaller cost; the costs of e and y equal those of the residues in time.
TEST(RandomisedSpacecraft, OptimalGainsAreTheLeast) {
  randomised_test({.quick = 60, .full = 20'000, .least_right = 0.5}, [](Draw& draw) {
    const Parameters p = drawn_craft(draw, 1);
    const CostWeights w{draw.chance(0.2) ? 0. : draw.log_uniform(1e-6, 1e6), draw.log_uniform(1e-6, 1e3)};
    const bool pd = draw.chance(0.5);
    const OptimalGains best = pd ? optimal_pd_gains(p, w) : optimal_gains(p, w);
    Gains other = best.gains;
    const double far = draw.log_uniform(1e-4, 3);
    other.k1 *= std::exp(far * draw.normal());
    other.k3 *= std::exp(far * draw.normal());
    if (!pd) other.k2 = (2 + other.k2) * std::exp(far * draw.normal()) - 2;
    if (other.k2 <= -2) return Case::undecided();
    double excess = (best.cost - cost(p, other, w)) / best.cost;
    if (draw.chance(0.01)) {
      const std::array<double, 1> tip = {p.length};
      const TimeResponse r = step_response(ClosedLoop(p, best.gains), 1, tip);
      if (!r.status.ok()) return Case::refused(r.status.text());
      // Terms of order 1e-9 are neglected; the decay of a pole has an error of some eps of its modulus.
      const StepCosts c = step_costs(p, best.gains, p.length);
      const ExponentialSum error({}, r.theta.poles(), r.theta.weights());
      for (const auto& [sum, exact] :
           {std::pair(&error, c.error), std::pair(&r.deflection[0], c.deflection)}) {
        const SquareIntegral of = square_integral(*sum);
        excess = std::max(excess, 1e-12 * std::abs(of.value - exact) / (1e-6 * exact + of.uncertainty));
      }
    }
    return Case::judged(excess, 1e-12,
                        text_of(p, best.gains) + fmt::format(" W {:.17g} R {:.17g}", w.deflection, w.torque));
  });
}

}  // namespace
}  // namespace nlmech::spacecraft::spacecraft_test

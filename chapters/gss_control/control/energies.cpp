#include <fmt/format.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/grids.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/spacecraft/control/lyapunov.hpp"
#include "nlmech/spacecraft/control/optimal_gains.hpp"
#include "nlmech/spacecraft/plant/discrete_model.hpp"

namespace nlmech::chapters::gss_control::energies {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using spacecraft::DiscreteModel;
using spacecraft::Gains;
using spacecraft::Parameters;

constexpr int modes = 10;

/// Integrals from 0 to infinity of a slew by 1 rad from rest.
struct Integrals {
  double hub = 0;         ///< int I_hub theta'^2/2 dt, lb ft s
  double beams = 0;       ///< int of the energy of both appendages relative to the hub dt, lb ft s
  double error = 0;       ///< int (theta - 1)^2 dt, s
  double dissipated = 0;  ///< int k3 theta'^2 dt, lb ft
};

Integrals integrals(const DiscreteModel& model, const Gains& gains) {
  const spacecraft::DiscreteLoop motion(model, gains, 1, 1);
  const Index n = model.size() + 1;
  const MatrixXd none = MatrixXd::Zero(n, n);
  MatrixXd angle = none, strain = none, kinetic = none;
  angle(0, 0) = 1;
  strain.bottomRightCorner(n - 1, n - 1) = model.stiffness / 2;
  kinetic.bottomRightCorner(n - 1, n - 1) = model.mass / 2;
  const double rate = motion.integral(none, angle);
  return {model.hub_inertia / 2 * rate, motion.integral(strain, kinetic), motion.integral(angle, none),
          gains.k3 * rate};
}

/// The integrals in closed form, for all modes.
Integrals closed_form(const Parameters& p, const Gains& k) {
  const double length = p.length, bending = p.youngs_modulus * p.second_moment;
  // sum 1/omega_n^2 of the hub-locked appendage: the trace of Green's function times the masses.
  const double sum = (p.mass_per_length * std::pow(length, 4) / 12 + p.tip_mass * std::pow(length, 3) / 3 +
                      p.tip_inertia * length) /
                     bending;
  return {p.hub_inertia * k.k1 / (4 * k.k3), k.k1 * k.k1 * sum / (k.k3 * (2 + k.k2)),
          spacecraft::step_costs(p, k, 0).error, k.k1 / 2};
}

struct Set {
  const char* name;
  Gains gains;
};
constexpr std::array sets = {Set{"unit", unit_gains}, Set{"designed", designed_gains}};

Gains with_load(Gains gains, double k2) {
  gains.k2 = k2;
  return gains;
}

void draw(const DiscreteModel& model, scene::Show& show) {
  scene::Panel& panel =
      show.plot("Integrals against {/:Italic k}_2: no extremum where {/:Italic k}_2 changes its sign",
                "{/:Italic k}_2", "integral over that at {/:Italic k}_2 = 0");
  panel.x_range(-2, 4).y_range(0, 4);
  show.figure().columns({"curve", "panel", "x", "y"});
  const Parameters p = craft(true);
  const Integrals zero = closed_form(p, with_load(unit_gains, 0));
  struct Drawn {
    const char *name, *dots;
    double Integrals::*part;
  };
  constexpr std::array parts = {Drawn{"energy of the hub", "ten modes", &Integrals::hub},
                                Drawn{"energy of the beams", "", &Integrals::beams},
                                Drawn{"(θ - θ_f)^2", "", &Integrals::error}};
  for (const Drawn& d : parts)
    panel.curve(d.name, equidistant(-1.9, 4, 119), std::identity(), [&](double k2) {
      return closed_form(p, with_load(unit_gains, k2)).*d.part / (zero.*d.part);
    });
  for (int style = 1; const Drawn& d : parts)
    panel.curve(
        d.dots, std::array{-1.5, -1.0, -0.5, 0.0, 1.0, 2.0, 3.0}, std::identity(),
        [&](double k2) { return integrals(model, with_load(unit_gains, k2)).*d.part / (zero.*d.part); },
        scene::points(style++));
}

/// Integrals of a slew with ten modes and in closed form.
struct Motions {
  std::string of;
  Gains gains;
  Integrals found, exact;

  [[nodiscard]] double k1() const { return gains.k1; }
  [[nodiscard]] double k2() const { return gains.k2; }
  [[nodiscard]] double k3() const { return gains.k3; }
  [[nodiscard]] double hub() const { return found.hub; }
  [[nodiscard]] double beams() const { return found.beams; }
  [[nodiscard]] double error() const { return found.error; }
};

std::vector<Motions> all_motions(const DiscreteModel& model) {
  std::vector<Motions> all;
  for (const Set& set : sets) {
    for (const double k2 : {-0.5, 0.0, 1.0}) {
      const Gains gains = with_load(set.gains, k2);
      all.push_back({fmt::format("{} k1 and k3, k2 = {:g}", set.name, k2), gains, integrals(model, gains),
                     closed_form(craft(true), gains)});
    }
  }
  return all;
}

void check(const Motions& m, scene::Show& show) {
  // Rounding: eps times the ratio of the fastest to the slowest decay rate of ten modes, 2.3e3 to 1.2e-5 1/s.
  show.near("energy of the hub, " + m.of, {m.found.hub, "lb ft s"}, m.exact.hub, 1e-7,
            "I_hub k1/(4 k3) by Parseval's theorem, for any number of modes; rounding of fast motions that "
            "hardly decay");
  show.near("energy of the beams, " + m.of, {m.found.beams, "lb ft s"}, m.exact.beams, 1e-5,
            "k1^2/(k3 (2 + k2)) times the sum of 1/omega_n^2; ten modes leave out 8e-6 of it, for omega_n is "
            "near ((n - 3/2) pi/L)^2 sqrt(EI/rho)");
  show.near("error of the angle, " + m.of, {m.found.error, "s"}, m.exact.error, 1e-7,
            "k3/(2 k1) + (I_hub + (2 + k2) B_0)/(2 k3); rounding as the hub's");
  show.near("dissipated energy, " + m.of, {m.found.dissipated, "lb ft"}, m.exact.dissipated, 1e-7,
            "V(0) = k1/2: all of it, whatever k2");
}

void put(scene::Show& show) {
  const DiscreteModel model =
      spacecraft::assumed_modes(craft(true), modes, spacecraft::ModeFunctions::eigenfunctions);
  draw(model, show);
  const std::vector<Motions> all = all_motions(model);
  show.table(all, {{"k1", &Motions::k1},
                   {"k2", &Motions::k2},
                   {"k3", &Motions::k3},
                   {"energy of the hub (lb ft s)", &Motions::hub, 5},
                   {"energy of the beams (lb ft s)", &Motions::beams, 5},
                   {"(theta - theta_f)^2 (s)", &Motions::error, 5}});
  for (const Motions& m : all) check(m, show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "energies",
           .title = "Energies of the hub and of the beams against the gain on the root load",
           .place = "our own, for two claims of section 3.1.4",
           .content = scene::Content(put)}};
}

}  // namespace nlmech::chapters::gss_control::energies

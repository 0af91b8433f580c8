#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/grids.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/spacecraft/control/lyapunov.hpp"
#include "nlmech/spacecraft/control/parseval.hpp"
#include "nlmech/spacecraft/plant/assumed_modes.hpp"
#include "nlmech/spacecraft/plant/finite_elements.hpp"
#include "nlmech/spacecraft/residues.hpp"
#include "nlmech/spacecraft/response.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::gss_control::energies {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using spacecraft::Complex;
using spacecraft::DiscreteModel;
using spacecraft::Gains;
using spacecraft::Parameters;

constexpr int modes = 10;

/// Of a slew from rest by 1 rad, from 0 to infinity.
struct Integrals {
  double hub = 0;         ///< int I_hub theta'^2/2 dt, lb ft s
  double beams = 0;       ///< int of strain energy and kinetic energy about the hub, both appendages, lb ft s
  double error = 0;       ///< int (theta - 1)^2 dt, s
  double dissipated = 0;  ///< int k3 theta'^2 dt, lb ft
};

/// Integrals of quadratic forms along the motion of a discrete model under the controller,
///
///     M x'' + C x' + K (x - x_f) = 0,  M = diag(I_hub, 0) + kappa/2 M_appendages,  C = diag(k3, 0),
///     K = diag(k1, 0) + kappa/2 K_appendages,
///
/// in coordinates a = Omega U^-1 (x - x_f), b = U^-1 x' with U^T M U = I and U^T K U = Omega^2.
class Motion {
 public:
  Motion(const DiscreteModel& model, const Gains& gains) {
    const double part = (2 + gains.k2) / 2;
    MatrixXd mass = part * model.full_mass(), stiffness = part * model.full_stiffness();
    mass(0, 0) += (1 - part) * model.hub_inertia;
    stiffness(0, 0) += gains.k1;
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> own(stiffness, mass);
    const Index n = mass.rows();
    const VectorXd omega = own.eigenvalues().cwiseSqrt();
    MatrixXd a = MatrixXd::Zero(2 * n, 2 * n);
    a.topRightCorner(n, n) = omega.asDiagonal();
    a.bottomLeftCorner(n, n) = -MatrixXd(omega.asDiagonal());
    a.bottomRightCorner(n, n) = -gains.k3 * own.eigenvectors().row(0).transpose() * own.eigenvectors().row(0);
    const Eigen::EigenSolver<MatrixXd> motions(a);
    rates_ = motions.eigenvalues();
    VectorXd start = VectorXd::Zero(2 * n);
    start.head(n) = omega.asDiagonal() * own.eigenvectors().transpose() * mass.col(0) * -1.;
    const Eigen::MatrixXcd vectors =
        motions.eigenvectors() *
        motions.eigenvectors().partialPivLu().solve(start.cast<Complex>()).asDiagonal();
    displacements_ =
        (own.eigenvectors() * omega.cwiseInverse().asDiagonal()).cast<Complex>() * vectors.topRows(n);
    velocities_ = own.eigenvectors().cast<Complex>() * vectors.bottomRows(n);
  }

  /// int (x - x_f)^T Q (x - x_f) dt.
  [[nodiscard]] double of_displacements(const MatrixXd& q) const { return integral(displacements_, q); }
  /// int x'^T Q x' dt.
  [[nodiscard]] double of_velocities(const MatrixXd& q) const { return integral(velocities_, q); }

 private:
  /// x = sum_i x_i e^(p_i t): each pair leaves -x_i^T Q x_j/(p_i + p_j).
  [[nodiscard]] double integral(const Eigen::MatrixXcd& x, const MatrixXd& q) const {
    const Eigen::MatrixXcd pairs = x.transpose() * q.cast<Complex>() * x;
    Complex sum = 0;
    for (Index i = 0; i < pairs.rows(); ++i) {
      for (Index j = 0; j < pairs.cols(); ++j) sum -= pairs(i, j) / (rates_[i] + rates_[j]);
    }
    return sum.real();
  }

  Eigen::VectorXcd rates_;
  Eigen::MatrixXcd displacements_, velocities_;
};

Integrals integrals(const DiscreteModel& model, const Gains& gains) {
  const Motion motion(model, gains);
  const Index n = model.size() + 1;
  MatrixXd angle = MatrixXd::Zero(n, n), strain = angle, kinetic = angle;
  angle(0, 0) = 1;
  strain.bottomRightCorner(n - 1, n - 1) = model.stiffness / 2;
  kinetic.bottomRightCorner(n - 1, n - 1) = model.mass / 2;
  return {model.hub_inertia / 2 * motion.of_velocities(angle),
          motion.of_displacements(strain) + motion.of_velocities(kinetic), motion.of_displacements(angle),
          gains.k3 * motion.of_velocities(angle)};
}

/// The same in closed form, all modes.
Integrals closed_form(const Parameters& p, const Gains& k) {
  const double length = p.length, bending = p.youngs_modulus * p.second_moment;
  // sum 1/omega_n^2 of the hub-locked appendage: the trace of Green's function with its masses.
  const double sum = (p.mass_per_length * std::pow(length, 4) / 12 + p.tip_mass * std::pow(length, 3) / 3 +
                      p.tip_inertia * length) /
                     bending;
  return {p.hub_inertia * k.k1 / (4 * k.k3), k.k1 * k.k1 * sum / (k.k3 * (2 + k.k2)),
          spacecraft::step_costs(p, k, 0).error, k.k1 / 2};
}

/// The last times at which an energy is a hundredth of its peak.
struct Fading {
  double hub = 0, beams = 0;  ///< s
};

Fading fading(const DiscreteModel& model, const Gains& gains, double until) {
  spacecraft::DiscreteLoop loop(model, gains, 1, 0.01);
  std::vector<std::array<double, 2>> energies;
  while (loop.time() < until) {
    loop.advance();
    const VectorXd q = loop.displacement().tail(model.size()), v = loop.velocity();
    const VectorXd w = v.tail(model.size());
    energies.push_back(
        {model.hub_inertia * v[0] * v[0] / 2, (q.dot(model.stiffness * q) + w.dot(model.mass * w)) / 2});
  }
  std::array<double, 2> last = {}, peak = {};
  for (std::size_t i = 0; i < 2; ++i) {
    for (const auto& e : energies) peak.at(i) = std::max(peak.at(i), e.at(i));
    for (std::size_t k = 0; k < energies.size(); ++k) {
      if (energies[k].at(i) > 0.01 * peak.at(i)) last.at(i) = 0.01 * static_cast<double>(k + 1);
    }
  }
  return {last[0], last[1]};
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
  scene::Panel& panel = show.plot("Nothing turns where {/:Italic k}_2 changes its sign", "{/:Italic k}_2",
                                  "integral over that at {/:Italic k}_2 = 0");
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

/// The last time at which the hub's energy is a hundredth of its peak, by the exact poles.
double exact_fading(const Gains& gains) {
  const auto response = spacecraft::step_response(spacecraft::ClosedLoop(craft(true), gains), 1, {});
  if (!response.status.ok()) throw Failure(response.status);
  const auto [least, largest] = spacecraft::extremes(response.theta_dot, 0, 20);
  const double peak = std::max(-least.value, largest.value);
  const auto settled = spacecraft::settling_time(response.theta_dot, 0, 0.1 * peak, 5000);
  if (!settled.status.ok()) throw Failure(settled.status);
  return settled.time;
}

/// A motion: what is found, and the same in closed form, by exact poles, by finite elements.
struct Motions {
  std::string of;
  Gains gains;
  Integrals found, exact;
  Fading last, other;

  [[nodiscard]] double k1() const { return gains.k1; }
  [[nodiscard]] double k2() const { return gains.k2; }
  [[nodiscard]] double k3() const { return gains.k3; }
  [[nodiscard]] double hub() const { return found.hub; }
  [[nodiscard]] double beams() const { return found.beams; }
  [[nodiscard]] double error() const { return found.error; }
  [[nodiscard]] double hub_fades() const { return last.hub; }
  [[nodiscard]] double beams_fade() const { return last.beams; }
};

std::vector<Motions> all_motions(const DiscreteModel& model) {
  const DiscreteModel elements = spacecraft::finite_elements(craft(true), 12);
  std::vector<Motions> all;
  for (const Set& set : sets) {
    for (const double k2 : {-0.5, 0.0, 1.0}) {
      const Gains gains = with_load(set.gains, k2);
      all.push_back({fmt::format("{} k1 and k3, k2 = {:g}", set.name, k2),
                     gains,
                     integrals(model, gains),
                     closed_form(craft(true), gains),
                     fading(model, gains, 400),
                     {exact_fading(gains), fading(elements, gains, 400).beams}});
    }
  }
  return all;
}

void check(const Motions& m, scene::Show& show) {
  // Rounding: eps times the fastest over the slowest decay of ten modes, 2.3e3 and 1.2e-5 a second.
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
  show.near("time of the hub below 1 %, " + m.of, {m.last.hub, "s"}, m.other.hub, 0.02 / m.last.hub,
            "the exact poles; samples 0.01 s apart");
  show.near("time of the beams below 1 %, " + m.of, {m.last.beams, "s"}, m.other.beams, 0.02 / m.last.beams,
            "12 finite elements; samples 0.01 s apart");
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
                   {"(theta - theta_f)^2 (s)", &Motions::error, 5},
                   {"hub below 1 % of its peak from (s)", &Motions::hub_fades, 4},
                   {"beams (s)", &Motions::beams_fade, 4}});
  for (const Motions& m : all) check(m, show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "energies",
           .title = "Energies of the hub and of the beams by the gain on the root load",
           .content = scene::Content(put)}};
}

}  // namespace nlmech::chapters::gss_control::energies

#include "nlmech/spacecraft/plant/assumed_modes.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "nlmech/spacecraft/plant/gauss_rule.hpp"
#include "nlmech/spacecraft/plant/poles.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::spacecraft {
namespace {

/// Functions of xi = x/L.
struct Family {
  /// phi_i, d phi_i/d xi or d^2 phi_i/d xi^2 at xi, by order 0, 1, 2, into a column.
  std::function<void(double, int, Eigen::VectorXd&)> evaluate;
  int count;
};

/// Eq. 3.45 with cos(i pi x/L) in place of cos(i pi x)/L. All meet phi(0) = phi'(0) = 0; phi'' = phi''' = 0
/// at the end, so that a tip body's conditions are met by none of them.
Family polynomial_cosine(int count) {
  return {[count](double xi, int order, Eigen::VectorXd& value) {
            for (int i = 1; i <= count; ++i) {
              const double k = i * std::numbers::pi, sign = i % 2 == 1 ? 1 : -1, angle = k * xi;
              const double half = std::sin(angle / 2);
              double& phi = value[i - 1];
              if (order == 0)
                phi = 2 * half * half + sign * angle * angle / 2;
              else if (order == 1)
                phi = k * (std::sin(angle) + sign * angle);
              else
                phi = k * k * (std::cos(angle) + sign);
            }
          },
          count};
}

/// The resonance of wave number q, root and tip: exponentials, sine and cosine as in motion_by_waves().
struct Resonance {
  double q, from_root, from_tip, cosine, sine;

  [[nodiscard]] double operator()(double xi, int order) const {
    const double away = from_root * std::exp(-q * xi), back = from_tip * std::exp(-q * (1 - xi)),
                 c = std::cos(q * xi), s = std::sin(q * xi);
    if (order == 0) return away + back + cosine * c + sine * s;
    if (order == 1) return q * (back - away + sine * c - cosine * s);
    return q * q * (away + back - cosine * c - sine * s);
  }
};

Family eigenfunctions(const Plant& plant, int count) {
  const Frequencies frequencies = hub_zeros(plant, count);
  if (!frequencies.status.ok()) throw Failure(frequencies.status);
  const Ratios& ratios = plant.appendage().ratios();
  auto all = std::make_shared<std::vector<Resonance>>();
  for (const double omega : frequencies.omega) {
    const double root = omega * std::sqrt(plant.appendage().beta_unit()), q = std::sqrt(root),
                 e = std::exp(-q);
    const double c = std::cos(q), s = std::sin(q);
    // F = -(A + E C) and G = A - E C hold the root; w'' = -b j w' at the tip gives A : C, b = -q^4.
    const double turn = ratios.tip ? q * root * ratios.inertia : 0;
    const double of_root = e * (1 + turn) + (c - turn * s) - (s + turn * c);
    const double of_tip = (1 - turn) + e * (c - turn * s) + e * (s + turn * c);
    const double size = std::hypot(of_root, of_tip), a = of_tip / size, t = -of_root / size;
    all->push_back({q, a, t, -(a + e * t), a - e * t});
  }
  return {[all](double xi, int order, Eigen::VectorXd& value) {
            for (std::size_t i = 0; i < all->size(); ++i)
              value[static_cast<Eigen::Index>(i)] = (*all)[i](xi, order);
          },
          count};
}

}  // namespace

// Integrals over two half waves of the shortest function a panel are exact to rounding.
DiscreteModel assumed_modes(const Parameters& parameters, int count, ModeFunctions functions) {
  const Plant plant(parameters);
  if (count < 1 || count > 400) throw invalid_argument("assumed_modes: {} modes, of 1 to 400", count);
  const Family family =
      functions == ModeFunctions::eigenfunctions ? eigenfunctions(plant, count) : polynomial_cosine(count);
  const double l = parameters.length, rho = parameters.mass_per_length, r = parameters.hub_radius;
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(count, count), stiffness = mass;
  Eigen::VectorXd coupling = Eigen::VectorXd::Zero(count), phi(count), bend(count);
  const int panels = count + 4;
  for (int panel = 0; panel < panels; ++panel) {
    for (const auto& [place, weight] : gauss_rule) {
      const double xi = (panel + (1 + place) / 2) / panels, w = weight / 2 / panels;
      family.evaluate(xi, 0, phi);
      family.evaluate(xi, 2, bend);
      coupling += (2 * rho * l * w * (r + l * xi)) * phi;
      mass.selfadjointView<Eigen::Lower>().rankUpdate(phi, 2 * rho * l * w);
      stiffness.selfadjointView<Eigen::Lower>().rankUpdate(
          bend, 2 * parameters.bending_stiffness() * w / (l * l * l));
    }
  }
  if (parameters.has_tip()) {
    Eigen::VectorXd slope(count);
    family.evaluate(1, 0, phi);
    family.evaluate(1, 1, slope);
    slope /= l;
    coupling += 2 * (parameters.tip_mass * (r + l) * phi + parameters.tip_inertia * slope);
    mass.selfadjointView<Eigen::Lower>().rankUpdate(phi, 2 * parameters.tip_mass);
    mass.selfadjointView<Eigen::Lower>().rankUpdate(slope, 2 * parameters.tip_inertia);
  }
  DiscreteModel model;
  model.hub_inertia = parameters.hub_inertia;
  model.total_inertia = parameters.total_inertia();
  model.coupling = coupling;
  model.mass = mass.selfadjointView<Eigen::Lower>();
  model.stiffness = stiffness.selfadjointView<Eigen::Lower>();
  model.shape = [family, plant](double x) {
    plant.appendage().require_place(x);
    Eigen::VectorXd value(family.count);
    family.evaluate(x / plant.parameters().length, 0, value);
    return value;
  };
  return model;
}

}  // namespace nlmech::spacecraft

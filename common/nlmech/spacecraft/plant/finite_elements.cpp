#include "nlmech/spacecraft/plant/finite_elements.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "nlmech/support/sentences.hpp"

namespace nlmech::spacecraft {
namespace {

/// Hermite's cubics at t = 0 to 1: deflection at the left node, slope times h there, the same at the right.
Eigen::Vector4d hermite(double t) {
  const double s = 1 - t;
  return {(1 + 2 * t) * s * s, t * s * s, t * t * (3 - 2 * t), -t * t * s};
}

/// The integral over an element of the products of Hermite's cubics, divided by h.
Eigen::Matrix4d element_mass() {
  Eigen::Matrix4d m;
  m << 156, 22, 54, -13, 22, 4, 13, -3, 54, 13, 156, -22, -13, -3, -22, 4;
  return m / 420;
}

/// The same of their second derivatives, times h^3.
Eigen::Matrix4d element_stiffness() {
  Eigen::Matrix4d k;
  k << 12, 6, -12, 6, 6, 4, -6, 2, -12, -6, 12, -6, 6, 2, -6, 4;
  return k;
}

}  // namespace

// Built with the root free first: the rigid rotation by theta is the vector of node values (r + x, h), and
// its products with the mass matrix are the coupling, exact because r + x is among the functions.
DiscreteModel finite_elements(const Parameters& parameters, int elements) {
  require_physical(parameters);
  if (elements < 1 || elements > 500)
    throw invalid_argument("finite_elements: {} elements, of 1 to 500", elements);
  const Eigen::Index n = 2 * (static_cast<Eigen::Index>(elements) + 1);
  const double l = parameters.length, h = l / elements;
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(n, n), stiffness = mass;
  Eigen::VectorXd rigid(n);
  for (Eigen::Index i = 0; i < elements; ++i) {
    mass.block<4, 4>(2 * i, 2 * i) += 2 * parameters.mass_per_length * h * element_mass();
    stiffness.block<4, 4>(2 * i, 2 * i) +=
        2 * parameters.bending_stiffness() / (h * h * h) * element_stiffness();
  }
  if (parameters.has_tip()) {
    mass(n - 2, n - 2) += 2 * parameters.tip_mass;
    mass(n - 1, n - 1) += 2 * parameters.tip_inertia / (h * h);
  }
  for (Eigen::Index i = 0; i <= elements; ++i) {
    rigid[2 * i] = parameters.hub_radius + l * static_cast<double>(i) / elements;
    rigid[2 * i + 1] = h;
  }
  DiscreteModel model;
  model.hub_inertia = parameters.hub_inertia;
  model.total_inertia = parameters.total_inertia();
  model.coupling = (mass * rigid).tail(n - 2);
  model.mass = mass.bottomRightCorner(n - 2, n - 2);
  model.stiffness = stiffness.bottomRightCorner(n - 2, n - 2);
  model.shape = [l, elements, n](double x) {
    if (!(x >= 0 && x <= l))
      throw invalid_argument("finite_elements: x = {} is not on the appendage, 0 to {}", x, l);
    const double at = x / l * elements;
    const int element = std::min(static_cast<int>(at), elements - 1);
    Eigen::VectorXd all = Eigen::VectorXd::Zero(n);
    all.segment<4>(2 * static_cast<Eigen::Index>(element)) = hermite(at - element);
    return Eigen::VectorXd(all.tail(n - 2));
  };
  return model;
}

}  // namespace nlmech::spacecraft

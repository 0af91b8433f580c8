#include "nlmech/spacecraft/parameters.hpp"

#include <cmath>

#include "nlmech/support/sentences.hpp"

namespace nlmech::spacecraft {

double Parameters::appendage_inertia() const {
  const double reach = hub_radius + length;
  // The integral of rho (r + x)^2 as a sum of positive terms.
  const double beam =
      mass_per_length * length * (hub_radius * hub_radius + hub_radius * length + length * length / 3);
  return has_tip() ? beam + tip_mass * reach * reach + tip_inertia : beam;
}

Parameters table_3_1() {
  return {.hub_inertia = 8,
          .mass_per_length = 0.0271875,
          .youngs_modulus = 0.1584e10,
          .length = 4,
          .hub_radius = 1,
          .second_moment = 0.47095e-7,
          .tip_mass = 0.1569,
          .tip_inertia = 0.0018};
}

Parameters without_tip(Parameters parameters) {
  parameters.tip_mass = parameters.tip_inertia = 0;
  return parameters;
}

void require_cantilever(const Parameters& p, const char* what) {
  if (!p.is_cantilever())
    throw invalid_argument(
        "{}: for appendages with a clamped root and a free tip alone; leave out "
        "root_stiffness and tip_support",
        what);
}

void require_restored(const Parameters& p, const char* what) {
  if (p.swings())
    throw invalid_argument(
        "{}: the appendages swing freely about pinned roots; give a root_stiffness above 0 "
        "or a support of the tips",
        what);
}

void require_physical(const Parameters& p) {
  const auto require = [](const char* name, double value, bool may_be_zero) {
    if (!std::isfinite(value) || value < 0 || (value == 0 && !may_be_zero)) {
      throw invalid_argument("spacecraft: {} = {} is not a {} number", name, value,
                             may_be_zero ? "finite non-negative" : "finite positive");
    }
  };
  require("hub_inertia", p.hub_inertia, true);
  require("mass_per_length", p.mass_per_length, false);
  require("youngs_modulus", p.youngs_modulus, false);
  require("length", p.length, false);
  require("hub_radius", p.hub_radius, true);
  require("second_moment", p.second_moment, false);
  require("tip_mass", p.tip_mass, true);
  require("tip_inertia", p.tip_inertia, true);
  // Squares and products of these must neither overflow nor underflow.
  const auto within = [](const char* what, double value, double least, double largest) {
    if (!(value >= least && value <= largest))
      throw invalid_argument(
          "spacecraft: {} = {:g} is outside {:g} to {:g}: no computation in double precision is possible",
          what, value, least, largest);
  };
  const double l = p.length, mass = p.mass_per_length * l, inertia = mass * l * l, ei = p.bending_stiffness();
  within("mass_per_length length^3", inertia, 1e-150, 1e150);
  within("youngs_modulus second_moment", ei, 1e-150, 1e150);
  within("mass_per_length length^4/(youngs_modulus second_moment)", inertia * l / ei, 1e-150, 1e150);
  within("hub_inertia/(mass_per_length length^3)", p.hub_inertia / inertia, 0, 1e75);
  within("hub_radius/length", p.hub_radius / l, 0, 1e75);
  within("tip_mass/(mass_per_length length)", p.tip_mass / mass, 0, 1e75);
  within("tip_inertia/(mass_per_length length^3)", p.tip_inertia / inertia, 0, 1e75);
  if (std::isnan(p.root_stiffness) || p.root_stiffness < 0)
    throw invalid_argument("spacecraft: root_stiffness = {} is not a non-negative number", p.root_stiffness);
  if (p.root_stiffness > 0 && std::isfinite(p.root_stiffness))
    within("root_stiffness length/(youngs_modulus second_moment)", p.root_ratio(), 1e-75, 1e75);
}

}  // namespace nlmech::spacecraft

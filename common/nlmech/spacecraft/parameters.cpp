#include "nlmech/spacecraft/parameters.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

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

void require_physical(const Parameters& p) {
  const auto require = [](const char* name, double value, bool may_be_zero) {
    if (!std::isfinite(value) || value < 0 || (value == 0 && !may_be_zero)) {
      throw std::invalid_argument(fmt::format("spacecraft: {} = {} is not a {} number", name, value,
                                              may_be_zero ? "finite non-negative" : "finite positive"));
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
}

}  // namespace nlmech::spacecraft

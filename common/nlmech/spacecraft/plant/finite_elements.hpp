/// @file
/// Finite elements: beam elements of equal length with Hermite's cubics and consistent mass.
#pragma once

#include "nlmech/spacecraft/parameters.hpp"
#include "nlmech/spacecraft/plant/discrete_model.hpp"

namespace nlmech::spacecraft {

/// A model of @p elements an appendage: 2 coordinates (deflection, slope times element length) a node. Poles
/// and responses converge to the exact ones with the fourth power of the element length; tests hold the
/// observed order to 0.2.
/// @throws std::invalid_argument if elements is not 1 to 500, or as require_physical()
[[nodiscard]] DiscreteModel finite_elements(const Parameters& parameters, int elements);

}  // namespace nlmech::spacecraft

/// @file
/// Assumed modes (Eqs. 3.44-3.48, corrected): the polynomial and cosine functions of the source, or the
/// appendage's own eigenfunctions.
#pragma once

#include <cstdint>

#include "nlmech/spacecraft/parameters.hpp"
#include "nlmech/spacecraft/plant/discrete_model.hpp"

namespace nlmech::spacecraft {

/// Which functions of x.
enum class ModeFunctions : std::uint8_t {
  polynomial_cosine,  ///< 1 - cos(i pi x/L) + (-1)^(i+1) (i pi x/L)^2/2: Eq. 3.45 with the argument corrected
  eigenfunctions      ///< resonances of the appendage, with its tip body, on a locked hub
};

/// A model of @p count modes.
/// @throws std::invalid_argument if count is not 1 to 400, or as require_physical()
/// @throws nlmech::Failure if the eigenfunctions' frequencies are not found
[[nodiscard]] DiscreteModel assumed_modes(const Parameters& parameters, int count,
                                          ModeFunctions functions = ModeFunctions::polynomial_cosine);

}  // namespace nlmech::spacecraft

/// @file
/// Flights about bodies with zonal harmonics, side by side. Internal to the component.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "nlmech/orbit/ensemble.hpp"

namespace nlmech::orbit::detail {

/// Moves flights about bodies with zonal harmonics, whose starts and fields are checked and which have
/// somewhere to go, by ivp::integrate_all() in units that are powers of two. What it does not bring to its
/// end keeps its failure, with a time in those units.
/// @param which the numbers of these flights
/// @param solutions by number
void fly_in_zonal_fields(std::span<const Flight> flights, const std::vector<std::size_t>& which,
                         const TaylorEnsemble& method, const InnerRows& rows, const Limits& limits,
                         std::vector<Solution>& solutions);

}  // namespace nlmech::orbit::detail

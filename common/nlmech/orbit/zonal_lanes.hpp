/// @file
/// Flights about bodies with zonal harmonics, side by side. Internal to the component.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "nlmech/orbit/ensemble.hpp"

namespace nlmech::orbit::detail {

/// Moves flights about bodies with zonal harmonics, whose starts and fields are checked and which have
/// somewhere to go, by ivp::integrate_all() in units that are powers of two. What it does not bring to its
/// end keeps its failure, with a time in those units. A step that is lost in the time, as Walk and Lanes
/// understand it, is one: `interrupted`.
/// @param which the numbers of these flights
/// @param steps of each flight
/// @param out_of_time asked by all threads; what is under way then is `interrupted`, too
/// @param solutions by number
void fly_in_zonal_fields(std::span<const Flight> flights, const std::vector<std::size_t>& which,
                         const TaylorEnsemble& method, const InnerRows& rows, std::int64_t steps,
                         const std::function<bool()>& out_of_time, std::vector<Solution>& solutions);

}  // namespace nlmech::orbit::detail

/// @file
/// Many trajectories by one of the methods that have names.
#pragma once

#include <span>
#include <vector>

#include "nlmech/ivp/ensemble/start.hpp"
#include "nlmech/ivp/named/named_methods.hpp"

namespace nlmech::ivp {

/// Each trajectory with the bits of method.with(settings), in threads: `series` that chooses its steps moves
/// several of them in a register, see integrate_all(), all others go one by one. Statistics::seconds is 0.
/// @param threads how many; 0: one a processor
/// @return a solution for each start, in their order
/// @throws std::invalid_argument as MethodInfo::with() and the method do
[[nodiscard]] std::vector<Solution> integrate_all_by(const MethodInfo& method, const Settings& settings,
                                                     std::span<const Start> starts, int threads);

}  // namespace nlmech::ivp

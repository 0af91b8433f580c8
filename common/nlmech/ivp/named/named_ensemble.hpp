/// @file
/// Many trajectories by one of the methods that have names.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "nlmech/ivp/ensemble/start.hpp"
#include "nlmech/ivp/named/named_methods.hpp"

namespace nlmech::ivp {

/// Each trajectory by itself, in threads. Statistics::seconds is 0.
/// @param method any; called by all threads at once
/// @param threads how many; 0: one a processor
/// @return a solution for each start, in their order
/// @throws whatever the method throws
[[nodiscard]] std::vector<Solution> each_by(const NamedIntegrator& method, std::span<const Start> starts,
                                            int threads);

/// The same by the method @p name, with the bits of named_integrator(): `series` that chooses its steps moves
/// several trajectories in a register, see integrate_all().
/// @throws std::invalid_argument as named_integrator() and the method do
[[nodiscard]] std::vector<Solution> named_integrate_all(std::string_view name, const Settings& settings,
                                                        std::span<const Start> starts, int threads);

}  // namespace nlmech::ivp

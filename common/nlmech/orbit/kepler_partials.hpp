/// @file
/// Kepler motion with its partial derivatives, without checks. Internal to the component.
#pragma once

#include "nlmech/orbit/kepler.hpp"

namespace nlmech::orbit::detail {

/// State and derivatives of kepler_transition(), in units with |r| and mu near 1; the status is a success.
/// Entries are not finite where they overflow.
[[nodiscard]] KeplerTransition kepler_partials(const State& start, double time, double mu);

}  // namespace nlmech::orbit::detail

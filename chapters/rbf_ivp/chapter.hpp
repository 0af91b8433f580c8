/// @file
/// Chapter `rbf_ivp`: collocation in time by radial basis functions against the classical integrators
/// (Elgohary 2015, chapter 4).
#pragma once

#include "nlmech/scene/command_line.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_ivp {

/// The chapter with its runs, scenes and measurements; nothing is computed.
[[nodiscard]] scene::Chapter rbf_ivp_chapter();

/// `rbf_ivp integrate` and `rbf_ivp compare`: every method and peer on the user's own parameters.
void rbf_ivp_work(CLI::App& app);

}  // namespace nlmech::chapters::rbf_ivp

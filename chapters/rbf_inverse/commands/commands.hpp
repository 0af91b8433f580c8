/// @file
/// Commands of the chapter for user-defined problems.
#pragma once

#include "nlmech/scene/program/options.hpp"

namespace nlmech::chapters::rbf_inverse {

void add_control_command(scene::Commands& all);   ///< `rbf_inverse control`
void add_duffing_command(scene::Commands& all);   ///< `rbf_inverse duffing`
void add_lambert_commands(scene::Commands& all);  ///< `rbf_inverse lambert`, `porkchop` and `merge`
void add_bvp_command(scene::Commands& all);       ///< `rbf_inverse bvp`

}  // namespace nlmech::chapters::rbf_inverse

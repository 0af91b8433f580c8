/// @file
/// The chapter's commands: spacecraft of the user's own.
#pragma once

#include "nlmech/scene/program/options.hpp"

namespace nlmech::chapters::gss_control {

void add_frequency_commands(scene::Commands& all);     ///< `gss_control poles`, `zeros` and `response`
void add_step_command(scene::Commands& all);           ///< `gss_control step`
void add_optimal_gains_command(scene::Commands& all);  ///< `gss_control optimal-gains`

}  // namespace nlmech::chapters::gss_control

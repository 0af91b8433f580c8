/// @file
/// The chapter's commands: the user's own numbers.
#pragma once

#include "nlmech/scene/program/command_line.hpp"

namespace nlmech::chapters::rbf_inverse {

void add_duffing_command(CLI::App& app);   ///< `rbf_inverse duffing`
void add_lambert_commands(CLI::App& app);  ///< `rbf_inverse lambert`, `porkchop` and `merge`

}  // namespace nlmech::chapters::rbf_inverse

/// @file
/// The chapter's commands: spacecraft of the user's own.
#pragma once

#include "nlmech/scene/program/command_line.hpp"

namespace nlmech::chapters::gss_control {

void add_poles_command(CLI::App& app);          ///< `gss_control poles`
void add_zeros_command(CLI::App& app);          ///< `gss_control zeros`
void add_response_command(CLI::App& app);       ///< `gss_control response`
void add_step_command(CLI::App& app);           ///< `gss_control step`
void add_optimal_gains_command(CLI::App& app);  ///< `gss_control optimal-gains`

}  // namespace nlmech::chapters::gss_control

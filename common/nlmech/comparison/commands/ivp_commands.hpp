/// @file
/// Commands of `integrators` for a user's equations.
#pragma once

#include "nlmech/comparison/commands/user_problem.hpp"
#include "nlmech/scene/program/options.hpp"

namespace nlmech::comparison {

/// Adds `integrate`, which prints a solution as CSV, `compare`, which runs several methods, and `choose`,
/// which ranks methods for a problem and prints the command that runs the first.
void add_ivp_commands(scene::Commands& commands);

}  // namespace nlmech::comparison

/// @file
/// The commands by which `integrators` takes a user's equations and numbers.
#pragma once

#include "nlmech/comparison/commands/user_problem.hpp"
#include "nlmech/scene/program/options.hpp"

namespace nlmech::comparison {

/// `integrate`: a problem from start to end as rows of CSV; `compare`: methods side by side; `choose`: which
/// method for a problem, with the command that runs it.
void add_ivp_commands(scene::Commands& commands);

}  // namespace nlmech::comparison

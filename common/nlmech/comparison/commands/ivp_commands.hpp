/// @file
/// The commands by which `integrators` takes a user's equations and numbers.
#pragma once

#include "nlmech/comparison/commands/user_problem.hpp"
#include "nlmech/scene/program/options.hpp"

namespace nlmech::comparison {

/// `integrate`: a problem from begin to end as rows of CSV.
/// @param problems that it offers by name, beside equations that are typed
void add_integrate_command(scene::Commands& commands, const Problems& problems);

/// `merge`: the shards of `integrate --states`.
void add_merge_command(scene::Commands& commands);

/// `choose`: which method for a problem, with the command that runs it.
void add_choose_command(scene::Commands& commands, const Problems& problems);

/// `compare`: methods side by side.
void add_compare_command(scene::Commands& commands, const Problems& problems);

}  // namespace nlmech::comparison

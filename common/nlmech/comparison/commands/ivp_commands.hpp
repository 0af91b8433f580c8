/// @file
/// The commands by which every chapter on initial value problems takes a user's numbers: `integrate` and
/// `compare`.
#pragma once

#include <string>
#include <vector>

#include "nlmech/comparison/commands/own_problem.hpp"
#include "nlmech/scene/program/options.hpp"

namespace nlmech::comparison {

/// `integrate`: a problem from begin to end as rows of CSV.
/// @param problems that it offers
/// @param methods that runs may take, the first of them where `--method` is not given; a single one needs no
/// such option. None: any method of ours and any peer, and the option is required
void add_integrate_command(scene::Commands& commands, const OwnProblems& problems,
                           const std::vector<std::string>& methods = {});

/// `compare`: methods side by side.
void add_compare_command(scene::Commands& commands, const OwnProblems& problems);

}  // namespace nlmech::comparison

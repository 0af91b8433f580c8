/// @file
/// The commands by which every chapter on initial value problems takes a user's numbers: `integrate` and
/// `compare`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "nlmech/comparison/commands/own_problem.hpp"

namespace nlmech::comparison {

/// `integrate`: a problem from begin to end as rows of CSV.
/// @param app the program's; the command lives as long
/// @param problems that it offers
/// @param methods that runs may take, the first of them where `--method` is not given; a single one needs no
/// such option. None: any method of ours and any peer, and the option is required
void add_integrate_command(CLI::App& app, const OwnProblems& problems,
                           const std::vector<std::string>& methods = {});

/// `compare`: methods side by side. @param program its name, for what is said on standard error
void add_compare_command(CLI::App& app, const OwnProblems& problems, const std::string& program);

}  // namespace nlmech::comparison

/// @file
/// The chapter's commands: toggles of the user's own.
#pragma once

#include <string>

#include "nlmech/scene/program/command_line.hpp"

namespace nlmech::chapters::homotopy {

void add_limit_points_command(CLI::App& app);  ///< `homotopy limit-points`
void add_solve_command(CLI::App& app);         ///< `homotopy solve`
/// Beam-columns a member as typed for a model: 4 if nothing was, because one does not bow, and limit points
/// of four are within 1e-3 of those of many. Williams' equation has 1.
/// @throws InputError for what is no such number
[[nodiscard]] int elements_of(const std::string& typed, const std::string& model);

}  // namespace nlmech::chapters::homotopy

/// @file
/// The scenes of the chapter, and its commands, one function a group.
#pragma once

#include "nlmech/scene/command_line.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

// Ours.
void add_solvers(scene::Chapter& chapter);   ///< every solver on every load
void add_elastica(scene::Chapter& chapter);  ///< element convergence to the exact curve
void add_extremes(scene::Chapter& chapter);  ///< stiff, many elements, at the limit load

// Commands.
void add_limit_points_command(CLI::App& app);  ///< `homotopy limit-points`
void add_solve_command(CLI::App& app);         ///< `homotopy solve`

}  // namespace nlmech::chapters

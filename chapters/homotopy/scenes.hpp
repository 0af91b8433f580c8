/// @file
/// The scenes of the chapter, and its commands, one function a group.
#pragma once

#include <string>

#include "chapters/homotopy/rows.hpp"
#include "nlmech/scene/command_line.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

// The dissertation's own.
void add_tangents(scene::Chapter& chapter);         ///< figures 2.1 to 2.3
void add_toggle_drawings(scene::Chapter& chapter);  ///< figures 2.4 and 2.5
void add_williams_curves(scene::Chapter& chapter);  ///< figures 2.6 and 2.7
void add_parameters(scene::Chapter& chapter);       ///< table 2.1 and the loads
void add_member_drawing(scene::Chapter& chapter);   ///< figure 2.12
void add_load_deflection(scene::Chapter& chapter);  ///< figures 2.13 to 2.15; the published loads
/// Tables 2.2 and 2.3, or 2.4 and 2.5, with the measurements of their rows.
void add_result_tables(scene::Chapter& chapter, const std::vector<Row>& rows, bool element);
/// Figures 2.8 to 2.11, or 2.16 to 2.20.
void add_histories(scene::Chapter& chapter, const std::vector<Row>& rows, bool element);

// Ours.
void add_iteration_study(scene::Chapter& chapter);      ///< counts against the step and the start
void add_load_stepping_study(scene::Chapter& chapter);  ///< load stepping in other ways
void add_misprint_study(scene::Chapter& chapter);       ///< the cycle that Eq. 2.35 as printed makes
void add_solvers(scene::Chapter& chapter);              ///< every solver on every load
void add_elastica(scene::Chapter& chapter);             ///< element convergence to the exact curve
void add_newton_cost(scene::Chapter& chapter);          ///< operations of assembly and of solving
void add_extremes(scene::Chapter& chapter);             ///< stiff, many elements, at the limit load
void add_error_vs_time(scene::Chapter& chapter);        ///< digits of the deflection against time

// Commands.
void add_limit_points_command(CLI::App& app);  ///< `homotopy limit-points`
void add_solve_command(CLI::App& app);         ///< `homotopy solve`
/// Beam-columns a member as typed for a model: 4 if nothing was, because one does not bow, and limit points
/// of four are within 1e-3 of those of many. Williams' equation has 1.
/// @throws InputError for what is no such number
[[nodiscard]] int elements_of(const std::string& typed, const std::string& model);

}  // namespace nlmech::chapters

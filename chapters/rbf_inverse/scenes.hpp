/// @file
/// The scenes of the chapter, and its commands, one function a group.
#pragma once

#include "chapters/rbf_inverse/duffing_runs.hpp"
#include "nlmech/scene/command_line.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

// Optimal control: the dissertation's own.
void add_end_conditions(scene::Chapter& chapter);                              ///< table 5.1
void add_duffing_parameters(scene::Chapter& chapter);                          ///< table 5.2
void add_duffing_histories(scene::Chapter& chapter, const DuffingRuns& runs);  ///< figures 5.1 to 5.18
void add_boundary_errors(scene::Chapter& chapter, const DuffingRuns& runs);    ///< table 5.3, the claim

// Optimal control: ours.
void add_from_guesses(scene::Chapter& chapter, const DuffingRuns& runs);     ///< what eleven guesses find
void add_extremals(scene::Chapter& chapter, const DuffingRuns& runs);        ///< all that were found
void add_basin(scene::Chapter& chapter);                                     ///< what random guesses lead to
void add_shape_study(scene::Chapter& chapter, const DuffingRuns& runs);      ///< c, N, and the rows
void add_bounded_control(scene::Chapter& chapter, const DuffingRuns& runs);  ///< |f| <= f_max
void add_interior_point(scene::Chapter& chapter, const DuffingRuns& runs);   ///< x1 prescribed at T/2
void add_continuation(scene::Chapter& chapter, const DuffingRuns& runs);     ///< folds in beta and T
void add_shooting(scene::Chapter& chapter);                                  ///< who diverges, T unknown
void add_scalar_homotopy(scene::Chapter& chapter);                           ///< Eqs 2.15, 2.16 as solvers
void add_control_extremes(scene::Chapter& chapter);                          ///< large beta and T, bad tasks
void add_error_vs_time_control(scene::Chapter& chapter);                     ///< digits against time

// Lambert's problem.
void add_transfer(scene::Chapter& chapter);               ///< figures 5.19 to 5.21, table 5.4
void add_guesses(scene::Chapter& chapter);                ///< what a guess leads to
void add_shape_study_lambert(scene::Chapter& chapter);    ///< shapes and nodes
void add_porkchop(scene::Chapter& chapter);               ///< maps of transfers
void add_lambert_extremes(scene::Chapter& chapter);       ///< angles, times, revolutions, units
void add_error_vs_time_lambert(scene::Chapter& chapter);  ///< digits against time

// Commands.
void add_duffing_command(CLI::App& app);   ///< `rbf_inverse duffing`
void add_lambert_commands(CLI::App& app);  ///< `rbf_inverse lambert` and `porkchop`

}  // namespace nlmech::chapters

/// @file
/// The scenes of the chapter, and its commands, one function a group.
#pragma once

#include "nlmech/scene/command_line.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

// The dissertation's own.
void add_drawings(scene::Chapter& chapter);           ///< figures 3.1 and 3.2
void add_parameters(scene::Chapter& chapter);         ///< table 3.1; all published values
void add_frequency_figures(scene::Chapter& chapter);  ///< figures 3.3 to 3.8
void add_step_figures(scene::Chapter& chapter);       ///< figures 3.9 to 3.12
void add_closed_bode(scene::Chapter& chapter);        ///< figures 3.13 to 3.16
void add_manoeuvre_figures(scene::Chapter& chapter);  ///< figures 3.17 to 3.20

// Ours.
void add_natural_frequencies(scene::Chapter& chapter);     ///< truncation errors of poles
void add_accuracy(scene::Chapter& chapter);                ///< three evaluations against extended precision
void add_optimal_gains(scene::Chapter& chapter);           ///< the cost over the gains
void add_delay_margin(scene::Chapter& chapter);            ///< what a delay does
void add_lyapunov(scene::Chapter& chapter);                ///< V along the motion
void add_energies(scene::Chapter& chapter);                ///< what k2 dissipates
void add_tracking(scene::Chapter& chapter);                ///< a moving target
void add_timoshenko(scene::Chapter& chapter);              ///< shear and rotary inertia
void add_extremes(scene::Chapter& chapter);                ///< stiff and extreme spacecraft
void add_loop_extremes(scene::Chapter& chapter);           ///< extreme gains, stiff beams, delays
void add_error_vs_time_response(scene::Chapter& chapter);  ///< digits of theta/u against time
void add_error_vs_time_step(scene::Chapter& chapter);      ///< digits of a step response against time

// Commands.
void add_poles_command(CLI::App& app);          ///< `gss_control poles`
void add_zeros_command(CLI::App& app);          ///< `gss_control zeros`
void add_response_command(CLI::App& app);       ///< `gss_control response`
void add_step_command(CLI::App& app);           ///< `gss_control step`
void add_optimal_gains_command(CLI::App& app);  ///< `gss_control optimal-gains`

}  // namespace nlmech::chapters

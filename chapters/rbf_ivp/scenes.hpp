/// @file
/// The scenes of the chapter, one function a group.
#pragma once

#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_ivp {

// The dissertation's own.
void add_drawings(scene::Chapter& chapter);          ///< figures 4.1 and 4.30
void add_parameter_tables(scene::Chapter& chapter);  ///< tables 4.1, 4.3, 4.5
void add_free_duffing(scene::Chapter& chapter);      ///< figures 4.2 to 4.16, table 4.2
void add_impact(scene::Chapter& chapter);            ///< figures 4.17 to 4.29, table 4.4
void add_three_masses(scene::Chapter& chapter);      ///< figures 4.31 to 4.56, table 4.6
void add_readings(scene::Chapter& chapter);  ///< how many readings were tried, how many rows each explains

// Ours.
void add_mcpi_limit(scene::Chapter& chapter);             ///< Picard contraction against the step
void add_kernels(scene::Chapter& chapter);                ///< the four radial functions
void add_fixed_step_more_nodes(scene::Chapter& chapter);  ///< the claim that more nodes keep accuracy
void add_conditioning(scene::Chapter& chapter);         ///< error of D against shape: truncation and rounding
void add_orders(scene::Chapter& chapter);               ///< observed order of every method
void add_instability_windows(scene::Chapter& chapter);  ///< LGL and RBF nodes grow, Radau stays bounded
void add_stability(scene::Chapter& chapter);            ///< method by problem: status, digits, largest step
void add_extremes(scene::Chapter& chapter);             ///< every method where there is no solution
void add_error_vs_time(scene::Chapter& chapter);        ///< ours and the peers on the three problems

// What the dissertation leaves for further study.
void add_shape_study(
    scene::Chapter& chapter);               ///< D by three ways against the shape; LOOCV and what it misses
void add_contour(scene::Chapter& chapter);  ///< the flat limit is the polynomial
void add_node_study(
    scene::Chapter& chapter);  ///< placed nodes, shapes of their own, least squares, refinement
void add_solver_study(scene::Chapter& chapter);  ///< scalar homotopy, Picard and Newton on the same equations
void add_chaos(scene::Chapter& chapter);         ///< RBF-Coll on aperiodic and chaotic motions
void add_ladder(scene::Chapter& chapter);        ///< what each step to the adaptive integrator bought
void add_held_back(scene::Chapter& chapter);  ///< error against time with parameters that were never tuned on

}  // namespace nlmech::chapters::rbf_ivp

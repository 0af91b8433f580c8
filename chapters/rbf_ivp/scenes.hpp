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
std::vector<scene::Scene> mcpi_limit();             ///< Picard contraction against the step
std::vector<scene::Scene> kernels();                ///< the four radial functions
std::vector<scene::Scene> fixed_step_more_nodes();  ///< the claim that more nodes keep accuracy
std::vector<scene::Scene> conditioning();           ///< error of D against shape: truncation and rounding
std::vector<scene::Scene> orders();                 ///< observed order of every method
std::vector<scene::Scene> instability_windows();    ///< LGL and RBF nodes grow, Radau stays bounded
std::vector<scene::Scene> stability();              ///< method by problem: status, digits, largest step
std::vector<scene::Scene> extremes();               ///< every method where there is no solution
void add_error_vs_time(scene::Chapter& chapter);    ///< ours and the peers on the three problems

// What the dissertation leaves for further study.
std::vector<scene::Scene> shape_study();   ///< D by three ways against the shape; LOOCV and what it misses
std::vector<scene::Scene> contour();       ///< the flat limit is the polynomial
std::vector<scene::Scene> node_study();    ///< placed nodes, shapes of their own, least squares, refinement
std::vector<scene::Scene> solver_study();  ///< scalar homotopy, Picard and Newton on the same equations
void add_chaos(scene::Chapter& chapter);   ///< RBF-Coll on aperiodic and chaotic motions
void add_ladder(scene::Chapter& chapter);  ///< what each step to the adaptive integrator bought
void add_held_back(scene::Chapter& chapter);  ///< error against time with parameters that were never tuned on

}  // namespace nlmech::chapters::rbf_ivp

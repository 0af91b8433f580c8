/// @file
/// The scenes of the chapter, one function a group.
#pragma once

#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

void add_tables(scene::Chapter& chapter);         ///< the paper's tables 1, 4 and 5
void add_search(scene::Chapter& chapter);         ///< what could have given tables 4 and 5
void add_spectral(scene::Chapter& chapter);       ///< spectral radius and period error of the five rows
void add_orders(scene::Chapter& chapter);         ///< error against the step
void add_energy(scene::Chapter& chapter);         ///< symmetric, not symplectic: energy over a long time
void add_wrong_branch(scene::Chapter& chapter);   ///< a converged iteration that leaves the solution
void add_extremes(scene::Chapter& chapter);       ///< stiff and oscillatory problems, steps far too long
void add_error_vs_time(scene::Chapter& chapter);  ///< the operators and the peers

}  // namespace nlmech::chapters

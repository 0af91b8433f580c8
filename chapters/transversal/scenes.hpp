/// @file
/// The scenes of the chapter, one function a group.
#pragma once

#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

// The paper's own.
void add_transversal_drawing(scene::Chapter& chapter);    ///< figure 1
void add_transversal_histories(scene::Chapter& chapter);  ///< figure 2

// Ours.
void add_transversal_orders(scene::Chapter& chapter);    ///< observed orders for p = 1 to 6
void add_transversal_overflow(scene::Chapter& chapter);  ///< error against step: bounded is not accurate
void add_transversal_symmetry(scene::Chapter& chapter);  ///< energy over a long time, area, there and back
void add_transversal_chaos(scene::Chapter& chapter);     ///< a periodic and a chaotic regime
void add_transversal_extremes(scene::Chapter& chapter);  ///< stiff and fast problems
void add_transversal_error_vs_time(scene::Chapter& chapter);  ///< beside our other methods and the peers

}  // namespace nlmech::chapters

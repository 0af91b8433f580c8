/// @file
/// The scenes of the chapter, one function a group.
#pragma once

#include "chapters/two_body_series/published_runs.hpp"

namespace nlmech::chapters {

// The dissertation's own.
void add_elements(scene::Chapter& chapter);   ///< equations 3.72 and 3.74
void add_algorithm(scene::Chapter& chapter);  ///< figure 3.21
/// Figure 3.22 or 3.23.
void add_history(scene::Chapter& chapter, const PublishedRuns& runs);
/// Table 3.2 or 3.3, with the measurements of its rows.
void add_table(scene::Chapter& chapter, const PublishedRuns& runs);
/// Which degrees and steps the printed values fit.
void add_reading_study(scene::Chapter& chapter, const PublishedRuns& low, const PublishedRuns& high);

// Ours.
void add_convergence_radius(scene::Chapter& chapter);  ///< printed steps against the radius of convergence
void add_cost(scene::Chapter& chapter);      ///< time of a step against its order, of a run against orbits
void add_drift(scene::Chapter& chapter);     ///< energy over ten thousand orbits
void add_zonal(scene::Chapter& chapter);     ///< a day about an oblate Earth
void add_extremes(scene::Chapter& chapter);  ///< where the methods end
void add_error_vs_time(scene::Chapter& chapter);  ///< all propagators

}  // namespace nlmech::chapters

/// @file
/// The scenes of the chapter, one function a group, and the runs that they share.
#pragma once

#include <array>

#include "chapters/geodesy/error_map.hpp"
#include "nlmech/geodesy/perturbation.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

/// Errors of the series over latitude and height, by order; index 0 is order 1.
struct SeriesRuns {
  template <std::size_t n>
  using Maps = std::array<const scene::Run<ErrorMap>*, n>;
  Maps<geodesy::highest_order> corrected;  ///< corrected coefficients, double precision
  Maps<geodesy::highest_order> extended;   ///< the same in extended precision: truncation error alone
  Maps<geodesy::highest_order> projected;  ///< height by projection instead of by the series
  Maps<4> printed;                         ///< Table 2.6 as printed; the dissertation ends at order 4
};

[[nodiscard]] SeriesRuns add_series_runs(scene::Chapter& chapter);

void add_drawings(scene::Chapter& chapter);                             ///< figures 2.21 and 2.22
void add_error_maps(scene::Chapter& chapter, const SeriesRuns& runs);   ///< figures 2.23 to 2.28
void add_table_2_6(scene::Chapter& chapter);                            ///< printed beside derived
void add_order_study(scene::Chapter& chapter, const SeriesRuns& runs);  ///< largest error against order
void add_claims(scene::Chapter& chapter, const SeriesRuns& runs);       ///< the numbers of the running text

void add_range(scene::Chapter& chapter);          ///< error against distance and flattening
void add_height_study(scene::Chapter& chapter);   ///< formulas for the height
void add_error_vs_time(scene::Chapter& chapter);  ///< ours and the peers

}  // namespace nlmech::chapters

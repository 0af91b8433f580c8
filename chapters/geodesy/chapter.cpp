#include "chapters/geodesy/chapter.hpp"

#include "chapters/geodesy/scenes.hpp"

namespace nlmech::chapters {

scene::Chapter geodesy_chapter() {
  scene::Chapter chapter("geodesy", "Cartesian to geodetic coordinates by perturbation series (section 2.4)");
  add_drawings(chapter);
  const SeriesRuns runs = add_series_runs(chapter);
  add_error_maps(chapter, runs);
  add_table_2_6(chapter);
  add_order_study(chapter, runs);
  add_height_study(chapter);
  add_range(chapter);
  add_error_vs_time(chapter);
  add_claims(chapter, runs);
  return chapter;
}

}  // namespace nlmech::chapters

#include "chapters/two_body_series/chapter.hpp"

#include "chapters/two_body_series/scenes.hpp"

namespace nlmech::chapters {

scene::Chapter two_body_series_chapter() {
  scene::Chapter chapter("two_body_series", "The two-body problem by Taylor series");
  add_elements(chapter);
  add_algorithm(chapter);
  const PublishedRuns low = add_published_runs(chapter, low_orbit()),
                      high = add_published_runs(chapter, high_orbit());
  add_history(chapter, low);
  add_history(chapter, high);
  add_table(chapter, low);
  add_table(chapter, high);
  add_reading_study(chapter, low, high);
  add_convergence_radius(chapter);
  add_cost(chapter);
  add_drift(chapter);
  add_zonal(chapter);
  add_extremes(chapter);
  add_error_vs_time(chapter);
  return chapter;
}

}  // namespace nlmech::chapters

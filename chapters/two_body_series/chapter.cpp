#include "chapters/two_body_series/chapter.hpp"

#include "chapters/two_body_series/scenes.hpp"

namespace nlmech::chapters {

scene::Chapter two_body_series_chapter() {
  scene::Chapter chapter("two_body_series", "The two-body problem by Taylor series");
  add_elements(chapter);
  add_algorithm(chapter);
  add_histories(chapter);
  add_tables(chapter);
  add_reading_study(chapter);
  add_convergence_radius(chapter);
  add_cost(chapter);
  add_drift(chapter);
  add_zonal(chapter);
  add_extremes(chapter);
  add_error_vs_time(chapter);
  return chapter;
}

}  // namespace nlmech::chapters

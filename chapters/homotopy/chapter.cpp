#include "chapters/homotopy/chapter.hpp"

#include "chapters/homotopy/scenes.hpp"

namespace nlmech::chapters {

scene::Chapter homotopy_chapter() {
  scene::Chapter chapter("homotopy", "Solvers at a limit point: Williams' toggle");
  add_tangents(chapter);
  add_toggle_drawings(chapter);
  add_parameters(chapter);
  add_williams_curves(chapter);
  const std::vector<Row> rows = add_rows(chapter);
  for (const bool element : {false, true}) {
    if (element) add_member_drawing(chapter);
    if (element) add_load_deflection(chapter);
    add_result_tables(chapter, rows, element);
    add_histories(chapter, rows, element);
  }
  add_iteration_study(chapter);
  add_load_stepping_study(chapter);
  add_misprint_study(chapter);
  add_elastica(chapter);
  add_solvers(chapter);
  add_newton_cost(chapter);
  add_extremes(chapter);
  add_error_vs_time(chapter);
  return chapter;
}

}  // namespace nlmech::chapters

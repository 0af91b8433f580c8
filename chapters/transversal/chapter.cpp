#include "chapters/transversal/chapter.hpp"

#include "chapters/transversal/scenes.hpp"

namespace nlmech::chapters {

scene::Chapter transversal_chapter() {
  scene::Chapter chapter("transversal", "Multi-step transversal linearisation: the linear part exact (Roy)");
  add_transversal_drawing(chapter);
  add_transversal_histories(chapter);
  add_transversal_orders(chapter);
  add_transversal_overflow(chapter);
  add_transversal_symmetry(chapter);
  add_transversal_chaos(chapter);
  add_transversal_extremes(chapter);
  add_transversal_error_vs_time(chapter);
  return chapter;
}

}  // namespace nlmech::chapters

#include "chapters/hermitian/chapter.hpp"

#include "chapters/hermitian/scenes.hpp"

namespace nlmech::chapters {

scene::Chapter hermitian_chapter() {
  scene::Chapter chapter("hermitian", "Nonlinear dynamics by Hermitian operators with jerks (Laier)");
  add_tables(chapter);
  add_search(chapter);
  add_spectral(chapter);
  add_orders(chapter);
  add_energy(chapter);
  add_wrong_branch(chapter);
  add_extremes(chapter);
  add_error_vs_time(chapter);
  return chapter;
}

}  // namespace nlmech::chapters

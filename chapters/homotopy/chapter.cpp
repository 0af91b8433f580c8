#include "chapters/homotopy/chapter.hpp"

#include "chapters/homotopy/scenes.hpp"

namespace nlmech::chapters {

scene::Chapter homotopy_chapter() {
  scene::Chapter chapter("homotopy", "Solvers at a limit point: Williams' toggle");
  add_elastica(chapter);
  add_solvers(chapter);
  add_extremes(chapter);
  return chapter;
}

}  // namespace nlmech::chapters

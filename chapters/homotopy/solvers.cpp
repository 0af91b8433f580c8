#include "chapters/homotopy/scenes.hpp"

namespace nlmech::chapters {

void add_solvers(scene::Chapter& /*chapter*/) {}

}  // namespace nlmech::chapters

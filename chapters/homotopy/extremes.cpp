#include "chapters/homotopy/scenes.hpp"

namespace nlmech::chapters {

void add_extremes(scene::Chapter& /*chapter*/) {}

}  // namespace nlmech::chapters

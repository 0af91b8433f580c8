#include "chapters/homotopy/scenes.hpp"

namespace nlmech::chapters {

void add_elastica(scene::Chapter& /*chapter*/) {}

}  // namespace nlmech::chapters

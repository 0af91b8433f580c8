#include "chapters/two_body_series/scenes.hpp"

namespace nlmech::chapters {

void add_elements(scene::Chapter& /*chapter*/) {}

}  // namespace nlmech::chapters

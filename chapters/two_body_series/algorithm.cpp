#include "chapters/two_body_series/scenes.hpp"

namespace nlmech::chapters {

void add_algorithm(scene::Chapter& /*chapter*/) {}

}  // namespace nlmech::chapters

#include "chapters/two_body_series/scenes.hpp"

namespace nlmech::chapters {

void add_reading_study(scene::Chapter& /*chapter*/) {}

}  // namespace nlmech::chapters

#include "chapters/two_body_series/scenes.hpp"

namespace nlmech::chapters {

void add_error_vs_time(scene::Chapter& /*chapter*/) {}

}  // namespace nlmech::chapters

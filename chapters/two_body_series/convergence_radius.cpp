#include "chapters/two_body_series/scenes.hpp"

namespace nlmech::chapters {

void add_convergence_radius(scene::Chapter& /*chapter*/) {}

}  // namespace nlmech::chapters

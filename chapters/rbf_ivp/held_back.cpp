#include "chapters/rbf_ivp/scenes.hpp"

namespace nlmech::chapters {

void add_held_back(scene::Chapter& chapter) { static_cast<void>(chapter); }

}  // namespace nlmech::chapters

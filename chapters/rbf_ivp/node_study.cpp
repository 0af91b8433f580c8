#include "chapters/rbf_ivp/scenes.hpp"

namespace nlmech::chapters {

void add_node_study(scene::Chapter& chapter) { static_cast<void>(chapter); }

}  // namespace nlmech::chapters

#include "chapters/rbf_ivp/scenes.hpp"

namespace nlmech::chapters {

void add_shape_study(scene::Chapter& chapter) { static_cast<void>(chapter); }

}  // namespace nlmech::chapters

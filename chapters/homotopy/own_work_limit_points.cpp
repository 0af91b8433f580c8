#include "chapters/homotopy/scenes.hpp"

namespace nlmech::chapters {

void add_limit_points_command(CLI::App& /*app*/) {}

}  // namespace nlmech::chapters

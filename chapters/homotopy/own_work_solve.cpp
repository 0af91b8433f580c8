#include "chapters/homotopy/scenes.hpp"

namespace nlmech::chapters {

void add_solve_command(CLI::App& /*app*/) {}

}  // namespace nlmech::chapters

#include "chapters/homotopy/chapter.hpp"
#include "chapters/homotopy/scenes.hpp"

namespace nlmech::chapters {

void homotopy_work(CLI::App& app) {
  add_limit_points_command(app);
  add_solve_command(app);
}

}  // namespace nlmech::chapters

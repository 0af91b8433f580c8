/// @file
/// Chapter `homotopy`: solvers of F(x) = 0 at a limit point (T. Elgohary, dissertation 2015, sections 2.1 to
/// 2.3).
#pragma once

#include "nlmech/scene/command_line.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

/// The chapter with its runs, scenes and measurements; nothing is computed.
[[nodiscard]] scene::Chapter homotopy_chapter();

/// `homotopy limit-points` and `homotopy solve`: toggles of the user's own.
void homotopy_work(CLI::App& app);

}  // namespace nlmech::chapters

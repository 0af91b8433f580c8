/// @file
/// Chapter `geodesy`: Cartesian to geodetic coordinates by perturbation series (Elgohary 2015, section 2.4).
#pragma once

#include "nlmech/scene/command_line.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

/// The chapter with its runs, scenes and measurements; nothing is computed.
[[nodiscard]] scene::Chapter geodesy_chapter();

/// `geodesy reverse` and `geodesy forward`: the transformation on the user's own points.
void geodesy_work(CLI::App& app);

}  // namespace nlmech::chapters

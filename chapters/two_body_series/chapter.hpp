/// @file
/// Chapter `two_body_series`: the two-body problem by Taylor series (T. Elgohary, dissertation 2015, section
/// 3.2).
#pragma once

#include "nlmech/scene/command_line.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

/// The chapter with its runs, scenes and measurements; nothing is computed.
[[nodiscard]] scene::Chapter two_body_series_chapter();

/// `two_body_series propagate`, `elements` and `state`: orbits of the user's own.
void two_body_series_work(CLI::App& app);

}  // namespace nlmech::chapters

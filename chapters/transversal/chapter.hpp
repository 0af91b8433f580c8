/// @file
/// Chapter `transversal`: multi-step transversal linearisation (D. Roy, A multi-step transversal
/// linearization method in nonlinear dynamics, extended summary).
#pragma once

#include "nlmech/scene/command_line.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

/// The chapter with its runs, scenes and measurements; nothing is computed.
[[nodiscard]] scene::Chapter transversal_chapter();

/// `transversal integrate` and `compare`: the method on the user's own parameters.
void transversal_work(CLI::App& app);

}  // namespace nlmech::chapters

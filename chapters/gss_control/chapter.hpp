/// @file
/// Chapter `gss_control`: exact transfer functions and control of a flexible spacecraft (T. Elgohary,
/// dissertation 2015, section 3.1).
#pragma once

#include "nlmech/scene/command_line.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

/// The chapter with its runs, scenes and measurements; nothing is computed.
[[nodiscard]] scene::Chapter gss_control_chapter();

/// `gss_control poles`, `zeros`, `response`, `step` and `optimal-gains`: spacecraft of the user's own.
void gss_control_work(CLI::App& app);

}  // namespace nlmech::chapters

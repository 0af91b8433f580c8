/// @file
/// Chapter `hermitian`: structural dynamics by single-step Hermitian operators with jerks (J. E. Laier,
/// High-order algorithm for non-linear dynamics).
#pragma once

#include "nlmech/scene/command_line.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

/// The chapter with its runs, scenes and measurements; nothing is computed.
[[nodiscard]] scene::Chapter hermitian_chapter();

/// `hermitian integrate`, `compare` and `peak`: the operators on the user's own parameters.
void hermitian_work(CLI::App& app);

}  // namespace nlmech::chapters

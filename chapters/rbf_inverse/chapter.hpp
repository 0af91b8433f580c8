/// @file
/// Chapter `rbf_inverse`: collocation for problems with conditions at both ends (T. Elgohary, dissertation
/// 2015, chapter 5).
#pragma once

#include "nlmech/scene/command_line.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

/// The chapter with its runs, scenes and measurements; nothing is computed.
[[nodiscard]] scene::Chapter rbf_inverse_chapter();

/// `rbf_inverse duffing` and the commands of Lambert's problem: the user's own numbers.
void rbf_inverse_work(CLI::App& app);

}  // namespace nlmech::chapters

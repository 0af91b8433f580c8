/// @file
/// Chapter `algebraic_series`: nonlinear differential systems by power series in time (C. P. Filipich and
/// M. B. Rosales, A straightforward approach to solve ordinary nonlinear differential systems).
#pragma once

#include "nlmech/scene/command_line.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

/// The chapter with its runs, scenes and measurements; nothing is computed.
[[nodiscard]] scene::Chapter algebraic_series_chapter();

/// `algebraic_series integrate`, `compare` and `poincare`: series on the user's own parameters.
void algebraic_series_work(CLI::App& app);

}  // namespace nlmech::chapters

/// @file
/// The picture of a run, and the one of a comparison, that a user asks for by `--plot`.
#pragma once

#include <string>

#include "nlmech/comparison/commands/own_problem.hpp"
#include "nlmech/scene/show.hpp"

namespace nlmech::comparison {

/// The unknowns against time, a panel each and at most most_panels of them, with a point at each event. The
/// time is logarithmic where most of the steps lie within the first thousandth of it.
/// @param heading as it stands, without markup
/// @throws Failure for a run of no length
[[nodiscard]] scene::Figure run_figure(const Seen& run, const std::string& heading);

/// The points of a section: an unknown and its derivative, or two unknowns, the first pair of which neither
/// is constant there.
/// @throws Failure if there are none
[[nodiscard]] scene::Figure section_figure(const Seen& run, const std::string& heading);

/// Digits against run time and against right-hand sides.
/// @throws Failure if no method has digits
[[nodiscard]] scene::Figure comparison_figure(const Comparison& comparison, const std::string& heading);

/// Unknowns that a picture shows.
inline constexpr int most_panels = 12;

}  // namespace nlmech::comparison

/// @file
/// What a command makes of a verification: how hard it tries, and what it says.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "nlmech/comparison/commands/own_problem.hpp"
#include "nlmech/comparison/reference/verification.hpp"
#include "nlmech/support/statistics.hpp"

namespace nlmech::comparison {

/// The tolerances of a run by its settings.
[[nodiscard]] Tolerance tolerance_of(const ivp::Settings& settings);

/// A reference that knows a tenth of these tolerances.
[[nodiscard]] Needed needed_for(const Tolerance& tolerance);

/// Some times the work of the run itself and one second.
/// @param components of the state
/// @param left wall time that is left of the command's limit, in seconds
[[nodiscard]] Effort effort_after(const Statistics& work, int components, double left);

/// As part of a sentence.
inline constexpr std::string_view what_a_tolerance_holds =
    "holds the error of each step, and not what these add up to";

/// What is worth saying of a run that is right or that could not be verified; empty if nothing.
/// @param names of the components
/// @throws Failure for a run that is wrong or that nothing determines: method, place, what its tolerance
/// holds, and what to change
[[nodiscard]] std::string remark(const Verification& found, const Reference& reference,
                                 const ivp::MethodInfo& method, const ivp::Settings& settings,
                                 const std::vector<std::string>& names);

}  // namespace nlmech::comparison

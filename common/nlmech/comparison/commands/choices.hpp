/// @file
/// Events, and lists of methods and of tolerances, as a user types them.
#pragma once

#include <string>
#include <vector>

#include "nlmech/comparison/commands/own_problem.hpp"

namespace nlmech::comparison {

/// Without the blanks at its ends.
[[nodiscard]] std::string trimmed(std::string text);

/// An event as typed: "x = 0 falling end". @throws InputError naming @p option that points at the mistake
[[nodiscard]] WantedEvent event_of(const std::string& option, const std::string& typed,
                                   const OwnProblem& problem);

/// Names with commas between, blanks beside them aside; "all": those of ours and of the peers in this build.
/// @throws InputError naming `--methods`, for a name that there is not, or twice
[[nodiscard]] std::vector<std::string> method_list(const std::string& list);

/// Tolerances: "1e-3:1e-12" by decades, or "1e-3,1e-6".
/// @throws InputError naming `--tolerances`
[[nodiscard]] std::vector<double> tolerance_list(const std::string& list);

/// The methods, each with those of the settings that it has, at each of the tolerances.
/// @param tolerances if empty, the settings' own
/// @throws InputError for a setting that none of them has
[[nodiscard]] std::vector<Choice> choices(const std::vector<std::string>& methods,
                                          const ivp::Settings& settings,
                                          const std::vector<double>& tolerances);

}  // namespace nlmech::comparison

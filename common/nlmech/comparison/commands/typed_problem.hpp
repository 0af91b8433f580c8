/// @file
/// Equations that a user types, as a problem of the commands.
#pragma once

#include <memory>
#include <string>

#include "nlmech/comparison/commands/own_problem.hpp"
#include "nlmech/program/equations.hpp"

namespace nlmech::comparison {

/// @param name in lists of problems; empty: the equation of a user
/// @throws InputError that points at a mistake in the text
[[nodiscard]] std::unique_ptr<OwnProblem> typed_problem(const program::SourceText& source,
                                                        const program::Settings& settings,
                                                        std::string_view name = {});

/// The text of a file of equations; - is standard input.
/// @throws InputError naming `--file` for a device, a file that cannot be read, or one that nobody has typed
[[nodiscard]] std::string read_equations(const std::string& name);

}  // namespace nlmech::comparison

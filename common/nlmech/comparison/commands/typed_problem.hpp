/// @file
/// Equations that a user types, as a problem of the commands.
#pragma once

#include <memory>

#include "nlmech/comparison/commands/own_problem.hpp"
#include "nlmech/expression/equations.hpp"

namespace nlmech::comparison {

/// @throws InputError that points at a mistake in the text
[[nodiscard]] std::unique_ptr<OwnProblem> typed_problem(const expression::SourceText& source,
                                                        const expression::Settings& settings);

}  // namespace nlmech::comparison

/// @file
/// The problems of the library by name.
#pragma once

#include "nlmech/comparison/commands/own_problem.hpp"

namespace nlmech::comparison {

/// All of them.
[[nodiscard]] OwnProblems library_problems();

}  // namespace nlmech::comparison

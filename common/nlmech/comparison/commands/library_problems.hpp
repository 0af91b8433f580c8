/// @file
/// The problems of the library by name.
#pragma once

#include "nlmech/comparison/commands/user_problem.hpp"

namespace nlmech::comparison {

/// All of them.
[[nodiscard]] Problems library_problems();

}  // namespace nlmech::comparison

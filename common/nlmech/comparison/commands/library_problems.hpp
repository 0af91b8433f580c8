/// @file
/// The problems of the library by name, the same in every program.
#pragma once

#include <string_view>
#include <vector>

#include "nlmech/comparison/commands/own_problem.hpp"

namespace nlmech::comparison {

/// All of them. @param first names of those that head the list
/// @throws std::logic_error for a name that there is not
[[nodiscard]] OwnProblems library_problems(const std::vector<std::string_view>& first = {});

}  // namespace nlmech::comparison

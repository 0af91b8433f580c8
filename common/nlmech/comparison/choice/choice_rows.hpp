/// @file
/// What `choose` prints.
#pragma once

#include <string>
#include <vector>

#include "nlmech/comparison/choice/choice.hpp"

namespace nlmech::comparison {

/// Rows `rank,method,tolerance,seconds,reason` as CSV.
/// @throws Failure if there is nothing to choose from, with the reason
[[nodiscard]] std::string choice_rows(const Chosen& chosen);

/// A remark beside the rows: digits that the problem does not give; empty if there are none.
[[nodiscard]] std::string choice_remark(const Chosen& chosen);

/// Words as they are typed to a shell.
[[nodiscard]] std::string shell_line(const std::vector<std::string>& words);

}  // namespace nlmech::comparison

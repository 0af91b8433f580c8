/// @file
/// `integrate --states`: one run for each row of a CSV file.
#pragma once

#include <string>

#include "nlmech/comparison/commands/run_options.hpp"

namespace nlmech::comparison {

/// Prints `row,t,...,status` in the order of the file, `...` the unknowns, `event` if events were asked for,
/// and the other columns. A run that fails is a row with empty cells and its status. Columns of the file are
/// unknowns and parameters by name, and `until`, if none of these has that name; others are handed on. The
/// method of all rows is that of the first one to the farthest end of all.
/// @param program on standard error
/// @returns the exit code: 1, with a word on standard error, if one failed
/// @throws InputError for whatever is wrong with the options or the file, with line and value
[[nodiscard]] int print_runs(const TypedOptions& typed, const Problems& problems, const std::string& program);

}  // namespace nlmech::comparison

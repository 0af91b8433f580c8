/// @file
/// Tables for a terminal: aligned columns that fit its width.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "nlmech/scene/table.hpp"

namespace nlmech::scene {

/// Width of the terminal of a stream in characters: the environment variable COLUMNS if it is a number from
/// 20 to 10000, else the width of the terminal, else 80. None if the stream is no terminal.
/// @param stream file descriptor, for example STDOUT_FILENO
[[nodiscard]] std::optional<std::size_t> terminal_width(int stream);

/// The table as lines of at most @p width characters, but at least four per column. Columns are two blanks
/// apart and numbers are right-aligned; the widest columns are shortened first, with "..." at the cut.
[[nodiscard]] std::string aligned(const Table& table, std::size_t width);

}  // namespace nlmech::scene

/// @file
/// Tables for a terminal: aligned columns that fit its width.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "nlmech/scene/table.hpp"

namespace nlmech::scene {

/// Columns of the terminal behind a stream: of the environment variable COLUMNS if it is a number from 20 to
/// 10000, else what the terminal says, else 80. None if the stream is no terminal.
/// @param stream STDOUT_FILENO, say
[[nodiscard]] std::optional<std::size_t> terminal_width(int stream);

/// The table as lines of at most @p width characters, as long as that leaves each column four: columns two
/// blanks apart, numbers to the right, the widest columns cut first, with "..." where something is left out.
[[nodiscard]] std::string aligned(const Table& table, std::size_t width);

}  // namespace nlmech::scene

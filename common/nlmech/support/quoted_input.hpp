/// @file
/// User input in messages: shortened, with control characters escaped.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace nlmech {

/// @p text for use in a message: at most @p most bytes, followed by the total number of bytes if it is
/// shortened ("1111... (10485760 bytes)"). Everything but printable UTF-8 characters is escaped (\\n, \\t,
/// \\x1b), including invalid UTF-8 and marks of writing direction, so the result is one line without effect
/// on a terminal.
/// @param most limit in bytes, before escaping; characters are not split
[[nodiscard]] std::string quoted_input(std::string_view text, std::size_t most = 60);

/// quoted_input() for a file name, with a limit of 400 bytes.
[[nodiscard]] std::string echoed_path(std::string_view path);

/// A complete message for printing: only printable characters, line ends and tabs; words of more than 400
/// bytes shortened as by quoted_input(); at most 4000 bytes. Functions that build a message should use
/// quoted_input() on its parts; this is a safeguard.
[[nodiscard]] std::string printable_message(std::string_view message);

}  // namespace nlmech

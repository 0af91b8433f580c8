/// @file
/// A user's text inside a message: short, and nothing in it that a terminal obeys.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace nlmech {

/// @p text as a message may repeat it: at most @p most bytes of it, with the number of all bytes behind it
/// where some are left out ("1111... (10485760 bytes)"). Whatever is no printable character of UTF-8 becomes
/// an escape (\\n, \\t, \\x1b), so that the result is one line that leaves a terminal as it was; bytes that
/// are no UTF-8 and marks that turn the direction of writing likewise.
/// @param most bytes of the text, before they are escaped; a character is never cut in two
[[nodiscard]] std::string quoted_input(std::string_view text, std::size_t most = 60);

/// The same for the name of a file: long enough for all that are ever read. At most 400 bytes.
[[nodiscard]] std::string echoed_path(std::string_view path);

/// A whole message as a program may print it: printable but for line ends and tabs, a word of more than 400
/// bytes cut as by quoted_input(), and at most 4000 bytes of the message. What builds a message should cut
/// each part of it by quoted_input(); this holds those that did not.
[[nodiscard]] std::string printable_message(std::string_view message);

}  // namespace nlmech

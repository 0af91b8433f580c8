/// @file
/// A user's file of TOML: read, with complaints that name file, line, key and value.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace nlmech::chapters {

/// The table in a text. @param name what complaints call the text
/// @throws InputError naming line and column of what is no TOML, and for more than 2000 dots besides decimal
/// points, more than any file of this suite can use: keys such as a.b.c make a table in a table, toml++ goes
/// through tables by recursion, and with some 30 000 of them, which fit on one line, a program would run out
/// of stack. A key whose every other dot looks like a decimal point is at most twice as deep.
[[nodiscard]] toml::table parse_toml(std::string_view text, const std::string& name);

/// Says what is wrong with the value @p node of @p key: "NAME, line 3: KEY = VALUE: WHAT". The value stands
/// as in the file, near enough to be found there. @throws InputError
[[noreturn]] void complain(const std::string& name, const toml::node& node, std::string_view key,
                           std::string_view what);

/// A finite number. @throws InputError
[[nodiscard]] double number_of(const std::string& name, const toml::node& node, std::string_view key);

}  // namespace nlmech::chapters

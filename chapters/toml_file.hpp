/// @file
/// Reading of TOML input files; error messages name file, line, key and value.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace nlmech::chapters {

/// Parses a TOML text. @param name of the text in error messages
/// @throws InputError naming line and column of a syntax error, and for more than 2000 dots besides decimal
/// points. Keys such as a.b.c nest tables, and toml++ visits tables by recursion: some 30 000 levels, which
/// fit on one line, would overflow the stack. A key with every second dot between two digits nests at most
/// twice as deep as counted.
[[nodiscard]] toml::table parse_toml(std::string_view text, const std::string& name);

/// Throws for the value @p node of @p key: "NAME, line 3: KEY = VALUE: WHAT". VALUE may be formatted
/// differently than in the file. @throws InputError
[[noreturn]] void complain(const std::string& name, const toml::node& node, std::string_view key,
                           std::string_view what);

/// The value of @p node as a finite number. @throws InputError if it is none
[[nodiscard]] double number_of(const std::string& name, const toml::node& node, std::string_view key);

}  // namespace nlmech::chapters

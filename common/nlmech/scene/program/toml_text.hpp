/// @file
/// What a text of TOML must not hold before it is handed to the parser.
#pragma once

#include <string>
#include <string_view>

namespace nlmech::scene {

/// Keys such as a.b.c make a table in a table, and toml++ goes through tables by recursion: with some 30 000
/// of them, which fit on one line, a program would run out of stack.
/// @param name what complaints call the text
/// @throws InputError for a text of more than 2000 dots besides decimal points, more than any file of this
/// suite can use. A key whose every other dot looks like a decimal point is at most twice as deep.
void require_shallow_toml(std::string_view text, const std::string& name);

}  // namespace nlmech::scene

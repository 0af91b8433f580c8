/// @file
/// What every command of every program has in common: its limit of wall time, its words on standard error and
/// its exit code.
#pragma once

#include <string>

#include "nlmech/scene/program/options.hpp"

namespace nlmech::scene {

/// Parses the command line and runs the command that it names.
///
/// Every command has the option `--limit`, 60 s if nothing else is said, and is ended by a TimeLimit. One
/// that heeds the limit by itself is ended half a second later if it does not. An option given twice, and one
/// with an empty text, is refused. InputError and wrong usage end with 2, any other exception with 1, with
/// its sentence on standard error: printable, and short whatever the user typed.
/// @param title of the program, above its help
/// @returns the exit code
[[nodiscard]] int run_command(const Commands& commands, const std::string& title, int argc,
                              const char* const* argv);

}  // namespace nlmech::scene

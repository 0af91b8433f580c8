/// @file
/// What every command of every program has in common: its limit of wall time, its words on standard error and
/// its exit code. And what a system wants of an installed program, its manual page and its completions, made
/// of the declared options.
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

/// The manual page of section 1, in the macros of man(7): a section a command, with its options as the help
/// has them. Names no date, so that it is the same at each build.
/// @param title of the program @param version of nlmech
[[nodiscard]] std::string manual_page(const Commands& commands, const std::string& title,
                                      const std::string& version);

/// A script for bash that completes commands, their options, values of which there is a list, and names of
/// scenes, for which it asks the program. Where it knows nothing, bash completes names of files.
[[nodiscard]] std::string bash_completion(const Commands& commands);

}  // namespace nlmech::scene

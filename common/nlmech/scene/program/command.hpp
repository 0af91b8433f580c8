/// @file
/// Execution of commands: wall-time limit, messages on standard error and exit code. Also manual page and
/// bash completion, generated from the declared options.
#pragma once

#include <string>

#include "nlmech/scene/program/options.hpp"

namespace nlmech::scene {

/// Parses the command line and runs its command.
///
/// Every command has the option `--limit` (default 60 s), and a TimeLimit ends it. A command that heeds the
/// limit itself has another half second. An option given twice or with an empty text is refused. The exit
/// code is 2 for InputError and wrong usage, 1 for any other exception; its message on standard error is
/// printable and short whatever the user typed.
/// @param title title of the program, above its help
/// @returns the exit code
[[nodiscard]] int run_command(const Commands& commands, const std::string& title, int argc,
                              const char* const* argv);

/// Manual page of section 1 in the macros of man(7), with a section per command and the options as in the
/// help. It contains no date, so that builds are reproducible.
/// @param title title of the program @param version version of nlmech
[[nodiscard]] std::string manual_page(const Commands& commands, const std::string& title,
                                      const std::string& version);

/// Bash script that completes commands, options, values of options with a list, and names of scenes, which
/// the program prints; otherwise bash completes file names.
[[nodiscard]] std::string bash_completion(const Commands& commands);

}  // namespace nlmech::scene

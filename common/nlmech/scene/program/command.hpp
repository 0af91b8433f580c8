/// @file
/// What every command of every program has in common: its limit of wall time, its words on standard error and
/// its exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <set>
#include <string>

namespace nlmech::scene {

/// Wall time of a command that does not say otherwise, s.
inline constexpr const char* usual_limit = "60";

/// Parses the command line and runs the subcommand that it names.
///
/// Every subcommand gets the option `--limit` and is ended by a TimeLimit. One that has a `--limit` of its
/// own heeds it by itself, and is ended half a second later if it does not. An option given twice, and one
/// with an empty text, is refused. InputError and what CLI11 complains of end with 2, any other exception
/// with 1, with its sentence on standard error: printable, and short whatever the user typed.
/// @param code what a callback leaves here is the exit code, if nothing is thrown
/// @param unlimited subcommands that take as long as they take unless the user gives a limit; the others have
/// usual_limit
[[nodiscard]] int run_command(CLI::App& app, int argc, const char* const* argv, const int& code,
                              const std::set<const CLI::App*>& unlimited);

}  // namespace nlmech::scene

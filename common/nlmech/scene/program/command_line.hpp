/// @file
/// The command line that all chapters share: list, run, check, and the chapter's own work.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::scene {

/// Adds the chapter's own subcommands. Their callbacks throw InputError (exit code 2) or Failure (exit code
/// 1), and print results with print_result() once they are sure of all of them.
using Commands = std::function<void(CLI::App&)>;

/// Runs a chapter's program; see run_command(). Exit codes: 0 done, 1 the computation failed, took longer
/// than its limit, or a check failed, 2 wrong usage or input.
[[nodiscard]] int chapter_main(const Chapter& chapter, const Commands& commands, int argc,
                               const char* const* argv);

}  // namespace nlmech::scene

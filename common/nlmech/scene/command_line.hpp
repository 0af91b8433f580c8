/// @file
/// The command line that all chapters share: list, run, check, and the chapter's own work.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "nlmech/scene/scene.hpp"

namespace nlmech::scene {

/// Adds the chapter's own subcommands. Their callbacks throw InputError (exit code 2) or Failure (exit code
/// 1), and print results with print_result() once they are sure of all of them.
using OwnWork = std::function<void(CLI::App&)>;

/// Runs a chapter's program. Exit codes: 0 done, 1 the computation failed or a promise was missed, 2 wrong
/// usage or input.
[[nodiscard]] int chapter_main(const Chapter& chapter, const OwnWork& own_work, int argc,
                               const char* const* argv);

/// Writes a result to standard output, whole. @throws Failure if it could not be written (a full disk, a
/// closed pipe)
void print_result(std::string_view text);

}  // namespace nlmech::scene

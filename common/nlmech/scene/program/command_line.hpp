/// @file
/// The command line that all chapters share: list, run, check, and the chapter's own commands.
#pragma once

#include "nlmech/scene/program/options.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::scene {

/// Runs a chapter's program; see run_command(). Exit codes: 0 done, 1 the computation failed, took longer
/// than its limit, or a check failed, 2 wrong usage or input.
/// @param add_commands adds the chapter's own commands
[[nodiscard]] int chapter_main(const Chapter& chapter, void (*add_commands)(Commands&), int argc,
                               const char* const* argv);

}  // namespace nlmech::scene

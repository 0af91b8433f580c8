/// @file
/// Common command line of all chapters: list, run, check, and the chapter's own commands.
#pragma once

#include "nlmech/scene/program/options.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::scene {

/// Runs a chapter's program; see run_command(). Exit codes: 0 success; 1 failed computation, exceeded time
/// limit or failed check; 2 wrong usage or input.
/// @param add_commands function that adds the chapter's own commands
[[nodiscard]] int chapter_main(const Chapter& chapter, void (*add_commands)(Commands&), int argc,
                               const char* const* argv);

}  // namespace nlmech::scene

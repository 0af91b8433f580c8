/// @file
/// What a system wants of an installed program: its manual page and its completions, made of the declared
/// options.
#pragma once

#include <string>

#include "nlmech/scene/program/options.hpp"

namespace nlmech::scene {

/// The manual page of section 1, in the macros of man(7): a section a command, with its options as the help
/// has them. Names no date, so that it is the same at each build.
/// @param title of the program @param version of nlmech
[[nodiscard]] std::string manual_page(const Commands& commands, const std::string& title,
                                      const std::string& version);

/// A script for bash that completes commands, their options, values of which there is a list, and names of
/// scenes, for which it asks the program. Where it knows nothing, bash completes names of files.
[[nodiscard]] std::string bash_completion(const Commands& commands);

}  // namespace nlmech::scene

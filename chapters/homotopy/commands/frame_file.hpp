/// @file
/// A plane frame of the user's own from a TOML file.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/frames/named/frame_model.hpp"

namespace nlmech::chapters::homotopy {

/// A frame as it stands in a file.
struct FrameFile {
  frames::FrameModel model;  ///< nodes in the order of the file
  std::string name;          ///< of the file, as complaints call it
  /// Of each entry of the model's lists, by frames::ModelPart.
  std::array<std::vector<int>, frames::model_parts> lines;
  /// Load cases that are not asked for: names, loads, displacements and their lines alone.
  std::vector<FrameFile> others = {};
};

/// Reads the tables `nodes`, `members`, `supports`, `loads`, `displacements`, `masses`, `damping` and
/// `imperfection`. Loads and displacements stand under the name of their node, or under that of a case and
/// then of their node.
/// @param name what complaints call the text: the file's name, or "standard input"
/// @param load_case which of several cases; a single one needs no name
/// @throws InputError naming file, line, key and value: no TOML, an unknown key, a value of the wrong kind or
/// not finite, a hinge at a node that the member does not reach, a case that is none or is not named
[[nodiscard]] FrameFile parse_frame(std::string_view text, const std::string& name,
                                    const std::optional<std::string>& load_case = {});

/// The same from a file; "-" is standard input. @throws InputError also if the file cannot be read
[[nodiscard]] FrameFile read_frame(const std::string& path, const std::optional<std::string>& load_case = {});

/// The frame of the file. @param elements beam-columns a member, times the member's own number
/// @throws InputError naming file, line and what is wrong, as of frames::build(); also of cases that are not
/// asked for
[[nodiscard]] frames::NamedFrame build_frame(const FrameFile& file, int elements);

/// Names file and line of what a model was refused for.
[[noreturn]] void complain_of(const FrameFile& file, const frames::ModelError& error);

}  // namespace nlmech::chapters::homotopy

/// @file
/// A plane frame of the user's own from a TOML file.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/frames/named/frame_model.hpp"

namespace nlmech::chapters::homotopy {

/// A frame as it stands in a file.
struct FrameFile {
  frames::FrameModel model;               ///< nodes in the order of the file
  std::string name;                       ///< of the file, as complaints call it
  std::array<std::vector<int>, 4> lines;  ///< of each entry of the model's lists, by frames::ModelPart
};

/// Reads the tables `nodes`, `members`, `supports` and `loads`.
/// @param name what complaints call the text: the file's name, or "standard input"
/// @throws InputError naming file, line, key and value: no TOML, an unknown key, a value of the wrong kind or
/// not finite, a hinge at a node that the member does not reach
[[nodiscard]] FrameFile parse_frame(std::string_view text, const std::string& name);

/// The same from a file; "-" is standard input. @throws InputError also if the file cannot be read
[[nodiscard]] FrameFile read_frame(const std::string& path);

/// The frame of the file. @param elements beam-columns a member, times the member's own number
/// @throws InputError naming file, line and what is wrong, as of frames::build()
[[nodiscard]] frames::NamedFrame build_frame(const FrameFile& file, int elements);

}  // namespace nlmech::chapters::homotopy

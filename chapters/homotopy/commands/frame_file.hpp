/// @file
/// Reading of a plane frame from a TOML file.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/frames/named/frame_model.hpp"

namespace nlmech::chapters::homotopy {

/// Contents of a frame file.
struct FrameFile {
  frames::FrameModel model;  ///< nodes in the order of the file
  std::string name;          ///< of the file in error messages
  /// Line of each entry of the model's lists, indexed by frames::ModelPart.
  std::array<std::vector<int>, frames::model_parts> lines;
  /// The other load cases: loads, displacements and their lines only.
  std::vector<FrameFile> others = {};
};

/// Parses the tables `nodes`, `members`, `supports`, `springs`, `loads`, `constant_loads`, `displacements`,
/// `masses`, `damping` and `imperfection`. The keys of loads and displacements are node names, or case names
/// and then node names.
/// @param name of the text in error messages: the file name, or "standard input"
/// @param load_case name of the load case; not needed for a single one
/// @throws InputError naming file, line, key and value: TOML syntax error, unknown key, value of the wrong
/// type or not finite, hinge at a node that is no end of the member, load case unknown or not chosen
[[nodiscard]] FrameFile parse_frame(std::string_view text, const std::string& name,
                                    const std::optional<std::string>& load_case = {});

/// Reads and parses a file; "-" is standard input. @throws InputError also if the file cannot be read
[[nodiscard]] FrameFile read_frame(const std::string& path, const std::optional<std::string>& load_case = {});

/// Builds the frame of the file. @param elements factor of each member's own number of beam-columns
/// @throws InputError naming file, line and error of frames::build(), also for the other load cases
[[nodiscard]] frames::NamedFrame build_frame(const FrameFile& file, int elements);

/// Throws InputError naming file and line of a model error.
[[noreturn]] void complain_of(const FrameFile& file, const frames::ModelError& error);

}  // namespace nlmech::chapters::homotopy

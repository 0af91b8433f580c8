/// @file
/// Files of a scene: data, provenance, table and figure.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "nlmech/scene/scene.hpp"

namespace nlmech::scene {

/// Destination and selection of the files.
struct Publishing {
  std::filesystem::path out = ".";  ///< folder of figures/, tables/, results/
  bool plots = true;                ///< draw the figures
  bool png = false;                 ///< also draw a PNG image of each figure
};

/// Writes `results/<chapter>/<scene>.csv` and `.json`, `tables/<chapter>/<scene>.csv` and `.md`, and
/// `figures/<chapter>/<scene>.svg`, as far as the scene has them. The data come first, so that they are kept
/// if drawing fails.
/// @returns these files relative to Publishing::out, in the order of writing, whether or not they have
/// changed
/// @throws Failure naming the figure that was not drawn and the reason, or the file that could not be written
std::vector<std::filesystem::path> publish(const Chapter& chapter, const Scene& scene,
                                           const Performance& performance, bool quick, const Publishing& how);

/// Provenance of one scene: chapter, scene, title, place; version, commit, dirty flag, compiler, flags,
/// processor, libraries; the command that reproduces it; effort; runs with their readings; quantities with
/// their ranges. It contains no time and no date, so that it is reproducible byte for byte.
[[nodiscard]] std::string provenance(const Chapter& chapter, const Scene& scene,
                                     const Performance& performance, bool quick);

/// Model name of the processor, or "unknown".
[[nodiscard]] std::string processor_name();

}  // namespace nlmech::scene

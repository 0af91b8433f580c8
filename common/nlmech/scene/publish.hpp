/// @file
/// Putting a scene on disk: numbers, provenance, table and figure.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "nlmech/scene/scene.hpp"

namespace nlmech::scene {

/// Where scenes are put, and what of them.
struct Publishing {
  std::filesystem::path out = ".";  ///< gets figures/, tables/, results/
  bool plots = true;                ///< draw the figures
  bool png = false;                 ///< a PNG image beside each SVG
};

/// Writes `results/<chapter>/<scene>.csv` and `.json`, `tables/<chapter>/<scene>.csv` and `.md`, and
/// `figures/<chapter>/<scene>.svg`, as far as the scene has them; the data first, so that they are kept if
/// drawing fails.
/// @returns these files as seen from Publishing::out, in the order of writing, whether or not their bytes
/// have changed
/// @throws Failure naming the figure that was not drawn and why, or the file that could not be written
std::vector<std::filesystem::path> publish(const Chapter& chapter, const Scene& scene,
                                           const Performance& performance, bool quick, const Publishing& how);

/// Provenance of one scene: chapter, scene, title, place; version, commit, dirty flag, compiler, flags,
/// processor, libraries; the command that makes it again; effort; runs with their readings; quantities with
/// their ranges. Holds no time and no date, so that it is the same byte for byte from run to run.
[[nodiscard]] std::string provenance(const Chapter& chapter, const Scene& scene,
                                     const Performance& performance, bool quick);

/// The processor's own name for itself, or "unknown".
[[nodiscard]] std::string processor_name();

}  // namespace nlmech::scene

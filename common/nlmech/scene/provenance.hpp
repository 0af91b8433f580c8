/// @file
/// Where a scene's numbers come from, as JSON beside them.
#pragma once

#include <string>

#include "nlmech/scene/scene.hpp"

namespace nlmech::scene {

/// Provenance of one scene: chapter, scene, title, place; version, commit, dirty flag, compiler, flags,
/// processor, libraries; the command that makes it again; effort; runs with their readings; quantities with
/// their ranges. Holds no time and no date, so that it is the same byte for byte from run to run.
[[nodiscard]] std::string provenance(const Chapter& chapter, const Scene& scene,
                                     const Performance& performance, bool quick);

/// The processor's own name for itself, or "unknown".
[[nodiscard]] std::string processor_name();

}  // namespace nlmech::scene

/// @file
/// What this program was made from. Filled in by the build; the values stand in the provenance of every
/// scene.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nlmech::scene {

/// A library that the build found, with its version.
struct LibraryVersion {
  std::string name;     ///< as CMake knows it
  std::string version;  ///< as found
};

/// Facts about the build; see provenance().
struct BuildInfo {
  std::string version;                    ///< of nlmech, "1.2.3"
  std::string commit;                     ///< git commit, or "unknown" outside a checkout
  bool dirty = false;                     ///< tracked files differed from that commit when it was built
  std::string compiler;                   ///< name and version
  std::string flags;                      ///< options given to the compiler, build type included
  std::vector<LibraryVersion> libraries;  ///< those that the configuration uses
  std::string source_folder;              ///< where templates and published values are, unless installed
};

/// Always the same object.
[[nodiscard]] const BuildInfo& build_info();

}  // namespace nlmech::scene

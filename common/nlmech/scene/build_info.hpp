/// @file
/// Sources, compiler and libraries of this build, for the provenance of every scene.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nlmech::scene {

/// A library that the build found, with its version.
struct LibraryVersion {
  std::string name;     ///< name of the CMake package
  std::string version;  ///< version found
};

/// Facts about the build; see provenance().
struct BuildInfo {
  std::string version;                    ///< version of nlmech, "1.2.3"
  std::string commit;                     ///< git commit, or "unknown" outside a checkout
  bool dirty = false;                     ///< true if tracked files differed from that commit
  std::string compiler;                   ///< name and version of the compiler
  std::string flags;                      ///< compiler options with the build type
  std::vector<LibraryVersion> libraries;  ///< libraries of this configuration
  std::string source_folder;              ///< folder of templates and published values, unless installed
};

/// The facts about this build.
[[nodiscard]] const BuildInfo& build_info();

}  // namespace nlmech::scene

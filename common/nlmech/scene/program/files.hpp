/// @file
/// Reading and writing of whole files. A file is written under a temporary name and renamed, so that no
/// partial file is visible.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace nlmech::scene {

/// The bytes of a file; "-" is standard input.
/// @throws InputError naming the file and the system's reason
[[nodiscard]] std::string read_whole(const std::filesystem::path& path);

/// Creates missing folders, writes @p text to a temporary file in the folder of @p path and renames it. A
/// process killed at any moment leaves the old file or the new one. A file with the same content keeps its
/// date.
/// @throws Failure naming the file and the system's reason; the temporary file is removed
void write_whole(const std::filesystem::path& path, std::string_view text);

/// The files of a folder with this extension (".csv"), in alphabetical order.
/// @throws InputError naming the folder and the system's reason
[[nodiscard]] std::vector<std::filesystem::path> files_with(const std::filesystem::path& folder,
                                                            std::string_view extension);

/// Folder that holds `figures/templates`, `figures/style.gp`, `tables/published`: the environment variable
/// NLMECH_DATA, else `share/nlmech` of the installation of the running program, else the source tree of its
/// build.
/// @throws Failure listing the folders that were tried
[[nodiscard]] std::filesystem::path data_folder();

}  // namespace nlmech::scene

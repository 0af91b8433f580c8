/// @file
/// Whole files: read at once, written under a temporary name and renamed, so that nobody ever sees half of
/// one.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace nlmech::scene {

/// The bytes of a file; "-" is standard input.
/// @throws InputError naming the file and the system's reason
[[nodiscard]] std::string read_whole(const std::filesystem::path& path);

/// Creates missing folders, writes @p text to a temporary name beside @p path and renames it. A process
/// killed at any moment leaves the old file or the new one. An unchanged file is left alone, date included.
/// @throws Failure naming the file and the system's reason; the temporary file is removed
void write_whole(const std::filesystem::path& path, std::string_view text);

/// The files of a folder with this extension (".csv"), in alphabetical order.
/// @throws InputError naming the folder and the system's reason
[[nodiscard]] std::vector<std::filesystem::path> files_with(const std::filesystem::path& folder,
                                                            std::string_view extension);

/// Folder that holds `figures/templates`, `figures/style.gp`, `tables/published`: the environment variable
/// NLMECH_DATA, else `share/nlmech` of the installation that the running program belongs to, else the source
/// tree it was built from.
/// @throws Failure saying where was looked
[[nodiscard]] std::filesystem::path data_folder();

}  // namespace nlmech::scene

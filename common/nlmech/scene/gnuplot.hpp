/// @file
/// Drawing: data and a template go into gnuplot, a picture comes out.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace nlmech::scene {

/// What draw() makes.
enum class PictureFormat { svg, png };

/// Runs gnuplot on `figures/style.gp` and then on the template, in the folder @p folder, and returns what it
/// draws.
/// @param templates folder with style.gp and templates/
/// @param data CSV file, relative to @p folder so that no drawing holds a path of the machine; the template's
/// `data`
/// @param variables further string variables of the template
/// @throws Failure if gnuplot cannot be started, fails, complains, or draws nothing; with its own words
[[nodiscard]] std::string draw(const std::filesystem::path& templates, const std::string& template_name,
                               const std::filesystem::path& folder, const std::string& data,
                               const std::map<std::string, std::string>& variables,
                               PictureFormat format = PictureFormat::svg);

}  // namespace nlmech::scene

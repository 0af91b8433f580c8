/// @file
/// Drawing of figures by gnuplot.
#pragma once

#include <filesystem>
#include <string>

#include "nlmech/scene/show.hpp"

namespace nlmech::scene {

/// Output formats of draw().
enum class PictureFormat { svg, png };

/// The complete gnuplot script of a figure, which can be edited and run by hand. It loads `figures/style.gp`
/// and contains the text of the figure's template, if it has one.
/// @param data CSV file, relative to the folder in which gnuplot runs, so that no drawing contains an
/// absolute path
/// @throws Failure if there is no such template
[[nodiscard]] std::string gnuplot_script(const Figure& figure, const std::string& data);

/// Copies the style that scripts load to `figures` of the folder @p out, and returns its text.
/// @throws Failure if it cannot be written
std::string put_style(const std::filesystem::path& out);

/// Script for interaction with the SVG of a figure that a browser opens by itself: it shows the titles of
/// curves under the pointer and a list to hide curves. Empty for a figure without the variable `answers`;
/// else the text of `figures/<answers>.xml`.
/// @throws Failure if that file is missing
[[nodiscard]] std::string answers_of(const Figure& figure);

/// Inserts the text of answers_of() at the end of an SVG. @param svg result of draw()
[[nodiscard]] std::string with_answers(std::string svg, const std::string& answers);

/// Runs gnuplot on a script in the folder @p folder and returns the picture.
/// @param script file relative to @p folder, so that no drawing contains an absolute path
/// @throws Failure with the message of gnuplot if it cannot be started, fails, warns, or draws nothing
[[nodiscard]] std::string draw(const std::filesystem::path& folder, const std::string& script,
                               PictureFormat format = PictureFormat::svg);

}  // namespace nlmech::scene

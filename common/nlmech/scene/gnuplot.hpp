/// @file
/// Drawing: a script goes into gnuplot, a picture comes out.
#pragma once

#include <filesystem>
#include <string>

#include "nlmech/scene/show.hpp"

namespace nlmech::scene {

/// What draw() makes.
enum class PictureFormat { svg, png };

/// All that gnuplot is told to draw a figure: complete, so that it can be edited and run by hand. It loads
/// `figures/style.gp`, and a figure with a template gets that one's text.
/// @param data CSV file, relative to the folder in which gnuplot runs, so that no drawing holds a path of the
/// machine
/// @throws Failure if there is no such template
[[nodiscard]] std::string gnuplot_script(const Figure& figure, const std::string& data);

/// Puts the style that scripts load into `figures` of the folder @p out, and returns it.
/// @throws Failure if it cannot be written
std::string put_style(const std::filesystem::path& out);

/// What makes a picture answer, at the end of its SVG: a reader who opens it by itself points at curves,
/// which say their titles, and switches them off in a list. Elsewhere it looks like any other. Empty for a
/// figure whose variables have no `answers`; else the text of `figures/<answers>.xml`.
/// @throws Failure if that is missing
[[nodiscard]] std::string answers_of(const Figure& figure);

/// Puts them there. @param svg what draw() makes
[[nodiscard]] std::string with_answers(std::string svg, const std::string& answers);

/// Runs gnuplot on a script in the folder @p folder, and returns what it draws.
/// @param script relative to @p folder, so that no drawing holds a path of the machine
/// @throws Failure if gnuplot cannot be started, fails, complains, or draws nothing; with its own words
[[nodiscard]] std::string draw(const std::filesystem::path& folder, const std::string& script,
                               PictureFormat format = PictureFormat::svg);

}  // namespace nlmech::scene

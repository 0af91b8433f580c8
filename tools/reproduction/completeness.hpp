/// @file
/// What stands behind each figure and table of the sources: its scene, what was drawn, what was checked.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "nlmech/scene/evidence/published.hpp"

namespace nlmech::reproduction {

/// A figure or table of a source, and what a chapter left on disk for it.
struct Shown {
  scene::Place place;         ///< of the source
  bool built = false;         ///< is its chapter part of this build?
  bool drawn = false;         ///< a figure with curves, or a table with rows
  std::size_t numbers = 0;    ///< rows of data behind the figure, or rows of the table
  std::size_t checked = 0;    ///< quantities
  std::size_t passed = 0;     ///< of these, those that pass
  std::size_t published = 0;  ///< printed numbers of this place that have a verdict

  /// Drawn, with at least one quantity checked and all of them passing; or its chapter is not built.
  [[nodiscard]] bool complete() const { return !built || (drawn && checked > 0 && passed == checked); }
};

/// All figures and tables of `places.csv`, with what `figures`, `tables` and `results` under @p out hold for
/// them. What is missing is not an error: it is not complete.
/// @throws InputError if a file that is there cannot be read
[[nodiscard]] std::vector<Shown> collect_shown(const std::vector<std::string>& built,
                                               const std::filesystem::path& data_folder,
                                               const std::filesystem::path& out);

/// The page `COMPLETENESS.md`: counts by source, then one row a figure or table.
[[nodiscard]] std::string completeness_page(const std::vector<Shown>& shown);

}  // namespace nlmech::reproduction

/// @file
/// Layout and drawing of a work-precision diagram.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "nlmech/scene/work_precision.hpp"

namespace nlmech::scene {

/// Positions at least @p gap apart within a range, in the order of the wanted ones and with the least sum of
/// squared distances from them. If the range is too short, they are equally spaced.
/// @param wanted wanted positions in any order; results have the same order
/// @param gap least distance, >= 0 @param low, high ends of the range
[[nodiscard]] std::vector<double> spread(const std::vector<double>& wanted, double gap, double low,
                                         double high);

/// Input of a drawing. Columns of the data: line, problem, kind, colour, digits, time_s, ..., and from the
/// 14th on those of WorkPrecision::work.
struct Diagram {
  const WorkPrecision& what;                  ///< labels and ranges
  const std::vector<ProblemLines>& problems;  ///< problems, at least one
  std::vector<InColour> chosen;               ///< coloured lines, the most important first
  Table data;                                 ///< one block of rows per curve
  std::vector<std::vector<int>> blocks;       ///< block by problem and line; -1: no point, not drawn

  /// Colour of a line; null if it is grey.
  [[nodiscard]] const InColour* colour_of(std::size_t line) const {
    const auto found = std::ranges::find(chosen, line, &InColour::line);
    return found != chosen.end() ? &*found : nullptr;
  }
};

/// The figure, interactive if a browser opens it by itself: see answers_of().
[[nodiscard]] Figure drawn(Diagram diagram);

}  // namespace nlmech::scene

/// @file
/// The drawing of a work-precision diagram: where axes, names and strips stand, and what they say.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "nlmech/scene/work_precision.hpp"

namespace nlmech::scene {

/// Places at least @p gap apart within a range, in the order of those wanted, which they miss by the least
/// sum of squares. Where the range has no room for all, they share it equally.
/// @param wanted in any order; answered in the same
/// @param gap not negative @param low, high end of the range
[[nodiscard]] std::vector<double> spread(const std::vector<double>& wanted, double gap, double low,
                                         double high);

/// All that a drawing is made of. Columns of the data: line, problem, kind, colour, digits, time_s, ..., and
/// from the 14th on those of WorkPrecision::work.
struct Diagram {
  const WorkPrecision& what;                  ///< labels, ranges
  const std::vector<ProblemLines>& problems;  ///< at least one
  std::vector<InColour> chosen;               ///< the most important first
  Table data;                                 ///< a block of rows a curve
  std::vector<std::vector<int>> blocks;       ///< of data, by problem and line; -1: no point, not drawn

  /// Of a line; null if it is grey.
  [[nodiscard]] const InColour* colour_of(std::size_t line) const {
    const auto found = std::ranges::find(chosen, line, &InColour::line);
    return found != chosen.end() ? &*found : nullptr;
  }
};

/// The figure, which answers a reader who opens it by itself, see answers_of().
[[nodiscard]] Figure drawn(Diagram diagram);

}  // namespace nlmech::scene

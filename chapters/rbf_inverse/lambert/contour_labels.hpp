/// @file
/// Placement of the labels of contour lines on a map.
#pragma once

#include <vector>

namespace nlmech::chapters::rbf_inverse {

/// Values on a grid, the second coordinate fastest; NaN where there is none.
struct GridValues {
  std::vector<double> x, y, values;
};

/// Label of a contour line: place and value.
struct ContourLabel {
  double x = 0, y = 0, level = 0;
};

/// At most one label per level, at the place with the largest distance from the lines of other levels. No
/// label overlaps another label, the line of another level, or a border; a level without such a place has no
/// label.
/// @param levels in any order
/// @param character width of a character, as a fraction of the width of the map
/// @param height height of a label, as a fraction of the height of the map
[[nodiscard]] std::vector<ContourLabel> contour_labels(const GridValues& grid,
                                                       const std::vector<double>& levels, double character,
                                                       double height);

}  // namespace nlmech::chapters::rbf_inverse

/// @file
/// Places for the labels of contour lines on a map.
#pragma once

#include <vector>

namespace nlmech::chapters::rbf_inverse {

/// Values on a grid, the second coordinate fastest; NaN where there is none.
struct GridValues {
  std::vector<double> x, y, values;
};

/// A value to be written on its line.
struct ContourLabel {
  double x = 0, y = 0, level = 0;
};

/// One place for each level at most: where the lines of other levels are farthest, so that no label lies on
/// another label, on a line that is not its own, or across a border. A level that has no such place gets
/// none.
/// @param levels any order @param character, height of a label, as shares of the map's width and height
[[nodiscard]] std::vector<ContourLabel> contour_labels(const GridValues& grid,
                                                       const std::vector<double>& levels, double character,
                                                       double height);

}  // namespace nlmech::chapters::rbf_inverse

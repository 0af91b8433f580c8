#include "chapters/rbf_inverse/lambert/contour_labels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace nlmech::chapters::rbf_inverse {
namespace {

/// Point of the map, from 0 to 1 in both directions.
struct Place {
  double u = 0, v = 0;
};

/// Intersections of a contour line with the edges of the cells.
std::vector<Place> crossings(const GridValues& grid, double level) {
  const std::size_t columns = grid.x.size(), rows = grid.y.size();
  std::vector<Place> places;
  const auto between = [&](std::size_t i, std::size_t j, std::size_t di, std::size_t dj) {
    if (i + di >= columns || j + dj >= rows) return;
    const double a = grid.values[i * rows + j] - level, b = grid.values[(i + di) * rows + j + dj] - level;
    if (!(a * b < 0)) return;  // the same side, or NaN
    const double t = a / (a - b);
    const double x = std::lerp(grid.x[i], grid.x[i + di], t), y = std::lerp(grid.y[j], grid.y[j + dj], t);
    places.push_back({(x - grid.x.front()) / (grid.x.back() - grid.x.front()),
                      (y - grid.y.front()) / (grid.y.back() - grid.y.front())});
  };
  for (std::size_t i = 0; i < columns; ++i) {
    for (std::size_t j = 0; j < rows; ++j) {
      between(i, j, 1, 0);
      between(i, j, 0, 1);
    }
  }
  return places;
}

/// Points without a value adjacent to a point with a value.
std::vector<Place> edge(const GridValues& grid) {
  const std::size_t columns = grid.x.size(), rows = grid.y.size();
  const auto empty = [&](std::size_t i, std::size_t j) { return std::isnan(grid.values[i * rows + j]); };
  std::vector<Place> places;
  for (std::size_t i = 0; i < columns; ++i) {
    for (std::size_t j = 0; j < rows; ++j) {
      if (empty(i, j) && ((i > 0 && !empty(i - 1, j)) || (i + 1 < columns && !empty(i + 1, j)) ||
                          (j > 0 && !empty(i, j - 1)) || (j + 1 < rows && !empty(i, j + 1))))
        places.push_back({(grid.x[i] - grid.x.front()) / (grid.x.back() - grid.x.front()),
                          (grid.y[j] - grid.y.front()) / (grid.y.back() - grid.y.front())});
    }
  }
  return places;
}

}  // namespace

std::vector<ContourLabel> contour_labels(const GridValues& grid, const std::vector<double>& levels,
                                         double character, double height) {
  std::vector<std::vector<Place>> lines;
  for (const double level : levels) lines.push_back(crossings(grid, level));
  lines.push_back(edge(grid));
  std::vector<ContourLabel> labels;
  std::vector<std::pair<Place, double>> placed;  // with the widths of the labels
  // Distances in half labels: 1: the point lies on the edge of the label; 2: two labels touch.
  const auto apart = [&](const Place& a, const Place& b, double width) {
    return std::max(std::abs(a.u - b.u) / (width / 2), std::abs(a.v - b.v) / (height / 2));
  };
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const double width = character * (0.5 + static_cast<double>(fmt::formatted_size("{:.12g}", levels[k])));
    Place best;
    double clearance = 1;
    for (const Place& place : lines[k]) {
      double least = std::min({place.u / (width / 2), (1 - place.u) / (width / 2), place.v / (height / 2),
                               (1 - place.v) / (height / 2)});
      for (const auto& [other, wide] : placed)
        least = std::min(least, std::max(std::abs(place.u - other.u) / ((width + wide) / 2),
                                         std::abs(place.v - other.v) / height));
      for (std::size_t l = 0; l < lines.size() && least > clearance; ++l) {
        if (l == k) continue;
        for (const Place& other : lines[l]) least = std::min(least, apart(place, other, width));
      }
      if (least > clearance) {
        clearance = least;
        best = place;
      }
    }
    if (clearance <= 1) continue;
    placed.emplace_back(best, width);
    labels.push_back({std::lerp(grid.x.front(), grid.x.back(), best.u),
                      std::lerp(grid.y.front(), grid.y.back(), best.v), levels[k]});
  }
  return labels;
}

}  // namespace nlmech::chapters::rbf_inverse

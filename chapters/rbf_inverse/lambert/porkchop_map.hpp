/// @file
/// Porkchop plot of a grid of transfers, for the scene and for `rbf_inverse porkchop --plot`.
#pragma once

#include <string>

#include "nlmech/orbit/transfer/porkchop.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_inverse {

/// Labels and units of the axes.
struct PorkchopAxes {
  std::string heading;                  ///< at most 60 characters
  std::string departure = "departure";  ///< label of the horizontal axis
  std::string arrival = "arrival";      ///< label of the vertical axis
  std::string speed = "speed";          ///< label of the colour scale: "km/s"
  double time = 1;                      ///< time unit of the axes in units of the grid
  double speed_unit = 1;                ///< speed unit of the colour scale in units of the grid
  std::string departure_tics = {};      ///< tics in gnuplot syntax, "'1 May' 121, ..."; empty: automatic
  std::string arrival_tics = {};        ///< tics of the vertical axis
};

/// Two maps over departure and arrival times: excess speeds at departure and at arrival. Colours and contour
/// lines range from the least speed to four times that; lines have labels where space permits. Higher speeds
/// and cells without a transfer are white. Grids with more than 400 rows or columns are thinned.
/// @param grid complete grid with at least two rows and columns and one transfer
/// @throws Failure if there is nothing to draw
[[nodiscard]] scene::Figure porkchop_map(const orbit::Porkchop& grid, const PorkchopAxes& axes);

}  // namespace nlmech::chapters::rbf_inverse

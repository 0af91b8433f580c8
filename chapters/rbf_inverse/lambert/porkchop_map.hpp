/// @file
/// The picture of a grid of transfers, for the scene and for `rbf_inverse porkchop --plot`.
#pragma once

#include <string>

#include "nlmech/orbit/transfer/porkchop.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_inverse {

/// What is written at the axes, and in which units.
struct PorkchopAxes {
  std::string heading;                  ///< at most 60 characters
  std::string departure = "departure";  ///< label below
  std::string arrival = "arrival";      ///< label at the left
  std::string speed = "speed";          ///< what follows the colours: "km/s"
  double time = 1;                      ///< so many units of the grid are one of the axes
  double speed_unit = 1;                ///< the same for speeds
  std::string departure_tics = {};      ///< tics as gnuplot has them, "'1 May' 121, ..."; empty: its own
  std::string arrival_tics = {};        ///< the same for the arrival
};

/// Two maps over departure and arrival, of the excess speeds at both. Colours and contour lines go from the
/// least speed to four times that, each line with its value where there is room for it; what is above, or has
/// no transfer, is left white. Of a grid of more than 400 rows or columns, every second, third, ... is drawn.
/// @param grid whole, with at least two rows and columns and a transfer somewhere
/// @throws Failure if there is nothing to draw
[[nodiscard]] scene::Figure porkchop_map(const orbit::Porkchop& grid, const PorkchopAxes& axes);

}  // namespace nlmech::chapters::rbf_inverse

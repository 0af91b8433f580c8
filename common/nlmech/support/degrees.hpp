/// @file
/// Sine and cosine of angles in degrees.
#pragma once

#include <cmath>
#include <numbers>

namespace nlmech {

/// One degree in radians.
inline constexpr double degree = std::numbers::pi / 180;

/// Sine and cosine of one angle.
struct SineCosine {
  double sine = 0;    ///< from -1 to 1
  double cosine = 1;  ///< from -1 to 1
};

/// Sine and cosine of an angle in degrees; NaN if @p angle is not finite. Quarter turns are subtracted
/// exactly: multiples of 90 degrees give exactly 0 and 1, and near them the smaller value keeps full relative
/// accuracy. The relative error of each is at most 2 eps.
[[nodiscard]] inline SineCosine sine_cosine_of_degrees(double angle) {
  int quarters = 0;
  const double rest = std::remquo(angle, 90.0, &quarters) * degree;  // exact but for the product
  const double s = std::sin(rest), c = std::cos(rest);
  // Adding 0 changes -0 to 0.
  switch (quarters & 3) {
    case 0: return {s + 0., c};
    case 1: return {c, -s + 0.};
    case 2: return {-s + 0., -c};
    default: return {-c, s + 0.};
  }
}

}  // namespace nlmech

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

/// Sine and cosine of an angle in degrees, any finite number; not a number otherwise. Quarter turns are
/// subtracted before anything is rounded: multiples of 90 degrees give 0 and 1 exactly, and near them the
/// smaller of both numbers keeps all its digits. Each is within 2 eps of itself.
[[nodiscard]] inline SineCosine sine_cosine_of_degrees(double angle) {
  int quarters = 0;
  const double rest = std::remquo(angle, 90.0, &quarters) * degree;  // exact but for the product
  const double s = std::sin(rest), c = std::cos(rest);
  // Adding 0 turns -0 into 0.
  switch (quarters & 3) {
    case 0: return {s + 0., c};
    case 1: return {c, -s + 0.};
    case 2: return {-s + 0., -c};
    default: return {-c, s + 0.};
  }
}

}  // namespace nlmech

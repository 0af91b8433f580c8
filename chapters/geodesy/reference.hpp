/// @file
/// Reference for the reverse transformation, in extended precision: slow, accurate to some 18 digits.
#pragma once

#include <algorithm>
#include <cmath>

#include "nlmech/geodesy/ellipsoid.hpp"

namespace nlmech::chapters::geodesy {

using Extended = long double;  // x86: 64-bit significand, 11 bits more than double

/// Computes the foot of the perpendicular from the largest root of
/// g(t) = (a r/(a^2 + t))^2 + (b z/(b^2 + t))^2 - 1. To the right of its poles g is decreasing and convex, so
/// Newton's iteration from a point with g >= 0 increases monotonically to the root.
/// @param p point with z != 0 or r > a e^2; its coordinates are taken as exact
[[nodiscard]] inline nlmech::geodesy::BasicGeodetic<Extended> reference_reverse(
    const nlmech::geodesy::Cartesian& p, const nlmech::geodesy::Ellipsoid& e) {
  const Extended a = e.a(), b = a * (1 - Extended(e.f())), z = p.z,
                 r = std::hypot(Extended(p.x), Extended(p.y));
  // u = t + b^2 avoids cancellation near the centre, where t is close to -b^2.
  const Extended gap = a * a - b * b;
  Extended u = std::max(b * std::abs(z), a * r - gap);
  for (int i = 0; i < 500; ++i) {
    const Extended A = a * r / (u + gap), B = b * z / u;
    const Extended g = A * A + B * B - 1, slope = -2 * (A * A / (u + gap) + B * B / u);
    const Extended step = -g / slope;
    u += step;
    if (!(std::abs(step) > 4e-19L * u)) break;
  }
  const Extended normal_r = r / (u + gap), normal_z = z / u;
  const Extended height = (u - b * b) * std::hypot(normal_r, normal_z);
  return {std::atan2(normal_z, normal_r), std::atan2(Extended(p.y), Extended(p.x)), height};
}

}  // namespace nlmech::chapters::geodesy

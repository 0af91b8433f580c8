/// @file
/// The reverse transformation in extended precision, to measure others by. Slow, and exact to some 18 digits.
#pragma once

#include <algorithm>
#include <cmath>

#include "nlmech/geodesy/ellipsoid.hpp"

namespace nlmech::chapters::geodesy {

using Extended = long double;  // x86: 64-bit significand, 11 bits more than double

/// Foot of the perpendicular by the largest root of g(t) = (a r/(a^2 + t))^2 + (b z/(b^2 + t))^2 - 1, which
/// is falling and convex to the right of its poles: Newton's iteration from a point with g >= 0 climbs to the
/// root and never passes it.
/// @param p any point with z != 0, or with r beyond the disc of radius a e^2; its coordinates are taken as
/// exact
[[nodiscard]] inline nlmech::geodesy::BasicGeodetic<Extended> reference_reverse(
    const nlmech::geodesy::Cartesian& p, const nlmech::geodesy::Ellipsoid& e) {
  const Extended a = e.a(), b = a * (1 - Extended(e.f())), z = p.z,
                 r = std::hypot(Extended(p.x), Extended(p.y));
  // u = t + b^2 instead of t: near the centre t is close to -b^2 and would cancel
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

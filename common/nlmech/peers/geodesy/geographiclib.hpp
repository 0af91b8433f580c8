/// @file
/// GeographicLib's reverse transformation as a peer; optional.
#pragma once

#include <cstddef>
#include <span>

#include "nlmech/geodesy/ellipsoid.hpp"

namespace nlmech::peers::geodesy {

/// Does this build have GeographicLib?
[[nodiscard]] bool geographiclib_available() noexcept;

/// GeographicLib::Geocentric::Reverse (C. F. F. Karney, Geodesics on an ellipsoid of revolution, 2011,
/// appendix B) on each point. Its degrees are turned into radians.
/// @throws std::logic_error if the build has no GeographicLib
[[nodiscard]] nlmech::geodesy::Geodetic geographiclib_reverse(const nlmech::geodesy::Ellipsoid& ellipsoid,
                                                              const nlmech::geodesy::Cartesian& point);

/// Transforms columns of points. Angles are in degrees as returned by the library, so that no conversion adds
/// to its time.
/// @throws std::logic_error if the build has no GeographicLib
void geographiclib_reverse_degrees(const nlmech::geodesy::Ellipsoid& ellipsoid, std::span<const double> x,
                                   std::span<const double> y, std::span<const double> z,
                                   std::span<double> latitude, std::span<double> longitude,
                                   std::span<double> height);

}  // namespace nlmech::peers::geodesy

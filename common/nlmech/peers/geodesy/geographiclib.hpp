/// @file
/// GeographicLib's reverse transformation behind our interface, if this build has it.
#pragma once

#include <cstddef>
#include <span>

#include "nlmech/geodesy/ellipsoid.hpp"

namespace nlmech::peers::geodesy {

/// Was the library found when this program was built?
[[nodiscard]] bool geographiclib_available() noexcept;

/// GeographicLib::Geocentric::Reverse (C. F. F. Karney, Geodesics on an ellipsoid of revolution, 2011,
/// appendix B) on each point. Its degrees are turned into radians.
/// @throws std::logic_error if the build has no GeographicLib
[[nodiscard]] nlmech::geodesy::Geodetic geographiclib_reverse(const nlmech::geodesy::Ellipsoid& ellipsoid,
                                                              const nlmech::geodesy::Cartesian& point);

/// The same over columns, in degrees as the library gives them: nothing is added to its own time.
/// @throws std::logic_error if the build has no GeographicLib
void geographiclib_reverse_degrees(const nlmech::geodesy::Ellipsoid& ellipsoid, std::span<const double> x,
                                   std::span<const double> y, std::span<const double> z,
                                   std::span<double> latitude, std::span<double> longitude,
                                   std::span<double> height);

}  // namespace nlmech::peers::geodesy

#include "nlmech/peers/geodesy/geographiclib.hpp"

#include <GeographicLib/Geocentric.hpp>
#include <numbers>

namespace nlmech::peers::geodesy {

bool geographiclib_available() noexcept { return true; }

nlmech::geodesy::Geodetic geographiclib_reverse(const nlmech::geodesy::Ellipsoid& ellipsoid,
                                                const nlmech::geodesy::Cartesian& p) {
  nlmech::geodesy::Geodetic g;
  GeographicLib::Geocentric(ellipsoid.a(), ellipsoid.f())
      .Reverse(p.x, p.y, p.z, g.latitude, g.longitude, g.height);
  constexpr double degree = std::numbers::pi / 180;
  return {g.latitude * degree, g.longitude * degree, g.height};
}

void geographiclib_reverse_degrees(const nlmech::geodesy::Ellipsoid& ellipsoid, std::span<const double> x,
                                   std::span<const double> y, std::span<const double> z,
                                   std::span<double> latitude, std::span<double> longitude,
                                   std::span<double> height) {
  const GeographicLib::Geocentric geocentric(ellipsoid.a(), ellipsoid.f());
  for (std::size_t i = 0; i < x.size(); ++i) {
    geocentric.Reverse(x[i], y[i], z[i], latitude[i], longitude[i], height[i]);
  }
}

}  // namespace nlmech::peers::geodesy

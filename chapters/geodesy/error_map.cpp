#include "chapters/geodesy/error_map.hpp"

#include <cmath>
#include <numbers>

namespace nlmech::chapters {
namespace {

using geodesy::BasicCartesian;
using geodesy::BasicEllipsoid;
using geodesy::BasicGeodetic;

using Extended = long double;  // x86: 64-bit significand, 11 bits more than double
constexpr Extended degree = std::numbers::pi_v<Extended> / 180;

void note(Extreme& extreme, double error, double latitude_deg, double height_km) {
  if (std::abs(error) > extreme.magnitude) extreme = {std::abs(error), latitude_deg, height_km};
}

template <class T>
void fill(ErrorMap& map, const geodesy::PerturbationSeries& method, const geodesy::SeriesTable& table,
          Extended longitude) {
  const auto exact = BasicEllipsoid<Extended>::wgs84();
  const auto ellipsoid = BasicEllipsoid<T>::wgs84();
  for (const double height_km : map.height_km) {
    for (const double latitude_deg : map.latitude_deg) {
      const BasicGeodetic<Extended> truth{latitude_deg * degree, longitude, height_km * Extended(1000)};
      const BasicCartesian<Extended> p = geodesy::forward(truth, exact);
      const BasicCartesian<T> given{static_cast<T>(p.x), static_cast<T>(p.y), static_cast<T>(p.z)};
      const auto found = geodesy::reverse(given, ellipsoid, method, table).position;
      const auto latitude_error = static_cast<double>((truth.latitude - found.latitude) / degree);
      const auto height_error = static_cast<double>(truth.height - found.height);
      map.latitude_error_deg.push_back(latitude_error);
      map.height_error_m.push_back(height_error);
      note(map.latitude, latitude_error, latitude_deg, height_km);
      note(map.height, height_error, latitude_deg, height_km);
    }
  }
}

}  // namespace

ErrorMap error_map(const geodesy::PerturbationSeries& method, const geodesy::SeriesTable& table,
                   Arithmetic arithmetic, bool quick, double longitude_deg) {
  ErrorMap map;
  const int steps = quick ? 90 : 720, ratios = quick ? 30 : 60;
  for (int i = 0; i <= steps; ++i) map.latitude_deg.push_back(-90 + 180. * i / steps);
  for (int i = 0; i <= ratios; ++i)
    map.height_km.push_back(200 * std::pow(35000.0 / 200.0, double(i) / ratios));
  map.height_km.back() = 35000;
  if (arithmetic == Arithmetic::extended)
    fill<Extended>(map, method, table, longitude_deg * degree);
  else
    fill<double>(map, method, table, longitude_deg * degree);
  return map;
}

}  // namespace nlmech::chapters

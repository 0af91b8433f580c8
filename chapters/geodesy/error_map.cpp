#include "chapters/geodesy/error_map.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "chapters/geodesy/printed.hpp"
#include "chapters/geodesy/reference.hpp"

namespace nlmech::chapters::geodesy {
namespace {

using nlmech::geodesy::BasicCartesian;
using nlmech::geodesy::BasicEllipsoid;
using nlmech::geodesy::BasicGeodetic;
using nlmech::geodesy::HeightFrom;

constexpr Extended degree = std::numbers::pi_v<Extended> / 180;

void note(Extreme& extreme, double error, double latitude_deg, double height_km) {
  if (std::abs(error) > extreme.magnitude) extreme = {std::abs(error), latitude_deg, height_km};
}

template <class T>
void fill(ErrorMap& map, const nlmech::geodesy::PerturbationSeries& method,
          const nlmech::geodesy::SeriesTable& table, Extended longitude) {
  const auto exact = BasicEllipsoid<Extended>::wgs84();
  const auto ellipsoid = BasicEllipsoid<T>::wgs84();
  for (const double height_km : map.height_km) {
    for (const double latitude_deg : map.latitude_deg) {
      const BasicGeodetic<Extended> expected{latitude_deg * degree, longitude, height_km * Extended(1000)};
      const BasicCartesian<Extended> p = forward(expected, exact);
      const BasicCartesian<T> given{static_cast<T>(p.x), static_cast<T>(p.y), static_cast<T>(p.z)};
      const auto found = reverse(given, ellipsoid, method, table).position;
      const auto latitude_error = static_cast<double>((expected.latitude - found.latitude) / degree);
      const auto height_error = static_cast<double>(expected.height - found.height);
      map.latitude_error_deg.push_back(latitude_error);
      map.height_error_m.push_back(height_error);
      note(map.latitude, latitude_error, latitude_deg, height_km);
      note(map.height, height_error, latitude_deg, height_km);
    }
  }
}

/// Name of a form and its deviations from the default reading.
struct Reading {
  const char *name, *further;
};
Reading reading_of(Form form) {
  switch (form) {
    case Form::corrected: return {"corrected", ""};
    case Form::extended: return {"extended", "; extended precision"};
    case Form::projected: return {"projected", "; height by projection on the normal"};
    case Form::printed:
      return {
          "printed",
          "; Table 2.6 as printed, with the equals sign in C8 read as minus and the dimension of the last "
          "term of C9 repaired"};
    case Form::literal: break;
  }
  return {"literal", "; Table 2.6 as printed, in metres, with the equals sign in C8 read as minus"};
}

}  // namespace

ErrorMap error_map(Form form, int order, bool quick, double longitude_deg) {
  ErrorMap map;
  const int steps = quick ? 90 : 720, ratios = quick ? 30 : 60;
  for (int i = 0; i <= steps; ++i) map.latitude_deg.push_back(-90 + 180. * i / steps);
  for (int i = 0; i <= ratios; ++i)
    map.height_km.push_back(200 * std::pow(35000.0 / 200.0, double(i) / ratios));
  map.height_km.back() = 35000;
  const nlmech::geodesy::PerturbationSeries method{
      order, form == Form::projected ? HeightFrom::projection : HeightFrom::series};
  const auto table = form == Form::printed   ? printed_series()
                     : form == Form::literal ? literal_series()
                                             : nlmech::geodesy::corrected_series();
  if (form == Form::extended)
    fill<Extended>(map, method, table, longitude_deg * degree);
  else
    fill<double>(map, method, table, longitude_deg * degree);
  return map;
}

scene::Result<ErrorMap> map_of(Form form, int order) {
  const auto [name, further] = reading_of(form);
  return {fmt::format("{}-order-{}", name, order),
          std::string("WGS84, longitude 30 deg, latitudes -90..90 deg, heights 200..35000 km; error = true "
                      "minus found (Eq. 2.54)") +
              further,
          [=](bool quick) { return error_map(form, order, quick); }};
}

}  // namespace nlmech::chapters::geodesy

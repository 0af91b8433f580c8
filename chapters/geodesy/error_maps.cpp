#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "chapters/geodesy/error_map.hpp"

namespace nlmech::chapters::geodesy::error_maps {
namespace {

/// Latitude or height error of a map.
struct Part {
  std::string name, unit;
  std::vector<double> ErrorMap::*errors;
  Extreme ErrorMap::*extreme;
};

/// A figure with the reference truncation error of the corrected series on its range.
struct Known {
  int figure, order;
  const Part& part;
  double error;
};

void draw(const ErrorMap& map, const Part& part, int order, scene::Show& show) {
  const Extreme& extreme = map.*part.extreme;
  scene::Table data({{"latitude_deg"}, {"height_km", 3, true}, {"error"}, {"magnitude"}});
  auto error = (map.*part.errors).begin();
  for (const double height : map.height_km) {
    for (const double latitude : map.latitude_deg) {
      data.add({latitude, height, *error, std::abs(*error)});
      ++error;
    }
  }
  show.draw(std::move(data), "geodesy-error-map",
            {{"quantity", fmt::format("|{} error| ({})", part.name, part.unit)},
             {"heading", fmt::format("Order {}: {} error at most {} {}, at {:.0f} deg and {:.0f} km", order,
                                     part.name, scene::format_number(extreme.magnitude, 2), part.unit,
                                     std::abs(extreme.latitude_deg), extreme.height_km)}});
}

scene::Scene scene_of(const Known& known) {
  const auto put = [known](const ErrorMap& map, scene::Show& show) {
    const Part& part = known.part;
    draw(map, part, known.order, show);
    // Rounding of double precision adds 2.2e-8 m of height at 35000 km and 1e-14 deg of latitude.
    show.near("max " + part.name + " error", {(map.*part.extreme).magnitude, part.unit}, known.error, 0.005,
              "truncation error by tools/oracles/geodesy_series.py; 0.5 % for the grid and for rounding");
  };
  return {
      .name = fmt::format("fig-2.{}", known.figure),
      .title = fmt::format("Error in {}, order {}, over latitude and height", known.part.name, known.order),
      .place = fmt::format("Figure 2.{}", known.figure),
      .content = scene::Content(put, map_of(Form::corrected, known.order))};
}

}  // namespace

std::vector<scene::Scene> scenes() {
  static const Part latitude{"latitude", "deg", &ErrorMap::latitude_error_deg, &ErrorMap::latitude};
  static const Part height{"height", "m", &ErrorMap::height_error_m, &ErrorMap::height};
  // oracle: geodesy_series order 2: *, order 3: *, order 4: latitude, order 4: height
  const std::vector<Known> all = {{23, 2, latitude, 1.120e-6},  {24, 2, height, 5.839e-2},
                                  {25, 3, latitude, 4.735e-9},  {26, 3, height, 2.033e-4},
                                  {27, 4, latitude, 2.417e-11}, {28, 4, height, 7.869e-7}};
  std::vector<scene::Scene> scenes;
  for (const Known& known : all) scenes.push_back(scene_of(known));
  return scenes;
}

}  // namespace nlmech::chapters::geodesy::error_maps

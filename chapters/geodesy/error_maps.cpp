#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chapters/geodesy/printed.hpp"
#include "chapters/geodesy/scenes.hpp"

namespace nlmech::chapters {
namespace {

using geodesy::HeightFrom;
using geodesy::PerturbationSeries;
using scene::Run;
using scene::Workshop;

constexpr const char* nominal_reading =
    "WGS84, longitude 30 deg, latitudes -90..90 deg, heights 200..35000 km; error = true minus found (Eq. "
    "2.54)";

/// Truncation errors of the corrected series on this range.
struct Reference {
  int order;
  double latitude_deg, height_m;
};
// oracle: geodesy_series order 2: *, order 3: *, order 4: latitude, order 4: height
constexpr std::array<Reference, 3> references = {
    {{2, 1.120e-6, 5.839e-2}, {3, 4.735e-9, 2.033e-4}, {4, 2.417e-11, 7.869e-7}}};

enum class Shown { latitude, height };

scene::Figure draw_map(const ErrorMap& map, Shown shown, int order) {
  const std::vector<double>& error = shown == Shown::latitude ? map.latitude_error_deg : map.height_error_m;
  const Extreme& extreme = shown == Shown::latitude ? map.latitude : map.height;
  const char* unit = shown == Shown::latitude ? "deg" : "m";
  scene::Table data({{"latitude_deg"}, {"height_km", 3, true}, {"error"}, {"magnitude"}});
  for (std::size_t i = 0; i < map.height_km.size(); ++i) {
    for (std::size_t j = 0; j < map.latitude_deg.size(); ++j) {
      const double e = error[i * map.latitude_deg.size() + j];
      data.add({map.latitude_deg[j], map.height_km[i], e, std::abs(e)});
    }
  }
  const std::string name = shown == Shown::latitude ? "latitude" : "height";
  return {std::move(data),
          "geodesy-error-map",
          {{"quantity", fmt::format("|{} error| ({})", name, unit)},
           {"heading", fmt::format("Order {}: {} error at most {} {}, at {:.0f} deg and {:.0f} km", order,
                                   name, scene::format_number(extreme.magnitude, 2), unit,
                                   std::abs(extreme.latitude_deg), extreme.height_km)}}};
}

/// Double precision adds its rounding to the truncation error: 2.2e-8 m of height at 35000 km, 1e-14 deg of
/// latitude.
scene::Showing show_map(const ErrorMap& map, Shown shown, const Reference& reference) {
  const char* reason =
      "truncation error by tools/oracles/geodesy_series.py; 0.5 % for the grid and for rounding";
  scene::Showing showing;
  showing.figure = draw_map(map, shown, reference.order);
  if (shown == Shown::latitude) {
    showing.quantities = {scene::near("max latitude error", "deg", map.latitude.magnitude,
                                      reference.latitude_deg, 0.005, reason)};
  } else {
    showing.quantities = {
        scene::near("max height error", "m", map.height.magnitude, reference.height_m, 0.005, reason)};
  }
  return showing;
}

const Run<ErrorMap>& add_map_run(scene::Chapter& chapter, const std::string& kind, PerturbationSeries method,
                                 const geodesy::SeriesTable& table, Arithmetic arithmetic,
                                 const std::string& reading) {
  return chapter.add_run<ErrorMap>(
      fmt::format("{}-order-{}", kind, method.order), reading, {},
      [=](Workshop& w) { return error_map(method, table, arithmetic, w.quick()); });
}

}  // namespace

SeriesRuns add_series_runs(scene::Chapter& chapter) {
  const geodesy::SeriesTable corrected = geodesy::corrected_series(), printed = printed_series();
  const std::string nominal = nominal_reading;
  SeriesRuns runs{};
  for (std::size_t i = 0; i < runs.corrected.size(); ++i) {
    const int order = static_cast<int>(i) + 1;
    const PerturbationSeries by_series{order, HeightFrom::series},
        by_projection{order, HeightFrom::projection};
    runs.corrected[i] =
        &add_map_run(chapter, "corrected", by_series, corrected, Arithmetic::double_precision, nominal);
    runs.extended[i] = &add_map_run(chapter, "extended", by_series, corrected, Arithmetic::extended,
                                    nominal + "; extended precision");
    runs.projected[i] =
        &add_map_run(chapter, "projected", by_projection, corrected, Arithmetic::double_precision,
                     nominal + "; height by projection on the normal");
    if (i >= runs.printed.size()) continue;
    runs.printed[i] =
        &add_map_run(chapter, "printed", by_series, printed, Arithmetic::double_precision,
                     nominal +
                         "; Table 2.6 as printed, with the equals sign in C8 read as minus and the "
                         "dimension of the last term of C9 repaired");
  }
  return runs;
}

void add_error_maps(scene::Chapter& chapter, const SeriesRuns& runs) {
  int figure = 23;
  for (const Reference& reference : references) {
    const Run<ErrorMap>& run = *runs.corrected.at(static_cast<std::size_t>(reference.order) - 1);
    for (const Shown shown : {Shown::latitude, Shown::height}) {
      chapter.add({.name = fmt::format("fig-2.{}", figure),
                   .title = fmt::format("Error in {}, order {}, over latitude and height",
                                        shown == Shown::latitude ? "latitude" : "height", reference.order),
                   .place = fmt::format("Figure 2.{}", figure),
                   .needs = {&run},
                   .show = [&run, shown, reference](Workshop& w) {
                     return show_map(w.result(run), shown, reference);
                   }});
      ++figure;
    }
  }
}

// Nominal is the series with its coefficients as printed, inferred with the misprints corrected.
void add_claims(scene::Chapter& chapter, const SeriesRuns& runs) {
  const std::string claim = "elgohary/claim-2.4/";
  const auto add = [&](const std::string& name, std::size_t order, auto read) {
    const Run<ErrorMap>&as_printed = *runs.printed[order - 1], &before = *runs.printed[order - 2];
    const Run<ErrorMap>&corrected = *runs.corrected[order - 1], &before_it = *runs.corrected[order - 2];
    chapter.add(scene::Measurement{claim + name,
                                   {&before, &as_printed, &before_it, &corrected},
                                   [&before, &as_printed, &before_it, &corrected, read](Workshop& w) {
                                     return scene::Measured{read(w.result(before), w.result(as_printed)),
                                                            read(w.result(before_it), w.result(corrected))};
                                   }});
  };
  const auto latitude = [](const ErrorMap& /*before*/, const ErrorMap& map) {
    return map.latitude.magnitude;
  };
  const auto height = [](const ErrorMap& /*before*/, const ErrorMap& map) { return map.height.magnitude; };
  const auto gain = [](const ErrorMap& before, const ErrorMap& map) {
    return std::min(before.latitude.magnitude / map.latitude.magnitude,
                    before.height.magnitude / map.height.magnitude);
  };
  add("order 4/latitude error, order of magnitude", 4, latitude);
  add("order 4/height error, order of magnitude", 4, height);
  add("order 2 to 3/improvement", 3, gain);
  add("order 3 to 4/improvement", 4, gain);
}

}  // namespace nlmech::chapters

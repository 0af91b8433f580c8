#include <algorithm>
#include <cmath>

#include "chapters/geodesy/scenes.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

std::vector<const scene::AnyRun*> all_of(const SeriesRuns& runs) {
  std::vector<const scene::AnyRun*> all;
  all.insert(all.end(), runs.corrected.begin(), runs.corrected.end());
  all.insert(all.end(), runs.extended.begin(), runs.extended.end());
  all.insert(all.end(), runs.projected.begin(), runs.projected.end());
  all.insert(all.end(), runs.printed.begin(), runs.printed.end());
  return all;
}

scene::Table largest_errors(const SeriesRuns& runs, Workshop& w) {
  scene::Table table({{"order"},
                      {"latitude_corrected_deg"},
                      {"latitude_extended_deg"},
                      {"latitude_printed_deg"},
                      {"height_corrected_m"},
                      {"height_extended_m"},
                      {"height_printed_m"},
                      {"height_projected_m"}});
  for (std::size_t i = 0; i < runs.corrected.size(); ++i) {
    const ErrorMap &corrected = w.result(*runs.corrected[i]), &extended = w.result(*runs.extended[i]);
    scene::Cell latitude_printed, height_printed;
    if (i < runs.printed.size()) {
      const ErrorMap& printed = w.result(*runs.printed[i]);
      latitude_printed = printed.latitude.magnitude;
      height_printed = printed.height.magnitude;
    }
    table.add({std::int64_t(i) + 1, corrected.latitude.magnitude, extended.latitude.magnitude,
               latitude_printed, corrected.height.magnitude, extended.height.magnitude, height_printed,
               w.result(*runs.projected[i]).height.magnitude});
  }
  return table;
}

/// The same numbers under headings for people.
scene::Table readable(const scene::Table& errors) {
  scene::Table table({{"order"},
                      {"latitude, double (deg)"},
                      {"latitude, exact (deg)"},
                      {"latitude, printed (deg)"},
                      {"height, double (m)"},
                      {"height, exact (m)"},
                      {"height, printed (m)"},
                      {"height, projected (m)"}});
  for (const auto& row : errors.rows()) table.add(row);
  return table;
}

/// The series sees the distance from the axis and the height above the equator only.
double change_with_longitude(const ErrorMap& at_30_deg, bool quick) {
  double change = 0;
  for (const double longitude_deg : {-170.0, -90.0, 0.0, 77.0}) {
    const ErrorMap map = error_map({4, geodesy::HeightFrom::series}, geodesy::corrected_series(),
                                   Arithmetic::extended, quick, longitude_deg);
    change = std::max(change, std::abs(map.latitude.magnitude / at_30_deg.latitude.magnitude - 1));
  }
  return change;
}

scene::Showing study(const SeriesRuns& runs, Workshop& w) {
  scene::Table table = largest_errors(runs, w);
  const ErrorMap &fifth = w.result(*runs.extended[4]), &sixth = w.result(*runs.extended[5]);
  const ErrorMap& printed = w.result(*runs.printed[3]);
  // oracle: geodesy_series order 5: latitude, order 5: height, order 6: latitude, order 4 as printed: *
  const char* program = "truncation error by tools/oracles/geodesy_series.py; 1 % for the grid";
  scene::Showing showing;
  showing.table = readable(table);
  showing.figure = {
      std::move(table),
      "geodesy-order-study",
      {{"heading", "Each order gains two digits; the table as printed gains none after order 3"}}};
  showing.quantities = {
      scene::near("max latitude error of order 5", "deg", fifth.latitude.magnitude, 1.143e-13, 0.01, program),
      scene::near("max height error of order 5", "m", fifth.height.magnitude, 3.219e-9, 0.01, program),
      scene::near("max latitude error of order 6", "deg", sixth.latitude.magnitude, 6.18e-16, 0.03,
                  "the same; 3 % for the rounding of extended precision, 2e-17 deg"),
      scene::near("max height error of order 4 as printed", "m", printed.height.magnitude, 1.508e-3, 0.005,
                  "the same with C6 as printed"),
      scene::near("max latitude error of order 4 as printed", "deg", printed.latitude.magnitude, 4.85e-7,
                  0.01, "the same with C3 and C8 as printed"),
      scene::at_most(
          "max height error of order 2 by projection", "m", w.result(*runs.projected[1]).height.magnitude,
          3e-8,
          "truncation 1.3e-8 m by (M + h)/2 times the squared latitude error, plus two ulp of 41000 km"),
      scene::at_most(
          "change of the latitude error of order 4 with longitude, relative", "1",
          change_with_longitude(w.result(*runs.extended[3]), w.quick()), 1e-6,
          "four roundings, 1.1e-19 of the distance from the axis each, over the error of 4.2e-13 rad"),
  };
  return showing;
}

}  // namespace

void add_order_study(scene::Chapter& chapter, const SeriesRuns& runs) {
  chapter.add({.name = "order-study",
               .title = "Largest error against the order: each order gains two digits; the printed table "
                        "gains none after 3",
               .place = "our own",
               .needs = all_of(runs),
               .show = [runs](Workshop& w) { return study(runs, w); }});
}

}  // namespace nlmech::chapters

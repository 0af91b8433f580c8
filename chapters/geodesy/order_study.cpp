#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "chapters/geodesy/error_map.hpp"

namespace nlmech::chapters::geodesy::order_study {
namespace {

using Maps = std::vector<const ErrorMap*>;  // index 0: order 1
using scene::Cell;

/// Error maps of one order.
struct Order {
  int order;
  const ErrorMap &corrected, &extended, &projected;
  const ErrorMap* printed;  ///< null above order 4
};

/// Relative change of the latitude error with longitude, on a coarse grid. The series depends only on r and
/// z.
double change_with_longitude() {
  const auto latitude_error = [](double longitude_deg) {
    return error_map(Form::extended, 4, true, longitude_deg).latitude.magnitude;
  };
  const double at_30_deg = latitude_error(30);
  double change = 0;
  for (const double longitude_deg : {-170.0, -90.0, 0.0, 77.0})
    change = std::max(change, std::abs(latitude_error(longitude_deg) / at_30_deg - 1));
  return change;
}

/// A column: name in the data of the figure, heading in the table, value.
struct Shown {
  std::string column, heading;
  std::function<Cell(const Order&)> error;
};
const std::vector<Shown>& all_shown() {
  using O = Order;
  static const std::vector<Shown> all = {
      {"order", "order", &O::order},
      {"latitude_corrected_deg", "latitude, double (deg)",
       [](const O& o) { return o.corrected.latitude.magnitude; }},
      {"latitude_extended_deg", "latitude, exact (deg)",
       [](const O& o) { return o.extended.latitude.magnitude; }},
      {"latitude_printed_deg", "latitude, printed (deg)",
       [](const O& o) { return o.printed ? Cell(o.printed->latitude.magnitude) : Cell(); }},
      {"height_corrected_m", "height, double (m)", [](const O& o) { return o.corrected.height.magnitude; }},
      {"height_extended_m", "height, exact (m)", [](const O& o) { return o.extended.height.magnitude; }},
      {"height_printed_m", "height, printed (m)",
       [](const O& o) { return o.printed ? Cell(o.printed->height.magnitude) : Cell(); }},
      {"height_projected_m", "height, projected (m)",
       [](const O& o) { return o.projected.height.magnitude; }}};
  return all;
}

/// Draws both panels with a common key below the heading. Points of the printed series are larger, to stay
/// visible where it agrees with the corrected one.
void draw(const std::vector<Order>& orders, scene::Show& show) {
  scene::Plot& plot = show.plots("Largest error: each order gains two digits; as printed none after 3");
  const auto panel = [&](const std::string& quantity, const std::string& unit) -> scene::Panel& {
    const std::string by_order = "order:" + quantity;
    return plot.panel("order of the expansion", "maximum |" + quantity + " error| (" + unit + ")")
        .x_range(0.7, 6.3)
        .log_y()
        .set("xtics 1")
        .set("ytics 100")
        .columns("as printed", by_order + "_printed_" + unit, {"linespoints pointsize 1.2", 5})
        .columns("corrected, double", by_order + "_corrected_" + unit, {"linespoints", 1})
        .columns("corrected, extended", by_order + "_extended_" + unit, {"linespoints", 3});
  };
  panel("latitude", "deg")
      .set("margins screen 0.125, screen 0.49, screen 0.13, screen 0.815")
      .key("at screen 0.5, screen 0.935 center top maxrows 2 samplen 3 spacing 1.1")
      .also("keyentry with linespoints linestyle 2 title 'height by projection'");
  panel("height", "m")
      .set("margins screen 0.615, screen 0.98, screen 0.13, screen 0.815")
      .key("off")
      .columns("", "order:height_projected_m", {"linespoints", 2});
  scene::ColumnsOf<std::vector<Order>> columns;
  for (const Shown& s : all_shown()) columns.emplace_back(s.column, s.error);
  plot.data(scene::table_of(orders, columns));
}

/// Nominal values use the coefficients as printed, inferred values and gains the corrected ones. C9
/// determines the latitude of order 4 as printed; the reading of C8's equals sign changes it by 2e-9 degrees.
void measure_claims(const Maps& corrected, Maps printed, const ErrorMap& literal, scene::Show& show) {
  printed[3] = &literal;
  const auto gain = [](const Maps& maps, std::size_t i) {
    const ErrorMap &before = *maps[i - 1], &map = *maps[i];
    return std::min(before.latitude.magnitude / map.latitude.magnitude,
                    before.height.magnitude / map.height.magnitude);
  };
  const auto earth = nlmech::geodesy::Ellipsoid::wgs84();
  show.measured("elgohary/eq-2.45/WGS 84/p", earth.a() / earth.b() - 1);
  const std::string claim = "elgohary/claim-2.4/";
  show.measured(claim + "order 4/latitude error, order of magnitude", printed[3]->latitude.magnitude,
                corrected[3]->latitude.magnitude);
  show.measured(claim + "order 4/height error, order of magnitude", printed[3]->height.magnitude,
                corrected[3]->height.magnitude);
  // oracle: geodesy_series order 2: latitude, order 3: latitude, order 4: latitude
  const char* ratio = "ratio of truncation errors by tools/oracles/geodesy_series.py; 1 % for the grid";
  show.near("gain of order 3, the lesser of latitude and height", gain(corrected, 2), 1.120e-6 / 4.735e-9,
            0.01, ratio);
  show.near("gain of order 4, the lesser of latitude and height", gain(corrected, 3), 4.735e-9 / 2.417e-11,
            0.01, ratio);
}

void put(const Maps& corrected, const Maps& extended, const Maps& projected, const Maps& printed,
         const ErrorMap& literal, scene::Show& show) {
  std::vector<Order> orders;
  for (std::size_t i = 0; i < corrected.size(); ++i)
    orders.push_back({static_cast<int>(i) + 1, *corrected[i], *extended[i], *projected[i],
                      i < printed.size() ? printed[i] : nullptr});
  draw(orders, show);
  scene::ColumnsOf<std::vector<Order>> headings;
  for (const Shown& s : all_shown()) headings.emplace_back(s.heading, s.error);
  show.table(orders, headings);

  // oracle: geodesy_series order 5: latitude, order 5: height, order 6: latitude, order 4 as printed: *,
  // order 4 with C9 in metres: latitude
  const char* program = "truncation error by tools/oracles/geodesy_series.py; 1 % for the grid";
  show.near("max latitude error of order 5", {extended[4]->latitude.magnitude, "deg"}, 1.143e-13, 0.01,
            program);
  show.near("max height error of order 5", {extended[4]->height.magnitude, "m"}, 3.219e-9, 0.01, program);
  show.near("max latitude error of order 6", {extended[5]->latitude.magnitude, "deg"}, 6.18e-16, 0.03,
            "the same; 3 % for the rounding of extended precision, 2e-17 deg");
  show.near("max height error of order 4 as printed", {printed[3]->height.magnitude, "m"}, 1.508e-3, 0.005,
            "the same with C6 as printed");
  show.near("max latitude error of order 4 as printed", {printed[3]->latitude.magnitude, "deg"}, 4.85e-7,
            0.01, "the same with C3 and C8 as printed");
  show.near("max latitude error of order 4 as printed, C9 in metres", {literal.latitude.magnitude, "deg"},
            6.39e-2, 0.01, "the same with the last term of C9 as printed");
  show.at_most("max height error of order 2 by projection", {projected[1]->height.magnitude, "m"}, 3e-8,
               "truncation 1.3e-8 m by (M + h)/2 times the squared latitude error, plus two ulp of 41000 km");
  show.at_most("change of the latitude error of order 4 with longitude, relative", change_with_longitude(),
               1e-6,
               "four roundings, 1.1e-19 of the distance from the axis each, over the error of 4.2e-13 rad");
  measure_claims(corrected, printed, literal, show);
}

std::vector<scene::Result<ErrorMap>> maps_of(Form form, int orders) {
  std::vector<scene::Result<ErrorMap>> maps;
  for (int order = 1; order <= orders; ++order) maps.push_back(map_of(form, order));
  return maps;
}

}  // namespace

std::vector<scene::Scene> scenes() {
  constexpr int highest = nlmech::geodesy::highest_order;
  return {{.name = "order-study",
           .title = "Largest error against the order: each order gains two digits; the printed table gains "
                    "none after 3",
           .content = scene::Content(put, maps_of(Form::corrected, highest), maps_of(Form::extended, highest),
                                     maps_of(Form::projected, highest), maps_of(Form::printed, 4),
                                     map_of(Form::literal, 4))}};
}

}  // namespace nlmech::chapters::geodesy::order_study

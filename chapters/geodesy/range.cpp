#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "chapters/geodesy/reference.hpp"
#include "chapters/geodesy/timed_methods.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::geodesy::range {
namespace {

using nlmech::geodesy::Cartesian;
using nlmech::geodesy::Ellipsoid;
using nlmech::geodesy::Geodetic;

constexpr double degree = std::numbers::pi / 180;

/// Largest latitude error of each method at an abscissa, rad; nothing if the method failed at a point.
struct Errors {
  double abscissa;
  std::map<std::string, std::optional<double>> of;
};

std::optional<double> worst(const OnePointMethod& method, const std::vector<Cartesian>& points,
                            const std::vector<Extended>& exact) {
  double largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::optional<Geodetic> found = method.reverse(points[i]);
    if (!found || !std::isfinite(found->latitude)) return std::nullopt;
    largest = std::max(largest, static_cast<double>(std::abs(found->latitude - exact[i])));
  }
  return largest;
}

Errors errors_of(double abscissa, const Ellipsoid& e, const std::vector<Cartesian>& points) {
  std::vector<Extended> exact;
  for (const Cartesian& p : points) exact.push_back(reference_reverse(p, e).latitude);
  Errors errors{abscissa, {}};
  for (const OnePointMethod& m : range_methods(e)) errors.of[m.name] = worst(m, points, exact);
  return errors;
}

std::vector<double> equal_ratios(double first, double last, int count) {
  std::vector<double> values;
  for (int i = 0; i <= count; ++i) values.push_back(first * std::pow(last / first, double(i) / count));
  return values;
}

/// A point on each of 45 rays. The equator and the axis are excluded: symmetry reduces the errors there.
/// @param at returns the point at a latitude, rad
template <class At>
std::vector<Cartesian> on_rays(At at) {
  std::vector<Cartesian> points;
  for (int i = 0; i < 45; ++i) points.push_back(at((1 + 2 * i) * degree));
  return points;
}

std::vector<Errors> over_distance(bool quick) {
  std::vector<Errors> all;
  for (const double km : equal_ratios(1e-3, 1e6, quick ? 45 : 135)) {
    const auto at = [&](double u) { return Cartesian{km * 1e3 * std::cos(u), 0, km * 1e3 * std::sin(u)}; };
    all.push_back(errors_of(km, Ellipsoid::wgs84(), on_rays(at)));
  }
  return all;
}

std::vector<Errors> over_flattening(bool quick) {
  std::vector<Errors> all;
  for (const double f : equal_ratios(1e-4, 0.9, quick ? 20 : 80)) {
    const Ellipsoid e(6378137, f);
    all.push_back(errors_of(f, e, on_rays([&](double u) { return forward(Geodetic{u, 0, 1e5}, e); })));
  }
  return all;
}

/// A method with its data column and line style.
struct Drawn {
  std::string method, column;
  scene::CurveStyle look;
};
const std::vector<Drawn> all_drawn = {{"fast", "fast_rad", {"lines linewidth 3", 1}},
                                      {"GeographicLib", "geographiclib_rad", {"lines", 3}},
                                      {"series, order 4", "series_4_rad", {"lines", 5}},
                                      {"series, order 6", "series_6_rad", {"lines", 4}},
                                      {"Bowring 1976, 2 iterations", "bowring_rad", {"lines", 2}},
                                      {"Vermeille 2011", "vermeille_rad", {"lines", 6}}};

scene::Table table_of(const std::vector<Errors>& distance, const std::vector<Errors>& flattening) {
  std::vector<scene::Column> columns = {{"panel", 3, true}, {"abscissa"}};
  for (const Drawn& d : all_drawn) columns.push_back({d.column});
  scene::Table table(columns);
  const auto add = [&](const char* panel, const Errors& errors) {
    std::vector<scene::Cell> row = {panel, errors.abscissa};
    for (const Drawn& d : all_drawn)
      row.emplace_back(errors.of.contains(d.method) ? errors.of.at(d.method) : std::nullopt);
    table.add(std::move(row));
  };
  for (const Errors& errors : distance) add("distance", errors);
  for (const Errors& errors : flattening) add("flattening", errors);
  return table;
}

/// Adds the curves of a data block, nlmech on top. An empty cell interrupts a curve; errors below 1e-17 are
/// drawn at 1e-17.
void add_curves(scene::Panel& panel, int block, const Errors& errors) {
  for (const std::size_t i : std::array<std::size_t, 6>{2, 3, 4, 5, 1, 0}) {
    const auto& [method, column, look] = all_drawn[i];
    if (!errors.of.contains(method)) continue;  // peer not in this build
    panel.columns(method, fmt::format("abscissa:(column('{0}') < 1e-17 ? 1e-17 : column('{0}'))", column),
                  look, block);
  }
}

void draw(const std::vector<Errors>& distance, const std::vector<Errors>& flattening, scene::Show& show) {
  const bool with_peer = distance.front().of.contains("GeographicLib");
  scene::Plot& plot = show.plots(
      with_peer ? "Latitude error of fast: only rounding, from 1 m to a million km and to f = 0.9"
                : "Latitude error of fast: only rounding at every distance (without GeographicLib)");
  plot.data(table_of(distance, flattening));
  scene::Panel& left = plot.panel("distance from the centre (km)", "max |latitude error| (rad)");
  left.log_x(1e-3, 1e6).log_y(1e-17, 10).set("xtics 1000").set("ytics 100");
  left.set("margins screen 0.12, screen 0.56, screen 0.13, screen 0.76");
  left.key("at screen 0.55, screen 0.93 center top maxrows 3 samplen 3 spacing 1.1");
  left.set("arrow 1 from 42.7, graph 0 to 42.7, graph 1 nohead linestyle 11");
  left.set("arrow 2 from 6371, graph 0 to 6371, graph 1 nohead linestyle 11");
  left.set("label 3 'evolute' at 42.7, graph 0.5 right offset -0.5,0 textcolor rgb soft_ink");
  left.set("label 4 'ground' at 6371, graph 0.5 left offset 0.5,0 textcolor rgb soft_ink");
  add_curves(left, 0, distance.front());
  scene::Panel& right = plot.panel("flattening f, 100 km high", "");
  right.log_x(1e-4, 1).log_y(1e-17, 10).set("xtics 10").set("ytics 100").set("format y ''").key("off");
  right.set("margins screen 0.61, screen 0.97, screen 0.13, screen 0.76");
  add_curves(right, 1, flattening.front());
}

/// Largest error of fast for abscissas >= @p first; infinite if it failed at one.
double largest_from(const std::vector<Errors>& all, double first) {
  double largest = 0;
  for (const Errors& errors : all) {
    if (errors.abscissa >= first) largest = std::max(largest, errors.of.at("fast").value_or(HUGE_VAL));
  }
  return largest;
}

void put(const std::vector<Errors>& distance, const std::vector<Errors>& flattening, scene::Show& show) {
  draw(distance, flattening, show);
  constexpr double surface_km = 6368;  // height above -10 km at all latitudes
  show.at_most("max latitude error of fast above -10 km", {largest_from(distance, surface_km), "rad"},
               4.5e-16, "error statement of ReverseTransform");
  show.at_most("max latitude error of fast down to 100 km from the centre",
               {largest_from(distance, 100), "rad"}, 1e-15,
               "a few roundings: the condition number of the latitude is below 2 there");
  show.at_most("max latitude error of fast for flattenings to 0.9", {largest_from(flattening, 0), "rad"},
               3e-15, "a few roundings of latitude, times the condition number 1/(1 - f) of the flattest");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result distance("latitude-error-over-distance",
                               "WGS84, 45 rays; exact in extended precision for the doubles given",
                               over_distance);
  const scene::Result flattening("latitude-error-over-flattening",
                                 "a = 6378137 m, 100 km high, 45 latitudes; exact in extended precision",
                                 over_flattening);
  return {{.name = "range",
           .title = "Latitude error from the centre to a million kilometres, and against flattening",
           .content = scene::Content(put, distance, flattening)}};
}

}  // namespace nlmech::chapters::geodesy::range

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>

#include "chapters/geodesy/contenders.hpp"
#include "chapters/geodesy/reference.hpp"
#include "chapters/geodesy/scenes.hpp"

namespace nlmech::chapters {
namespace {

using geodesy::Cartesian;
using geodesy::Ellipsoid;
using geodesy::Geodetic;
using scene::Workshop;

constexpr double degree = std::numbers::pi / 180;

/// Largest latitude error of a method at each abscissa; nothing where the method had no answer at one of the
/// points.
struct RangeCurve {
  std::string method;
  std::vector<double> abscissa;
  std::vector<std::optional<double>> error;
};

/// Points on rays from the equator to the pole, or whatever a study lets an abscissa stand for.
using PointsAt = std::function<std::vector<Cartesian>(double)>;
using EllipsoidAt = std::function<Ellipsoid(double)>;

std::optional<double> worst(const OnePointMethod& method, const std::vector<Cartesian>& points,
                            const std::vector<Extended>& truth) {
  double largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::optional<Geodetic> found = method.reverse(points[i]);
    if (!found || !std::isfinite(found->latitude)) return std::nullopt;
    largest = std::max(largest, static_cast<double>(std::abs(found->latitude - truth[i])));
  }
  return largest;
}

std::vector<RangeCurve> measure(const std::vector<double>& abscissas, const EllipsoidAt& ellipsoid_at,
                                const PointsAt& points_at) {
  std::vector<RangeCurve> curves;
  for (const double abscissa : abscissas) {
    const Ellipsoid e = ellipsoid_at(abscissa);
    const std::vector<Cartesian> points = points_at(abscissa);
    std::vector<Extended> truth;
    truth.reserve(points.size());
    for (const Cartesian& p : points) truth.push_back(reference_reverse(p, e).latitude);
    const std::vector<OnePointMethod> methods = range_methods(e);
    if (curves.empty()) {
      for (const OnePointMethod& m : methods) curves.push_back({m.name, {}, {}});
    }
    for (std::size_t i = 0; i < methods.size(); ++i) {
      curves[i].abscissa.push_back(abscissa);
      curves[i].error.push_back(worst(methods[i], points, truth));
    }
  }
  return curves;
}

std::vector<double> equal_ratios(double first, double last, int count) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(count) + 1);
  for (int i = 0; i <= count; ++i) values.push_back(first * std::pow(last / first, double(i) / count));
  return values;
}

/// Latitudes of the rays: none on the equator or the axis, where symmetry makes every method look better than
/// it is.
std::vector<double> ray_latitudes() {
  std::vector<double> latitudes;
  for (int i = 0; i < 45; ++i) latitudes.push_back((1 + 2 * i) * degree);
  return latitudes;
}

std::vector<RangeCurve> over_distance(bool quick) {
  const auto points_at = [](double distance_km) {
    std::vector<Cartesian> points;
    for (const double u : ray_latitudes()) {
      points.push_back({distance_km * 1e3 * std::cos(u), 0, distance_km * 1e3 * std::sin(u)});
    }
    return points;
  };
  return measure(
      equal_ratios(1e-3, 1e6, quick ? 45 : 135), [](double) { return Ellipsoid::wgs84(); }, points_at);
}

std::vector<RangeCurve> over_flattening(bool quick) {
  const auto ellipsoid_at = [](double f) { return Ellipsoid(6378137, f); };
  const auto points_at = [&](double f) {
    std::vector<Cartesian> points;
    for (const double u : ray_latitudes())
      points.push_back(geodesy::forward(Geodetic{u, 0, 1e5}, ellipsoid_at(f)));
    return points;
  };
  return measure(equal_ratios(1e-4, 0.9, quick ? 20 : 80), ellipsoid_at, points_at);
}

/// Columns of the figure's data, and the methods that fill them.
const std::vector<std::pair<std::string, std::string>> method_columns = {
    {"fast", "fast_rad"},
    {"GeographicLib", "geographiclib_rad"},
    {"series, order 4", "series_4_rad"},
    {"series, order 6", "series_6_rad"},
    {"Bowring 1976, 2 iterations", "bowring_rad"},
    {"Vermeille 2011", "vermeille_rad"}};

const RangeCurve* find(const std::vector<RangeCurve>& curves, const std::string& method) {
  for (const RangeCurve& curve : curves) {
    if (curve.method == method) return &curve;
  }
  return nullptr;
}

void add_rows(scene::Table& table, const std::string& panel, const std::vector<RangeCurve>& curves) {
  for (std::size_t i = 0; i < curves.front().abscissa.size(); ++i) {
    std::vector<scene::Cell> row = {panel, curves.front().abscissa[i]};
    for (const auto& [method, column] : method_columns) {
      const RangeCurve* curve = find(curves, method);
      row.push_back(scene::to_cell(curve ? curve->error[i] : std::nullopt));
    }
    table.add(std::move(row));
  }
}

/// Largest error of a method over the abscissas from @p first on; infinite where it once had no answer.
double largest_from(const std::vector<RangeCurve>& curves, const std::string& method, double first) {
  const RangeCurve& curve = *find(curves, method);
  double largest = 0;
  for (std::size_t i = 0; i < curve.abscissa.size(); ++i) {
    if (curve.abscissa[i] >= first) largest = std::max(largest, curve.error[i].value_or(HUGE_VAL));
  }
  return largest;
}

scene::Showing show(const std::vector<RangeCurve>& distance, const std::vector<RangeCurve>& flattening) {
  std::vector<scene::Column> columns = {{"panel", 3, true}, {"abscissa"}};
  for (const auto& [method, column] : method_columns) columns.push_back({column});
  scene::Table data(columns);
  add_rows(data, "distance", distance);
  add_rows(data, "flattening", flattening);
  scene::Showing showing;
  const bool with_peer = find(distance, "GeographicLib") != nullptr;
  showing.figure = {
      std::move(data),
      "geodesy-full-range",
      {{"heading", with_peer ? "Full accuracy from 1 m to a million km, and for flattenings to 0.9"
                             : "Full accuracy at every distance (built without GeographicLib)"},
       {"geographiclib", with_peer ? "yes" : "no"}}};
  constexpr double surface_km = 6368;  // above -10 km everywhere
  showing.quantities = {
      scene::at_most("max latitude error of fast above -10 km", "rad",
                     largest_from(distance, "fast", surface_km), 4.5e-16,
                     "error statement of ReverseTransform"),
      scene::at_most("max latitude error of fast down to 100 km from the centre", "rad",
                     largest_from(distance, "fast", 100), 1e-15,
                     "a few roundings: the condition number of the latitude is below 2 there"),
      scene::at_most("max latitude error of fast for flattenings to 0.9", "rad",
                     largest_from(flattening, "fast", 0), 3e-15,
                     "a few roundings of latitude, times the condition number 1/(1 - f) of the flattest"),
  };
  return showing;
}

}  // namespace

void add_range(scene::Chapter& chapter) {
  const auto& distance = chapter.add_run<std::vector<RangeCurve>>(
      "latitude-error-over-distance", "WGS84, 45 rays; truth in extended precision for the doubles given", {},
      [](Workshop& w) { return over_distance(w.quick()); });
  const auto& flattening = chapter.add_run<std::vector<RangeCurve>>(
      "latitude-error-over-flattening",
      "a = 6378137 m, 100 km high, 45 latitudes; truth in extended precision", {},
      [](Workshop& w) { return over_flattening(w.quick()); });
  chapter.add({.name = "range",
               .title = "Latitude error from the centre to a million kilometres, and against flattening",
               .place = "our own",
               .needs = {&distance, &flattening},
               .show = [&distance, &flattening](Workshop& w) {
                 return show(w.result(distance), w.result(flattening));
               }});
}

}  // namespace nlmech::chapters

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "nlmech/geodesy/ellipsoid.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::geodesy::height_study {
namespace {

constexpr double degree = std::numbers::pi / 180, latitude_error = 1e-9, height = 400e3;

/// Height errors in double precision, m; the first three with a latitude error of 1e-9 rad.
struct Errors {
  double latitude_deg, by_cosine, by_sine, by_projection, exact_latitude;
};

Errors errors_at(double latitude_deg) {
  const auto e = nlmech::geodesy::Ellipsoid::wgs84();
  const double latitude = latitude_deg * degree;
  const nlmech::geodesy::Cartesian p = forward(nlmech::geodesy::Geodetic{latitude, 0, height}, e);
  const auto projection = [&](double s, double c) {
    return std::abs(p.x * c + p.z * s - e.a() * std::sqrt(1 - e.e2() * s * s) - height);
  };
  const double s = std::sin(latitude + latitude_error), c = std::cos(latitude + latitude_error);
  const double N = e.a() / std::sqrt(1 - e.e2() * s * s);
  return {latitude_deg, std::abs(p.x / c - N - height), std::abs(p.z / s - N * (1 - e.e2()) - height),
          projection(s, c), projection(std::sin(latitude), std::cos(latitude))};
}

/// Draws the errors; values below 1e-11 m are drawn at 1e-11 m.
void draw(const std::vector<Errors>& all, scene::Show& show) {
  scene::Panel& panel = show.plot("Height error: the projection is insensitive to an error of latitude",
                                  "geodetic latitude (deg)", "|height error| (m)");
  panel.x_range(0, 90).log_y(5e-12, 10).set("xtics 15").set("ytics 100").set("title offset 0,3");
  panel.set("margins screen 0.12, screen 0.97, screen 0.13, screen 0.78");
  panel.key("at screen 0.54, screen 0.90 center top maxrows 2 samplen 2 spacing 1.2 width -9");
  const auto curve = [&](const std::string& column, const scene::CurveStyle& look, const std::string& name) {
    panel.columns(name, fmt::format("latitude_deg:(column('{0}') < 1e-11 ? 1e-11 : column('{0}'))", column),
                  look);
  };
  curve("by_cosine_m", {"lines", 2}, "{/:Italic r}/cos φ − {/:Italic N}, latitude off by 1e-9 rad");
  curve("by_sine_m", {"lines", 5}, "{/:Italic z}/sin φ − (1 − {/:Italic e}^2){/:Italic N}, the same");
  curve("by_projection_m", {"points pointtype 7 pointsize 0.35", 1}, "projection, the same");
  curve("exact_latitude_m", {"points pointtype 6 pointsize 0.5", 13}, "projection, exact latitude");
  show.figure().data(scene::table_of(all, {{"latitude_deg", &Errors::latitude_deg},
                                           {"by_cosine_m", &Errors::by_cosine},
                                           {"by_sine_m", &Errors::by_sine},
                                           {"by_projection_m", &Errors::by_projection},
                                           {"exact_latitude_m", &Errors::exact_latitude}}));
}

void put(scene::Show& show) {
  std::vector<Errors> all;
  for (int i = 1; i < 360; ++i) all.push_back(errors_at(i / 4.));
  draw(all, show);
  const auto worst = [&](double Errors::*of) { return std::ranges::max(all, {}, of).*of; };
  // (N + h) tan(phi) dphi at 89.75 degrees
  const double expected = (6399593 + height) * std::tan(89.75 * degree) * latitude_error;
  show.near("max height error of r/cos(phi) - N", {worst(&Errors::by_cosine), "m"}, expected, 0.01,
            "first-order error (N + h) tan(phi) dphi at 89.75 deg; 1 % for e^2 and rounding");
  show.at_most("max height error of the projection", {worst(&Errors::by_projection), "m"}, 4e-9,
               "second-order error 3e-12 m, and four roundings of 6800 km");
  show.at_most("max height error of the projection at the exact latitude",
               {worst(&Errors::exact_latitude), "m"}, 4e-9, "four roundings of 6800 km");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "height-study",
           .title = "Three formulas for the height at a latitude that is off by 1e-9 rad",
           .content = scene::Content(put)}};
}

}  // namespace nlmech::chapters::geodesy::height_study

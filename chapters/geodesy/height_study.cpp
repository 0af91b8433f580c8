#include <cmath>
#include <numbers>

#include "chapters/geodesy/scenes.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

constexpr double degree = std::numbers::pi / 180, latitude_error = 1e-9, height = 400e3;

struct HeightErrors {
  double by_cosine, by_sine, by_projection;
};

/// The three formulas in doubles at a latitude that is off by @p error radians.
HeightErrors height_errors(double latitude, double error) {
  const geodesy::Ellipsoid e = geodesy::Ellipsoid::wgs84();
  const geodesy::Cartesian p = geodesy::forward(geodesy::Geodetic{latitude, 0, height}, e);
  const double s = std::sin(latitude + error), c = std::cos(latitude + error);
  const double root = std::sqrt(1 - e.e2() * s * s), N = e.a() / root;
  return {std::abs(p.x / c - N - height), std::abs(p.z / s - N * (1 - e.e2()) - height),
          std::abs(p.x * c + p.z * s - e.a() * root - height)};
}

scene::Showing study() {
  scene::Table data(
      {{"latitude_deg"}, {"by_cosine_m"}, {"by_sine_m"}, {"by_projection_m"}, {"exact_latitude_m"}});
  double worst_cosine = 0, worst_projection = 0, worst_exact = 0;
  for (int i = 1; i < 360; ++i) {
    const double latitude = i / 4.0 * degree;
    const HeightErrors off = height_errors(latitude, latitude_error), exact = height_errors(latitude, 0);
    data.add({i / 4.0, off.by_cosine, off.by_sine, off.by_projection, exact.by_projection});
    worst_cosine = std::max(worst_cosine, off.by_cosine);
    worst_projection = std::max(worst_projection, off.by_projection);
    worst_exact = std::max(worst_exact, exact.by_projection);
  }
  scene::Showing showing;
  showing.figure = {std::move(data),
                    "geodesy-height-study",
                    {{"heading", "Height by projection forgives an error of latitude; the quotients do not"},
                     {"latitude_error", "1e-9 rad"}}};
  // (N + h) tan(phi) times the error of latitude, at 89.75 degrees
  const double expected = (6399593 + height) * std::tan(89.75 * degree) * latitude_error;
  showing.quantities = {
      scene::near("max height error of r/cos(phi) - N", "m", worst_cosine, expected, 0.01,
                  "first-order error (N + h) tan(phi) dphi at 89.75 deg; 1 % for e^2 and rounding"),
      scene::at_most("max height error of the projection", "m", worst_projection, 4e-9,
                     "second-order error 3e-12 m, and four roundings of 6800 km"),
      scene::at_most("max height error of the projection at the exact latitude", "m", worst_exact, 4e-9,
                     "four roundings of 6800 km"),
  };
  return showing;
}

}  // namespace

void add_height_study(scene::Chapter& chapter) {
  chapter.add({.name = "height-study",
               .title = "Three formulas for the height at a latitude that is off by 1e-9 rad",
               .place = "our own",
               .needs = {},
               .show = [](Workshop&) { return study(); }});
}

}  // namespace nlmech::chapters

#include <cmath>
#include <numbers>

#include "chapters/drawing.hpp"
#include "chapters/geodesy/scenes.hpp"

namespace nlmech::chapters {
namespace {

using geodesy::Cartesian;
using geodesy::Ellipsoid;
using geodesy::Geodetic;

constexpr double degree = std::numbers::pi / 180;

/// An ellipsoid of radius 1, flattened so far that the eye can tell the latitudes apart, and a satellite
/// above it.
struct Scenery {
  Ellipsoid ellipsoid;
  Geodetic satellite;

  [[nodiscard]] Cartesian at(double latitude, double longitude, double height = 0) const {
    return geodesy::forward(Geodetic{latitude, longitude, height}, ellipsoid);
  }
  /// Distance of the ellipsoid's point under the satellite from the centre of curvature on the equator's
  /// plane, N e^2.
  [[nodiscard]] double foot_distance() const {
    const double s = std::sin(satellite.latitude);
    return ellipsoid.a() / std::sqrt(1 - ellipsoid.e2() * s * s) * ellipsoid.e2() *
           std::cos(satellite.latitude);
  }
};

/// Largest deviation from what the drawing claims: the line from ground to satellite is the normal, and its
/// length is h.
double departure_from_normal(const Scenery& s) {
  const auto [latitude, longitude, height] = s.satellite;
  const Cartesian ground = s.at(latitude, longitude), above = s.at(latitude, longitude, height);
  const double b2 = s.ellipsoid.b() * s.ellipsoid.b(), a2 = s.ellipsoid.a() * s.ellipsoid.a();
  // the gradient of x^2/a^2 + y^2/a^2 + z^2/b^2 is normal to the ellipsoid
  const Cartesian n{ground.x / a2, ground.y / a2, ground.z / b2},
      d{above.x - ground.x, above.y - ground.y, above.z - ground.z};
  const double length = std::hypot(d.x, d.y, d.z),
               cosine = (n.x * d.x + n.y * d.y + n.z * d.z) / std::hypot(n.x, n.y, n.z);
  return std::max(std::abs(length - height), std::abs(cosine - height));
}

scene::Quantity drawn_normal(const Scenery& s) {
  return scene::at_most("departure of the drawn line from the normal", "1", departure_from_normal(s), 1e-15,
                        "geometry of Eq. 2.40: a few roundings of lengths about 1");
}

// ---------------------------------------------------------------------------------------------- figure 2.21,
// in space

class SpaceDrawing {
 public:
  void point(const std::string& element, const Cartesian& p) {
    ++curves_;
    add(element, p);
  }
  /// A curve over degrees from @p first to @p last.
  template <class Curve>
  void curve(const std::string& element, int first, int last, int step, Curve at) {
    ++curves_;
    for (int i = first; i <= last; i += step) add(element, at(i * degree));
  }
  scene::Table take() { return std::move(table_); }

 private:
  void add(const std::string& element, const Cartesian& p) { table_.add({element, p.x, p.y, p.z, curves_}); }
  std::int64_t curves_ = 0;
  scene::Table table_{{{"element"}, {"x"}, {"y"}, {"z"}, {"curve", 3, true}}};
};

void add_graticule(SpaceDrawing& drawing, const Scenery& s) {
  for (int i = 0; i < 12; ++i) {
    drawing.curve("graticule", -90, 90, 2, [&](double u) { return s.at(u, 30 * i * degree); });
  }
  for (int i = -60; i <= 60; i += 30) {
    drawing.curve("graticule", 0, 360, 2, [&](double u) { return s.at(i * degree, u); });
  }
}

scene::Showing draw_in_space() {
  const Scenery s{Ellipsoid(1, 0.2), {42 * degree, 65 * degree, 0.75}};
  const double latitude = s.satellite.latitude, longitude = s.satellite.longitude,
               height = s.satellite.height;
  const double arrow = 0.3, foot = s.foot_distance();
  const Cartesian satellite = s.at(latitude, longitude, height), ground = s.at(latitude, longitude);
  SpaceDrawing drawing;
  drawing.point("semi_axes", {s.ellipsoid.a(), s.ellipsoid.a(), s.ellipsoid.b()});
  drawing.point("satellite", satellite);
  drawing.point("ground", ground);
  drawing.point("foot", {foot * std::cos(longitude), foot * std::sin(longitude), 0});
  drawing.point("below", {satellite.x, satellite.y, 0});
  drawing.point("normal_tip", s.at(latitude, longitude, arrow));
  drawing.point("east_tip",
                {ground.x - arrow * std::sin(longitude), ground.y + arrow * std::cos(longitude), ground.z});
  drawing.curve("equator", 0, 360, 1, [&](double u) { return s.at(0, u); });
  drawing.curve("meridian", -90, 90, 1, [&](double u) { return s.at(u, longitude); });
  drawing.curve("zero_meridian", -90, 90, 1, [&](double u) { return s.at(u, 0); });
  drawing.curve("arc_longitude", 0, 65, 1, [](double u) {
    return Cartesian{0.45 * std::cos(u), 0.45 * std::sin(u), 0};
  });
  drawing.curve("arc_latitude", 0, 42, 1, [&](double u) {
    const double from_axis = foot + 0.3 * std::cos(u);
    return Cartesian{from_axis * std::cos(longitude), from_axis * std::sin(longitude), 0.3 * std::sin(u)};
  });
  add_graticule(drawing, s);
  return {scene::Figure{drawing.take(), "geodesy-fig-2.21", {}}, {}, {drawn_normal(s)}};
}

// --------------------------------------------------------------------------------------- figure 2.22, in the
// meridian

class MeridianDrawing {
 public:
  void point(const std::string& element, double r, double z) { table_.add({element, r, z}); }
  /// An arc about (centre, 0) with half axes a and b, over degrees.
  void arc(const std::string& element, double centre, double a, double b, double first_deg, double last_deg) {
    const int pieces = static_cast<int>(std::ceil(last_deg - first_deg));
    for (int i = 0; i <= pieces; ++i) {
      const double u = (first_deg + (last_deg - first_deg) * i / pieces) * degree;
      point(element, centre + a * std::cos(u), b * std::sin(u));
    }
  }
  scene::Table take() { return std::move(table_); }

 private:
  scene::Table table_{{{"element", 3, true}, {"r_xy"}, {"z"}}};
};

scene::Showing draw_in_the_meridian() {
  const Scenery s{Ellipsoid(1, 0.4), {60 * degree, 0, 0.35}};
  const double a = s.ellipsoid.a(), b = s.ellipsoid.b(), foot = s.foot_distance();
  const Cartesian satellite = s.at(s.satellite.latitude, 0, s.satellite.height),
                  ground = s.at(s.satellite.latitude, 0);
  const Cartesian tip = s.at(s.satellite.latitude, 0, 0.2);
  const double parametric = std::atan2(a * ground.z, b * ground.x),
               geocentric = std::atan2(satellite.z, satellite.x);
  MeridianDrawing drawing;
  drawing.point("semi_axes", a, b);
  drawing.point("satellite", satellite.x, satellite.z);
  drawing.point("ground", ground.x, ground.z);
  drawing.point("foot", foot, 0);
  drawing.point("circle", a * std::cos(parametric), a * std::sin(parametric));
  drawing.point("normal_tip", tip.x, tip.z);
  drawing.arc("ellipse", 0, a, b, -12, 102);
  drawing.arc("auxiliary_circle", 0, a, a, -12, 102);
  drawing.arc("arc_geodetic", foot, 0.13, 0.13, 0, s.satellite.latitude / degree);
  drawing.arc("arc_parametric", 0, 0.36, 0.36, 0, parametric / degree);
  drawing.arc("arc_geocentric", 0, 0.20, 0.20, 0, geocentric / degree);
  // Eq. 2.53 corrected: tan(phi_g) = (a/b) tan(phi_c)
  const double from_parametric = std::atan2(a * std::sin(parametric), b * std::cos(parametric));
  scene::Showing showing{scene::Figure{drawing.take(), "geodesy-fig-2.22", {}}, {}, {drawn_normal(s)}};
  showing.quantities.push_back(scene::near("geodetic latitude from the drawn parametric one", "deg",
                                           from_parametric / degree, 60, 1e-15,
                                           "drawn at 60 deg; two roundings"));
  return showing;
}

}  // namespace

void add_drawings(scene::Chapter& chapter) {
  add_drawing(chapter, "fig-2.21", "Cartesian and geodetic coordinates of a satellite (drawn)",
              draw_in_space);
  add_drawing(chapter, "fig-2.22", "Geodetic, parametric and geocentric latitude in the meridian (drawn)",
              draw_in_the_meridian);
}

}  // namespace nlmech::chapters

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "nlmech/geodesy/ellipsoid.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::geodesy::drawings {
namespace {

using nlmech::geodesy::Cartesian;
using nlmech::geodesy::Ellipsoid;
using nlmech::geodesy::Geodetic;
using std::cos;
using std::sin;

constexpr double degree = std::numbers::pi / 180;

/// An ellipsoid of radius 1, with a flattening large enough to distinguish the latitudes, and a satellite.
struct Scenery {
  Ellipsoid ellipsoid;
  Geodetic satellite;

  [[nodiscard]] Cartesian at(double latitude, double longitude, double height = 0) const {
    return forward(Geodetic{latitude, longitude, height}, ellipsoid);
  }
  /// Point at a height on the ellipsoid normal through the satellite.
  [[nodiscard]] Cartesian above(double height) const {
    return at(satellite.latitude, satellite.longitude, height);
  }
  /// Distance from the axis to the point where the normal through the satellite meets the equatorial plane,
  /// N e^2 cos(phi).
  [[nodiscard]] double foot_distance() const {
    const double s = sin(satellite.latitude);
    return ellipsoid.a() / std::sqrt(1 - ellipsoid.e2() * s * s) * ellipsoid.e2() * cos(satellite.latitude);
  }
};

/// Checks that the line from ground to satellite is normal to the ellipsoid and has the length h.
void check_normal(const Scenery& s, scene::Show& show) {
  const Cartesian ground = s.above(0), above = s.above(s.satellite.height);
  const double b2 = s.ellipsoid.b() * s.ellipsoid.b(), a2 = s.ellipsoid.a() * s.ellipsoid.a();
  // Gradient of x^2/a^2 + y^2/a^2 + z^2/b^2, normal to the ellipsoid.
  const Cartesian n{ground.x / a2, ground.y / a2, ground.z / b2},
      d{above.x - ground.x, above.y - ground.y, above.z - ground.z};
  const double length = std::hypot(d.x, d.y, d.z),
               cosine = (n.x * d.x + n.y * d.y + n.z * d.z) / std::hypot(n.x, n.y, n.z);
  show.at_most("departure of the drawn line from the normal",
               std::max(std::abs(length - s.satellite.height), std::abs(cosine - s.satellite.height)), 1e-15,
               "geometry of Eq. 2.40: a few roundings of lengths about 1");
}

/// Points and curves in space, each with the name of its element.
class SpaceDrawing {
 public:
  void point(const std::string& element, const Cartesian& p) {
    curve(element, 0, 0, 1, [&](double) { return p; });
  }
  /// Adds a curve for angles from @p first to @p last in steps of @p step, degrees.
  template <class Curve>
  void curve(const std::string& element, int first, int last, int step, Curve at) {
    ++curves_;
    for (int i = first; i <= last; i += step) {
      const Cartesian p = at(i * degree);
      table.add({element, p.x, p.y, p.z, curves_});
    }
  }
  scene::Table table{{{"element"}, {"x"}, {"y"}, {"z"}, {"curve", 3, true}}};

 private:
  int curves_ = 0;
};

void add_graticule(SpaceDrawing& drawing, const Scenery& s) {
  for (int i = 0; i < 360; i += 30)
    drawing.curve("graticule", -90, 90, 2, [&](double u) { return s.at(u, i * degree); });
  for (int i = -60; i <= 60; i += 30)
    drawing.curve("graticule", 0, 360, 2, [&](double u) { return s.at(i * degree, u); });
}

void draw_in_space(scene::Show& show) {
  const Scenery s{Ellipsoid(1, 0.2), {42 * degree, 65 * degree, 0.75}};
  const double longitude = s.satellite.longitude, arrow = 0.3, foot = s.foot_distance();
  const Cartesian satellite = s.above(s.satellite.height), ground = s.above(0);
  SpaceDrawing drawing;
  drawing.point("semi_axes", {s.ellipsoid.a(), s.ellipsoid.a(), s.ellipsoid.b()});
  drawing.point("satellite", satellite);
  drawing.point("ground", ground);
  drawing.point("foot", {foot * cos(longitude), foot * sin(longitude), 0});
  drawing.point("below", {satellite.x, satellite.y, 0});
  drawing.point("normal_tip", s.above(arrow));
  drawing.point("east_tip", {ground.x - arrow * sin(longitude), ground.y + arrow * cos(longitude), ground.z});
  drawing.curve("equator", 0, 360, 1, [&](double u) { return s.at(0, u); });
  drawing.curve("meridian", -90, 90, 1, [&](double u) { return s.at(u, longitude); });
  drawing.curve("zero_meridian", -90, 90, 1, [&](double u) { return s.at(u, 0); });
  drawing.curve("arc_longitude", 0, 65, 1, [](double u) {
    return Cartesian{0.45 * cos(u), 0.45 * sin(u), 0};
  });
  drawing.curve("arc_latitude", 0, 42, 1, [&](double u) {
    const double from_axis = foot + 0.3 * cos(u);
    return Cartesian{from_axis * cos(longitude), from_axis * sin(longitude), 0.3 * sin(u)};
  });
  add_graticule(drawing, s);
  show.draw(std::move(drawing.table), "geodesy-fig-2.21", {});
  check_normal(s, show);
}

void draw_in_the_meridian(scene::Show& show) {
  const Scenery s{Ellipsoid(1, 0.4), {60 * degree, 0, 0.35}};
  const double a = s.ellipsoid.a(), b = s.ellipsoid.b(), foot = s.foot_distance();
  const Cartesian satellite = s.above(s.satellite.height), ground = s.above(0), tip = s.above(0.2);
  const double parametric = std::atan2(a * ground.z, b * ground.x),
               geocentric = std::atan2(satellite.z, satellite.x);
  scene::Table table({{"element", 3, true}, {"r_xy"}, {"z"}});
  table.add({"semi_axes", a, b});
  table.add({"satellite", satellite.x, satellite.z});
  table.add({"ground", ground.x, ground.z});
  table.add({"foot", foot, 0.});
  table.add({"circle", a * cos(parametric), a * sin(parametric)});
  table.add({"normal_tip", tip.x, tip.z});
  // Elliptic arc about (centre, 0) with the given half axes; angles in degrees.
  const auto arc = [&](const char* element, double centre, double half_r, double half_z, double first_deg,
                       double last_deg) {
    const int pieces = static_cast<int>(std::ceil(last_deg - first_deg));
    for (int i = 0; i <= pieces; ++i) {
      const double u = (first_deg + (last_deg - first_deg) * i / pieces) * degree;
      table.add({element, centre + half_r * cos(u), half_z * sin(u)});
    }
  };
  arc("ellipse", 0, a, b, -12, 102);
  arc("auxiliary_circle", 0, a, a, -12, 102);
  arc("arc_geodetic", foot, 0.13, 0.13, 0, s.satellite.latitude / degree);
  arc("arc_parametric", 0, 0.36, 0.36, 0, parametric / degree);
  arc("arc_geocentric", 0, 0.20, 0.20, 0, geocentric / degree);
  show.draw(std::move(table), "geodesy-fig-2.22", {});
  check_normal(s, show);
  // Eq. 2.53 corrected: tan(phi_g) = (a/b) tan(phi_c)
  const double from_parametric = std::atan2(a * sin(parametric), b * cos(parametric));
  show.near("geodetic latitude from the drawn parametric one", {from_parametric / degree, "deg"}, 60, 1e-15,
            "drawn at 60 deg; two roundings");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "fig-2.21",
           .title = "Cartesian and geodetic coordinates of a satellite (drawn)",
           .place = "Figure 2.21",
           .content = scene::Content(draw_in_space)},
          {.name = "fig-2.22",
           .title = "Geodetic, parametric and geocentric latitude in the meridian (drawn)",
           .place = "Figure 2.22",
           .content = scene::Content(draw_in_the_meridian)}};
}

}  // namespace nlmech::chapters::geodesy::drawings

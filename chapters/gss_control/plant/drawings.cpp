#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "chapters/drawing.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/spacecraft/parameters.hpp"

namespace nlmech::chapters::gss_control::drawings {
namespace {

/// Geometry of the drawing: hub rotated by an angle, deflections exaggerated.
struct Craft {
  double radius = 1, length = 5.2, angle = 0.35, bend = 1.1;
  [[nodiscard]] Spot along() const { return direction(angle); }
  [[nodiscard]] Spot across() const { return direction(angle + std::numbers::pi / 2); }
  /// Static shape of a clamped beam under a force at its tip: xi^2 (3 - xi)/2.
  [[nodiscard]] Spot beam(double xi) const {
    return (radius + length * xi) * along() + bend * xi * xi * (3 - xi) / 2 * across();
  }
};

void draw_appendage(Drawing& d, const Craft& c, double sign) {
  std::vector<Spot> rest, bent;
  for (int i = 0; i <= 60; ++i) {
    rest.push_back(sign * (c.radius + c.length * i / 60) * c.along());
    bent.push_back(sign * c.beam(i / 60.0));
  }
  d.path("rest", rest);
  d.path("member", bent);
  d.arc("body", bent.back(), 0.22, 0, 2 * std::numbers::pi);
}

void draw_spacecraft(scene::Show& show) {
  const Craft c;
  Drawing d;
  d.arrow({0, 0}, {8, 0});
  d.text("{/:Bold n}_1", {8.35, 0});
  d.arrow({0, 0}, {0, 3.2});
  d.text("{/:Bold n}_2", {0.45, 3.25});
  d.arrow({0, 0}, 8.3 * c.along(), "axis");
  d.text("{/:Bold b}_1", 8.65 * c.along());
  d.arrow({0, 0}, 3.2 * c.across(), "axis");
  d.text("{/:Bold b}_2", 3.55 * c.across());
  draw_appendage(d, c, 1);
  draw_appendage(d, c, -1);
  d.arc("body", {0, 0}, c.radius, 0, 2 * std::numbers::pi);
  d.turn({0, 0}, 4.6, 0, c.angle);
  d.text("{/:Italic θ}", 5.0 * direction(c.angle / 2));
  d.turn({0, 0}, 1.45, 3.6, 5.6, "force");
  d.text("{/:Italic u}", {0.2, -1.95});
  d.text("hub {/:Italic I}_{hub}", {-1.6, 1.35});
  d.text("{/:Italic m} {/:Italic I}_{tip}", c.beam(1) + Spot{-0.2, 0.65});
  d.text("{/:Italic m} {/:Italic I}_{tip}", -1 * c.beam(1) + Spot{0.2, -0.65});
  d.text("{/:Italic ρ} {/:Italic EI} {/:Italic L}", -1 * c.beam(0.6) + Spot{0.3, -0.55});
  // Moment of inertia of the rigid body, by the formulas of (3.20) and by a sum over slices of the
  // appendages.
  const spacecraft::Parameters p = spacecraft::table_3_1();
  double slices = p.hub_inertia + 2 * p.tip_mass * std::pow(p.hub_radius + p.length, 2) + 2 * p.tip_inertia;
  constexpr int n = 2000;
  const double h = p.length / n;
  for (int i = 0; i < n; ++i)
    slices += 2 * p.mass_per_length * h * (std::pow(p.hub_radius + (i + 0.5) * h, 2) + h * h / 12);
  show.draw(d.take({{"heading", "A rigid hub with two flexible appendages and tip bodies"},
                    {"xrange", "[-7.6:9]"},
                    {"yrange", "[-4.1:4.3]"},
                    {"height", "400"}}));
  show.near("inertia of the rigid body", {p.total_inertia(), "slug ft^2"}, slices, 1e-12,
            "the sum over 2000 rigid slices of an appendage, each with its inertia: exact to rounding");
  show.near("the same, by hand", {p.total_inertia(), "slug ft^2"}, 18.0961, 1e-12,
            "8 + 2 x 0.1569 x 25 + 2 x 0.0018 + 2 x 0.0271875 x 124/3 by hand");
}

void draw_appendage_axes(scene::Show& show) {
  Craft c{.radius = 1.6, .length = 5.6, .angle = 0.3, .bend = 1.7};
  Drawing d;
  const double at = 0.62;
  const Spot foot = (c.radius + c.length * at) * c.along(), point = c.beam(at);
  d.arrow({0, 0}, {8.2, 0});
  d.text("{/:Bold n}_1", {8.55, 0});
  d.arrow({0, 0}, 8.6 * c.along(), "axis");
  d.text("{/:Bold b}_1", 8.95 * c.along());
  d.arrow({0, 0}, 3.3 * c.across(), "axis");
  d.text("{/:Bold b}_2", 3.65 * c.across());
  std::vector<Spot> bent;
  for (int i = 0; i <= 60; ++i) bent.push_back(c.beam(i / 60.0));
  d.path("member", bent);
  d.arc("body", bent.back(), 0.2, 0, 2 * std::numbers::pi);
  d.arc("body", {0, 0}, c.radius, 0, 2 * std::numbers::pi);
  d.arrow(foot, point - 0.05 * (point - foot), "force");
  d.text("{/:Italic y}", foot + 0.45 * (point - foot) + Spot{0.3, 0.05});
  // Dimension lines of lengths below the axis b_1; that of the total length is above the tip, clear of n_1.
  const Spot below = -0.45 * c.across();
  const auto measure = [&](double from, double to, const std::string& name, double offset) {
    const Spot shift = offset * below;
    d.arrow(0.5 * (from + to) * c.along() + shift, from * c.along() + shift);
    d.arrow(0.5 * (from + to) * c.along() + shift, to * c.along() + shift);
    d.text(name, 0.5 * (from + to) * c.along() + shift + 0.75 * below);
  };
  measure(0, c.radius, "{/:Italic r}", 1);
  measure(c.radius, c.radius + at * c.length, "{/:Italic x}", 1);
  measure(c.radius, c.radius + c.length, "{/:Italic L}", -5.2);
  d.turn({0, 0}, 7.6, 0, c.angle);
  d.text("{/:Italic θ}", 7.95 * direction(0.4 * c.angle));
  d.text("hub", {-0.5, 0.75});
  d.text("{/:Italic m} {/:Italic I}_{tip}", c.beam(1) + Spot{0.95, 0});
  // The drawn shape is that of a clamped beam: tangent to b_1 at the hub, without bending moment at the tip.
  const auto xi = [](double t) { return t * t * (3 - t) / 2; };
  constexpr double h = 1e-3;
  show.draw(d.take({{"heading", "The deflection is measured from the axis that turns with the hub"},
                    {"xrange", "[-2.2:9.8]"},
                    {"yrange", "[-2:5.2]"},
                    {"height", "430"}}));
  show.near("slope of the drawn shape at the hub", (xi(h) - xi(-h)) / (2 * h) + 1, 1, 1e-6,
            "clamped: the central difference of a cubic, off by h^2/2");
  show.near("curvature of the drawn shape at the tip", (xi(1 + h) - 2 * xi(1) + xi(1 - h)) / (h * h) + 1, 1,
            1e-9, "no moment there: the second difference of a cubic is exact but for rounding over h^2");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "fig-3.1",
           .title = "The symmetric rotating spacecraft (drawn)",
           .place = "Figure 3.1",
           .content = scene::Content(draw_spacecraft)},
          {.name = "fig-3.2",
           .title = "Deformation and axes of an appendage (drawn)",
           .place = "Figure 3.2",
           .content = scene::Content(draw_appendage_axes)}};
}

}  // namespace nlmech::chapters::gss_control::drawings

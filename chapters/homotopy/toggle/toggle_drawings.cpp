#include <algorithm>
#include <cmath>
#include <vector>

#include "chapters/drawing.hpp"
#include "chapters/homotopy/toggle/toggles.hpp"
#include "nlmech/frames/stability_functions.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::homotopy::toggle_drawings {
namespace {

/// Draws a hatched support at the end of a member.
void draw_base(Drawing& d, Spot at) {
  d.path("ground", {at + Spot{-0.9, 0}, at + Spot{0.9, 0}});
  for (int i = 0; i < 6; ++i)
    d.path("hatch", {at + Spot{-0.9 + 0.3 * (i + 1), 0}, at + Spot{-0.9 + 0.3 * i, -0.35}});
}

// ------------------------------------------------------------------------------------ figure 2.4, the toggle

/// Corners of the drawing, with an exaggerated height of 0.27 l (actual: 0.025 to 0.034 l).
constexpr Spot left{-8, 0}, apex{0, 2.3}, right{8, 0};

/// Stiffness at rest by linear theory: 2 (12 EI cos^2(beta)/l^3 + EA sin^2(beta)/l).
double linear_stiffness(double height) {
  const frames::Toggle t;
  const double sine = height / t.length;
  return 2 * (12 * t.ei * (1 - sine * sine) / std::pow(t.length, 3) + t.ea * sine * sine / t.length);
}

void draw_toggle(scene::Show& show) {
  Drawing d;
  draw_base(d, left);
  draw_base(d, right);
  d.path("member", {left, apex, right});
  d.path("thin", {left + Spot{1, 0}, right - Spot{1, 0}});
  d.arrow(apex + Spot{0, 1.7}, apex + Spot{0, 0.15}, "force");
  d.text("{/:Italic W}", apex + Spot{0.5, 1.2});
  d.path("thin", {apex, {0, 0}});
  d.arrow({0.35, 1.2}, {0.35, 2.05});
  d.arrow({0.35, 0.9}, {0.35, 0.05});
  d.text("{/:Italic l} sin {/:Italic β}", {1.25, 1.05});
  d.arc("thin", left, 2.6, 0, std::atan2(apex.y, -left.x));
  d.text("{/:Italic β}", left + Spot{3.0, 0.4});
  d.text("{/:Italic l} {/:Italic EA} {/:Italic EI}", {-4.6, 1.75});
  d.text("{/:Italic l} {/:Italic EA} {/:Italic EI}", {4.6, 1.75});
  d.joint(apex);
  double worst = 0;
  for (const double height : heights)
    worst = std::max(worst, std::abs(element_curve(height)->stiffness(0) / linear_stiffness(height) - 1));
  show.draw(d.take({{"heading", "Williams' toggle: two members, clamped, rigidly joined, loaded at the apex"},
                    {"xrange", "[-10:10]"},
                    {"yrange", "[-1:4.5]"},
                    {"height", "260"}}));
  show.at_most("stiffness at rest against linear theory, relative", worst, 1e-13,
               "two bars and two beams in closed form; some hundred roundings");
}

// -------------------------------------------------------------------- figure 2.5, the symmetric deformation

/// Deflection of a clamped beam-column whose far end moves sideways by one without rotation, under the
/// compression P l^2/EI = k^2: y = a + b xi - a cos k xi + d sin k xi. The transverse force is d k^3 EI/l^3.
struct Sway {
  explicit Sway(double wave) : k(wave) {
    const double s = std::sin(k), c = 1 - std::cos(k);
    d = 1 / (c * c / s + s - k);
    a = d * c / s;
  }
  [[nodiscard]] double at(double xi) const {
    return a * (1 - std::cos(k * xi)) + d * (std::sin(k * xi) - k * xi);
  }
  double k, a = 0, d = 0;
};

void draw_deflected(scene::Show& show) {
  constexpr double fall = 1.5;
  // The shape is drawn for the compression at the maximum of l sin(beta) = 0.44 in.
  const frames::Williams w{.height = 0.44};
  const double p = w.compression(0.2282), k = std::sqrt(p * w.length * w.length / w.ei);
  const Sway sway(k);
  Drawing drawing;
  const Spot r{-8, 0}, s{0, 3.0}, e = (1 / length(s - r)) * (s - r), across{e.y, -e.x};
  draw_base(drawing, r);
  drawing.path("rest", {r, s});
  drawing.path("rest", {s, {8, 0}});
  draw_base(drawing, {8, 0});
  // Components of the apex deflection `fall`: fall cos(beta) across the member, fall sin(beta) along it.
  std::vector<Spot> line, mirrored;
  for (int i = 0; i <= 60; ++i) {
    const double xi = i / 60.0;
    const Spot at = r + xi * (length(s - r) - fall * e.y) * e + fall * e.x * sway.at(xi) * across;
    line.push_back(at);
    mirrored.push_back({-at.x, at.y});
  }
  drawing.path("member", line);
  drawing.path("member", mirrored);
  const Spot fallen = line.back();
  drawing.arrow(s + Spot{0, 1.5}, s + Spot{0, 0.1}, "force");
  drawing.text("{/:Italic W}", s + Spot{0.5, 1.1});
  drawing.arrow(s + Spot{0.25, 0}, fallen + Spot{0.25, 0});
  drawing.text("{/:Italic δ}", s + Spot{0.65, -0.75});
  drawing.arrow(fallen, fallen - 2.4 * e, "force");
  drawing.text("{/:Italic P}", fallen - 2.4 * e + Spot{-0.3, -0.35});
  drawing.arrow(fallen, fallen + 1.6 * across, "force");
  drawing.text("{/:Italic F}", fallen + 1.6 * across + Spot{0.5, 0});
  drawing.text("{/:Italic r}", r + Spot{-0.2, 0.5});
  drawing.text("{/:Italic s}", s + Spot{-0.5, 0.2});
  drawing.text("{/:Italic s′}", fallen + Spot{-0.55, 0.35});
  drawing.joint(fallen);
  const double n = -k * k, force = frames::stability_functions<double>(n).antisymmetric.value + n;
  show.draw(
      drawing.take({{"heading", "Symmetric deformation: the apex does not rotate, each member bends to an S"},
                    {"xrange", "[-10:10]"},
                    {"yrange", "[-1.2:5]"},
                    {"height", "290"}}));
  show.near("transverse force of the drawn shape over 6 EI d_5 delta/l^3", sway.d * k * k * k / force, 1,
            1e-13, "the beam-column's differential equation solved in closed form; some hundred roundings");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "fig-2.4",
           .title = "Williams' toggle (drawn)",
           .place = "Figure 2.4",
           .content = scene::Content(draw_toggle)},
          {.name = "fig-2.5",
           .title = "The symmetric deformation of the toggle (drawn)",
           .place = "Figure 2.5",
           .content = scene::Content(draw_deflected)}};
}

}  // namespace nlmech::chapters::homotopy::toggle_drawings

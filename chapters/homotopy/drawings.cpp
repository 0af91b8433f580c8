#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "chapters/drawing.hpp"
#include "chapters/homotopy/curves.hpp"
#include "chapters/homotopy/scenes.hpp"
#include "chapters/homotopy/toggles.hpp"
#include "nlmech/frames/stability_functions.hpp"

namespace nlmech::chapters {
namespace {

/// A base that holds a member's end, hatched below.
void draw_base(Drawing& d, Spot at) {
  d.path("ground", {at + Spot{-0.9, 0}, at + Spot{0.9, 0}});
  for (int i = 0; i < 6; ++i)
    d.path("hatch", {at + Spot{-0.9 + 0.3 * (i + 1), 0}, at + Spot{-0.9 + 0.3 * i, -0.35}});
}

// ------------------------------------------------------------------------------------ figure 2.4, the toggle

/// Drawn with a height of 0.27 l; the real one is 0.025 to 0.034 l.
constexpr Spot left{-8, 0}, apex{0, 2.3}, right{8, 0};

/// Stiffness at rest by linear theory: 2 (12 EI cos^2(beta)/l^3 + EA sin^2(beta)/l).
double linear_stiffness(double height) {
  const frames::Toggle t;
  const double sine = height / t.length;
  return 2 * (12 * t.ei * (1 - sine * sine) / std::pow(t.length, 3) + t.ea * sine * sine / t.length);
}

scene::Showing draw_toggle() {
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
  return {d.take({{"heading", "Two members, rigidly joined, clamped, and loaded at the apex"},
                  {"xrange", "[-10:10]"},
                  {"yrange", "[-1:4.5]"},
                  {"height", "260"}}),
          {},
          {scene::at_most("stiffness at rest against linear theory, relative", "1", worst, 1e-13,
                          "two bars and two beams in closed form; some hundred roundings")}};
}

// -------------------------------------------------------------------- figure 2.5, the symmetric deformation

/// Deflection of a clamped beam-column whose far end moves sideways by one and does not turn, in compression
/// P l^2/EI = k^2: y = a + b xi - a cos k xi + d sin k xi. The transverse force is d k^3 EI/l^3.
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

scene::Showing draw_deflected() {
  constexpr double fall = 1.5;
  // The compression at the maximum of l sin(beta) = 0.44 in, by which the shape is drawn.
  const frames::Williams w{.height = 0.44};
  const double p = w.compression(0.2282), k = std::sqrt(p * w.length * w.length / w.ei);
  const Sway sway(k);
  Drawing drawing;
  const Spot r{-8, 0}, s{0, 3.0}, e = (1 / length(s - r)) * (s - r), across{e.y, -e.x};
  draw_base(drawing, r);
  drawing.path("rest", {r, s});
  drawing.path("rest", {s, {8, 0}});
  draw_base(drawing, {8, 0});
  // The apex falls by `fall`: that is fall cos(beta) across the member, and fall sin(beta) along it.
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
  return {drawing.take({{"heading", "The apex moves down and does not turn; members bend to an S"},
                        {"xrange", "[-10:10]"},
                        {"yrange", "[-1.2:5]"},
                        {"height", "290"}}),
          {},
          {scene::near("transverse force of the drawn shape over 6 EI d_5 delta/l^3", "1",
                       sway.d * k * k * k / force, 1, 1e-13,
                       "the beam-column's differential equation solved in closed form; some hundred "
                       "roundings")}};
}

// ----------------------------------------------------------- figure 2.12, a member's sign convention

/// Hermite's cubic with these end slopes: the deflection of a beam without axial force, over its length.
double hermite(double xi, double theta_1, double theta_2) {
  return theta_1 * xi * (1 - xi) * (1 - xi) - theta_2 * xi * xi * (1 - xi);
}

/// m_1 and m_2 by Eqs 2.27 and 2.28 against -+ the curvature of the cubic at its ends.
double moment_error(double theta_1, double theta_2) {
  const auto g = frames::stability_functions<double>(0.0);
  const double m_a = g.antisymmetric.value * (theta_1 + theta_2) / 2,
               m_s = g.symmetric.value * (theta_1 - theta_2) / 2;
  const double m_1 = (m_a + m_s) / 2, m_2 = (m_s - m_a) / 2;
  return std::max(std::abs(m_1 - (4 * theta_1 + 2 * theta_2)), std::abs(m_2 + (2 * theta_1 + 4 * theta_2)));
}

void draw_axes(Drawing& d) {
  d.arrow({-1.2, -0.9}, {0.6, -0.9}, "axis");
  d.text("{/:Italic z} {/:Italic w}", {1.2, -0.9});
  d.arrow({-1.2, -0.9}, {-1.2, 0.9}, "axis");
  d.text("{/:Italic x} {/:Italic u}", {-1.2, 1.25});
}

scene::Showing draw_member() {
  constexpr Spot one{0, 0}, two{8, 0}, moved_one{1.3, 1.6}, moved_two{9.0, 4.4};
  constexpr double theta_1 = 0.45, theta_2 = 0.3;
  const Spot chord = moved_two - moved_one, e = (1 / length(chord)) * chord, across{-e.y, e.x};
  const double chord_angle = std::atan2(e.y, e.x);
  Drawing d;
  draw_axes(d);
  d.path("rest", {one, two});
  d.path("thin", {moved_one, moved_two});
  std::vector<Spot> line;
  for (int i = 0; i <= 60; ++i) {
    const double xi = i / 60.0;
    line.push_back(moved_one + xi * chord + length(chord) * hermite(xi, theta_1, theta_2) * across);
  }
  d.path("member", line);
  for (const Spot& spot : {one, two, moved_one, moved_two}) d.joint(spot);
  const auto displacement = [&](Spot from, Spot to, int node) {
    d.path("thin", {from, {to.x, from.y}, to});
    d.text(fmt::format("{{/:Italic w}}_{}", node), {(from.x + to.x) / 2, from.y - 0.4});
    d.text(fmt::format("{{/:Italic u}}_{}", node), {to.x + (node == 1 ? 0.45 : 0.5), from.y + 0.5});
  };
  displacement(one, moved_one, 1);
  displacement(two, moved_two, 2);
  d.path("thin", {moved_one, moved_one + Spot{3.4, 0}});
  d.path("thin", {moved_one, moved_one + 3.0 * direction(chord_angle + theta_1)});
  d.arc("thin", moved_one, 2.9, 0, chord_angle);
  d.text("θ̃", moved_one + 3.25 * direction(chord_angle / 2));
  d.arc("thin", moved_one, 2.4, chord_angle, chord_angle + theta_1);
  d.text("{/:Italic θ}_1^∗", moved_one + 2.9 * direction(chord_angle + 0.62 * theta_1));
  d.path("thin", {moved_two - 2.6 * direction(chord_angle + theta_2),
                  moved_two + 1.5 * direction(chord_angle + theta_2)});
  d.arc("thin", moved_two, 2.1, std::numbers::pi + chord_angle, std::numbers::pi + chord_angle + theta_2);
  d.text("{/:Italic θ}_2^∗", moved_two - 2.65 * direction(chord_angle + theta_2 / 2));
  d.arrow(moved_two, moved_two + 1.8 * e, "force");
  d.arrow(moved_one, moved_one - 1.8 * e, "force");
  d.text("{/:Italic N}", moved_two + 2.2 * e);
  d.text("{/:Italic N}", moved_one - 2.2 * e);
  d.turn(moved_one, 0.8, 2.0, 4.6);
  d.text("{/:Italic M}_1", moved_one + Spot{-0.6, 1.1});
  d.turn(moved_two, 0.8, 1.4, -1.2);
  d.text("{/:Italic M}_2", moved_two + Spot{0.6, 1.1});
  d.text("1", one + Spot{-0.35, -0.35});
  d.text("2", two + Spot{-0.35, -0.35});
  double worst = 0;
  for (const Spot& angles : {Spot{theta_1, theta_2}, Spot{1, -1}, Spot{1, 1}, Spot{-0.3, 0.7}})
    worst = std::max(worst, moment_error(angles.x, angles.y));
  return {d.take({{"heading", "Rotations of the ends are split into the chord's and the rest"},
                  {"xrange", "[-2.5:12]"},
                  {"yrange", "[-1.6:6.4]"},
                  {"height", "440"}}),
          {},
          {scene::at_most("end moments by (2.27), (2.28) against the cubic's, times l/EI", "1", worst, 1e-14,
                          "Euler's beam without axial force; rounding of numbers up to 6")}};
}

}  // namespace

void add_toggle_drawings(scene::Chapter& chapter) {
  add_drawing(chapter, "fig-2.4", "Williams' toggle (drawn)", draw_toggle);
  add_drawing(chapter, "fig-2.5", "The symmetric deformation of the toggle (drawn)", draw_deflected);
}

void add_member_drawing(scene::Chapter& chapter) {
  add_drawing(chapter, "fig-2.12", "Kinematics and sign convention of a beam-column (drawn)", draw_member);
}

}  // namespace nlmech::chapters

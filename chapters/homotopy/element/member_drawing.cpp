#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "chapters/drawing.hpp"
#include "nlmech/frames/stability_functions.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::homotopy::member_drawing {
namespace {

/// Hermite cubic with the given end slopes: deflection over length of a beam without axial force.
double hermite(double xi, double theta_1, double theta_2) {
  return theta_1 * xi * (1 - xi) * (1 - xi) - theta_2 * xi * xi * (1 - xi);
}

/// Largest difference of m_1, m_2 (Eqs 2.27, 2.28) from -+ the end curvatures of the cubic.
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

void draw_member(scene::Show& show) {
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
  show.draw(d.take({{"heading", "End rotations: rotation of the chord plus rotation relative to the chord"},
                    {"xrange", "[-2.5:12]"},
                    {"yrange", "[-1.6:6.4]"},
                    {"height", "440"}}));
  show.at_most("end moments by (2.27), (2.28) against the cubic's, times l/EI", worst, 1e-14,
               "Euler's beam without axial force; rounding of numbers up to 6");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "fig-2.12",
           .title = "Kinematics and sign convention of a beam-column (drawn)",
           .place = "Figure 2.12",
           .content = scene::Content(draw_member)}};
}

}  // namespace nlmech::chapters::homotopy::member_drawing

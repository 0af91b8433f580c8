#include <fmt/format.h>

#include <cmath>
#include <ranges>
#include <string>
#include <vector>

#include "chapters/transversal/oscillators.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::transversal::histories {
namespace {

constexpr double end = 8;

/// RK6 and MTL with the same step size.
struct Pair {
  double step;
  Course rk6, mtl;
};

struct Histories {
  std::vector<Point> reference;
  std::vector<Pair> pairs;
};

Histories all_histories() {
  const problems::TextProblem problem = stand_in(0.5);
  const Reference reference(problem, {0, 0}, 0, end);
  Histories all;
  for (int i = 0; i <= 400; ++i) {
    const double t = end * i / 400;
    all.reference.push_back({t, reference(t).cast<double>()});
  }
  for (const double h : {0.05, 0.1, 0.21})
    all.pairs.push_back({h, course(problem, {0, 0}, end, classical("rk6", h), &reference),
                         course(problem, {0, 0}, end, mtl(h, 3), &reference)});
  return all;
}

/// Draws a curve up to the first point with |x| >= 1e3, far outside the panel.
void curve(scene::Panel& panel, const std::string& name, const std::vector<Point>& points,
           const scene::CurveStyle& look) {
  const auto inside =
      std::ranges::take_while_view(points, [](const Point& p) { return std::abs(p.x[0]) < 1e3; });
  panel.curve(name, inside, &Point::t, &Point::position, look);
}

void draw(const Histories& all, scene::Show& show) {
  scene::Plot& plot =
      show.plots("Displacement at {/:Italic h} = 0.21: RK6 overflows, MTL stays bounded but inaccurate");
  plot.stacked().size(760, 620).columns({"series", "t", "x"});
  for (const Pair& pair : all.pairs) {
    scene::Panel& panel = plot.panel("time (periods of the force)", "{/:Italic x}");
    panel.x_range(0, 8).y_range(-3, 3).set("ytics 1").key(
        pair.step == 0.05 ? "at graph 1, graph 1 right top horizontal samplen 3" : "off");
    panel.note(fmt::format("{{/:Italic h}} = {}", pair.step), 0.1, -2.6);
    curve(panel, "solution", all.reference, {"lines linewidth 4", 8});
    curve(panel, "RK6", pair.rk6.points, {"linespoints linewidth 1.3 pointsize 0.5", 5});
    curve(panel, "MTL, {/:Italic p} = 3", pair.mtl.points, {"linespoints linewidth 1.5 pointsize 0.45", 1});
  }
}

void put(const Histories& all, scene::Show& show) {
  draw(all, show);
  show.table(all.pairs, {{"h", &Pair::step},
                         {"RK6 ends", [](const Pair& p) { return to_string(p.rk6.status.outcome()); }},
                         {"RK6 error", [](const Pair& p) { return p.rk6.finite_error(); }, 2},
                         {"MTL ends", [](const Pair& p) { return to_string(p.mtl.status.outcome()); }},
                         {"MTL error", [](const Pair& p) { return p.mtl.finite_error(); }, 2},
                         {"MTL largest |x|", [](const Pair& p) { return p.mtl.largest; }}});
  const Pair &fine = all.pairs[0], &coarse = all.pairs[2];
  show.equals("does RK6 overflow at h = 0.21", coarse.rk6.overflows(), 1, "as stated in the paper");
  show.equals("does MTL finish at h = 0.21", coarse.mtl.status.ok(), 1, "as stated in the paper");
  show.between("MTL's error at h = 0.21", coarse.mtl.error, 0.5, 4,
               "regression value: an error of the size of the motion over a longer time");
  show.between("MTL's error at h = 0.05 over that of RK6", fine.mtl.error / fine.rk6.error, 2, 200,
               "regression value: a factor of 43 over a longer time");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result(
      "histories",
      "neither equation nor parameters are printed: stand-in e1 = 0.25, e2 = 0.5, e3 = 0.5 "
      "from rest, of the form that the author uses elsewhere; RK6 is Butcher's of 7 stages",
      all_histories);
  return {{.name = "fig-2",
           .title = "Driven hardening Duffing oscillator by RK6 and MTL, p = 3, at three steps",
           .place = "Figure 2",
           .content = scene::Content(put, result)}};
}

}  // namespace nlmech::chapters::transversal::histories

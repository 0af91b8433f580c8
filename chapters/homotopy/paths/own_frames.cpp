#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "chapters/homotopy/paths/walked.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::homotopy::own_frames {
namespace {

using frames::FramePoint;
using Kind = FramePoint::Kind;
constexpr double pi = std::numbers::pi;

// ------------------------------------------------------------------------------------------- Lee's frame

Walked walk_lee() { return walk("lee", 4, {.until = 3, .turn = 0.06}); }

void show_lee(const Walked& lee, scene::Show& show) {
  scene::Plot& plot = show.plots("Lee's frame: the load turns back, then its displacement");
  plot.size(960, 480).columns({"panel", "curve", "x", "y"});
  scene::Panel& path =
      plot.panel("displacement of the load, downwards, in the file's units", "load factor").key("top left");
  const auto down = lee.motion("load.y", -1);
  path.x_range(0, 100).y_range(-1.5, 4.4);
  path.curve("path from rest", lee.points(0), down, &FramePoint::load);
  put_forks(lee, down, path);
  scene::Panel& shapes = plot.panel("x, in the file's units", "y, in the file's units").key("top left");
  shapes.x_range(-40, 264).y_range(-37, 250);
  put_rest(lee, shapes);
  const FramePoint high = lee.points(Kind::maximum).at(0), low = lee.points(Kind::minimum).at(0);
  put_shape(lee, high.x, "at the maximum", scene::lines(1), shapes);
  put_shape(lee, low.x, "at the minimum", scene::lines(2), shapes);
  put_shape(lee, lee.points(0).back().x, "at a load of 3", scene::lines(3), shapes);
  // oracle: homotopy_frames Lee's frame of 20 limit, Lee's frame of 20 lower limit
  const char* program = "tools/oracles/homotopy_frames.py, all its digits";
  show.near("upper limit load, 20+20 elements", high.load, 1.8556739134, 1e-10, program);
  show.near("lower limit load, 20+20 elements", low.load, -0.9414420703, 1e-10, program);
  show.at_most("bifurcations on the path", lee.points(Kind::bifurcation).size(), 0,
               "none is known of this frame");
  double back = HUGE_VAL;
  for (const FramePoint& p : lee.points(0)) {
    if (p.load < 0.5 && down(p) > 40) back = std::min(back, down(p));
  }
  show.between("least displacement of the load after its snap back", back, 50.3, 51.2,
               "50.8 by a walk of another program, places of steps");
}

// ----------------------------------------------------------------------------------------- shallow arch

Walked walk_arch() { return walk("shallow-arch", 4, {.until = 60, .branches = 2, .turn = 0.05}); }

void show_arch(const Walked& arch, scene::Show& show) {
  scene::Plot& plot = show.plots("A shallow arch falls straight, or tilts on its way");
  plot.size(960, 480).columns({"panel", "curve", "x", "y"});
  const auto put = [&](const char* label, const std::function<double(const FramePoint&)>& x, bool is_named) {
    scene::Panel& panel = plot.panel(label, "load factor").key(is_named ? "top left" : "off").y_range(0, 80);
    if (!is_named) panel.x_range(-0.0145, 0.0145).set("xtics 0.01");
    panel.curve("symmetric path", arch.points(0), x, &FramePoint::load, scene::lines(1));
    panel.curve("tilted to the left", arch.points(1), x, &FramePoint::load, scene::lines(2));
    panel.curve("tilted to the right", arch.points(2), x, &FramePoint::load, scene::lines(4));
    put_forks(arch, x, panel);
  };
  put("displacement of the crown, downwards, in the file's units", arch.motion("crown.y", -1), true);
  put("rotation of the crown, rad", arch.motion("crown.rotation"), false);
  const auto forks = arch.points(Kind::bifurcation);
  if (forks.size() != 2) throw Failure("shallow arch: other bifurcations than two");
  // oracle: homotopy_frames shallow arch of 32 limit, shallow arch of 32 lower limit
  const char* program = "tools/oracles/homotopy_frames.py, half the arch; all its digits";
  show.near("limit load, 16 elements a half", arch.points(Kind::maximum).at(0).load, 34.0902630603, 1e-10,
            program);
  show.near("lower limit load, 16 elements a half", arch.points(Kind::minimum).at(0).load, 14.2531501017,
            1e-10, program);
  show.between("load of the first bifurcation", forks[0].load, 26.5, 27.5,
               "near 27.0, between two places of a displacement-controlled walk of another program");
  show.between("drop of the crown at the first bifurcation", arch.motion("crown.y", -1)(forks[0]), 0.74, 0.76,
               "the same walk");
  show.at_most("distance of the end of a tilted branch from the second bifurcation",
               std::abs(arch.points(1).back().load - forks[1].load), 1e-9,
               "both halves join the two bifurcations");
}

// -------------------------------------------------------------------------------------------- deep arch

/// An arch by more and more elements.
std::vector<Walked> walk_deep() {
  std::vector<Walked> all;
  for (const int elements : {2, 4, 8}) all.push_back(walk("deep-arch", elements, {.turn = 0.06}));
  return all;
}

void show_deep(const std::vector<Walked>& all, scene::Show& show) {
  const Walked& fine = all.back();
  scene::Plot& plot = show.plots("A deep arch, pinned at one end alone, leans over and falls");
  plot.size(960, 480).columns({"panel", "curve", "x", "y"});
  scene::Panel& path =
      plot.panel("displacement of the crown, downwards, over R", "load times R²/{/:Italic EI}");
  path.key("bottom right").x_range(0, 4.5).y_range(-2, 10);
  const double radius = 100;
  const auto down = fine.motion("crown.y", -1 / radius);
  path.curve("path from rest", fine.points(0), down, &FramePoint::load);
  put_forks(fine, down, path);
  scene::Panel& shapes = plot.panel("x, in the file's units", "y, in the file's units").key("bottom left");
  shapes.set("size ratio -1").x_range(-160, 160).y_range(-370, 30);
  put_rest(fine, shapes);
  const FramePoint high = fine.points(Kind::maximum).at(0);
  put_shape(fine, high.x, "at the maximum", scene::lines(1), shapes);
  put_shape(fine, fine.points(0).back().x, "at the end of the path", scene::lines(2), shapes);

  std::vector<double> limits;
  for (const Walked& w : all) limits.push_back(w.points(Kind::maximum).at(0).load);
  const double second[] = {limits[1] + (limits[1] - limits[0]) / 3, limits[2] + (limits[2] - limits[1]) / 3},
               extrapolated = second[1] + (second[1] - second[0]) / 15;
  // oracle: homotopy_frames deep arch of 20 limit
  show.near("limit load times R^2/EI, 20 elements", limits[0], 907.34075563 / 100, 1e-9,
            "tools/oracles/homotopy_frames.py, where R^2/EI is 1/100; all its digits");
  show.near("limit load times R^2/EI, extrapolated", extrapolated, 8.97294947594,
            std::abs(extrapolated - second[1]),
            "tables/frames/deck.csv, the elastica; what the last extrapolation changes");
  struct Line {
    int elements;
    double limit;
  };
  std::vector<Line> lines;
  for (std::size_t i = 0; i < limits.size(); ++i) lines.push_back({20 << i, limits[i]});
  show.table(lines, {{"elements", &Line::elements}, {"limit load times R²/EI", &Line::limit, 12}});
}

// ------------------------------------------------------------------------------------------- cantilever

std::vector<Walked> walk_cantilever() {
  std::vector<Walked> all;
  for (const double load : {0.125, 0.25, 0.5, 0.75, 1.})
    all.push_back(walk("cantilever", 20, {.until = load}));
  return all;
}

void show_cantilever(const std::vector<Walked>& all, scene::Show& show) {
  scene::Panel& panel =
      show.plot("A moment at its end rolls a cantilever up to a circle", "x / length", "y / length");
  panel.set("size ratio -1").x_range(-0.5, 1.5).y_range(-0.1, 1.6).key("top right");
  put_rest(all[0], panel);
  const char* const names[] = {"one eighth of 2π {/:Italic EI}/{/:Italic l}", "a quarter", "half",
                               "three quarters", "all of it"};
  double worst = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const FramePoint& last = all[i].paths.points.back();
    put_shape(all[i], last.x, names[i], scene::lines(static_cast<int>(i) + 1), panel);
    const double turn = 2 * pi * last.load;
    worst = std::max(worst, std::hypot(1 + all[i].motion("tip.x")(last) - std::sin(turn) / turn,
                                       all[i].motion("tip.y")(last) - (1 - std::cos(turn)) / turn));
  }
  const FramePoint& last = all.back().paths.points.back();
  show.at_most("distance of the tip from the arc of a circle, over l", worst, 1e-8,
               "M = EI kappa; chords of 100 elements are too long by m^-4");
  show.at_most("distance of tip and base when rolled up, over l",
               std::hypot(1 + all.back().motion("tip.x")(last), all.back().motion("tip.y")(last)), 1e-11,
               "equal chords and angles close the polygon; rounding");
}

// ----------------------------------------------------------------------------------------------- column

Walked walk_column() { return walk("column", 10, {.until = 2, .branches = 2, .turn = 0.08}); }

void show_column(const Walked& column, scene::Show& show) {
  scene::Plot& plot = show.plots("Euler's column branches, and bends as his elastica");
  plot.size(960, 480).columns({"panel", "curve", "x", "y"});
  scene::Panel& path = plot.panel("rotation of the base, rad", "load/Euler's load").key("top left");
  const auto turn = column.motion("base.rotation");
  const auto euler = [](double a) {
    const double k = 2 * std::comp_ellint_1(std::sin(std::abs(a) / 2)) / pi;
    return k * k;
  };
  path.y_range(0, 3.2);
  path.curve("straight", column.points(0), turn, &FramePoint::load, scene::lines(1));
  path.curve("bent to the left", column.points(1), turn, &FramePoint::load, scene::lines(2));
  path.curve("bent to the right", column.points(2), turn, &FramePoint::load, scene::lines(4));
  std::vector<double> angles, loads;
  for (int i = -8; i <= 8; ++i) {
    angles.push_back(0.25 * i);
    loads.push_back(euler(0.25 * i));
  }
  path.curve("elastica", angles, loads, scene::points(3));
  scene::Panel& shapes =
      plot.panel("x / length", "y / length").key("top left").x_range(-0.85, 0.75).y_range(-0.45, 1.06);
  put_rest(column, shapes);
  double worst = 0;
  for (const int branch : {1, 2}) {
    const auto points = column.points(Kind::step, branch);
    for (const FramePoint& p : points) worst = std::max(worst, std::abs(p.load / euler(turn(p)) - 1));
    const auto at =
        std::find_if(points.begin(), points.end(), [](const FramePoint& p) { return p.load > 1.2; });
    if (branch == 1) put_shape(column, at->x, fmt::format("load {:.3g}", at->load), scene::lines(4), shapes);
    put_shape(column, points.back().x, branch == 1 ? "load 2" : "", scene::lines(2), shapes);
  }
  const double strain = pi * pi / 1e6;
  show.near("load of the bifurcation over Euler's", column.points(Kind::bifurcation).at(0).load,
            2 / (1 + std::sqrt(1 - 4 * strain)), 1e-7,
            "P (1 - P/EA) = pi^2 EI/l^2 for a bar that stretches; elements err by P/EA m^-2");
  show.at_most("load on the bent branches against the elastica, relative", worst, 1e-3,
               "(2 K(sin(a/2))/pi)^2; 20 elements err by m^-2, at a load of 2 by some 5e-4");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result lee("lee-path", "Lee's frame, chapters/homotopy/frames/lee.toml, 20 elements a member",
                          walk_lee);
  const scene::Result arch("shallow-arch-paths",
                           "chapters/homotopy/frames/shallow-arch.toml, 16 elements a half, both branches",
                           walk_arch);
  const scene::Result deep("deep-arch-paths",
                           "chapters/homotopy/frames/deep-arch.toml, 20, 40 and 80 elements, extrapolated "
                           "by powers of elements^-2",
                           walk_deep);
  const scene::Result cantilever("cantilever-paths",
                                 "chapters/homotopy/frames/cantilever.toml, 100 elements, to five loads",
                                 walk_cantilever);
  const scene::Result column("column-paths", "chapters/homotopy/frames/column.toml, 20 elements, both sides",
                             walk_column);
  return {{.name = "lee-frame",
           .title = "Lee's frame: its whole path, with limit points of the load and of the displacement",
           .content = scene::Content(show_lee, lee)},
          {.name = "shallow-arch",
           .title = "A clamped shallow arch: limit points, bifurcations and the branch between them",
           .content = scene::Content(show_arch, arch)},
          {.name = "deep-arch",
           .title = "A deep arch clamped at one end and pinned at the other: limit load, extrapolated",
           .content = scene::Content(show_deep, deep)},
          {.name = "cantilever",
           .title = "A cantilever rolled up by a moment",
           .content = scene::Content(show_cantilever, cantilever)},
          {.name = "column",
           .title = "Euler's column: its bifurcation, and both sides behind it",
           .content = scene::Content(show_column, column)}};
}

}  // namespace nlmech::chapters::homotopy::own_frames

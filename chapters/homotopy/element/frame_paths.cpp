#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "chapters/homotopy/commands/frame_file.hpp"
#include "chapters/homotopy/commands/frame_picture.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::homotopy::frame_paths {
namespace {

using frames::FramePoint;
using Kind = FramePoint::Kind;

/// A shipped frame and its equilibrium paths.
struct TracedPath {
  frames::NamedFrame frame;
  frames::FramePaths paths;

  [[nodiscard]] std::vector<FramePoint> points(int branch) const {
    return select([branch](const FramePoint& p) { return p.branch == branch; });
  }
  [[nodiscard]] std::vector<FramePoint> points(Kind kind) const {
    return select([kind](const FramePoint& p) { return p.branch == 0 && p.kind == kind; });
  }
  /// Function that returns the displacement @p name of a point, times @p factor. @throws Failure if the frame
  /// has no such displacement
  [[nodiscard]] std::function<double(const FramePoint&)> motion(const std::string& name,
                                                                double factor = 1) const {
    for (const frames::NamedMotion& m : frame.motions) {
      if (m.name == name) return [at = m.unknown, factor](const FramePoint& p) { return factor * p.x[at]; };
    }
    throw Failure("no motion " + name);
  }

 private:
  template <class Wanted>
  [[nodiscard]] std::vector<FramePoint> select(const Wanted& wanted) const {
    std::vector<FramePoint> some;
    std::copy_if(paths.points.begin(), paths.points.end(), std::back_inserter(some), wanted);
    return some;
  }
};

/// Traces the equilibrium paths of a file of chapters/homotopy/frames. @throws Failure if tracing fails
TracedPath trace(const std::string& name, int elements, const frames::PathOptions& how) {
  const auto file = scene::data_folder() / "chapters" / "homotopy" / "frames" / (name + ".toml");
  frames::NamedFrame frame = build(parse_frame(scene::read_whole(file), name + ".toml").model, elements);
  frames::FramePaths paths = equilibrium_paths(frame, how);
  if (!paths.status.ok()) throw Failure(paths.status);
  return {std::move(frame), std::move(paths)};
}

void put_shape(const TracedPath& w, const Eigen::VectorXd& x, const std::string& name,
               const scene::CurveStyle& look, scene::Panel& panel) {
  const Shape shape = shape_of(w.frame.frame, x);
  panel.curve(name, shape.x, shape.y, look);
}

/// Draws the limit and bifurcation points of the path from rest.
void put_forks(const TracedPath& w, const std::function<double(const FramePoint&)>& x, scene::Panel& panel) {
  for (const auto& [kind, style] :
       {std::pair{Kind::maximum, 5}, {Kind::minimum, 4}, {Kind::bifurcation, 3}}) {
    if (!w.points(kind).empty())
      panel.curve(std::string(to_string(kind)), w.points(kind), x, &FramePoint::load,
                  scene::large_points(style));
  }
}

// ------------------------------------------------------------------------------------------- Lee's frame

TracedPath trace_lee() { return trace("lee", 4, {.until = 3, .turn = 0.06}); }

void show_lee(const TracedPath& lee, scene::Show& show) {
  scene::Plot& plot = show.plots("Lee's frame: limit points of the load and of its displacement");
  plot.size(960, 480).columns({"panel", "curve", "x", "y"});
  scene::Panel& path =
      plot.panel("downward displacement of the load (units of the file)", "load factor").key("top left");
  const auto down = lee.motion("load.y", -1);
  path.x_range(0, 100).y_range(-1.5, 4.4);
  path.curve("path from rest", lee.points(0), down, &FramePoint::load);
  put_forks(lee, down, path);
  scene::Panel& shapes = plot.panel("x (units of the file)", "y (units of the file)").key("top left");
  shapes.x_range(-40, 264).y_range(-37, 250);
  put_shape(lee, Eigen::VectorXd::Zero(lee.frame.frame.size()), "at rest", scene::thin_lines(8), shapes);
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
               "regression value 50.8, places of steps");
}

// ----------------------------------------------------------------------------------------- shallow arch

TracedPath trace_arch() { return trace("shallow-arch", 4, {.until = 60, .branches = 2, .turn = 0.05}); }

void show_arch(const TracedPath& arch, scene::Show& show) {
  scene::Plot& plot = show.plots("Shallow arch: symmetric path, and tilted branch between its bifurcations");
  plot.size(960, 480).columns({"panel", "curve", "x", "y"});
  const auto put = [&](const char* label, const std::function<double(const FramePoint&)>& x, bool is_named) {
    scene::Panel& panel = plot.panel(label, "load factor").key(is_named ? "top left" : "off").y_range(0, 80);
    if (!is_named) panel.x_range(-0.0145, 0.0145).set("xtics 0.01");
    panel.curve("symmetric path", arch.points(0), x, &FramePoint::load, scene::lines(1));
    panel.curve("tilted to the left", arch.points(1), x, &FramePoint::load, scene::lines(2));
    panel.curve("tilted to the right", arch.points(2), x, &FramePoint::load, scene::lines(4));
    put_forks(arch, x, panel);
  };
  put("downward displacement of the crown (units of the file)", arch.motion("crown.y", -1), true);
  put("rotation of the crown (rad)", arch.motion("crown.rotation"), false);
  const auto forks = arch.points(Kind::bifurcation);
  if (forks.size() != 2) throw Failure("shallow arch: other bifurcations than two");
  // oracle: homotopy_frames shallow arch of 32 limit, shallow arch of 32 lower limit
  const char* program = "tools/oracles/homotopy_frames.py, half the arch; all its digits";
  show.near("limit load, 16 elements a half", arch.points(Kind::maximum).at(0).load, 34.0902630603, 1e-10,
            program);
  show.near("lower limit load, 16 elements a half", arch.points(Kind::minimum).at(0).load, 14.2531501017,
            1e-10, program);
  show.between("load of the first bifurcation", forks[0].load, 26.5, 27.5,
               "regression value near 27.0, between two places of a displacement-controlled path");
  show.between("drop of the crown at the first bifurcation", arch.motion("crown.y", -1)(forks[0]), 0.74, 0.76,
               "the same path");
  show.at_most("distance of the end of a tilted branch from the second bifurcation",
               std::abs(arch.points(1).back().load - forks[1].load), 1e-9,
               "both halves join the two bifurcations");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result lee("lee-path", "Lee's frame, chapters/homotopy/frames/lee.toml, 20 elements a member",
                          trace_lee);
  const scene::Result arch("shallow-arch-paths",
                           "chapters/homotopy/frames/shallow-arch.toml, 16 elements a half, both branches",
                           trace_arch);
  return {{.name = "lee-frame",
           .title = "Lee's frame: its whole path, with limit points of the load and of the displacement",
           .content = scene::Content(show_lee, lee)},
          {.name = "shallow-arch",
           .title = "A clamped shallow arch: limit points, bifurcations and the branch between them",
           .content = scene::Content(show_arch, arch)}};
}

}  // namespace nlmech::chapters::homotopy::frame_paths

#include "chapters/homotopy/commands/frame_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "nlmech/scene/picture.hpp"

namespace nlmech::chapters::homotopy {
namespace {

using frames::FramePoint;
using frames::Motion;

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr int width = 960, height = 480;
constexpr double panel_share = 0.76;  // of the height; the rest is heading and labels

/// Adds points along one beam-column: the deformed chord plus the cubic of its end rotations relative to it.
void add_beam(const frames::Frame& frame, const Eigen::VectorXd& x, std::size_t index, int parts,
              Shape& shape) {
  const frames::Member& m = frame.members()[index];
  const frames::Node &a = frame.nodes()[static_cast<std::size_t>(m.first)],
                     &b = frame.nodes()[static_cast<std::size_t>(m.second)];
  const auto d = frame.ends<double>(x, index);
  const auto state = frame.member<double>(x, index);
  const double turn_1 = state.antisymmetric + state.symmetric, turn_2 = state.antisymmetric - state.symmetric;
  const double ax = a.x + d[0], ay = a.y + d[1], dx = b.x + d[3] - ax, dy = b.y + d[4] - ay;
  for (int i = 0; i <= parts; ++i) {
    const double xi = static_cast<double>(i) / parts;
    const double across = turn_1 * xi * (1 - xi) * (1 - xi) - turn_2 * xi * xi * (1 - xi);
    shape.x.push_back(ax + xi * dx - across * dy);
    shape.y.push_back(ay + xi * dy + across * dx);
  }
}

/// Path point of a drawn shape, and its label.
struct ShownShape {
  const FramePoint* point;
  std::string name;
};

/// Points whose shapes are drawn: the first limit and bifurcation points, and the ends of the first branches.
std::vector<ShownShape> shown_shapes(const frames::FramePaths& paths) {
  std::vector<ShownShape> all;
  const auto& points = paths.points;
  for (std::size_t i = 0; i < points.size() && all.size() < 6; ++i) {
    const FramePoint& p = points[i];
    const bool is_first = i == 0 || points[i - 1].branch != p.branch,
               is_last = i + 1 == points.size() || points[i + 1].branch != p.branch;
    if (p.kind != FramePoint::Kind::step && !(is_first && p.branch > 0) && all.size() < 4)
      all.push_back({&p, fmt::format("{}, load {:.4g}", to_string(p.kind), p.load)});
    else if (is_last)
      all.push_back({&p, fmt::format("end{}, load {:.4g}",
                                     p.branch > 0 ? fmt::format(" of branch {}", p.branch) : "", p.load)});
  }
  return all;
}

/// Range of numbers; NaN is ignored.
struct Range {
  double low = HUGE_VAL, high = -HUGE_VAL;
  void take(double value) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  [[nodiscard]] double size() const { return high - low; }
};

/// Fraction of the panel height that a key with @p lines lines takes.
double key_share(std::size_t lines) {
  return std::min(0.6, (26. * static_cast<double>(lines) + 18) / (panel_share * height));
}

/// Sets the ranges with room for the key at the top, and equal scales on both axes unless the frame is flat.
void give_ranges(const std::vector<Shape>& shapes, scene::Panel& panel) {
  Range x, y;
  for (const Shape& s : shapes) {
    for (const double value : s.x) x.take(value);
    for (const double value : s.y) y.take(value);
  }
  const double key = key_share(shapes.size()), pixels_x = width / 2. - 93,
               pixels_y = (1 - key) * panel_share * height;
  double unit_x = 1.1 * std::max(x.size(), 1e-300) / pixels_x,
         unit_y = 1.1 * std::max(y.size(), 1e-300) / pixels_y;
  if (unit_y > 0.2 * unit_x) unit_x = unit_y = std::max(unit_x, unit_y);
  unit_y = std::max(unit_y, 1e-3 * unit_x);
  const double half = pixels_x * unit_x / 2, middle = (x.low + x.high) / 2;
  const double below = (y.low + y.high - pixels_y * unit_y) / 2;
  panel.x_range(middle - half, middle + half).y_range(below, below + panel_share * height * unit_y);
}

void put_paths(const frames::NamedMotion& motion, const frames::FramePaths& paths, scene::Panel& panel) {
  const auto along = [&](const FramePoint& p) { return p.x[motion.unknown]; };
  const auto select = [&](const auto& wanted) {
    std::vector<FramePoint> some;
    std::copy_if(paths.points.begin(), paths.points.end(), std::back_inserter(some), wanted);
    return some;
  };
  Range loads;
  for (const FramePoint& p : paths.points) loads.take(p.load);
  std::size_t named = 0;
  for (int branch = 0; branch <= std::min(paths.branches, 6); ++branch, ++named) {
    const auto points = select([&](const FramePoint& p) { return p.branch == branch; });
    panel.curve(branch == 0 ? "from rest" : fmt::format("branch {}", branch), points, along,
                &FramePoint::load, scene::lines(branch == 0 ? 1 : branch % 7 + 2));
  }
  for (const FramePoint::Kind kind :
       {FramePoint::Kind::maximum, FramePoint::Kind::minimum, FramePoint::Kind::bifurcation}) {
    const auto points = select([&](const FramePoint& p) { return p.kind == kind; });
    if (points.empty()) continue;
    ++named;
    panel.curve(std::string(to_string(kind)), points, along, &FramePoint::load,
                scene::large_points(kind == FramePoint::Kind::maximum   ? 5
                                    : kind == FramePoint::Kind::minimum ? 4
                                                                        : 3));
  }
  const double room = std::max(loads.size(), 1e-300) / (1 - key_share(named));
  panel.y_range(loads.low - 0.03 * room, loads.low + 1.02 * room);
}

}  // namespace

Shape shape_of(const frames::Frame& frame, const Eigen::VectorXd& x) {
  Shape shape;
  const int parts = frame.members().size() > 300 ? 1 : 8;
  for (std::size_t i = 0; i < frame.members().size(); ++i) {
    if (i > 0 && frame.members()[i].first != frame.members()[i - 1].second) {
      shape.x.push_back(none);
      shape.y.push_back(none);
    }
    add_beam(frame, x, i, parts, shape);
  }
  return shape;
}

const frames::NamedMotion& largest_motion(const frames::NamedFrame& frame, const frames::FramePaths& paths) {
  const frames::NamedMotion* most = &frame.motions.front();
  double greatest = -1;
  bool is_translation = false;
  for (const frames::NamedMotion& m : frame.motions) {
    double here = 0;
    for (const FramePoint& p : paths.points) here = std::max(here, std::abs(p.x[m.unknown]));
    const bool moves = m.motion != Motion::rotation;
    if (moves < is_translation || (moves == is_translation && here <= greatest)) continue;
    most = &m, greatest = here, is_translation = moves;
  }
  return *most;
}

scene::Figure frame_picture(const frames::NamedFrame& frame, const frames::FramePaths& paths) {
  const frames::NamedMotion& motion = largest_motion(frame, paths);
  scene::Show show(false);
  scene::Plot& plot = show.plots("Load factor against the largest displacement, and shapes");
  plot.size(width, height).columns({"panel", "curve", "x", "y"});
  put_paths(motion, paths, plot.panel(scene::without_markup(motion.name), "load factor").key("top left"));
  scene::Panel& panel = plot.panel("x (units of the file)", "y (units of the file)").key("top left");
  const std::vector<ShownShape> seen = shown_shapes(paths);
  std::vector<Shape> shapes = {shape_of(frame.frame, Eigen::VectorXd::Zero(frame.frame.size()))};
  for (const ShownShape& s : seen) shapes.push_back(shape_of(frame.frame, s.point->x));
  give_ranges(shapes, panel);
  panel.curve("at rest", shapes[0].x, shapes[0].y, scene::thin_lines(8));
  for (std::size_t i = 0; i < seen.size(); ++i)
    panel.curve(seen[i].name, shapes[i + 1].x, shapes[i + 1].y, scene::lines(static_cast<int>(i % 7) + 1));
  return *show.take().figure;
}

}  // namespace nlmech::chapters::homotopy

#include "chapters/homotopy/paths/walked.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "chapters/homotopy/commands/frame_file.hpp"
#include "chapters/homotopy/commands/frame_picture.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::homotopy {
namespace {

using frames::FramePoint;
using Kind = FramePoint::Kind;

template <class Wanted>
std::vector<FramePoint> select(const Walked& w, const Wanted& wanted) {
  std::vector<FramePoint> some;
  std::copy_if(w.paths.points.begin(), w.paths.points.end(), std::back_inserter(some), wanted);
  return some;
}

}  // namespace

frames::FrameModel shipped_model(const std::string& name) {
  const auto file = scene::data_folder() / "chapters" / "homotopy" / "frames" / (name + ".toml");
  return parse_frame(scene::read_whole(file), name + ".toml").model;
}

std::vector<FramePoint> Walked::points(int branch) const {
  return select(*this, [branch](const FramePoint& p) { return p.branch == branch; });
}

std::vector<FramePoint> Walked::points(Kind kind, int branch) const {
  return select(*this, [=](const FramePoint& p) { return p.branch == branch && p.kind == kind; });
}

std::function<double(const FramePoint&)> Walked::motion(const std::string& name, double factor) const {
  return [at = unknown_of(frame, name), factor](const FramePoint& p) { return factor * p.x[at]; };
}

Eigen::Index unknown_of(const frames::NamedFrame& frame, const std::string& motion) {
  for (const frames::NamedMotion& m : frame.motions) {
    if (m.name == motion) return m.unknown;
  }
  throw Failure("no motion " + motion);
}

Walked walk(const std::string& name, int elements, const frames::FrameWalk& how) {
  frames::NamedFrame frame = build(shipped_model(name), elements);
  frames::FramePaths paths = equilibrium_paths(frame, how);
  if (!paths.status.ok()) throw Failure(paths.status);
  return {std::move(frame), std::move(paths)};
}

void put_shape(const Walked& w, const Eigen::VectorXd& x, const std::string& name, const scene::Look& look,
               scene::Panel& panel) {
  const Shape shape = shape_of(w.frame.frame, x);
  panel.curve(name, shape.x, shape.y, look);
}

void put_rest(const Walked& w, scene::Panel& panel) {
  put_shape(w, Eigen::VectorXd::Zero(w.frame.frame.size()), "at rest", scene::thin_lines(8), panel);
}

void put_forks(const Walked& w, const std::function<double(const FramePoint&)>& x, scene::Panel& panel) {
  for (const auto& [kind, style] :
       {std::pair{Kind::maximum, 5}, {Kind::minimum, 4}, {Kind::bifurcation, 3}}) {
    if (!w.points(kind).empty())
      panel.curve(std::string(to_string(kind)), w.points(kind), x, &FramePoint::load,
                  scene::large_points(style));
  }
}

}  // namespace nlmech::chapters::homotopy

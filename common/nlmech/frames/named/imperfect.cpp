#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "nlmech/frames/named/frame_paths.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::frames {
namespace {

/// Displacements of the nodes for a shape, x and y of each.
std::vector<Node> displacements_of(const Frame& frame, const Eigen::VectorXd& shape) {
  std::vector<Node> all;
  const auto at = [&](Eigen::Index i) { return i < 0 ? 0 : shape[i]; };
  for (int node = 0; node < static_cast<int>(frame.nodes().size()); ++node)
    all.push_back({at(frame.unknown(node, Motion::x)), at(frame.unknown(node, Motion::y))});
  return all;
}

/// What makes the farthest displacement along x or y 1. Two that are equal but for rounding have different
/// signs, perhaps: the first of them decides.
double factor_of(const std::vector<Node>& moves) {
  double most = 0;
  for (const Node& m : moves) most = std::max({most, std::abs(m.x), std::abs(m.y)});
  for (const Node& m : moves) {
    for (const double part : {m.x, m.y}) {
      if (std::abs(part) >= (1 - 1e-6) * most) return 1 / std::copysign(most, part);
    }
  }
  return HUGE_VAL;
}

}  // namespace

Imperfect imperfect(const NamedFrame& perfect, const Imperfection& imperfection, const FrameWalk& walk) {
  const auto& [mode, amplitude] = imperfection;
  if (mode < 1 || !std::isfinite(amplitude))
    throw invalid_argument("imperfect: mode {} with the amplitude {}; modes count from 1", mode, amplitude);
  FrameWalk how = walk;
  how.branches = 0;
  how.critical = mode;
  const FramePaths paths = equilibrium_paths(perfect, how);
  Imperfect out{perfect, {}, paths.status};
  int met = 0;
  for (const FramePoint& p : paths.points) {
    if (p.kind != FramePoint::Kind::step && ++met == mode) out.buckled = p;
  }
  if (met < mode) {
    if (out.status.ok() || out.status.outcome() == Outcome::step_limit)
      out.status = Status::failure(
          Outcome::not_converged,
          fmt::format(
              "imperfection: the perfect frame has {} limit and branch points in {} steps, and mode {} "
              "would be that of the next; take more steps, or a lower mode",
              met, walk.steps, mode));
    return out;
  }
  out.status = {};
  const std::vector<Node> moves = displacements_of(perfect.frame, out.buckled.mode);
  const double factor = amplitude * factor_of(moves);
  if (!std::isfinite(factor)) {
    out.status = Status::failure(Outcome::not_converged,
                                 "imperfection: the shape turns nodes and moves none; take another mode");
    return out;
  }
  std::vector<Node> nodes = perfect.frame.nodes();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes[i].x += factor * moves[i].x;
    nodes[i].y += factor * moves[i].y;
  }
  out.frame.frame = Frame(std::move(nodes), perfect.frame.members(), perfect.supports);
  return out;
}

}  // namespace nlmech::frames

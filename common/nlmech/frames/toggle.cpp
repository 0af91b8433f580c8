#include "nlmech/frames/toggle.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "nlmech/support/sentences.hpp"

namespace nlmech::frames {

ToggleFrame make_frame(const Toggle& toggle) {
  if (!(toggle.height > 0 && toggle.length > toggle.height && std::isfinite(toggle.length))) {
    throw invalid_argument("Toggle: a height of {} with members of length {}", toggle.height, toggle.length);
  }
  if (toggle.elements < 1) throw invalid_argument("Toggle: {} elements a member", toggle.elements);
  const double half_span = std::sqrt((toggle.length - toggle.height) * (toggle.length + toggle.height));
  const int apex = toggle.elements, last = toggle.full ? 2 * apex : apex;
  std::vector<Node> nodes;
  std::vector<Member> members;
  for (int i = 0; i <= last; ++i) {
    // Mirrored nodes have exactly mirrored coordinates.
    const double part = static_cast<double>(i <= apex ? apex - i : i - apex) / apex;
    nodes.push_back({(i <= apex ? -part : part) * half_span, (1 - part) * toggle.height});
    if (i > 0) members.push_back({i - 1, i, toggle.ea, toggle.ei});
  }
  std::vector<Support> supports = {{0, Motion::x}, {0, Motion::y}, {0, Motion::rotation}};
  const auto support = [&](int node, Motion motion) { supports.push_back({node, motion}); };
  support(last, Motion::x);
  support(last, Motion::rotation);
  if (toggle.full) support(last, Motion::y);
  Frame frame(std::move(nodes), std::move(members), supports);
  const Eigen::Index at = frame.unknown(apex, Motion::y);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(frame.size());
  load[at] = toggle.full ? -1 : -0.5;
  return {std::move(frame), at, std::move(load)};
}

}  // namespace nlmech::frames

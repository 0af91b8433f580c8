#include "nlmech/frames/named/frame_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "nlmech/support/echo.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::frames {
namespace {

using Names = std::unordered_map<std::string_view, int>;

template <class... Args>
[[nodiscard]] ModelError refusal(ModelPart part, std::size_t index, fmt::format_string<Args...> sentence,
                                 Args&&... args) {
  return {part, index, fmt::format(sentence, std::forward<Args>(args)...)};
}

std::string called(const NamedMember& m) {
  return fmt::format("member {}-{}", echoed(m.first), echoed(m.second));
}

Names names_of(const std::vector<NamedNode>& nodes) {
  if (nodes.empty()) throw refusal(ModelPart::nodes, 0, "there are no nodes");
  Names names;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const NamedNode& n = nodes[i];
    if (!(std::isfinite(n.x) && std::isfinite(n.y)))
      throw refusal(ModelPart::nodes, i, "node {} is at ({}, {}); places are finite", echoed(n.name), n.x,
                    n.y);
    if (!names.emplace(n.name, static_cast<int>(i)).second)
      throw refusal(ModelPart::nodes, i, "node {} stands twice", echoed(n.name));
  }
  return names;
}

/// Two nodes in one place are a slip of the pen: nothing joins them.
void require_places(const std::vector<NamedNode>& nodes) {
  std::vector<std::size_t> order(nodes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto place = [&](std::size_t i) { return std::tuple(nodes[i].x, nodes[i].y, i); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
  for (std::size_t k = 1; k < order.size(); ++k) {
    const NamedNode &a = nodes[order[k - 1]], &b = nodes[order[k]];
    if (a.x == b.x && a.y == b.y)
      throw refusal(ModelPart::nodes, order[k], "node {} is where node {} is, at ({}, {})", echoed(b.name),
                    echoed(a.name), b.x, b.y);
  }
}

int index_of(const Names& names, const std::string& name, ModelPart part, std::size_t index) {
  const auto found = names.find(name);
  if (found == names.end()) throw refusal(part, index, "there is no node {}", echoed(name));
  return found->second;
}

void require_member(const NamedMember& m, double length, std::size_t index) {
  const auto refuse = [&](const std::string& why) {
    throw refusal(ModelPart::members, index, "{}: {}", called(m), why);
  };
  if (m.first == m.second) refuse("from a node to itself");
  if (!(length > 0 && std::isfinite(length))) refuse(fmt::format("its length is {}", length));
  if (!(m.ea > 0 && std::isfinite(m.ea))) refuse(fmt::format("EA = {}; it must be positive", m.ea));
  if (!(m.ei > 0 && std::isfinite(m.ei))) refuse(fmt::format("EI = {}; it must be positive", m.ei));
  if (m.elements < 1) refuse(fmt::format("elements = {}; at least 1", m.elements));
  if (!std::isfinite(m.radius)) refuse(fmt::format("radius = {}; it must be finite", m.radius));
  if (m.radius != 0 && length > 2 * std::abs(m.radius) * (1 + 1e-12))
    refuse(fmt::format("radius = {}: such a circle does not span its length of {}", m.radius, length));
}

/// The lists that a Frame is made of.
struct Parts {
  std::vector<Node> nodes;
  std::vector<Member> members;
  std::vector<std::size_t> origins;
};

/// The places between the ends of a member. Mirrored members have exact mirror images.
std::vector<Node> inner_places(const NamedMember& m, const Node& a, const Node& b, int elements) {
  const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
  const double r = std::abs(m.radius), side = m.radius < 0 ? -1 : 1;
  const double half = r > 0 ? std::asin(std::min(1., length / (2 * r))) : 0;
  const double middle_x = a.x + dx / 2, middle_y = a.y + dy / 2, ex = dx / length, ey = dy / length;
  std::vector<Node> places;
  for (int i = 1; i < elements; ++i) {
    const double part = static_cast<double>(2 * i - elements) / elements;  // from -1 to 1
    double along = part * length / 2, across = 0;
    if (r > 0) {
      along = r * std::sin(part * half);
      // cos(part half) - cos(half), without cancellation
      across = side * 2 * r * std::sin((1 + std::abs(part)) * half / 2) *
               std::sin((1 - std::abs(part)) * half / 2);
    }
    places.push_back({middle_x + (along * ex - across * ey), middle_y + (along * ey + across * ex)});
  }
  return places;
}

void add_member(const NamedMember& m, std::size_t index, int first, int second, int elements, Parts& parts) {
  const Node a = parts.nodes[static_cast<std::size_t>(first)],
             b = parts.nodes[static_cast<std::size_t>(second)];
  int before = first;
  for (const Node& place : inner_places(m, a, b, elements)) {
    parts.nodes.push_back(place);
    const int next = static_cast<int>(parts.nodes.size()) - 1;
    parts.members.push_back({before, next, m.ea, m.ei, before == first && m.is_first_pinned, false});
    before = next;
  }
  parts.members.push_back(
      {before, second, m.ea, m.ei, before == first && m.is_first_pinned, m.is_second_pinned});
  parts.origins.resize(parts.members.size(), index);
}

/// @param elements a member's share; 0: one straight beam-column a member, whatever the shares
Parts parts_of(const FrameModel& model, const Names& names, int elements) {
  Parts parts;
  for (const NamedNode& n : model.nodes) parts.nodes.push_back({n.x, n.y});
  std::vector<char> is_reached(model.nodes.size(), 0);
  std::int64_t all = 0;
  for (std::size_t i = 0; i < model.members.size(); ++i) {
    const NamedMember& m = model.members[i];
    const int first = index_of(names, m.first, ModelPart::members, i),
              second = index_of(names, m.second, ModelPart::members, i);
    const Node &a = parts.nodes[static_cast<std::size_t>(first)],
               &b = parts.nodes[static_cast<std::size_t>(second)];
    require_member(m, std::hypot(b.x - a.x, b.y - a.y), i);
    const std::int64_t share = elements == 0 ? 1 : static_cast<std::int64_t>(m.elements) * elements;
    all += share;
    if (all > most_beam_columns)
      throw refusal(ModelPart::members, i, "{}: more than {} elements with those before it", called(m),
                    most_beam_columns);
    is_reached[static_cast<std::size_t>(first)] = is_reached[static_cast<std::size_t>(second)] = 1;
    add_member(m, i, first, second, static_cast<int>(share), parts);
  }
  for (std::size_t i = 0; i < is_reached.size(); ++i) {
    if (is_reached[i] == 0)
      throw refusal(ModelPart::nodes, i, "node {} has no member", echoed(model.nodes[i].name));
  }
  return parts;
}

Frame frame_of(const Parts& parts, const std::vector<Support>& supports) {
  return {parts.nodes, parts.members, supports};
}

Eigen::VectorXd load_of(const FrameModel& model, const Names& names, const Frame& frame) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(frame.size());
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const NamedLoad& l = model.loads[i];
    const Eigen::Index at = frame.unknown(index_of(names, l.node, ModelPart::loads, i), l.motion);
    if (!std::isfinite(l.value))
      throw refusal(ModelPart::loads, i, "load on {}.{} = {}; it must be finite", echoed(l.node),
                    to_string(l.motion), l.value);
    if (at < 0)
      throw refusal(
          ModelPart::loads, i, "load on {}.{}, which {}", echoed(l.node), to_string(l.motion),
          l.motion == Motion::rotation ? "is held, or which no member is rigidly joined to" : "is held");
    load[at] += l.value;
  }
  if (!(load.cwiseAbs().maxCoeff() > 0))
    throw refusal(ModelPart::loads, 0, "there is no load, or all of them are 0");
  return load;
}

}  // namespace

std::string_view to_string(Motion motion) noexcept {
  switch (motion) {
    case Motion::x: return "x";
    case Motion::y: return "y";
    default: return "rotation";
  }
}

NamedFrame build(const FrameModel& model, int elements) {
  if (elements < 1) throw invalid_argument("frame: {} elements a member", elements);
  const Names names = names_of(model.nodes);
  require_places(model.nodes);
  if (model.members.empty()) throw refusal(ModelPart::members, 0, "there are no members");
  std::vector<Support> supports;
  for (std::size_t i = 0; i < model.supports.size(); ++i) {
    const NamedSupport& s = model.supports[i];
    supports.push_back({index_of(names, s.node, ModelPart::supports, i), s.motion});
  }
  // Whether a frame is a mechanism does not depend on what its members are divided into.
  const Parts whole = parts_of(model, names, 0), divided = parts_of(model, names, elements);
  std::optional<LooseMotion> loose;
  if (supports.empty()) loose = {0, Motion::x};
  bool is_all_held = false;
  try {
    if (!loose) loose = loose_motion(frame_of(whole, supports));
  } catch (const std::invalid_argument&) {
    is_all_held = true;  // nothing can move but inside of members
  }
  if (loose) {
    const auto at = static_cast<std::size_t>(loose->node);
    throw refusal(ModelPart::nodes, at,
                  "node {} can move along {} and no member is strained: nothing holds it, or the frame is a "
                  "mechanism; give it a support or a member",
                  echoed(model.nodes[at].name), to_string(loose->motion));
  }
  if (is_all_held) throw refusal(ModelPart::supports, 0, "all motions of all nodes are held");
  Frame frame = frame_of(divided, supports);
  Eigen::VectorXd load = load_of(model, names, frame);
  std::vector<NamedMotion> motions;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    for (const Motion motion : {Motion::x, Motion::y, Motion::rotation}) {
      const Eigen::Index at = frame.unknown(static_cast<int>(i), motion);
      if (at >= 0)
        motions.push_back(
            {fmt::format("{}.{}", model.nodes[i].name, to_string(motion)), static_cast<int>(i), motion, at});
    }
  }
  return {std::move(frame), std::move(load), std::move(motions), divided.origins};
}

}  // namespace nlmech::frames

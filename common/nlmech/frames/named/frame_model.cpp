#include "nlmech/frames/named/frame_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "nlmech/algebraic/symmetric_solver.hpp"
#include "nlmech/support/quoted_input.hpp"
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
  return fmt::format("member {}-{}", quoted_input(m.first), quoted_input(m.second));
}

Names names_of(const std::vector<NamedNode>& nodes) {
  if (nodes.empty()) throw refusal(ModelPart::nodes, 0, "there are no nodes");
  Names names;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const NamedNode& n = nodes[i];
    if (!(std::isfinite(n.x) && std::isfinite(n.y)))
      throw refusal(ModelPart::nodes, i, "node {} is at ({}, {}); coordinates must be finite",
                    quoted_input(n.name), n.x, n.y);
    if (!names.emplace(n.name, static_cast<int>(i)).second)
      throw refusal(ModelPart::nodes, i, "node {} is given twice", quoted_input(n.name));
  }
  return names;
}

bool is_spring_between(const std::vector<NamedSpring>& springs, const std::string& a, const std::string& b) {
  return std::ranges::any_of(springs, [&](const NamedSpring& s) {
    return (s.first == a && s.second == b) || (s.first == b && s.second == a);
  });
}

/// Rejects two nodes at one position that no spring joins.
void require_places(const std::vector<NamedNode>& nodes, const std::vector<NamedSpring>& springs) {
  std::vector<std::size_t> order(nodes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto place = [&](std::size_t i) { return std::tuple(nodes[i].x, nodes[i].y, i); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
  for (std::size_t k = 1; k < order.size(); ++k) {
    const NamedNode &a = nodes[order[k - 1]], &b = nodes[order[k]];
    if (a.x == b.x && a.y == b.y && !is_spring_between(springs, a.name, b.name))
      throw refusal(ModelPart::nodes, order[k], "node {} is at the position of node {}, ({}, {})",
                    quoted_input(b.name), quoted_input(a.name), b.x, b.y);
  }
}

int index_of(const Names& names, const std::string& name, ModelPart part, std::size_t index) {
  const auto found = names.find(name);
  if (found == names.end()) throw refusal(part, index, "there is no node {}", quoted_input(name));
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
  if (!(m.mass >= 0 && std::isfinite(m.mass)))
    refuse(fmt::format("mass = {}; it must not be negative", m.mass));
  for (const double joint : {m.first_joint, m.second_joint}) {
    if (!(joint >= 0 && std::isfinite(joint)))
      refuse(fmt::format("joint = {}; its stiffness must not be negative", joint));
  }
  if (m.elements < 1) refuse(fmt::format("elements = {}; at least 1", m.elements));
  if (!std::isfinite(m.radius)) refuse(fmt::format("radius = {}; it must be finite", m.radius));
  if (m.radius != 0 && length > 2 * std::abs(m.radius) * (1 + 1e-12))
    refuse(fmt::format("radius = {}: such a circle does not span its length of {}", m.radius, length));
}

/// Nodes and members of a Frame, with the model's member of each.
struct Parts {
  std::vector<Node> nodes;
  std::vector<Member> members;
  std::vector<std::size_t> origins;
};

/// Positions of the inner nodes of a member. Mirrored members have exactly mirrored nodes.
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
  const std::vector<Node> places = inner_places(m, a, b, elements);
  for (std::size_t i = 0; i <= places.size(); ++i) {
    const Node &from = i == 0 ? a : places[i - 1], &to = i == places.size() ? b : places[i];
    if (!(std::hypot(to.x - from.x, to.y - from.y) > 0))
      throw refusal(ModelPart::members, index,
                    "{}: {} elements are too short for the rounding of its coordinates", called(m), elements);
  }
  for (const Node& place : places) {
    parts.nodes.push_back(place);
    const int next = static_cast<int>(parts.nodes.size()) - 1;
    parts.members.push_back(
        {before, next, m.ea, m.ei, before == first && m.is_first_pinned, false, m.first_joint});
    before = next;
  }
  parts.members.push_back({before, second, m.ea, m.ei, before == first && m.is_first_pinned,
                           m.is_second_pinned, m.first_joint, m.second_joint});
  parts.origins.resize(parts.members.size(), index);
}

/// @param elements factor of NamedMember::elements; 0: one straight beam-column per member
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
      throw refusal(ModelPart::nodes, i, "node {} has no member", quoted_input(model.nodes[i].name));
  }
  return parts;
}

std::vector<Spring> springs_of(const FrameModel& model, const Names& names) {
  std::vector<Spring> springs;
  for (std::size_t i = 0; i < model.springs.size(); ++i) {
    const NamedSpring& s = model.springs[i];
    const auto refuse = [&](const std::string& why) {
      throw refusal(ModelPart::springs, i, "spring at {}: {}", quoted_input(s.second), why);
    };
    const int first = s.first.empty() ? -1 : index_of(names, s.first, ModelPart::springs, i),
              second = index_of(names, s.second, ModelPart::springs, i);
    if (first == second) refuse("from a node to itself");
    if (!(s.stiffness > 0 && std::isfinite(s.stiffness)))
      refuse(fmt::format("stiffness = {}; it must be positive", s.stiffness));
    const double length = std::hypot(s.x, s.y);
    if (!s.turns && !(length > 0 && std::isfinite(length)))
      refuse(fmt::format("direction = [{}, {}]; its length must be positive", s.x, s.y));
    springs.push_back(s.turns ? Spring{first, second, s.stiffness, 0, 0, 1}
                              : Spring{first, second, s.stiffness, s.x / length, s.y / length, 0});
  }
  return springs;
}

/// Rejects springs both of whose ends are fixed.
void require_spring_motions(const FrameModel& model, const Frame& frame) {
  for (std::size_t i = 0; i < frame.springs().size(); ++i) {
    const Spring& s = frame.springs()[i];
    const auto can_move = [&](int node) {
      return node >= 0 && ((s.x != 0 && frame.unknown(node, Motion::x) >= 0) ||
                           (s.y != 0 && frame.unknown(node, Motion::y) >= 0) ||
                           (s.rotation != 0 && frame.unknown(node, Motion::rotation) >= 0));
    };
    if (!can_move(s.first) && !can_move(s.second))
      throw refusal(ModelPart::springs, i,
                    "spring at {}, whose motion is fixed, or to which no member is rigidly joined",
                    quoted_input(model.springs[i].second));
  }
}

/// Index of the member that a load names as "FIRST-SECOND".
std::size_t member_called(const FrameModel& model, const std::string& name, std::size_t load) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < model.members.size(); ++i) {
    const NamedMember& m = model.members[i];
    if (name != m.first + '-' + m.second && name != m.second + '-' + m.first) continue;
    if (found)
      throw refusal(ModelPart::loads, load, "load along {}: several members join these nodes",
                    quoted_input(name));
    found = i;
  }
  if (!found)
    throw refusal(ModelPart::loads, load, "there is no node{} {}",
                  name.find('-') == std::string::npos ? "" : " and no member", quoted_input(name));
  return *found;
}

/// Index of the unknown on which a load or displacement acts. @param what "load on", for messages
Eigen::Index unknown_of(const std::string& node, Motion motion, const Names& names, const Frame& frame,
                        ModelPart part, std::size_t index, std::string_view what) {
  const Eigen::Index at = frame.unknown(index_of(names, node, part, index), motion);
  if (at < 0)
    throw refusal(
        part, index, "{} {}.{}, which {}", what, quoted_input(node), to_string(motion),
        motion == Motion::rotation ? "is fixed, or to which no member is rigidly joined" : "is fixed");
  return at;
}

void add_load(const FrameModel& model, const Names& names, std::size_t i, NamedFrame& f) {
  const NamedLoad& l = model.loads[i];
  AppliedLoads& to = l.is_constant ? f.constant : f.growing;
  if (!std::isfinite(l.value))
    throw refusal(ModelPart::loads, i, "load on {}.{} = {}; it must be finite", quoted_input(l.node),
                  to_string(l.motion), l.value);
  const auto part = static_cast<Eigen::Index>(l.motion);
  if (const auto node = names.find(l.node); node != names.end()) {
    const Eigen::Index at = unknown_of(l.node, l.motion, names, f.frame, ModelPart::loads, i, "load on");
    if (std::binary_search(f.given.begin(), f.given.end(), at))
      throw refusal(ModelPart::loads, i, "load on {}.{}, whose displacement is given", quoted_input(l.node),
                    to_string(l.motion));
    to.nodes[3L * node->second + part] += l.value;
    return;
  }
  const bool is_weight = l.node == "gravity";
  const std::size_t member = is_weight ? 0 : member_called(model, l.node, i);
  if (l.motion == Motion::rotation)
    throw refusal(ModelPart::loads, i, "load on {}: gravity and loads along members have x and y",
                  quoted_input(l.node));
  double most = 0;
  for (std::size_t k = 0; k < f.members.size(); ++k) {
    if (!is_weight && f.members[k] != member) continue;
    const double factor = is_weight ? model.members[f.members[k]].mass : 1;
    to.members[2 * static_cast<Eigen::Index>(k) + part] += factor * l.value;
    most = std::max(most, factor);
  }
  for (std::size_t k = 0; is_weight && k < model.masses.size(); ++k) {
    const NamedMass& m = model.masses[k];
    to.nodes[3L * index_of(names, m.node, ModelPart::masses, k) + part] += m.mass * l.value;
    most = std::max(most, m.mass);
  }
  if (!(most > 0)) throw refusal(ModelPart::loads, i, "gravity: no member and no node has a mass");
}

/// Sets the loads on the unknowns and the prescribed displacements.
void add_actions(const FrameModel& model, const Names& names, NamedFrame& f) {
  f.load = f.displacement = Eigen::VectorXd::Zero(f.frame.size());
  for (std::size_t i = 0; i < model.displacements.size(); ++i) {
    const NamedDisplacement& d = model.displacements[i];
    const Eigen::Index at =
        unknown_of(d.node, d.motion, names, f.frame, ModelPart::displacements, i, "displacement of");
    if (!std::isfinite(d.value))
      throw refusal(ModelPart::displacements, i, "displacement of {}.{} = {}; it must be finite",
                    quoted_input(d.node), to_string(d.motion), d.value);
    if (std::find(f.given.begin(), f.given.end(), at) != f.given.end())
      throw refusal(ModelPart::displacements, i, "displacement of {}.{} is given twice", quoted_input(d.node),
                    to_string(d.motion));
    f.given.push_back(at);
    f.displacement[at] = d.value;
  }
  std::sort(f.given.begin(), f.given.end());
  for (AppliedLoads* const loads : {&f.growing, &f.constant}) {
    loads->nodes.setZero(3 * static_cast<Eigen::Index>(model.nodes.size()));
    loads->members.setZero(2 * static_cast<Eigen::Index>(f.members.size()));
  }
  for (std::size_t i = 0; i < model.loads.size(); ++i) add_load(model, names, i, f);
  f.load = f.growing.on_unknowns(f.frame);
  f.steady = f.constant.on_unknowns(f.frame);
  if (!(f.steady.cwiseAbs().maxCoeff() > 0)) f.steady.resize(0);
  if (static_cast<Eigen::Index>(f.given.size()) == f.frame.size())
    throw refusal(ModelPart::displacements, 0, "the displacements of all nodes are given");
  if (!model.needs_load || f.load.cwiseAbs().maxCoeff() > 0 || f.displacement.cwiseAbs().maxCoeff() > 0)
    return;
  const auto growing = std::ranges::find(model.loads, false, &NamedLoad::is_constant);
  throw refusal(ModelPart::loads, static_cast<std::size_t>(growing - model.loads.begin()), "{}",
                f.steady.size() > 0
                    ? "constant loads alone do not grow with the load factor; add a load other "
                      "than 0, or a displacement"
                    : "there is no load, or all of them are 0");
}

Eigen::VectorXd masses_of(const FrameModel& model, const Names& names, const Frame& frame,
                          const std::vector<std::size_t>& origins) {
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(frame.size());
  for (std::size_t i = 0; i < frame.members().size(); ++i) {
    const Member& m = frame.members()[i];
    const Node &a = frame.nodes()[static_cast<std::size_t>(m.first)],
               &b = frame.nodes()[static_cast<std::size_t>(m.second)];
    const double length = std::hypot(b.x - a.x, b.y - a.y), all = model.members[origins[i]].mass * length;
    if (!std::isfinite(all * length * length))
      throw refusal(ModelPart::members, origins[i], "{}: its mass is {}, beyond the range of doubles",
                    called(model.members[origins[i]]), all);
    const std::array<Eigen::Index, 6> unknowns = frame.unknowns_of(i);
    for (std::size_t j = 0; j < 6; ++j) {
      if (unknowns[j] >= 0) mass[unknowns[j]] += j % 3 == 2 ? all * length * length / 24 : all / 2;
    }
  }
  for (std::size_t i = 0; i < model.masses.size(); ++i) {
    const NamedMass& m = model.masses[i];
    const int node = index_of(names, m.node, ModelPart::masses, i);
    for (const double value : {m.mass, m.inertia}) {
      if (!(value >= 0 && std::isfinite(value)))
        throw refusal(ModelPart::masses, i,
                      "mass and inertia of {} are {} and {}; both must be 0 or more and finite",
                      quoted_input(m.node), m.mass, m.inertia);
    }
    for (const Motion motion : {Motion::x, Motion::y, Motion::rotation}) {
      const Eigen::Index at = frame.unknown(node, motion);
      if (at >= 0) mass[at] += motion == Motion::rotation ? m.inertia : m.mass;
    }
  }
  if (!mass.allFinite())
    throw refusal(ModelPart::masses, 0, "a sum of masses is beyond the range of doubles");
  return mass;
}

void require_numbers(const FrameModel& model) {
  for (const double value : {model.damping.mass, model.damping.stiffness}) {
    if (!(value >= 0 && std::isfinite(value)))
      throw refusal(ModelPart::damping, 0, "damping = {}; it must not be negative", value);
  }
  if (!model.imperfection) return;
  if (model.imperfection->mode < 1)
    throw refusal(ModelPart::imperfection, 0, "mode = {}; modes are numbered from 1",
                  model.imperfection->mode);
  if (!std::isfinite(model.imperfection->amplitude))
    throw refusal(ModelPart::imperfection, 0, "amplitude = {}; it must be finite",
                  model.imperfection->amplitude);
}

/// A motion that strains no member.
struct Mechanism {
  int node;       ///< the node that moves most, weighted by the stiffness at the node
  Motion motion;  ///< its direction
};

constexpr double no_energy = 1e-18;

/// Twice the strain energy of small displacements, from the strains of the members.
double twice_energy(const Frame& frame, const Eigen::VectorXd& x) {
  double sum = 2 * frame.spring_energy<double>(x);
  for (std::size_t i = 0; i < frame.members().size(); ++i) {
    const Member& m = frame.members()[i];
    const Node &a = frame.nodes()[static_cast<std::size_t>(m.first)],
               &b = frame.nodes()[static_cast<std::size_t>(m.second)];
    const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
    const Vector<double, 6> d = frame.ends<double>(x, i);
    const double u = d[3] - d[0], v = d[4] - d[1];
    const double stretch = (dx * u + dy * v) / length, turn = (dx * v - dy * u) / (length * length);
    // Without axial force g_a = 12 and g_s = 4.
    const double a_part = (d[2] + d[5]) / 2 - turn, s_part = (d[2] - d[5]) / 2;
    sum += m.ea / length * stretch * stretch + m.ei / length * (12 * a_part * a_part + 4 * s_part * s_part);
  }
  return sum;
}

/// Node and direction of an unknown; empty for the rotation of a pinned end.
std::optional<Mechanism> owner_of(const Frame& frame, Eigen::Index unknown) {
  for (int node = 0; node < static_cast<int>(frame.nodes().size()); ++node) {
    for (const Motion motion : {Motion::x, Motion::y, Motion::rotation}) {
      if (frame.unknown(node, motion) == unknown) return Mechanism{node, motion};
    }
  }
  return std::nullopt;
}

/// Gives all members and springs stiffnesses of similar sizes. Whether a frame is a mechanism does not depend
/// on them, but rounding would lose the small ones beside great ones. The longest member gets a length of
/// about 1; stiffnesses of another of length l lie between l and 1/l, so that the energy of a shape that
/// strains it is at least some l^2 of the whole, above no_energy for l > 1e-8.
void level_stiffness(Parts& parts, std::vector<Spring>& springs) {
  const auto length_of = [&](const Member& m) {
    const Node &a = parts.nodes[static_cast<std::size_t>(m.first)],
               &b = parts.nodes[static_cast<std::size_t>(m.second)];
    return std::hypot(b.x - a.x, b.y - a.y);
  };
  double longest = 0;
  for (const Member& m : parts.members) longest = std::max(longest, length_of(m));
  const int power = std::ilogb(longest);
  for (Node& n : parts.nodes) n = {std::scalbn(n.x, -power), std::scalbn(n.y, -power)};
  for (Member& m : parts.members) {
    m.ea = 1;
    m.ei = std::max(length_of(m) * length_of(m) / 12, 1e-300);
    for (double* const joint : {&m.first_joint, &m.second_joint}) *joint = *joint > 0 ? 1 : 0;
  }
  for (Spring& s : springs) s.stiffness = 1;
}

/// Searches for a mechanism of a frame of level_stiffness() at rest. Inverse iteration gives the shape of
/// smallest stiffness, and the strains of the members give its energy. An energy below 1e-18 of the sum of
/// the energies of the single unknowns counts as zero, which distinguishes a mechanism from a soft frame.
/// @return empty if there is none
std::optional<Mechanism> find_mechanism(const Frame& frame) {
  Eigen::SparseMatrix<double> k;
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(frame.size());
  if (!frame.tangent<double>(rest, k).ok()) return std::nullopt;
  const Eigen::VectorXd scale = algebraic::scale_of(k.diagonal());
  algebraic::SymmetricSolver solver;
  solver.take(k, scale);
  static_cast<void>(solver.factorise(1e-15 * solver.norm()));
  // The start vector has a component of every shape.
  Eigen::VectorXd v(frame.size()), next(frame.size());
  for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = 1 + 0.5 * std::sin(1. + static_cast<double>(i));
  for (int iteration = 0; iteration < 4; ++iteration) {
    solver.solve(v, next);
    v = next.normalized();
  }
  if (twice_energy(frame, v.cwiseQuotient(scale)) > no_energy) return std::nullopt;
  for (;;) {
    const double most = v.cwiseAbs().maxCoeff();
    if (!(most > 0)) return std::nullopt;
    Eigen::Index first = 0;  // of several that are equal to rounding
    while (std::abs(v[first]) < (1 - 1e-6) * most) ++first;
    if (const auto owner = owner_of(frame, first)) return owner;
    v[first] = 0;
  }
}

}  // namespace

Vector<double, 6> AppliedLoads::at_ends(const Frame& frame, std::size_t beam_column) const {
  const Member& m = frame.members()[beam_column];
  const Node &a = frame.nodes()[static_cast<std::size_t>(m.first)],
             &b = frame.nodes()[static_cast<std::size_t>(m.second)];
  const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
  const auto at = 2 * static_cast<Eigen::Index>(beam_column);
  const double x = members[at], y = members[at + 1], moment = (dx * y - dy * x) * length / 12;
  Vector<double, 6> forces;
  forces << x * length / 2, y * length / 2, moment, x * length / 2, y * length / 2, -moment;
  return forces;
}

Eigen::VectorXd AppliedLoads::on_unknowns(const Frame& frame) const {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(frame.size());
  for (Eigen::Index i = 0; i < nodes.size(); ++i) {
    const Eigen::Index at = frame.unknown(static_cast<int>(i / 3), static_cast<Motion>(i % 3));
    if (at >= 0) load[at] += nodes[i];
  }
  for (std::size_t k = 0; k < frame.members().size(); ++k) {
    const Vector<double, 6> forces = at_ends(frame, k);
    const std::array<Eigen::Index, 6>& unknowns = frame.unknowns_of(k);
    for (std::size_t i = 0; i < 6; ++i) {
      if (unknowns[i] >= 0) load[unknowns[i]] += forces[static_cast<Eigen::Index>(i)];
    }
  }
  return load;
}

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
  require_places(model.nodes, model.springs);
  if (model.members.empty()) throw refusal(ModelPart::members, 0, "there are no members");
  std::vector<Support> supports;
  for (std::size_t i = 0; i < model.supports.size(); ++i) {
    const NamedSupport& s = model.supports[i];
    supports.push_back({index_of(names, s.node, ModelPart::supports, i), s.motion});
  }
  require_numbers(model);
  const std::vector<Spring> springs = springs_of(model, names);
  // Prescribed displacements count as fixed: the load factor does not change here.
  std::vector<Support> fixed = supports;
  for (std::size_t i = 0; i < model.displacements.size(); ++i) {
    const NamedDisplacement& d = model.displacements[i];
    fixed.push_back({index_of(names, d.node, ModelPart::displacements, i), d.motion});
  }
  // Whether a frame is a mechanism does not depend on the number of elements.
  const Parts divided = parts_of(model, names, elements);
  Parts whole = parts_of(model, names, 0);
  std::vector<Spring> level_springs = springs;
  level_stiffness(whole, level_springs);
  std::optional<Mechanism> mechanism;
  if (fixed.empty() && springs.empty() && !model.may_move) mechanism = {0, Motion::x};
  bool is_all_fixed = false;
  try {
    if (!mechanism && !model.may_move)
      mechanism = find_mechanism(Frame(whole.nodes, whole.members, fixed, level_springs));
  } catch (const std::invalid_argument&) {
    is_all_fixed = true;  // only inner nodes of members can move
  }
  if (mechanism) {
    const auto at = static_cast<std::size_t>(mechanism->node);
    throw refusal(ModelPart::nodes, at,
                  "node {} can move along {} and no member is strained: it is unsupported, or the frame is a "
                  "mechanism; give it a support or a member",
                  quoted_input(model.nodes[at].name), to_string(mechanism->motion));
  }
  if (is_all_fixed && supports.size() == fixed.size() && divided.nodes.size() == model.nodes.size())
    throw refusal(ModelPart::supports, 0,
                  "all nodes are fixed; take more elements, or add a node that moves");
  NamedFrame f{.frame = Frame(divided.nodes, divided.members, supports, springs),
               .members = divided.origins,
               .supports = supports};
  require_spring_motions(model, f.frame);
  f.mass = masses_of(model, names, f.frame, f.members);
  add_actions(model, names, f);
  f.damping = model.damping;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    for (const Motion motion : {Motion::x, Motion::y, Motion::rotation}) {
      const Eigen::Index at = f.frame.unknown(static_cast<int>(i), motion);
      if (at >= 0)
        f.motions.push_back(
            {fmt::format("{}.{}", model.nodes[i].name, to_string(motion)), static_cast<int>(i), motion, at});
    }
  }
  return f;
}

}  // namespace nlmech::frames

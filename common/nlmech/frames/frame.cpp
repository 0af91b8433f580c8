#include "nlmech/frames/frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "nlmech/program/dual.hpp"
#include "nlmech/support/doubles.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::frames {
namespace {

void require_node(int node, std::size_t nodes, const char* whose) {
  if (node < 0 || static_cast<std::size_t>(node) >= nodes)
    throw invalid_argument("Frame: {} names node {} of {} nodes", whose, node, nodes);
}

BeamColumn beam_of(const Member& m, std::size_t index, const std::vector<Node>& nodes) {
  require_node(m.first, nodes.size(), "a member");
  require_node(m.second, nodes.size(), "a member");
  const Node &a = nodes[static_cast<std::size_t>(m.first)], &b = nodes[static_cast<std::size_t>(m.second)];
  const BeamColumn beam{b.x - a.x, b.y - a.y, m.ea, m.ei};
  const double length = std::hypot(beam.dx, beam.dy);
  if (!(length > 0 && std::isfinite(length)))
    throw invalid_argument("Frame: member {} has the length {}", index, length);
  if (!(m.ea > 0 && std::isfinite(m.ea) && m.ei > 0 && std::isfinite(m.ei))) {
    throw invalid_argument("Frame: member {} has EA = {} and EI = {}; both must be positive", index, m.ea,
                           m.ei);
  }
  for (const double joint : {m.first_joint, m.second_joint}) {
    if (!(joint >= 0 && std::isfinite(joint)))
      throw invalid_argument("Frame: member {} has a joint of stiffness {}", index, joint);
  }
  return beam;
}

/// Nodes with members, all of whose member ends are pinned.
std::vector<std::size_t> nodes_without_rotation(const std::vector<Member>& members, std::size_t nodes) {
  std::vector<int> pinned(nodes, 0), rigid(nodes, 0);
  const auto count = [&](int node, bool is_pinned) {
    require_node(node, nodes, "a member");
    ++(is_pinned ? pinned : rigid)[static_cast<std::size_t>(node)];
  };
  for (const Member& m : members) {
    count(m.first, m.is_first_pinned && m.first_joint == 0);
    count(m.second, m.is_second_pinned && m.second_joint == 0);
  }
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < nodes; ++i) {
    if (pinned[i] > 0 && rigid[i] == 0) found.push_back(i);
  }
  return found;
}

}  // namespace

Frame::Frame(std::vector<Node> nodes, std::vector<Member> members, const std::vector<Support>& supports,
             std::vector<Spring> springs)
    : nodes_(std::move(nodes)), members_(std::move(members)), springs_(std::move(springs)) {
  number_unknowns(supports);
  add_springs();
  parts_.reserve(members_.size());
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const Member& m = members_[i];
    Part part{beam_of(m, i, nodes_), {}, {}};
    for (std::size_t j = 0; j < 3; ++j) {
      part.unknowns[j] = unknowns_[3 * static_cast<std::size_t>(m.first) + j];
      part.unknowns[j + 3] = unknowns_[3 * static_cast<std::size_t>(m.second) + j];
    }
    const std::array nodes_rotations = {part.unknowns[2], part.unknowns[5]};
    if (m.is_first_pinned) part.unknowns[2] = size_++;
    if (m.is_second_pinned) part.unknowns[5] = size_++;
    if (m.is_first_pinned) add_joint(m.first_joint, nodes_rotations[0], part.unknowns[2]);
    if (m.is_second_pinned) add_joint(m.second_joint, nodes_rotations[1], part.unknowns[5]);
    parts_.push_back(part);
  }
  if (size_ == 0) throw std::invalid_argument("Frame: every displacement is fixed");
  make_pattern();
}

void Frame::number_unknowns(const std::vector<Support>& supports) {
  unknowns_.assign(3 * nodes_.size(), 0);
  for (const std::size_t node : nodes_without_rotation(members_, nodes_.size())) unknowns_[3 * node + 2] = -1;
  for (const Support& s : supports) {
    require_node(s.node, nodes_.size(), "a support");
    unknowns_[3 * static_cast<std::size_t>(s.node) + static_cast<std::size_t>(s.motion)] = -1;
  }
  for (Eigen::Index& u : unknowns_) {
    if (u == 0) u = size_++;
  }
}

void Frame::add_joint(double stiffness, Eigen::Index node, Eigen::Index end) {
  if (stiffness > 0) elastics_.push_back({stiffness, {0, 0, -1, 0, 0, 1}, {-1, -1, node, -1, -1, end}, {}});
}

void Frame::add_springs() {
  for (const Spring& s : springs_) {
    if (s.first != -1) require_node(s.first, nodes_.size(), "a spring");
    require_node(s.second, nodes_.size(), "a spring");
    if (!(s.stiffness > 0 && std::isfinite(s.stiffness) && std::isfinite(s.x + s.y + s.rotation)))
      throw invalid_argument("Frame: a spring has the stiffness {} and the direction ({}, {}, {})",
                             s.stiffness, s.x, s.y, s.rotation);
    Elastic elastic{s.stiffness, {-s.x, -s.y, -s.rotation, s.x, s.y, s.rotation}, {}, {}};
    for (std::size_t i = 0; i < 3; ++i) {
      elastic.unknowns[i] = s.first < 0 ? -1 : unknowns_[3 * static_cast<std::size_t>(s.first) + i];
      elastic.unknowns[i + 3] = unknowns_[3 * static_cast<std::size_t>(s.second) + i];
    }
    elastics_.push_back(elastic);
  }
}

void Frame::make_pattern() {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(36 * (parts_.size() + elastics_.size()));
  const auto add_entries = [&](const std::array<Eigen::Index, 6>& unknowns) {
    for (const Eigen::Index column : unknowns) {
      for (const Eigen::Index row : unknowns) {
        if (row >= 0 && column >= 0)
          entries.emplace_back(static_cast<int>(row), static_cast<int>(column), 0.);
      }
    }
  };
  for (const Part& part : parts_) add_entries(part.unknowns);
  for (const Elastic& elastic : elastics_) add_entries(elastic.unknowns);
  pattern_.resize(size_, size_);
  pattern_.setFromTriplets(entries.begin(), entries.end());
  pattern_.makeCompressed();
  const int* const rows = pattern_.innerIndexPtr();
  const int* const starts = pattern_.outerIndexPtr();
  const auto find_slots = [&](auto& part) {
    for (std::size_t i = 0; i < 36; ++i) {
      const Eigen::Index row = part.unknowns[i % 6], column = part.unknowns[i / 6];
      part.slots[i] = -1;
      if (row < 0 || column < 0) continue;
      const int *const first = rows + starts[column], *const last = rows + starts[column + 1];
      part.slots[i] = std::lower_bound(first, last, static_cast<int>(row)) - rows;
    }
  };
  for (Part& part : parts_) find_slots(part);
  for (Elastic& elastic : elastics_) find_slots(elastic);
}

double Frame::spring_force(const Displacements<double>& x, std::size_t index) const {
  require_size(x.size());
  if (index >= springs_.size()) throw invalid_argument("Frame: there is no spring {}", index);
  return elastics_[index].stiffness * elongation<double>(elastics_[index], x);
}

Status Frame::geometric(const Displacements<double>& x, const Displacements<double>& rate,
                        Eigen::SparseMatrix<double>& k) const {
  using Number = Dual<double, 1>;
  require_size(rate.size());
  clear(k);
  Displacements<Number> moving(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    moving[i] = x[i];
    moving[i].partial[0] = rate[i];
  }
  return for_members<Number>(moving, [&](const Part& part, const MemberState<Number>& state) {
    const Matrix<double, 6> m =
        state.axial_force.partial[0] *
        member_geometric(member_state<double>(part.beam, displacements_of<double>(part, x)));
    for (int i = 0; i < 36; ++i) {
      const Eigen::Index slot = part.slots[static_cast<std::size_t>(i)];
      if (slot >= 0) k.valuePtr()[slot] += m(i % 6, i / 6);
    }
  });
}

double Frame::data_rounding(const Displacements<double>& v) const {
  require_size(v.size());
  double sum = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    const Vector<double, 6> d = displacements_of<double>(part, v);
    const Node &a = nodes_[static_cast<std::size_t>(members_[i].first)],
               &b = nodes_[static_cast<std::size_t>(members_[i].second)];
    const double far = std::max({std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y)});
    const double l = std::hypot(part.beam.dx, part.beam.dy);
    const double along = (part.beam.dx * (d[3] - d[0]) + part.beam.dy * (d[4] - d[1])) / l,
                 across = (part.beam.dx * (d[4] - d[1]) - part.beam.dy * (d[3] - d[0])) / l;
    const double bent = part.beam.ei / (l * l * l) *
                        std::max(std::abs(12 * across - 6 * l * (d[2] + d[5])), std::abs(l * (d[2] - d[5])));
    sum += eps / 2 * far * (part.beam.ea / l * std::abs(along) + bent);
  }
  return sum;
}

Eigen::Index Frame::unknown(int node, Motion motion) const {
  require_node(node, nodes_.size(), "the caller");
  return unknowns_[3 * static_cast<std::size_t>(node) + static_cast<std::size_t>(motion)];
}

void Frame::require_size(Eigen::Index size) const {
  if (size != size_) throw invalid_argument("Frame: {} displacements for {} unknowns", size, size_);
}

void Frame::require_member(std::size_t index) const {
  if (index >= parts_.size()) throw invalid_argument("Frame: there is no member {}", index);
}

Status Frame::failure(std::size_t member, Outcome outcome) const {
  const Member& m = members_[member];
  const std::string where =
      fmt::format("frame: member {} from node {} to node {}", member, m.first, m.second);
  switch (outcome) {
    case Outcome::wrong_branch:
      return Status::failure(
          outcome, where +
                       " carries more than its clamped buckling load without symmetric bending: this is the"
                       " straight branch, which is unstable; take two elements a member, or start from a"
                       " symmetric imperfection of the end rotations");
    case Outcome::at_pole:
      return Status::failure(outcome, where +
                                          " is at its clamped buckling load, where its bending stiffness has"
                                          " a pole; change the displacements slightly");
    case Outcome::outside_validity:
      return Status::failure(outcome, where + " has both ends in one place; take a shorter step");
    default:
      return Status::failure(outcome, where + " has displacements that are not finite; take a shorter step");
  }
}

}  // namespace nlmech::frames

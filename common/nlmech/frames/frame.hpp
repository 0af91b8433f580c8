/// @file
/// A plane frame of beam-columns: strain energy, its gradient and its Hessian as functions of the free
/// displacements of the nodes.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "nlmech/frames/beam_column.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::frames {

/// A joint, at rest.
struct Node {
  double x;  ///< place
  double y;  ///< place
};

/// A straight beam-column, rigidly joined to two nodes or pinned.
struct Member {
  int first;                      ///< index of a node
  int second;                     ///< index of another one
  double ea;                      ///< EA, a force
  double ei;                      ///< EI, force times length squared
  bool is_first_pinned = false;   ///< does the first end turn by itself?
  bool is_second_pinned = false;  ///< does the second?
};

/// What a node can do.
enum class Motion : std::uint8_t {
  x,        ///< displacement along x
  y,        ///< displacement along y
  rotation  ///< anticlockwise
};

/// A motion of a node that is zero.
struct Support {
  int node;       ///< index
  Motion motion;  ///< which
};

/// A strain energy, or why there is none.
template <class T>
struct Energy {
  T value{};      ///< of all members
  Status status;  ///< as of Frame::force()
};

/// Are results under this status of use? Those of a success and of `wrong_branch` are.
[[nodiscard]] inline bool has_values(const Status& status) {
  return status.ok() || status.outcome() == Outcome::wrong_branch;
}

/// Members, supports, and the numbering of the unknowns: free motions, node by node in the order x, y,
/// rotation; then the rotations of pinned ends, member by member. A node whose member ends are all pinned has
/// no rotation.
///
/// Tests hold a pinned end to the closed forms of a propped cantilever and of a two-bar truss (1e-12).
///
/// All three functions are templates on the type of number: the frame's data are double, displacements may be
/// extended precision or dual numbers. Rotations are not taken modulo anything: a node may turn as often as
/// it likes, while each member's ends stay within half a turn of its chord.
class Frame {
 public:
  /// Column of free displacements, or of forces on them.
  template <class T>
  using Displacements = Eigen::Matrix<T, Eigen::Dynamic, 1>;

  /// @throws std::invalid_argument for an index out of range, a member of no length, EA or EI that is not
  /// positive, data that are not finite, or no free motion at all
  Frame(std::vector<Node> nodes, std::vector<Member> members, const std::vector<Support>& supports);

  /// Number of unknowns.
  [[nodiscard]] Eigen::Index size() const { return size_; }
  /// Its nodes.
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  /// Its members.
  [[nodiscard]] const std::vector<Member>& members() const { return members_; }
  /// Index of an unknown, -1 if that motion is held.
  /// @throws std::invalid_argument if there is no such node
  [[nodiscard]] Eigen::Index unknown(int node, Motion motion) const;

  /// Of a member the unknowns of x, y and rotation of both ends, -1 where held; rotations of pinned ends
  /// are their own. @throws std::invalid_argument if there is no such member
  [[nodiscard]] const std::array<Eigen::Index, 6>& unknowns_of(std::size_t member) const {
    require_member(member);
    return parts_[member].unknowns;
  }

  /// U(x).
  /// @throws std::invalid_argument if x has another size
  template <class T>
  [[nodiscard]] Energy<T> energy(const Displacements<T>& x) const;

  /// f = dU/dx, the forces that hold the frame there.
  /// @return success; `wrong_branch` if a member carries more than its clamped buckling load with symmetric
  /// end rotations of 0, below 1e-95 (f is right, the equilibrium of that member unstable and there is
  /// another one); without a usable f: `outside_validity` if the ends of a member have met, `at_pole` at the
  /// clamped buckling load, `non_finite`
  /// @throws std::invalid_argument if x has another size
  template <class T>
  [[nodiscard]] Status force(const Displacements<T>& x, Displacements<T>& f) const;

  /// k = d^2U/dx^2, symmetric, both halves stored. A k from an earlier call is filled again, without
  /// allocation.
  /// @return as force()
  /// @throws std::invalid_argument if x has another size
  template <class T>
  [[nodiscard]] Status tangent(const Displacements<T>& x, Eigen::SparseMatrix<T>& k,
                               Coupling coupling = Coupling::consistent) const;

  /// How much the work of the forces dU/dx along @p v may change if the places of nodes are changed in their
  /// last digits: by half a unit of the greatest coordinate of each member, times its stiffnesses EA/l and
  /// 12 EI/l^3 with the relative motion of its ends, summed over the members.
  /// @throws std::invalid_argument if v has another size
  [[nodiscard]] double data_rounding(const Displacements<double>& v) const;

  /// The state of one member, to look at its axial force and moments.
  /// @throws std::invalid_argument if x has another size or there is no such member
  template <class T>
  [[nodiscard]] MemberState<T> member(const Displacements<T>& x, std::size_t index) const;
  /// Displacements x, y and rotation of both ends of a member, those of pinned ends their own.
  /// @throws std::invalid_argument if x has another size or there is no such member
  template <class T>
  [[nodiscard]] Vector<T, 6> ends(const Displacements<T>& x, std::size_t index) const {
    require_size(x.size());
    require_member(index);
    return displacements_of<T>(parts_[index], x);
  }

 private:
  /// What the loops need of a member.
  struct Part {
    BeamColumn beam;
    std::array<Eigen::Index, 6> unknowns;  ///< -1: held
    std::array<Eigen::Index, 36> slots;    ///< of the tangent's values, by columns
  };

  void number_unknowns(const std::vector<Support>& supports);
  void make_pattern();
  void require_size(Eigen::Index size) const;
  void require_member(std::size_t index) const;
  /// The sentence for a member that failed.
  [[nodiscard]] Status failure(std::size_t member, Outcome outcome) const;

  template <class T>
  [[nodiscard]] static Vector<T, 6> displacements_of(const Part& part, const Displacements<T>& x) {
    Vector<T, 6> d;
    for (int i = 0; i < 6; ++i) {
      const Eigen::Index at = part.unknowns[static_cast<std::size_t>(i)];
      d[i] = at < 0 ? T(0) : x[at];
    }
    return d;
  }

  /// Calls use(part, state) for all members up to one that has no state.
  template <class T, class Use>
  [[nodiscard]] Status for_members(const Displacements<T>& x, const Use& use) const {
    require_size(x.size());
    Status status;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const MemberState<T> state = member_state<T>(parts_[i].beam, displacements_of<T>(parts_[i], x));
      if (state.outcome != Outcome::success && status.ok()) status = failure(i, state.outcome);
      if (state.outcome != Outcome::success && state.outcome != Outcome::wrong_branch)
        return failure(i, state.outcome);
      use(parts_[i], state);
    }
    return status;
  }

  std::vector<Node> nodes_;
  std::vector<Member> members_;
  std::vector<Part> parts_;
  std::vector<Eigen::Index> unknowns_;  ///< of 3 motions a node; -1: held
  Eigen::SparseMatrix<double> pattern_;
  Eigen::Index size_ = 0;
};

template <class T>
Energy<T> Frame::energy(const Displacements<T>& x) const {
  Energy<T> energy;
  T sum(0);
  energy.status = for_members<T>(
      x, [&](const Part& part, const MemberState<T>& state) { sum += member_energy<T>(part.beam, state); });
  energy.value = sum;
  return energy;
}

template <class T>
Status Frame::force(const Displacements<T>& x, Displacements<T>& f) const {
  f.setConstant(size_, T(0));
  return for_members<T>(x, [&](const Part& part, const MemberState<T>& state) {
    const Vector<T, 6> r = member_force<T>(state);
    for (int i = 0; i < 6; ++i) {
      const Eigen::Index at = part.unknowns[static_cast<std::size_t>(i)];
      if (at >= 0) f[at] += r[i];
    }
  });
}

template <class T>
Status Frame::tangent(const Displacements<T>& x, Eigen::SparseMatrix<T>& k, Coupling coupling) const {
  if (k.rows() != size_ || k.nonZeros() != pattern_.nonZeros() || !k.isCompressed())
    k = pattern_.template cast<T>();
  T* const values = k.valuePtr();
  for (Eigen::Index i = 0; i < pattern_.nonZeros(); ++i) values[i] = T(0);
  return for_members<T>(x, [&](const Part& part, const MemberState<T>& state) {
    const Matrix<T, 6> m = member_tangent<T>(part.beam, state, coupling);
    for (int i = 0; i < 36; ++i) {
      const Eigen::Index slot = part.slots[static_cast<std::size_t>(i)];
      if (slot >= 0) values[slot] += m(i % 6, i / 6);
    }
  });
}

template <class T>
MemberState<T> Frame::member(const Displacements<T>& x, std::size_t index) const {
  require_size(x.size());
  require_member(index);
  return member_state<T>(parts_[index].beam, displacements_of<T>(parts_[index], x));
}

}  // namespace nlmech::frames

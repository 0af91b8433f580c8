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

/// A node, at rest.
struct Node {
  double x;  ///< place
  double y;  ///< place
};

/// A straight beam-column between two nodes, joined rigidly or by pins.
struct Member {
  int first;                      ///< index of a node
  int second;                     ///< index of another one
  double ea;                      ///< EA, a force
  double ei;                      ///< EI, force times length squared
  bool is_first_pinned = false;   ///< is the first end pinned?
  bool is_second_pinned = false;  ///< is the second end pinned?
  double first_joint = 0;   ///< stiffness of the joint at a pinned first end, moment per rad; 0: a hinge
  double second_joint = 0;  ///< stiffness of the joint at a pinned second end, moment per rad; 0: a hinge
};

/// Degree of freedom of a node.
enum class Motion : std::uint8_t {
  x,        ///< displacement along x
  y,        ///< displacement along y
  rotation  ///< anticlockwise
};

/// A fixed degree of freedom of a node.
struct Support {
  int node;       ///< index
  Motion motion;  ///< which
};

/// A linear spring that keeps its direction: energy stiffness e^2/2 for the elongation e = x u_x + y u_y +
/// rotation theta of the displacements of its second node relative to its first, or to the ground.
struct Spring {
  int first;         ///< index of a node; -1: the ground
  int second;        ///< index of another node
  double stiffness;  ///< positive
  double x;          ///< factor of the displacement along x
  double y;          ///< factor of the displacement along y
  double rotation;   ///< factor of the rotation
};

/// Strain energy with its status.
template <class T>
struct Energy {
  T value{};      ///< strain energy of all members and springs
  Status status;  ///< outcome as in Frame::force()
};

/// Are results with this status valid? True for success and `wrong_branch`.
[[nodiscard]] inline bool has_values(const Status& status) {
  return status.ok() || status.outcome() == Outcome::wrong_branch;
}

/// Members, supports, and the numbering of the unknowns: free motions, node by node in the order x, y,
/// rotation; then the rotations of pinned ends, member by member. A node whose member ends are all pinned has
/// no rotation. A joint of some stiffness keeps the rotation of its node.
///
/// Tests compare pinned ends with the closed forms of a propped cantilever and of a two-bar truss (1e-12),
/// and springs and joints with those of a beam on springs.
///
/// energy(), force() and tangent() are templates on the number type: the data of the frame are double,
/// displacements may be extended precision or dual numbers. Rotations are not reduced modulo 2 pi: a node may
/// turn any number of times, as long as the ends of each member stay within half a turn of its chord.
class Frame {
 public:
  /// Vector of free displacements, or of the forces on them.
  template <class T>
  using Displacements = Eigen::Matrix<T, Eigen::Dynamic, 1>;

  /// @throws std::invalid_argument for an index out of range, a member of no length, EA, EI or the stiffness
  /// of a spring that is not positive, a negative one of a joint, data that are not finite, or no free motion
  /// at all
  Frame(std::vector<Node> nodes, std::vector<Member> members, const std::vector<Support>& supports,
        std::vector<Spring> springs = {});

  /// Number of unknowns.
  [[nodiscard]] Eigen::Index size() const { return size_; }
  /// The nodes.
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  /// The members.
  [[nodiscard]] const std::vector<Member>& members() const { return members_; }
  /// The springs, without the joints of members.
  [[nodiscard]] const std::vector<Spring>& springs() const { return springs_; }
  /// Is there a spring, or a joint of some stiffness?
  [[nodiscard]] bool has_springs() const { return !elastics_.empty(); }
  /// Force of a spring, its stiffness times its elongation; a moment for rotations.
  /// @throws std::invalid_argument if x has another size or there is no such spring
  [[nodiscard]] double spring_force(const Displacements<double>& x, std::size_t index) const;
  /// Strain energy of springs and joints. @throws std::invalid_argument if x has another size
  template <class T>
  [[nodiscard]] T spring_energy(const Displacements<T>& x) const {
    require_size(x.size());
    T sum(0);
    for (const Elastic& s : elastics_) sum += s.stiffness / 2 * square(elongation<T>(s, x));
    return sum;
  }
  /// Index of an unknown; -1 if that degree of freedom is fixed.
  /// @throws std::invalid_argument if there is no such node
  [[nodiscard]] Eigen::Index unknown(int node, Motion motion) const;

  /// Indices of the unknowns x, y and rotation of both ends of a member, -1 where fixed; a pinned end has its
  /// own rotation. @throws std::invalid_argument if there is no such member
  [[nodiscard]] const std::array<Eigen::Index, 6>& unknowns_of(std::size_t member) const {
    require_member(member);
    return parts_[member].unknowns;
  }

  /// U(x).
  /// @throws std::invalid_argument if x has another size
  template <class T>
  [[nodiscard]] Energy<T> energy(const Displacements<T>& x) const;

  /// f = dU/dx, the external forces in equilibrium with x.
  /// @return success; `wrong_branch` if a member carries more than its clamped buckling load with symmetric
  /// end rotations of 0 (below 1e-95): f is valid, but the equilibrium of that member is unstable and another
  /// one exists; without a valid f: `outside_validity` if the ends of a member coincide, `at_pole` at the
  /// clamped buckling load, `non_finite`
  /// @throws std::invalid_argument if x has another size
  template <class T>
  [[nodiscard]] Status force(const Displacements<T>& x, Displacements<T>& f) const;

  /// k = d^2U/dx^2, symmetric, both triangles stored. A k of an earlier call is reused without allocation.
  /// @return as force()
  /// @throws std::invalid_argument if x has another size
  template <class T>
  [[nodiscard]] Status tangent(const Displacements<T>& x, Eigen::SparseMatrix<T>& k,
                               Coupling coupling = Coupling::consistent) const;

  /// k = sum of N' dK/dN over the members, at fixed displacements: the change of the stiffness with axial
  /// forces that grow as the displacements x + t rate. Its pattern is that of tangent().
  /// @return as force() @throws std::invalid_argument if x or rate has another size
  [[nodiscard]] Status geometric(const Displacements<double>& x, const Displacements<double>& rate,
                                 Eigen::SparseMatrix<double>& k) const;

  /// Bound of the change of v^T dU/dx under changes of node coordinates in their last digits: half a unit in
  /// the last place of the greatest coordinate of each member, times its stiffnesses EA/l and 12 EI/l^3 and
  /// the relative motion of its ends, summed over the members.
  /// @throws std::invalid_argument if v has another size
  [[nodiscard]] double data_rounding(const Displacements<double>& v) const;

  /// State of one member, with its axial force and moments.
  /// @throws std::invalid_argument if x has another size or there is no such member
  template <class T>
  [[nodiscard]] MemberState<T> member(const Displacements<T>& x, std::size_t index) const;
  /// Displacements x, y and rotation of both ends of a member; a pinned end has its own rotation.
  /// @throws std::invalid_argument if x has another size or there is no such member
  template <class T>
  [[nodiscard]] Vector<T, 6> ends(const Displacements<T>& x, std::size_t index) const {
    require_size(x.size());
    require_member(index);
    return displacements_of<T>(parts_[index], x);
  }

 private:
  /// Data of a member for the loops over members.
  struct Part {
    BeamColumn beam;
    std::array<Eigen::Index, 6> unknowns;  ///< -1: fixed
    std::array<Eigen::Index, 36> slots;    ///< positions in the values of the tangent, by columns
  };

  /// A spring or joint between the motions of two nodes.
  struct Elastic {
    double stiffness;
    std::array<double, 6> direction;       ///< derivatives of the elongation by the motions
    std::array<Eigen::Index, 6> unknowns;  ///< -1: fixed, or of the ground
    std::array<Eigen::Index, 36> slots;    ///< as of Part
  };

  void number_unknowns(const std::vector<Support>& supports);
  void add_joint(double stiffness, Eigen::Index node, Eigen::Index end);
  void add_springs();
  void make_pattern();
  /// Zero matrix with the pattern of the tangent, in place if it has that already.
  template <class T>
  void clear(Eigen::SparseMatrix<T>& k) const;
  void require_size(Eigen::Index size) const;
  void require_member(std::size_t index) const;
  /// Failure status with a message for one member.
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

  template <class T>
  [[nodiscard]] static T square(const T& x) {
    return x * x;
  }
  template <class T>
  [[nodiscard]] static T elongation(const Elastic& s, const Displacements<T>& x) {
    T sum(0);
    for (std::size_t i = 0; i < 6; ++i) {
      if (s.unknowns[i] >= 0) sum += s.direction[i] * x[s.unknowns[i]];
    }
    return sum;
  }

  /// Calls use(part, state) for all members; stops at a member without a valid state.
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
  std::vector<Spring> springs_;
  std::vector<Part> parts_;
  std::vector<Elastic> elastics_;       ///< the springs, then the joints
  std::vector<Eigen::Index> unknowns_;  ///< for 3 degrees of freedom per node; -1: fixed
  Eigen::SparseMatrix<double> pattern_;
  Eigen::Index size_ = 0;
};

template <class T>
Energy<T> Frame::energy(const Displacements<T>& x) const {
  Energy<T> energy;
  T sum(0);
  energy.status = for_members<T>(
      x, [&](const Part& part, const MemberState<T>& state) { sum += member_energy<T>(part.beam, state); });
  energy.value = sum + spring_energy<T>(x);
  return energy;
}

template <class T>
Status Frame::force(const Displacements<T>& x, Displacements<T>& f) const {
  f.setConstant(size_, T(0));
  require_size(x.size());
  for (const Elastic& s : elastics_) {
    const T force = s.stiffness * elongation<T>(s, x);
    for (std::size_t i = 0; i < 6; ++i) {
      if (s.unknowns[i] >= 0) f[s.unknowns[i]] += s.direction[i] * force;
    }
  }
  return for_members<T>(x, [&](const Part& part, const MemberState<T>& state) {
    const Vector<T, 6> r = member_force<T>(state);
    for (int i = 0; i < 6; ++i) {
      const Eigen::Index at = part.unknowns[static_cast<std::size_t>(i)];
      if (at >= 0) f[at] += r[i];
    }
  });
}

template <class T>
void Frame::clear(Eigen::SparseMatrix<T>& k) const {
  if (k.rows() != size_ || k.nonZeros() != pattern_.nonZeros() || !k.isCompressed())
    k = pattern_.template cast<T>();
  T* const values = k.valuePtr();
  for (Eigen::Index i = 0; i < pattern_.nonZeros(); ++i) values[i] = T(0);
}

template <class T>
Status Frame::tangent(const Displacements<T>& x, Eigen::SparseMatrix<T>& k, Coupling coupling) const {
  clear(k);
  T* const values = k.valuePtr();
  for (const Elastic& s : elastics_) {
    for (std::size_t i = 0; i < 36; ++i) {
      if (s.slots[i] >= 0) values[s.slots[i]] += T(s.stiffness * s.direction[i % 6] * s.direction[i / 6]);
    }
  }
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

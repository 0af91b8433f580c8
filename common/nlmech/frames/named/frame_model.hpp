/// @file
/// A plane frame described by names: nodes, members between them, supports, loads; and the Frame that it
/// makes.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "nlmech/frames/frame.hpp"

namespace nlmech::frames {

/// A joint with a name, at rest.
struct NamedNode {
  std::string name;  ///< each its own
  double x = 0;      ///< place
  double y = 0;      ///< place
};

/// A member between two named nodes.
struct NamedMember {
  std::string first;              ///< name of a node
  std::string second;             ///< name of another one
  double ea = 0;                  ///< EA, a force, positive
  double ei = 0;                  ///< EI, force times length squared, positive
  bool is_first_pinned = false;   ///< does the first end turn by itself?
  bool is_second_pinned = false;  ///< does the second?
  int elements = 1;               ///< beam-columns, times those of build()
  /// Of a circular arc, at most half a circle, with its elements' ends on it: clockwise from the first node
  /// to the second if positive, anticlockwise if negative; 0: straight
  double radius = 0;
  double mass = 0;  ///< per length, not negative; counts for motions in time alone
};

/// A motion of a named node that is zero.
struct NamedSupport {
  std::string node;           ///< its name
  Motion motion = Motion::x;  ///< which
};

/// A dead load on a named node, times the load factor.
struct NamedLoad {
  std::string node;           ///< its name
  Motion motion = Motion::x;  ///< along which; a moment on a rotation
  double value = 0;           ///< force or moment, finite
};

/// A motion of a named node that is given, times the load factor.
struct NamedDisplacement {
  std::string node;           ///< its name
  Motion motion = Motion::x;  ///< which
  double value = 0;           ///< displacement, or angle in rad, finite
};

/// A mass at a named node, for motions in time.
struct NamedMass {
  std::string node;    ///< its name
  double mass = 0;     ///< not negative
  double inertia = 0;  ///< mass times length squared, against rotation, not negative
};

/// Rayleigh's damping: forces a M v + b K v, with the masses M and the stiffness K at rest.
struct Damping {
  double mass = 0;       ///< a, 1/time, not negative
  double stiffness = 0;  ///< b, time, not negative
};

/// A shape in which the perfect frame buckles, built in without strain.
struct Imperfection {
  int mode = 1;          ///< that of the limit or branch point of this number on the path from rest, from 1
  double amplitude = 0;  ///< greatest displacement of a node along x or y, of either sign, finite
};

/// A frame with its loads.
struct FrameModel {
  std::vector<NamedNode> nodes;                   ///< in the order of the results
  std::vector<NamedMember> members;               ///< at least one
  std::vector<NamedSupport> supports;             ///< in any order
  std::vector<NamedLoad> loads;                   ///< one that is not 0, or a displacement
  std::vector<NamedDisplacement> displacements;   ///< given motions, each but once, none of them held
  std::vector<NamedMass> masses;                  ///< beside those of members
  Damping damping;                                ///< of motions in time
  std::optional<Imperfection> imperfection = {};  ///< for imperfect(); build() makes the perfect frame
  bool may_move = false;                          ///< a mechanism is a frame too, for motions in time
};

/// Which of the lists of a FrameModel.
enum class ModelPart : std::uint8_t {
  nodes,          ///< joints
  members,        ///< between them
  supports,       ///< what is held
  loads,          ///< what pulls
  displacements,  ///< what is moved
  masses,         ///< what is heavy
  damping,        ///< the one entry
  imperfection    ///< the one entry
};

/// How many lists there are.
inline constexpr std::size_t model_parts = 8;

/// Why a model makes no frame, and which entry of it is to blame.
class ModelError : public std::invalid_argument {
 public:
  /// @param sentence names what is wrong, with the value
  ModelError(ModelPart part, std::size_t index, const std::string& sentence)
      : std::invalid_argument(sentence), part_(part), index_(index) {}
  [[nodiscard]] ModelPart part() const { return part_; }      ///< the list
  [[nodiscard]] std::size_t index() const { return index_; }  ///< in it; 0 for an empty list

 private:
  ModelPart part_;
  std::size_t index_;
};

/// A free motion of a named node.
struct NamedMotion {
  std::string name;      ///< "B.y", "B.rotation"
  int node;              ///< index
  Motion motion;         ///< which
  Eigen::Index unknown;  ///< of the frame
};

/// The frame of a model.
struct NamedFrame {
  Frame frame;                            ///< the named nodes first, in the order of the model
  Eigen::VectorXd load = {};              ///< forces on the unknowns for a load factor of 1
  std::vector<NamedMotion> motions = {};  ///< free motions of the named nodes, in their order
  std::vector<std::size_t> members = {};  ///< of each beam-column the model's member that it is a part of
  Eigen::VectorXd displacement = {};      ///< given displacements for a load factor of 1; 0 where none is
  std::vector<Eigen::Index> given = {};   ///< the unknowns that are given, rising; most frames have none
  std::vector<Support> supports = {};     ///< of the frame
  /// Of each unknown: half the mass of each beam-column that meets there, at a rotation m l^2/24 of each,
  /// which is that of its half turning about the node; and what the node has of its own. Such masses are the
  /// same whichever way a member points, so that no gyroscopic forces arise.
  Eigen::VectorXd mass = {};
  Damping damping = {};  ///< of motions in time
};

/// "x", "y", "rotation".
[[nodiscard]] std::string_view to_string(Motion motion) noexcept;

/// Beam-columns of the largest frame that is built.
inline constexpr int most_beam_columns = 100'000;

/// Builds it.
///
/// Tests compare nodes of arcs with the circle, and frames with their nodes in another order with the same
/// loads.
/// @param model see there
/// @param elements beam-columns a member, times NamedMember::elements; positive
/// @throws ModelError for a name that is none or stands twice, two nodes in one place, a node without a
/// member, a member of no length, EA or EI that is not positive, an arc that does not span its nodes, numbers
/// that are not finite, a load on a held or a given motion or on no rotation, neither load nor displacement,
/// a displacement that is held or stands twice, masses or damping that are negative, a mode below 1, more
/// than most_beam_columns; and, unless it may, for a frame that can move without a strain in any member (a
/// mechanism, a part that nothing holds), blaming the node that moves most
/// @throws std::invalid_argument if @p elements is not positive
[[nodiscard]] NamedFrame build(const FrameModel& model, int elements);

/// A motion that strains no member, if there is one.
struct Mechanism {
  int node;       ///< the node that moves most, by the stiffness of what it is joined to
  Motion motion;  ///< along which
};

/// Is the frame at rest a mechanism? The softest shape is found by inverse iteration, and its energy is the
/// sum of those of the strains of the members, which tells a soft frame from a mechanism: a strain energy of
/// less than 1e-18 of that of the unknowns each by itself is none.
[[nodiscard]] std::optional<Mechanism> find_mechanism(const Frame& frame);

}  // namespace nlmech::frames

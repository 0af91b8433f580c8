/// @file
/// Model of a plane frame with named nodes, members, supports and loads, and the Frame built from it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "nlmech/frames/frame.hpp"

namespace nlmech::frames {

/// A named node, at rest.
struct NamedNode {
  std::string name;  ///< unique name
  double x = 0;      ///< place
  double y = 0;      ///< place
};

/// A member between two named nodes.
struct NamedMember {
  std::string first;              ///< name of a node
  std::string second;             ///< name of another one
  double ea = 0;                  ///< EA, a force, positive
  double ei = 0;                  ///< EI, force times length squared, positive
  bool is_first_pinned = false;   ///< is the first end pinned?
  bool is_second_pinned = false;  ///< is the second end pinned?
  double first_joint = 0;   ///< stiffness of the joint at a pinned first end, moment per rad; 0: a hinge
  double second_joint = 0;  ///< the same at a pinned second end
  int elements = 1;         ///< beam-columns, times @p elements of build()
  /// Radius of a circular arc, at most half a circle, with the ends of its elements on it: clockwise from the
  /// first node to the second if positive, anticlockwise if negative; 0: straight
  double radius = 0;
  double mass = 0;  ///< mass per length, not negative; for motions, vibrations and own weight
};

/// A fixed degree of freedom of a named node.
struct NamedSupport {
  std::string node;           ///< its name
  Motion motion = Motion::x;  ///< which
};

/// A linear spring that keeps its direction, between two named nodes or from the ground to one.
struct NamedSpring {
  std::string first;     ///< name of a node; empty: the ground
  std::string second;    ///< name of another node
  double x = 0;          ///< direction; its length does not count
  double y = 0;          ///< direction
  bool turns = false;    ///< is it a spring against rotation? It has no direction then
  double stiffness = 0;  ///< force per length, or moment per rad; positive
};

/// A dead load for a load factor of 1.
struct NamedLoad {
  /// Name of a node, or of a member as "FIRST-SECOND" for a force per length along it, or "gravity", unless a
  /// node has that name, for an acceleration of all masses: own weight
  std::string node;
  Motion motion = Motion::x;  ///< direction of the load; a moment for a rotation of a node
  double value = 0;           ///< force, moment, force per length at rest, or acceleration; finite
  bool is_constant = false;   ///< does the load stay the same at all load factors?
};

/// A prescribed displacement of a named node for a load factor of 1.
struct NamedDisplacement {
  std::string node;           ///< its name
  Motion motion = Motion::x;  ///< which
  double value = 0;           ///< displacement, or angle in rad, finite
};

/// A mass at a named node, for motions, vibrations and own weight.
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

/// Imperfection: a buckling mode of the perfect frame, added to the geometry without strain.
struct Imperfection {
  int mode = 1;          ///< number of the limit or bifurcation point on the path from rest, from 1
  double amplitude = 0;  ///< greatest displacement of a node along x or y, of either sign, finite
};

/// A frame with its loads.
struct FrameModel {
  std::vector<NamedNode> nodes;        ///< nodes, in the order of the results
  std::vector<NamedMember> members;    ///< members, at least one
  std::vector<NamedSupport> supports;  ///< supports, in any order
  std::vector<NamedLoad>
      loads;  ///< one at least that grows and is not 0, unless a displacement is prescribed
  std::vector<NamedDisplacement> displacements;   ///< prescribed displacements, each once, none of them fixed
  std::vector<NamedMass> masses;                  ///< masses in addition to those of members
  Damping damping;                                ///< damping of motions in time
  std::optional<Imperfection> imperfection = {};  ///< used by imperfect(); build() makes the perfect frame
  bool may_move = false;                          ///< accept a mechanism, for motions in time
  std::vector<NamedSpring> springs = {};          ///< springs, in the order of the results
  bool needs_load = true;  ///< refuse a model whose loads do not grow; vibrations need none
};

/// List of a FrameModel.
enum class ModelPart : std::uint8_t {
  nodes,          ///< FrameModel::nodes
  members,        ///< FrameModel::members
  supports,       ///< FrameModel::supports
  loads,          ///< FrameModel::loads
  displacements,  ///< FrameModel::displacements
  masses,         ///< FrameModel::masses
  damping,        ///< the one entry
  imperfection,   ///< the one entry
  springs         ///< FrameModel::springs
};

/// Number of values of ModelPart.
inline constexpr std::size_t model_parts = 9;

/// Error in a model, with the entry that causes it.
class ModelError : public std::invalid_argument {
 public:
  /// @param sentence what is wrong, with the value
  ModelError(ModelPart part, std::size_t index, const std::string& sentence)
      : std::invalid_argument(sentence), part_(part), index_(index) {}
  [[nodiscard]] ModelPart part() const { return part_; }      ///< the list
  [[nodiscard]] std::size_t index() const { return index_; }  ///< index in the list; 0 for an empty list

 private:
  ModelPart part_;
  std::size_t index_;
};

/// A free degree of freedom of a named node.
struct NamedMotion {
  std::string name;      ///< "B.y", "B.rotation"
  int node;              ///< index
  Motion motion;         ///< which
  Eigen::Index unknown;  ///< index of the unknown of the frame
};

/// Loads as they are applied, on fixed motions too.
struct AppliedLoads {
  Eigen::VectorXd nodes = {};    ///< forces along x and y and moment at each named node, three numbers each
  Eigen::VectorXd members = {};  ///< forces per length along x and y of each beam-column, two numbers each

  /// Forces and moments at the ends of a beam-column that do the work of the load along it: half of it at
  /// each end, and moments of p l^2/12 for its part p across the member at rest.
  [[nodiscard]] Vector<double, 6> at_ends(const Frame& frame, std::size_t beam_column) const;
  /// Forces on the unknowns of the frame.
  [[nodiscard]] Eigen::VectorXd on_unknowns(const Frame& frame) const;
};

/// The frame built from a model.
struct NamedFrame {
  Frame frame;                ///< structure; the named nodes come first, in the order of the model
  Eigen::VectorXd load = {};  ///< forces on the unknowns for a load factor of 1
  std::vector<NamedMotion> motions = {};  ///< free degrees of freedom of the named nodes, in their order
  std::vector<std::size_t> members = {};  ///< for each beam-column, the index of its member in the model
  Eigen::VectorXd displacement = {};      ///< prescribed displacements for a load factor of 1; 0 elsewhere
  std::vector<Eigen::Index> given = {};   ///< indices of the prescribed unknowns, ascending; usually empty
  std::vector<Support> supports = {};     ///< supports of the frame
  /// Lumped mass of each unknown: half the mass m of each adjacent beam-column, for a rotation m l^2/24 of
  /// each (its half rotating about the node), plus the mass or inertia of the node itself. These masses do
  /// not depend on the direction of a member, so there are no gyroscopic forces.
  Eigen::VectorXd mass = {};
  Damping damping = {};         ///< damping of motions in time
  AppliedLoads growing = {};    ///< for a load factor of 1; `load` is on_unknowns() of it
  AppliedLoads constant = {};   ///< at all load factors
  Eigen::VectorXd steady = {};  ///< on_unknowns() of `constant`; empty if there is none
};

/// All loads on the unknowns at a load factor.
[[nodiscard]] inline Eigen::VectorXd loads_at(const NamedFrame& frame, double load) {
  if (frame.steady.size() == 0) return load * frame.load;
  return load * frame.load + frame.steady;
}

/// "x", "y", "rotation".
[[nodiscard]] std::string_view to_string(Motion motion) noexcept;

/// Largest number of beam-columns of a frame.
inline constexpr int most_beam_columns = 100'000;

/// Builds the frame of a model.
///
/// Tests compare nodes of arcs with the circle, and frames with the same frames after renumbering the nodes.
/// @param model nodes, members, supports and actions
/// @param elements beam-columns per member, times NamedMember::elements; positive
/// @throws ModelError for an unknown or repeated name, two nodes at one position, a node without a member, a
/// member of zero length, EA or EI that is not positive, an arc that does not span its nodes, numbers that
/// are not finite, a load on a fixed, prescribed or missing degree of freedom or along a member that is not
/// there, a spring of no stiffness or at fixed motions only, neither load nor displacement (unless
/// FrameModel::needs_load is false), a prescribed displacement that is fixed or repeated, negative masses or
/// damping, a mode below 1, more than
/// most_beam_columns; and, unless FrameModel::may_move, for a frame that can move without strain in any
/// member (a mechanism, a part without support), naming the node that moves most
/// @throws std::invalid_argument if @p elements is not positive
[[nodiscard]] NamedFrame build(const FrameModel& model, int elements);

}  // namespace nlmech::frames

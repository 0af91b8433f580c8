/// @file
/// Frames on which path following is judged: Lee's frame and circular arches.
#pragma once

#include <Eigen/Core>

#include "nlmech/frames/frame.hpp"

namespace nlmech::frames {

/// A frame with one dead load.
struct LoadedStructure {
  Frame frame;            ///< the frame
  Eigen::Index loaded;    ///< unknown along which the load acts, downwards where y points up
  Eigen::Index sideways;  ///< unknown of the same node along x; -1 if held
  Eigen::VectorXd load;   ///< forces on the unknowns for a load of 1
};

/// Lee's frame (Lee, Manuel and Rossow 1968): a column and a beam that meet in a rigid corner, both far ends
/// pinned, a load down on the beam. Its path snaps through in the load and back in the displacement.
struct LeeFrame {
  int elements = 10;     ///< of the column, and of the beam; a multiple of 5, for a node under the load
  double length = 120;   ///< of each, positive
  double ea = 720. * 6;  ///< EA, a force
  double ei = 720. * 2;  ///< EI, force times length squared
};

/// A circular arch of straight elements with its nodes on the circle, loaded at the crown downwards.
struct Arch {
  double radius = 100;           ///< positive
  double half_angle = 1;         ///< from the crown to each end, rad; between 0 and pi
  double ea = 1e8;               ///< EA, a force
  double ei = 1e6;               ///< EI, force times length squared
  int elements = 20;             ///< of the whole arch; even, for a node at the crown
  bool is_left_clamped = true;   ///< else pinned
  bool is_right_clamped = true;  ///< else pinned
  /// The left half only, its crown held against moving sideways and turning; the load is still that on the
  /// whole. For arches with both ends held alike.
  bool is_half = false;
};

/// The arch of 215 degrees, clamped left and pinned right, of DaDeppo and Schmidt (1975).
[[nodiscard]] Arch deep_arch(int elements);
/// The clamped shallow arch of Gjelsvik and Bodner (1962): it snaps through, and branches into an
/// antisymmetric shape.
[[nodiscard]] Arch shallow_arch(int elements);

/// Builds it.
/// @throws std::invalid_argument for a number out of the ranges given above
[[nodiscard]] LoadedStructure make_frame(const LeeFrame& lee);
/// Builds it.
/// @throws std::invalid_argument for a number out of the ranges given above
[[nodiscard]] LoadedStructure make_frame(const Arch& arch);

}  // namespace nlmech::frames

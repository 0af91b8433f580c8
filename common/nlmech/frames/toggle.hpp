/// @file
/// The toggle of Williams as a plane frame.
#pragma once

#include <Eigen/Core>

#include "nlmech/frames/frame.hpp"

namespace nlmech::frames {

/// Two equal straight members that meet in a rigid apex over clamped bases, loaded at the apex downwards.
/// Defaults: Table 2.1 of Elgohary 2015 (inch, pound), first case.
struct Toggle {
  double height = 0.32;   ///< height of the apex over the bases; positive
  double length = 12.94;  ///< of a member; above the height. Half span: sqrt(length^2 - height^2)
  double ea = 1.885e6;    ///< EA, a force
  double ei = 9.27e3;     ///< EI, force times length squared
  int elements = 1;       ///< beam-columns per member; at least 1
  bool full = false;  ///< both members; else one, with the apex fixed against sideways motion and rotation
};

/// Frame model of a toggle, with its load.
struct ToggleFrame {
  Frame frame;           ///< nodes from the left base over the apex to the right base
  Eigen::Index apex;     ///< unknown of the apex's vertical displacement, upwards
  Eigen::VectorXd load;  ///< forces on the unknowns for a load of 1 on the full toggle
};

/// Builds the frame of a toggle.
/// @throws std::invalid_argument for a number out of the ranges given above
[[nodiscard]] ToggleFrame make_frame(const Toggle& toggle);

}  // namespace nlmech::frames

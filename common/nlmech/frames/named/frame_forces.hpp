/// @file
/// Forces in the members of a frame, at its supports and in its springs.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "nlmech/frames/named/frame_model.hpp"

namespace nlmech::frames {

/// Forces in a section of a member, in the directions of its axis there, which leads from the first node of
/// the member to the second.
struct SectionForces {
  double axial = 0;   ///< tension positive
  double shear = 0;   ///< derivative of the moment along the axis
  double moment = 0;  ///< EI times the change of curvature, anticlockwise positive: with the axis along x it
                      ///< is positive where the lower side is in tension
};

/// Forces in a member.
struct MemberForces {
  SectionForces first;   ///< at its first end
  SectionForces second;  ///< at its second end
  double moment = 0;     ///< moment of the greatest size in the member
};

/// Forces of a frame in one state.
struct FrameForces {
  std::vector<MemberForces> members;  ///< for each member of the model
  /// Forces along x and y and moment at each named node, three numbers each, that supports and prescribed
  /// displacements exert on the frame: zero at free motions, up to the residual of the state.
  Eigen::VectorXd nodes;
  std::vector<double> springs;  ///< for each spring of the model: stiffness times elongation
};

/// Forces in equilibrium with the displacements @p x at a load factor. Those of a loaded member are the
/// forces of its deformation less the work-equivalent loads at its ends; between the ends of a beam-column
/// its moment is the parabola with the load as curvature, which neglects N l^2/(8 EI) of its height.
///
/// Tests compare them with closed forms (beams on two and more supports, a cantilever under its own weight,
/// an arch) and with sums of all loads.
/// @param model the model from which @p frame was built
/// @param frame the frame @param x displacements, finite @param load load factor
[[nodiscard]] FrameForces forces_of(const FrameModel& model, const NamedFrame& frame,
                                    const Eigen::VectorXd& x, double load);

}  // namespace nlmech::frames

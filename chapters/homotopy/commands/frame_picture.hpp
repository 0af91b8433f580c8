/// @file
/// Figure of the equilibrium paths of a frame: load factor against a displacement, and deformed shapes.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "nlmech/frames/named/frame_model.hpp"
#include "nlmech/frames/named/frame_paths.hpp"
#include "nlmech/scene/show.hpp"

namespace nlmech::chapters::homotopy {

/// Polylines of the deformed members.
struct Shape {
  std::vector<double> x;  ///< NaN between two members
  std::vector<double> y;  ///< NaN between two members
};

/// Deformed frame for the displacements @p x; each beam-column is a cubic with its end rotations.
[[nodiscard]] Shape shape_of(const frames::Frame& frame, const Eigen::VectorXd& x);

/// The named displacement with the largest value on all paths; a translation if there is one.
/// @param frame with at least one named displacement
[[nodiscard]] const frames::NamedMotion& largest_motion(const frames::NamedFrame& frame,
                                                        const frames::FramePaths& paths);

/// Figure with a panel of the paths and a panel of the shapes at rest, at limit and bifurcation points, and
/// at the ends of paths.
[[nodiscard]] scene::Figure frame_picture(const frames::NamedFrame& frame, const frames::FramePaths& paths);

}  // namespace nlmech::chapters::homotopy

/// @file
/// The paths of a frame as a picture: load factor against a displacement beside the frame's shapes.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "nlmech/frames/named/frame_model.hpp"
#include "nlmech/frames/named/frame_paths.hpp"
#include "nlmech/scene/show.hpp"

namespace nlmech::chapters::homotopy {

/// Lines along the deformed members, to be drawn.
struct Shape {
  std::vector<double> x;  ///< NaN between two members
  std::vector<double> y;  ///< NaN between two members
};

/// The frame with displacements @p x, each beam-column as the cubic with its end rotations.
[[nodiscard]] Shape shape_of(const frames::Frame& frame, const Eigen::VectorXd& x);

/// The named motion that gets farthest on all paths, a translation if there is one.
/// @param frame with a motion at least
[[nodiscard]] const frames::NamedMotion& largest_motion(const frames::NamedFrame& frame,
                                                        const frames::FramePaths& paths);

/// A panel of the paths, and one of the shapes at rest, at limit and branch points, and at the ends.
[[nodiscard]] scene::Figure frame_picture(const frames::NamedFrame& frame, const frames::FramePaths& paths);

}  // namespace nlmech::chapters::homotopy

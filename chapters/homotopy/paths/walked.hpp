/// @file
/// The frames that ship, their paths, and how scenes draw them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "nlmech/frames/named/frame_model.hpp"
#include "nlmech/frames/named/frame_paths.hpp"
#include "nlmech/scene/show.hpp"

namespace nlmech::chapters::homotopy {

/// The model of a file of chapters/homotopy/frames, named without its ending. @throws Failure if it is none
[[nodiscard]] frames::FrameModel shipped_model(const std::string& name);

/// A frame that ships, and its paths.
struct Walked {
  frames::NamedFrame frame;  ///< as of build()
  frames::FramePaths paths;  ///< of it

  /// All points of a branch.
  [[nodiscard]] std::vector<frames::FramePoint> points(int branch) const;
  /// Those of a kind.
  [[nodiscard]] std::vector<frames::FramePoint> points(frames::FramePoint::Kind kind, int branch = 0) const;
  /// The motion of this name, times a factor, of any point. @throws Failure if there is none
  [[nodiscard]] std::function<double(const frames::FramePoint&)> motion(const std::string& name,
                                                                        double factor = 1) const;
};

/// The unknown of a motion by its name. @throws Failure if there is none
[[nodiscard]] Eigen::Index unknown_of(const frames::NamedFrame& frame, const std::string& motion);

/// Walks along the paths of a frame that ships, its imperfection left out.
/// @throws Failure if a path does not get to its end
[[nodiscard]] Walked walk(const std::string& name, int elements, const frames::FrameWalk& how);

/// Draws the frame with displacements @p x.
void put_shape(const Walked& w, const Eigen::VectorXd& x, const std::string& name, const scene::Look& look,
               scene::Panel& panel);
/// Draws it at rest.
void put_rest(const Walked& w, scene::Panel& panel);
/// Draws limit and branch points of the path from rest.
void put_forks(const Walked& w, const std::function<double(const frames::FramePoint&)>& x,
               scene::Panel& panel);

}  // namespace nlmech::chapters::homotopy

/// @file
/// A frame as equations with a parameter, and how a path of these is measured.
#pragma once

#include <Eigen/Core>

#include "nlmech/frames/loaded_frame.hpp"
#include "nlmech/frames/named/driven_frame.hpp"
#include "nlmech/frames/named/frame_model.hpp"

namespace nlmech::frames {

/// A beam-column that has lost most of its length.
struct ShortestMember {
  double left;  ///< length of the chord over that at rest
  double x;     ///< of its first node at rest
  double y;     ///< of its first node at rest
};

/// A frame as equations, and all of its displacements from the unknowns of these.
struct WalkedFrame {
  const Frame& frame;                   ///< must outlive this object
  algebraic::Loaded& equations;         ///< must outlive this object
  const DrivenFrame* driven = nullptr;  ///< the equations, if some motions are given

  /// All displacements.
  [[nodiscard]] Eigen::VectorXd whole(const Eigen::VectorXd& x, double load) const {
    return driven != nullptr ? driven->whole(x, load) : x;
  }
  /// A direction of all of them.
  [[nodiscard]] Eigen::VectorXd shape(const Eigen::VectorXd& v) const {
    return driven != nullptr ? driven->shape(v) : v;
  }
  /// Scales by which a path is measured: one for all translations, so that a member that turns with its node
  /// does not turn the path, and 1 for rotations.
  [[nodiscard]] Eigen::VectorXd scale() const;
  /// Takes whole turns from a difference of displacements by scale(), if each member has turned so at both
  /// its ends: the frame is the same then.
  void forget_turns(Eigen::VectorXd& change) const;
  /// The beam-column that has lost most of its length under a load. @param x unknowns of the equations
  [[nodiscard]] ShortestMember shortest(const Eigen::VectorXd& x, double load) const;
};

/// See first_load() of a NamedFrame.
[[nodiscard]] double first_load(const WalkedFrame& walked);

/// Calls use(walked) with the equations of a frame.
template <class Use>
auto with_equations(const NamedFrame& f, const Use& use) {
  if (f.given.empty()) {
    LoadedFrame equations(f.frame, f.load);
    return use(WalkedFrame{f.frame, equations});
  }
  DrivenFrame equations(f);
  return use(WalkedFrame{f.frame, equations, &equations});
}

}  // namespace nlmech::frames

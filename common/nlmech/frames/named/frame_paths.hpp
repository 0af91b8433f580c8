/// @file
/// All of a frame's equilibrium path from rest, with the branches that leave it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "nlmech/frames/frame.hpp"
#include "nlmech/frames/named/frame_model.hpp"
#include "nlmech/support/statistics.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::frames {

/// How far to walk.
struct PathOptions {
  int steps = 200;  ///< along each branch, at most; positive
  /// Load factor of either sign at which each branch ends, not 0; negative: the path sets out to negative
  /// ones.
  std::optional<double> until = {};
  int branches = 0;    ///< to be followed besides the path from rest, at most
  double turn = 0.15;  ///< of the tangent in a step, as it should be, rad
  /// The path from rest ends at its limit or branch point of this number, not at a multiple of their loads;
  /// 0: goes on.
  int critical = 0;
  double seconds = std::numeric_limits<double>::infinity();  ///< wall time of all branches, positive
};

/// A point of a path.
struct FramePoint {
  /// What it is.
  enum class Kind : std::uint8_t {
    step,        ///< where the walk stepped
    maximum,     ///< of the load factor, along the walk
    minimum,     ///< of the load factor, along the walk
    bifurcation  ///< other branches leave the path
  };
  int branch = 0;          ///< 0: from rest
  Kind kind = Kind::step;  ///< what it is
  double load = 0;         ///< load factor
  Eigen::VectorXd x;       ///< displacements
  Eigen::Index negative =
      0;  ///< negative eigenvalues of the tangent stiffness; the vanishing one not counted
  Eigen::VectorXd mode = {};   ///< of a limit or branch point: the shape that costs no work, of length 1
  Eigen::Index vanishing = 0;  ///< of a limit or branch point: eigenvalues that vanish, as far as is known
};

/// "step", "maximum", "minimum", "bifurcation".
[[nodiscard]] std::string_view to_string(FramePoint::Kind kind) noexcept;

/// The paths, as far as they were followed.
struct FramePaths {
  /// Branch by branch, in the order of the walk; each but that from rest begins with its bifurcation.
  std::vector<FramePoint> points;
  int branches = 0;       ///< followed besides the path from rest
  int unfollowed = 0;     ///< halves of branches seen and not followed, where one eigenvalue vanishes
  Status status;          ///< success, or why a branch was left before its end, the first that was
  Statistics statistics;  ///< of all of it
};

/// Follows the equilibria of a frame under growing dead loads from rest through all limit and branch points,
/// each computed to rounding, and goes on along branches that were met, both ways from a branch point, in the
/// order in which they were met. Where several eigenvalues vanish at once, the directions of branches are not
/// those of the null vectors: such a point is listed, and no branch of it followed.
///
/// A branch ends at a load factor of `until`, or where it meets a branch point that is known. Without `until`
/// it ends at twice the greatest load factor of a limit or branch point on it, its first one included; those
/// of more than twice the first do not count. An end after its steps is a failure, `step_limit`; one after
/// `seconds`, asked before each step, `time_limit`. `singular_matrix`: elements so short that by rounding the
/// frame is unstable at rest.
///
/// Given motions have the same load factor, and eigenvalues are those with given motions held.
///
/// Tests compare limit and branch points with tools/oracles/homotopy_frames.py and closed forms (a two-bar
/// truss, Euler's loads, a cantilever that rolls up to a circle), and paths under a given displacement with
/// those under the force that it takes.
/// @param frame stable at rest
/// @param walk how far
/// @throws std::invalid_argument if a number of @p walk is out of its range
[[nodiscard]] FramePaths equilibrium_paths(const NamedFrame& frame, const PathOptions& walk);

/// The frame with an imperfection built in, or why there is none.
struct Imperfect {
  NamedFrame frame;    ///< with its nodes moved, at rest and without strain
  FramePoint buckled;  ///< where the perfect frame has the shape; without it the status is a failure
  Status status;       ///< success; `not_converged` for a path without that point; as FramePaths::status
};

/// Moves the nodes of a frame along the null vector of its stiffness at a limit or branch point of the path
/// from rest. Of its two directions the one is taken in which the first node that moves farthest along x or y
/// moves to greater values.
///
/// Tests hold it to closed forms of two columns held by braces, whose limit loads fall with the amplitude by
/// Koiter's powers 1/2 and 2/3.
/// @param perfect the frame
/// @param imperfection which point and how far
/// @param walk how far to look for the point
/// @throws std::invalid_argument for a mode below 1 or an amplitude that is not finite; as build(), if nodes
/// meet
[[nodiscard]] Imperfect imperfect(const NamedFrame& perfect, const Imperfection& imperfection,
                                  const PathOptions& walk = {});

}  // namespace nlmech::frames

/// @file
/// Equilibrium path of a frame from rest, with its secondary branches.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <vector>

#include "nlmech/algebraic/paths/path.hpp"
#include "nlmech/frames/frame.hpp"
#include "nlmech/frames/named/frame_model.hpp"
#include "nlmech/support/statistics.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::frames {

/// Options of path following.
struct PathOptions {
  int steps = 200;  ///< limit of steps on each branch; positive
  /// Load factor at which each branch ends, not 0; if negative, the path starts towards negative load
  /// factors.
  std::optional<double> until = {};
  /// Load factors at which the paths have points too, wherever they pass them before their ends; finite
  std::vector<double> at = {};
  int branches = 0;    ///< limit of branches to follow in addition to the path from rest
  double turn = 0.15;  ///< target rotation of the tangent in a step, rad
  /// Number of the limit or bifurcation point at which the path from rest ends, in place of a multiple of
  /// their loads; 0: none.
  int critical = 0;
  double seconds = std::numeric_limits<double>::infinity();  ///< wall time of all branches, positive
};

/// A point of an equilibrium path.
struct FramePoint {
  using Kind = algebraic::PointKind;  ///< types of points
  int branch = 0;                     ///< number of the branch; 0: path from rest
  Kind kind = Kind::step;             ///< type of the point
  double load = 0;                    ///< load factor
  Eigen::VectorXd x;                  ///< displacements
  Eigen::Index negative = 0;          ///< negative eigenvalues of the tangent, without the vanishing one
  Eigen::VectorXd mode = {};          ///< at a limit or bifurcation point: null vector of norm 1
  Eigen::Index vanishing = 0;         ///< number of vanishing eigenvalues, as far as known; 0 for a step
};

/// Result of equilibrium_paths().
struct FramePaths {
  /// Points branch by branch, in the order of the path; each secondary branch starts with its bifurcation.
  std::vector<FramePoint> points;
  int branches = 0;       ///< number of secondary branches followed
  int unfollowed = 0;     ///< number of half branches found but not followed, at simple bifurcations
  Status status;          ///< success, or the first failure on a branch
  Statistics statistics;  ///< counters of all branches
};

/// Follows the equilibrium path of a frame under growing dead loads from rest through all limit and
/// bifurcation points, each computed to rounding, and then the secondary branches, in both directions, in the
/// order in which they were found. Where several eigenvalues vanish at once, the null vectors do not give the
/// directions of the branches: such a point is listed, but its branches are not followed.
///
/// A branch ends at the load factor `until`, or at a known bifurcation point. Without `until` it ends at
/// twice the greatest load factor of its limit and bifurcation points, including its start; points beyond
/// twice the first load factor do not count. Where loads are constant the path starts at start_of().
/// Failures: `step_limit`; `time_limit` after `seconds`, checked at each step; `singular_matrix` if elements
/// are so short that rounding makes the frame unstable at rest.
///
/// Prescribed displacements have the same load factor; eigenvalues are those with prescribed displacements
/// fixed.
///
/// Tests compare limit and bifurcation points with tools/oracles/homotopy_frames.py and closed forms (a
/// two-bar truss, Euler's loads, a cantilever that rolls up to a circle), and paths under a prescribed
/// displacement with those under the corresponding force.
/// @param frame stable at rest
/// @param options limits and end of the paths
/// @throws std::invalid_argument if an option of @p options is out of range
[[nodiscard]] FramePaths equilibrium_paths(const NamedFrame& frame, const PathOptions& options);

/// Displacements of a frame at the load factor 0, or the reason of failure.
struct Start {
  Eigen::VectorXd x;  ///< displacements; 0 without constant loads
  Status status;  ///< success, or as FramePaths::status; `wrong_branch` if the constant loads alone buckle it
};

/// Equilibrium under the constant loads alone, on the path along which they grow together from nothing, which
/// must be stable.
///
/// Tests compare it with the path of a frame whose constant loads grow.
[[nodiscard]] Start start_of(const NamedFrame& frame, const PathOptions& options);

/// Factor that scales the greatest displacement of a node along x or y in a shape to 1. If several are equal
/// to rounding, the first determines the sign. Infinite if no node is displaced: by more than 1e-9 of the
/// greatest product of a member's length and the rotation of its end, above the rounding of eigenvectors.
[[nodiscard]] double factor_of(const Frame& frame, const Eigen::VectorXd& shape);

/// Frame with an imperfection, or the reason of failure.
struct Imperfect {
  NamedFrame frame;    ///< the frame with displaced nodes, at rest and without strain
  FramePoint buckled;  ///< critical point of the perfect frame with this mode; not set after a failure
  Status status;       ///< success; `not_converged` if the path has no such point; else as FramePaths::status
};

/// Displaces the nodes of a frame along the null vector of its stiffness at a limit or bifurcation point of
/// the path from rest. Its sign is chosen so that the first of the greatest displacements along x or y is
/// positive.
///
/// Tests compare it with closed forms of two braced columns, whose limit loads decrease with the amplitude by
/// Koiter's powers 1/2 and 2/3.
/// @param perfect the frame
/// @param imperfection number of the critical point, and amplitude
/// @param options limits of the search for the point
/// @throws std::invalid_argument for a mode below 1 or an amplitude that is not finite; if nodes coincide
/// afterwards, as build()
[[nodiscard]] Imperfect imperfect(const NamedFrame& perfect, const Imperfection& imperfection,
                                  const PathOptions& options = {});

}  // namespace nlmech::frames

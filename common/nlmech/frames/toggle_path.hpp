/// @file
/// Snap-through of a symmetric toggle: limit points and bifurcations of its path from rest, and stability of
/// a configuration.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "nlmech/algebraic/paths/path.hpp"
#include "nlmech/frames/toggle.hpp"
#include "nlmech/frames/williams.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::frames {

/// A limit point or bifurcation on the symmetric path of a full toggle of two members.
struct ToggleEvent {
  algebraic::CriticalPoint::Kind kind;  ///< which
  double load;                          ///< load on the apex, downwards
  double drop;                          ///< downward displacement of the apex
  /// Is the null vector symmetric? Then both members bow alike; else the apex rotates and moves sideways.
  bool is_symmetric;
};

/// Result of following the path.
struct TogglePath {
  std::vector<ToggleEvent> events;  ///< critical points in order from rest
  double drop = 0;                  ///< downward displacement of the apex at the end
  Status status;                    ///< success, or why the path ends early
};

/// Limit points and bifurcations of the full toggle on its symmetric path from rest, until the apex has
/// dropped by at least 2.2 heights, the load increases and the equilibrium is stable.
///
/// The full toggle includes the antisymmetric buckling modes that half a toggle excludes. They come first
/// where the compression of a member exceeds about 20.19 EI/l^2 (clamped at the base, free to rotate at the
/// apex), half of 4 pi^2.
///
/// Tests compare loads with eigenvalues of dense tangents under displacement control (1e-8), for low toggles
/// with tools/oracles (1e-10), and for high ones with other numbers m of elements (error m^-2).
/// @param toggle `full` is taken as true
/// @throws std::invalid_argument as make_frame()
[[nodiscard]] TogglePath critical_points(const Toggle& toggle);

/// The first limit point or bifurcation of the symmetric path from rest before it reaches @p load. If there
/// is none, `events` is empty and `drop` is the drop at that load. The status reports whether the path could
/// be followed that far.
/// @param load of either sign, finite
/// @throws std::invalid_argument as make_frame()
[[nodiscard]] TogglePath first_critical_point(const Toggle& toggle, double load);

/// Critical points of Williams' equation. By stability functions its members buckle at the compressions 20.19
/// EI/l^2 (antisymmetric, apex free to rotate) and 4 pi^2 EI/l^2 (symmetric); sideways motion of the apex is
/// neglected, as in the equation. Where the compression reaches the pole of d_5, the load tends to minus
/// infinity and the path from rest ends with `drop` below 2.2 heights: for heights above 0.976 in with the
/// numbers of Table 2.1.
///
/// Tests compare limit points with bisection in 50 digits, and bifurcations with their compression.
/// @throws std::invalid_argument if a number of the toggle is not positive
[[nodiscard]] TogglePath critical_points(const Williams& toggle);

/// First critical point of Williams' equation before @p load.
/// @throws std::invalid_argument if a number of the toggle is not positive, or the load not finite
[[nodiscard]] TogglePath first_critical_point(const Williams& toggle, double load);

/// Number of unstable directions of the full toggle in the symmetric configuration whose left half is @p x.
/// @param toggle `full` is ignored
/// @param x unknowns of the half toggle
/// @return number of negative eigenvalues of the tangent, plus those that vanish to rounding; empty if there
/// is no tangent, or a member is on its straight branch past buckling (`wrong_branch`)
/// @throws std::invalid_argument as make_frame(), or if x has another size
[[nodiscard]] std::optional<Eigen::Index> unstable_motions(const Toggle& toggle, const Eigen::VectorXd& x);

/// Number of unstable directions of Williams' equation at a drop: one for a negative slope of the load, and
/// one for each exceeded buckling load.
[[nodiscard]] std::optional<Eigen::Index> unstable_motions(const Williams& toggle, double drop);

}  // namespace nlmech::frames

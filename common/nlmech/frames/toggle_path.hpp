/// @file
/// How a symmetric toggle gets from rest through the level of its bases: limit points and bifurcations on the
/// way, and whether a shape is stable.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "nlmech/algebraic/paths/path.hpp"
#include "nlmech/frames/toggle.hpp"
#include "nlmech/frames/williams.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::frames {

/// A limit point or a bifurcation on the symmetric path of a whole toggle, both members of it.
struct ToggleEvent {
  algebraic::CriticalPoint::Kind kind;  ///< which
  double load;                          ///< on the apex, downwards
  double drop;                          ///< of the apex
  /// Is the motion that costs no work there a mirror image of itself? Members then bow alike; else the apex
  /// turns and moves sideways.
  bool is_symmetric;
};

/// The path, as far as it was followed.
struct TogglePath {
  std::vector<ToggleEvent> events;  ///< in order from rest
  double drop = 0;                  ///< of the apex, at the end
  Status status;                    ///< success, or why the path was left before its end
};

/// Limit points and bifurcations of the whole toggle on its symmetric path from rest, until the apex has
/// dropped by 2.2 heights and more, the load rises and the shape is stable.
///
/// A path of both members sees what half a toggle cannot: antisymmetric motions, which come first where the
/// compression of a member exceeds about 20.19 EI/l^2 (clamped below, free to turn above), half of 4 pi^2.
///
/// Tests hold loads to eigenvalues of dense tangents under displacement control (1e-8), of low toggles to
/// tools/oracles (1e-10), and of high ones to other numbers of elements (their m^-2).
/// @param toggle `full` is taken as true
/// @throws std::invalid_argument as make_frame()
[[nodiscard]] TogglePath critical_points(const Toggle& toggle);

/// The first limit point or bifurcation that the symmetric path from rest meets before it carries @p load;
/// nothing if it meets none, and then `drop` is where it carries the load. The status tells whether the path
/// could be followed so far.
/// @param load of either sign, finite
/// @throws std::invalid_argument as make_frame()
[[nodiscard]] TogglePath first_critical_point(const Toggle& toggle, double load);

/// The same of Williams' equation, whose members buckle where their compression is 20.19 EI/l^2
/// (antisymmetric, the apex free to turn) and 4 pi^2 EI/l^2 (symmetric), by stability functions, sideways
/// motion of the apex left out as the equation does. Where the compression reaches the pole of d_5 the load
/// falls without bound and the path from rest ends: for heights above 0.976 in with the numbers of Table 2.1;
/// `drop` is less than 2.2 heights then.
///
/// Tests hold limit points to bisection in 50 digits, bifurcations to their compression.
/// @throws std::invalid_argument if a number of the toggle is not positive
[[nodiscard]] TogglePath critical_points(const Williams& toggle);

/// The same of Williams' equation.
/// @throws std::invalid_argument if a number of the toggle is not positive, or the load not finite
[[nodiscard]] TogglePath first_critical_point(const Williams& toggle, double load);

/// In how many motions is the whole toggle unstable in the symmetric shape that @p x is the left half of?
/// @param toggle `full` is ignored
/// @param x unknowns of the half toggle
/// @return negative eigenvalues of its tangent, and those that vanish to rounding; nothing if it has no
/// tangent, or a member is on the straight branch of its buckling (`wrong_branch`)
/// @throws std::invalid_argument as make_frame(), or if x has another size
[[nodiscard]] std::optional<Eigen::Index> unstable_motions(const Toggle& toggle, const Eigen::VectorXd& x);

/// The same of Williams' equation at a drop: negative slope of the load, and each kind of buckling counted
/// once.
[[nodiscard]] std::optional<Eigen::Index> unstable_motions(const Williams& toggle, double drop);

}  // namespace nlmech::frames

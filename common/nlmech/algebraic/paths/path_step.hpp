/// @file
/// What two neighbouring points of a path tell of the stretch between them.
#pragma once

#include <cmath>
#include <cstdlib>

#include "nlmech/algebraic/paths/path.hpp"

namespace nlmech::algebraic {

/// What has changed between two points of a path.
struct PathChanges {
  bool fold;              ///< has the slope another sign?
  Eigen::Index branches;  ///< eigenvalues that have changed their signs besides that of the fold, at least
  /// Of both kinds.
  [[nodiscard]] Eigen::Index count() const { return branches + (fold ? 1 : 0); }
};

/// Compares two points. At a limit point one eigenvalue changes its sign; all others that do are those of
/// branch points.
/// @param is_symmetric are eigenvalues counted? Else branches are told by the sign of the bordered
/// determinant
[[nodiscard]] inline PathChanges changes_between(const PathPoint& a, const PathPoint& b, bool is_symmetric) {
  const bool fold = (a.slope > 0) != (b.slope > 0);
  if (!is_symmetric) return {fold, a.sign * b.sign < 0 ? 1 : 0};
  const Eigen::Index change = std::abs(b.negative - a.negative);
  return {fold, fold ? std::abs(change - 1) : change};
}

/// A place on the cubic through both points with their tangents.
/// @param part 0 at @p begin, 1 at @p end
[[nodiscard]] PathVector between_by_cubic(const PathPoint& begin, const PathPoint& end, double part);

}  // namespace nlmech::algebraic

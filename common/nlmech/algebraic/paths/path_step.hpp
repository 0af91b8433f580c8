/// @file
/// What two neighbouring points of a path tell of the stretch between them.
#pragma once

#include <cmath>
#include <cstdlib>
#include <optional>

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

/// Closes in on the least value between two places, as long as there are values.
/// @param at `std::optional<double>(double place)`: a value; empty where the search is to end
/// @return the place where it ended, if it did within so many steps
template <class At>
[[nodiscard]] std::optional<double> golden_section(double low, double high, int steps, const At& at) {
  const double golden = (std::sqrt(5.) - 1) / 2;
  double left = high - golden * (high - low), right = low + golden * (high - low);
  std::optional<double> at_left = at(left);
  if (!at_left) return left;
  std::optional<double> at_right = at(right);
  if (!at_right) return right;
  for (int k = 0; k < steps; ++k) {
    if (*at_left < *at_right) {
      high = right, right = left, at_right = at_left;
      left = high - golden * (high - low);
      if (at_left = at(left); !at_left) return left;
    } else {
      low = left, left = right, at_left = at_right;
      right = low + golden * (high - low);
      if (at_right = at(right); !at_right) return right;
    }
  }
  return std::nullopt;
}

}  // namespace nlmech::algebraic

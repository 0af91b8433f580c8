/// @file
/// Comparison of two neighbouring points of a path, and interpolation between them.
#pragma once

#include <cmath>
#include <cstdlib>
#include <optional>

#include "nlmech/algebraic/paths/path.hpp"

namespace nlmech::algebraic {

/// Sign changes between two points of a path.
struct PathChanges {
  bool fold;              ///< does the slope change sign?
  Eigen::Index branches;  ///< smallest number of eigenvalues that change sign, without that of the fold
  /// Number of changes of both kinds.
  [[nodiscard]] Eigen::Index count() const { return branches + (fold ? 1 : 0); }
};

/// Compares two points. At a limit point one eigenvalue changes sign; further changes belong to bifurcation
/// points.
/// @param is_symmetric counts eigenvalues if true; else the sign of the bordered determinant shows
/// bifurcations
[[nodiscard]] inline PathChanges changes_between(const PathPoint& a, const PathPoint& b, bool is_symmetric) {
  const bool fold = (a.slope > 0) != (b.slope > 0);
  if (!is_symmetric) return {fold, a.sign * b.sign < 0 ? 1 : 0};
  const Eigen::Index change = std::abs(b.negative - a.negative);
  return {fold, fold ? std::abs(change - 1) : change};
}

/// Point on the Hermite cubic through both points with their tangents.
/// @param part 0 at @p begin, 1 at @p end
[[nodiscard]] PathVector between_by_cubic(const PathPoint& begin, const PathPoint& end, double part);

/// Golden-section search for the minimum of at() in [low, high].
/// @param at `std::optional<double>(double place)`: the value; empty to end the search
/// @return the place where at() was empty; empty if that does not happen within @p steps steps
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

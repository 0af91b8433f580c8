/// @file
/// Golden section for a least value. Internal to the paths.
#pragma once

#include <cmath>
#include <optional>

namespace nlmech::algebraic {

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

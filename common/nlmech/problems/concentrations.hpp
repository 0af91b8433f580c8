/// @file
/// Bounds that the equations of chemical kinetics have in common.
#pragma once

#include <limits>

#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// Concentrations of n species do not become negative where no rate constant is: their lower bounds are then
/// 0, otherwise -infinity.
template <int n>
[[nodiscard]] Vector<double, n> concentrations_lower_bounds(bool rates_are_not_negative) {
  Vector<double, n> bounds = Vector<double, n>::Zero();
  if (!rates_are_not_negative) bounds.setConstant(-std::numeric_limits<double>::infinity());
  return bounds;
}

}  // namespace nlmech::problems

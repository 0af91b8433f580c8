/// @file
/// Grids of points for curves.
#pragma once

#include <cmath>
#include <vector>

#include "nlmech/support/sentences.hpp"

namespace nlmech::chapters::gss_control {

/// n equidistant points from @p low to @p high, including both ends.
[[nodiscard]] inline std::vector<double> equidistant(double low, double high, int n) {
  std::vector<double> all;
  for (int i = 0; i < n; ++i) all.push_back(low + (high - low) * i / (n - 1));
  return all;
}

/// Logarithmic grid of n points from @p low to @p high, including both ends.
/// @throws std::invalid_argument unless 0 < low < high and n >= 2
[[nodiscard]] inline std::vector<double> logarithmic(double low, double high, int n) {
  if (!(low > 0 && high > low) || n < 2)
    throw invalid_argument("logarithmic: {} points from {:.6g} to {:.6g}", n, low, high);
  std::vector<double> all;
  const double first = std::log10(low), length = std::log10(high) - first;  // powers of ten are exact
  for (int i = 0; i < n; ++i) all.push_back(std::pow(10, first + length * i / (n - 1)));
  all.front() = low;  // exact, without rounding
  all.back() = high;
  return all;
}

}  // namespace nlmech::chapters::gss_control

/// @file
/// Points at which curves are computed.
#pragma once

#include <cmath>
#include <vector>

#include "nlmech/support/sentences.hpp"

namespace nlmech::chapters::gss_control {

/// Equidistant points, both ends included.
[[nodiscard]] inline std::vector<double> equidistant(double low, double high, int n) {
  std::vector<double> all;
  for (int i = 0; i < n; ++i) all.push_back(low + (high - low) * i / (n - 1));
  return all;
}

/// Points of a logarithmic grid from @p low to @p high, both included. @throws std::invalid_argument unless
/// 0 < low < high and n >= 2
[[nodiscard]] inline std::vector<double> logarithmic(double low, double high, int n) {
  if (!(low > 0 && high > low) || n < 2)
    throw invalid_argument("logarithmic: {} points from {:.6g} to {:.6g}", n, low, high);
  std::vector<double> all;
  const double first = std::log10(low), length = std::log10(high) - first;  // powers of ten stay themselves
  for (int i = 0; i < n; ++i) all.push_back(std::pow(10, first + length * i / (n - 1)));
  all.front() = low;  // as typed, not as rounded
  all.back() = high;
  return all;
}

}  // namespace nlmech::chapters::gss_control

/// @file
/// Points at which curves are computed.
#pragma once

#include <vector>

namespace nlmech::chapters::gss_control {

/// Points of a logarithmic grid from @p low to @p high, both included. @throws std::invalid_argument unless
/// 0 < low < high and n >= 2
[[nodiscard]] std::vector<double> logarithmic(double low, double high, int n);

/// Equidistant points, both ends included.
[[nodiscard]] std::vector<double> equidistant(double low, double high, int n);

}  // namespace nlmech::chapters::gss_control

/// @file
/// Two constants of double precision.
#pragma once

#include <limits>

namespace nlmech {

/// The spacing of doubles at 1, 2^-52.
inline constexpr double eps = std::numeric_limits<double>::epsilon();

/// Not a number, in place of a missing result.
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace nlmech

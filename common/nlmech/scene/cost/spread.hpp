/// @file
/// Labels beside a picture, moved apart.
#pragma once

#include <vector>

namespace nlmech::scene {

/// Places at least @p gap apart within a range, in the order of those wanted, which they miss by the least
/// sum of squares. Where the range has no room for all, they share it equally.
/// @param wanted in any order; answered in the same
/// @param gap not negative @param low, high end of the range
[[nodiscard]] std::vector<double> spread(const std::vector<double>& wanted, double gap, double low,
                                         double high);

}  // namespace nlmech::scene

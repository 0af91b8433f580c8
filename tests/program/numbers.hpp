/// @file
/// Numbers of 50 digits, and random numbers.
#pragma once

#include "nlmech/support/extended_real.hpp"
#include "tests/random.hpp"

namespace nlmech::tests {

using Real = ExtendedReal<50>;

inline constexpr double epsilon = 0x1p-52;

}  // namespace nlmech::tests

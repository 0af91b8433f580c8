/// @file
/// Numbers of 50 digits, and random ones.
#pragma once

#include <rapidcheck/gtest.h>

#include "nlmech/support/extended_real.hpp"

namespace nlmech::tests {

using Real = ExtendedReal<50>;

inline constexpr double epsilon = 0x1p-52;

/// A double in [low, high), with all digits random.
inline rc::Gen<double> between(double low, double high) {
  return rc::gen::map(rc::gen::inRange<std::int64_t>(0, std::int64_t{1} << 52), [=](std::int64_t i) {
    return low + (high - low) * (static_cast<double>(i) * 0x1p-52);
  });
}

}  // namespace nlmech::tests

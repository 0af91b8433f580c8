/// @file
/// Numbers of 50 digits, and random ones.
#pragma once

#include <rapidcheck/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace nlmech::tests {

using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

inline constexpr double epsilon = 0x1p-52;

/// A double in [low, high), with all digits random.
inline rc::Gen<double> between(double low, double high) {
  return rc::gen::map(rc::gen::inRange<std::int64_t>(0, std::int64_t{1} << 52), [=](std::int64_t i) {
    return low + (high - low) * (static_cast<double>(i) * 0x1p-52);
  });
}

}  // namespace nlmech::tests

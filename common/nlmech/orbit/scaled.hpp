/// @file
/// States in units that are powers of two, in which squares and cubes do not overflow. Internal to the
/// component.
#pragma once

#include <algorithm>
#include <cmath>

#include "nlmech/orbit/gravity.hpp"

namespace nlmech::orbit::detail {

/// Speed, in circular speeds, above which gravity is below rounding and e^2 overflows.
inline constexpr double fastest = 1e150;

/// Is a number so far from 1 that its powers may overflow or underflow?
[[nodiscard]] inline bool is_extreme(double size) { return !(size > 1e-60 && size < 1e60); }

/// Largest absolute component of a vector.
[[nodiscard]] inline double extent(const Vector3<double>& v) {
  return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
}

/// A vector times 2^exponent.
[[nodiscard]] inline Vector3<double> times_power_of_two(const Vector3<double>& v, int exponent) {
  return {std::ldexp(v[0], exponent), std::ldexp(v[1], exponent), std::ldexp(v[2], exponent)};
}

/// Units 2^length of length and 2^time of time, in which |r| and mu are near 1. Scaling is exact except for
/// subnormal results.
struct PowerUnits {
  int length = 0, time = 0;  ///< exponents

  PowerUnits() = default;
  /// @param size of the position, positive @param mu positive
  PowerUnits(double size, double mu) : length(std::ilogb(size)), time((3 * length - std::ilogb(mu)) / 2) {}

  /// State in these units.
  [[nodiscard]] State own(const State& s) const {
    return {times_power_of_two(s.position, -length), times_power_of_two(s.velocity, time - length)};
  }
  /// State in the units of the user.
  [[nodiscard]] State users(const State& s) const {
    if (length == 0 && time == 0) return s;
    return {times_power_of_two(s.position, length), times_power_of_two(s.velocity, length - time)};
  }
  /// Field in these units.
  [[nodiscard]] Gravity own(Gravity gravity) const {
    gravity.mu = own_mu(gravity.mu);
    gravity.radius = std::ldexp(gravity.radius, -length);
    return gravity;
  }
  /// Gravitational parameter, from 1/2 to 4.
  [[nodiscard]] double own_mu(double mu) const { return std::ldexp(mu, 2 * time - 3 * length); }
};

}  // namespace nlmech::orbit::detail

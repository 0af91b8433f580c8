/// @file
/// Days about an oblate Earth, and ends of them known from elsewhere.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "nlmech/orbit/gravity.hpp"

namespace nlmech::chapters::two_body_series {

/// A start in metres and seconds, in decimals, and what 86400 s of J_2 make of it.
struct ZonalDay {
  const char* name;                   ///< "LEO"
  std::array<const char*, 6> start;   ///< position, velocity
  std::array<const char*, 6> end_j2;  ///< to 20 digits, by tools/oracles/two_body_series_orbits.py
};

/// Seconds of a day.
inline constexpr double day = 86400;

/// LEO of Eq. 3.71; the same with the velocity tilted by 60 degrees out of the equator; a nearly circular
/// one.
[[nodiscard]] std::span<const ZonalDay> zonal_days();

/// The start, rounded to double.
[[nodiscard]] orbit::State start_of(const ZonalDay& d);

/// Errors of the end by J_2: lengths of the differences to the digits.
struct ZonalErrors {
  double position = 0;  ///< m
  double velocity = 0;  ///< m/s
  double energy = 0;    ///< relative change
};

/// In double precision, by orbit::propagate().
[[nodiscard]] ZonalErrors day_in_double(const ZonalDay& d);

/// In quadruple precision, by orbit::continue_analytically().
[[nodiscard]] ZonalErrors day_in_extended(const ZonalDay& d);

}  // namespace nlmech::chapters::two_body_series

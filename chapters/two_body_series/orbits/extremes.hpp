/// @file
/// Orbits where methods end, and the same orbit in two systems of units.
#pragma once

namespace nlmech::chapters::two_body_series {

/// The low orbit of Eq. 3.71 over 20 revolutions in metres and seconds, and in units of @p length metres and
/// @p time seconds: |difference of the ends|/|r|. 0: the same digits.
[[nodiscard]] double difference_between_units(double length, double time);

/// The unit of time, in seconds, in which mu is 1 and @p length metres are the unit of length.
[[nodiscard]] double canonical_time(double length);

/// kappa eps/2 of those 20 revolutions, kappa the condition of the position: what rounding the data does.
[[nodiscard]] double rounding_between_units();

}  // namespace nlmech::chapters::two_body_series

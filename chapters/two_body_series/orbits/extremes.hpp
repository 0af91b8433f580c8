/// @file
/// Difficult orbits, and one orbit in two systems of units.
#pragma once

namespace nlmech::chapters::two_body_series {

/// Relative difference of the final positions of the low orbit of Eq. 3.71 after 20 revolutions, computed in
/// metres and seconds, and in units of @p length metres and @p time seconds. 0: bitwise equal.
[[nodiscard]] double difference_between_units(double length, double time);

/// Unit of time, s, for which mu = 1 with the unit of length @p length, m.
[[nodiscard]] double canonical_time(double length);

/// Effect of rounding of the data on those 20 revolutions: kappa eps/2, kappa the condition of the position.
[[nodiscard]] double rounding_between_units();

}  // namespace nlmech::chapters::two_body_series

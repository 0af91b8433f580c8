/// @file
/// Ellipses in the units a = 1 and mu = 1, a revolution being 2 pi, and the scale of errors on them.
#pragma once

#include "nlmech/orbit/state.hpp"

namespace nlmech::chapters::two_body_series {

/// 2 pi.
inline constexpr double revolution = 6.283185307179586;

/// The state at the mean anomaly @p anomaly, the periapsis on the x axis; rounded to double from more digits.
[[nodiscard]] orbit::State on_ellipse(double eccentricity, double anomaly = 0);

/// The state @p time after @p start, from Kepler's equation in 50 digits.
[[nodiscard]] orbit::BasicState<long double> state_in_50_digits(const orbit::State& start, double time,
                                                                double mu);

/// |r - r'| with r' from Kepler's equation in 50 digits, @p time after @p start.
[[nodiscard]] double position_error(const orbit::State& start, double time, double mu,
                                    const orbit::Vector3<double>& position);

/// What a relative error eps/2 of all data grows to on the way, as a length.
[[nodiscard]] double rounding_of_data(const orbit::State& start, double time, double mu);

}  // namespace nlmech::chapters::two_body_series

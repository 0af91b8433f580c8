/// @file
/// Ellipses in units a = 1, mu = 1 (period 2 pi), and errors on them.
#pragma once

#include "nlmech/orbit/state.hpp"

namespace nlmech::chapters::two_body_series {

/// Period, 2 pi.
inline constexpr double revolution = 6.283185307179586;

/// State at the mean anomaly @p anomaly (rad), periapsis on the x axis; computed in long double, then
/// rounded.
[[nodiscard]] orbit::State on_ellipse(double eccentricity, double anomaly = 0);

/// State @p time after @p start, by Kepler's equation in 50 digits.
[[nodiscard]] orbit::BasicState<long double> state_in_50_digits(const orbit::State& start, double time,
                                                                double mu);

/// Error |r - r'| of a position @p time after @p start; r' by Kepler's equation in 50 digits.
[[nodiscard]] double position_error(const orbit::State& start, double time, double mu,
                                    const orbit::Vector3<double>& position);

/// Position error @p time after @p start caused by a relative error eps/2 of the data, as a length.
[[nodiscard]] double rounding_of_data(const orbit::State& start, double time, double mu);

}  // namespace nlmech::chapters::two_body_series

/// @file
/// How far a Taylor series in time of Kepler's motion converges.
#pragma once

#include "nlmech/orbit/state.hpp"

namespace nlmech::orbit {

/// The distance in mean anomaly from the periapsis of an ellipse to the nearest singularities,
/// acosh(1/e) - sqrt(1 - e^2) on the imaginary axis (there r = 0). At mean anomaly M, from -pi to pi, the
/// radius of convergence is sqrt(M^2 + rho^2). Without cancellation for e near 1.
/// @param eccentricity from 0 (infinite) to 1 (0) @throws std::invalid_argument for another
[[nodiscard]] double convergence_radius_at_periapsis(double eccentricity);

/// The radius of convergence, as a time, of the Taylor series at @p state: its distance in the complex plane
/// from the nearest time at which r.r = 0. Infinite for circles (and where it is beyond the doubles). For
/// every conic, straight lines included, where it is the time to the nearest collision.
/// @throws std::invalid_argument for a position 0, mu not positive, or anything not finite
[[nodiscard]] double convergence_radius(const State& state, double mu);

}  // namespace nlmech::orbit

/// @file
/// Radius of convergence of the Taylor series in time of Kepler motion.
#pragma once

#include "nlmech/orbit/state.hpp"

namespace nlmech::orbit {

/// Distance in mean anomaly rho from the periapsis of an ellipse to the nearest singularities, acosh(1/e) -
/// sqrt(1 - e^2) on the imaginary axis (there r = 0). At mean anomaly M, from -pi to pi, the radius of
/// convergence is sqrt(M^2 + rho^2). Without cancellation for e near 1.
/// @param eccentricity from 0 (infinite) to 1 (0) @throws std::invalid_argument for another
[[nodiscard]] double convergence_radius_at_periapsis(double eccentricity);

/// Radius of convergence, as a time, of the Taylor series at @p state: distance in the complex plane to the
/// nearest time at which r.r = 0. Infinite for circles (and where it overflows). Valid for every conic,
/// including straight lines, where it is reserved for the time to the nearest collision.
/// @throws std::invalid_argument for a zero position, mu not positive, or values that are not finite
[[nodiscard]] double convergence_radius(const State& state, double mu);

}  // namespace nlmech::orbit

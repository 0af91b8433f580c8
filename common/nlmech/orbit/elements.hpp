/// @file
/// Classical orbital elements and the state that belongs to them.
#pragma once

#include "nlmech/orbit/state.hpp"

namespace nlmech::orbit {

/// A conic, where it lies and where on it the body is. Angles in radians. Where an angle is not defined it is
/// 0 by convention, and the next one is counted from where the undefined one would have ended:
///  - no inclination (0 or pi): ascending_node = 0, the node is the x axis;
///  - a circle: periapsis_argument = 0, the true anomaly is counted from the node.
/// Eccentricities below 4 eps and inclinations with a sine below 4 eps count as such.
struct Elements {
  double semi_latus_rectum = 1;   ///< p = h.h/mu, positive; unlike a it exists for every conic
  double eccentricity = 0;        ///< e, 0 or more
  double inclination = 0;         ///< i, from 0 to pi
  double ascending_node = 0;      ///< Omega, from 0 to 2 pi
  double periapsis_argument = 0;  ///< omega, from 0 to 2 pi, in the direction of motion
  double true_anomaly = 0;        ///< nu, from -pi to pi
  /// a: negative for hyperbolas, infinite for parabolas. From the energy, and so more accurate than
  /// p/(1 - e^2) for thin ellipses; no input of state_of().
  double semi_major_axis = 1;

  /// 2 pi sqrt(a^3/mu), infinite for open conics.
  [[nodiscard]] double period(double mu) const;
};

/// Elements with p = a (1 - e^2), for ellipses and hyperbolas. @throws std::invalid_argument for e = 1, for e
/// < 0, if a has not the sign of 1 - e, or if p is no double
[[nodiscard]] Elements from_axis(double semi_major_axis, double eccentricity, double inclination = 0,
                                 double ascending_node = 0, double periapsis_argument = 0,
                                 double true_anomaly = 0);

/// The elements of @p state. The state that state_of() makes of them is within 32 eps of |r| and |v| (times
/// (1 + e)/(1 + e cos nu) where that is more than 1: far out on an open conic, and on the fastest ones, the
/// anomaly fixes the distance less and less); tests
/// hold random orbits of all kinds to that. Any units: what is far from 1 is scaled by powers of two.
/// @throws std::invalid_argument for a position 0, mu not positive, anything not finite, for motion on a
/// straight line through the centre, which has no such elements, and where elements are beyond the range of
/// doubles (a is infinite for parabolas alone)
[[nodiscard]] Elements elements_of(const State& state, double mu);

/// The state of @p elements. @throws std::invalid_argument for p or mu not positive, e < 0, anything not
/// finite (the semi-major axis is not read), an angle beyond 1/eps (its rounding is as large as a turn), an
/// anomaly beyond the asymptote of an open conic, and where distance or speed is beyond the range of doubles
[[nodiscard]] State state_of(const Elements& elements, double mu);

}  // namespace nlmech::orbit

/// @file
/// Classical orbital elements, and conversion to and from states.
#pragma once

#include "nlmech/orbit/state.hpp"
#include "nlmech/support/degrees.hpp"

namespace nlmech::orbit {

/// Orbital elements: size, shape and orientation of a conic, and position on it. Angles in radians. An
/// undefined angle is 0 by convention, and the next angle is measured from its end:
///  - no inclination (0 or pi): ascending_node = 0, the node is the x axis;
///  - a circle: periapsis_argument = 0, the true anomaly is measured from the node.
/// Eccentricities below 4 eps and inclinations with a sine below 4 eps count as zero.
struct Elements {
  double semi_latus_rectum = 1;   ///< p = h.h/mu, positive; unlike a it exists for every conic
  double eccentricity = 0;        ///< e, 0 or more
  double inclination = 0;         ///< i, from 0 to pi
  double ascending_node = 0;      ///< Omega, from 0 to 2 pi
  double periapsis_argument = 0;  ///< omega, from 0 to 2 pi, in the direction of motion
  double true_anomaly = 0;        ///< nu, from -pi to pi

  // Results of elements_of(), not read by state_of():

  /// a: negative for hyperbolas, infinite for parabolas. Computed from the energy, which for thin ellipses is
  /// more accurate than p/(1 - e^2).
  double semi_major_axis = 1;
  double periapsis_distance = 1;  ///< q = p/(1 + e), at most a for ellipses; 1 - e = q/a
  /// E, from -pi to pi; of a hyperbola the hyperbolic anomaly H; of a parabola their limit, 0.
  double eccentric_anomaly = 0;
  double mean_anomaly = 0;          ///< M = E - e sin E, from -pi to pi; e sinh H - H; 0 for a parabola
  double time_since_periapsis = 0;  ///< negative before it; within half a period for ellipses

  /// 2 pi sqrt(a^3/mu), infinite for open conics.
  [[nodiscard]] double period(double mu) const;
};

/// Elements with p = a (1 - e^2), for ellipses and hyperbolas. @throws std::invalid_argument for e = 1, for e
/// < 0, if the signs of a and 1 - e differ, or if p overflows
[[nodiscard]] Elements from_axis(double semi_major_axis, double eccentricity, double inclination = 0,
                                 double ascending_node = 0, double periapsis_argument = 0,
                                 double true_anomaly = 0);

/// Elements of @p state. state_of() reproduces the state within 32 eps of |r| and |v|, times (1 + e)/(1 + e
/// cos nu) where that exceeds 1: far out on a near-parabolic conic, and on very fast ones, e and the true
/// anomaly are ill-conditioned for the distance. Periapsis distance, semi-major axis and time since periapsis
/// are well-conditioned everywhere: state_at_time() reproduces the state within 32 eps of |r| and of the
/// larger of |v| and the circular speed. Tests check both for random orbits of all kinds. Any units: extreme
/// values are scaled by powers of two.
/// @throws std::invalid_argument for a zero position, mu not positive, values that are not finite, motion on
/// a straight line through the centre, which has no such elements, and elements beyond the range of doubles
/// (a is infinite only for parabolas)
[[nodiscard]] Elements elements_of(const State& state, double mu);

/// State of @p elements, within 32 eps of |r| and |v| times the condition number: 1 + e cos nu is computed
/// without cancellation. @throws std::invalid_argument for p or mu not positive, e < 0, values that are not
/// finite, an angle beyond 1/eps (its rounding is as large as a turn), an anomaly at or beyond the asymptote
/// of an open conic, and a distance or speed beyond the range of doubles
[[nodiscard]] State state_of(const Elements& elements, double mu);

/// Size and shape of a conic by q and 1 - e, which are accurate for every conic; near the parabola e does not
/// distinguish an ellipse from a hyperbola.
struct Conic {
  double periapsis_distance = 1;  ///< q, positive
  double one_minus_e = 1;         ///< 1 - e = q/a: at most 1, 0 for parabolas, negative for hyperbolas

  /// e, 0 or more.
  [[nodiscard]] double eccentricity() const { return 1 - one_minus_e; }
  /// p = q (1 + e).
  [[nodiscard]] double semi_latus_rectum() const { return periapsis_distance * (2 - one_minus_e); }
  /// a, infinite for parabolas.
  [[nodiscard]] double semi_major_axis() const { return periapsis_distance / one_minus_e; }
};

/// Orientation of a conic: sines and cosines of i, Omega and omega of Elements; sine_cosine_of_degrees()
/// gives them exactly for quarter turns.
struct Orientation {
  SineCosine inclination;         ///< sine and cosine of i
  SineCosine ascending_node;      ///< sine and cosine of Omega
  SineCosine periapsis_argument;  ///< sine and cosine of omega
};

/// State on @p conic at a true anomaly, within 16 eps of |r| and |v| for exact arguments (near an asymptote
/// times the condition number). @param half sine and cosine of nu/2
/// @throws std::invalid_argument for mu not positive, an invalid conic, a true anomaly at or beyond the
/// asymptote, and a distance or speed beyond the range of doubles
[[nodiscard]] State state_at_true_anomaly(const Conic& conic, const Orientation& orientation,
                                          const SineCosine& half, double mu);

/// State at an eccentric anomaly of an ellipse. @param half sine and cosine of E/2
/// @throws std::invalid_argument as above, and for other conics
[[nodiscard]] State state_at_eccentric_anomaly(const Conic& conic, const Orientation& orientation,
                                               const SineCosine& half, double mu);

/// State at a hyperbolic anomaly H. @throws std::invalid_argument as above, and for other conics
[[nodiscard]] State state_at_hyperbolic_anomaly(const Conic& conic, const Orientation& orientation,
                                                double anomaly, double mu);

/// State at a mean anomaly in radians, M = E - e sin E or e sinh H - H.
/// @throws std::invalid_argument as above, and for a parabola
[[nodiscard]] State state_at_mean_anomaly(const Conic& conic, const Orientation& orientation, double anomaly,
                                          double mu);

/// State at a time since the periapsis, of either sign. @throws std::invalid_argument as above
[[nodiscard]] State state_at_time(const Conic& conic, const Orientation& orientation, double time, double mu);

}  // namespace nlmech::orbit

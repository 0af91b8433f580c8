/// @file
/// Classical orbital elements and the state that belongs to them.
#pragma once

#include "nlmech/orbit/state.hpp"
#include "nlmech/support/degrees.hpp"

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

  // Results of elements_of(), not read by state_of():

  /// a: negative for hyperbolas, infinite for parabolas. From the energy, and so more accurate than
  /// p/(1 - e^2) for thin ellipses.
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
/// < 0, if a has not the sign of 1 - e, or if p is no double
[[nodiscard]] Elements from_axis(double semi_major_axis, double eccentricity, double inclination = 0,
                                 double ascending_node = 0, double periapsis_argument = 0,
                                 double true_anomaly = 0);

/// The elements of @p state. The state that state_of() makes of them is within 32 eps of |r| and |v|, times
/// (1 + e)/(1 + e cos nu) where that is more than 1: far out on a conic near the parabola, and on the fastest
/// ones, e and the true anomaly fix the distance less and less. The periapsis distance, the semi-major axis
/// and the time since periapsis fix it everywhere: state_at_time() makes of them a state within 32 eps of
/// |r| and of the larger of |v| and the circular speed there. Tests check both for random orbits of all
/// kinds. Any units: what is far from 1 is scaled by powers of two.
/// @throws std::invalid_argument for a position 0, mu not positive, anything not finite, for motion on a
/// straight line through the centre, which has no such elements, and where elements are beyond the range of
/// doubles (a is infinite for parabolas alone)
[[nodiscard]] Elements elements_of(const State& state, double mu);

/// The state of @p elements, within 32 eps of |r| and |v| times their condition: 1 + e cos nu is formed
/// without cancellation. @throws std::invalid_argument for p or mu not positive, e < 0, anything not finite,
/// an angle beyond 1/eps (its rounding is as large as a turn), an anomaly at or beyond the asymptote of an
/// open conic, and where distance or speed is beyond the range of doubles
[[nodiscard]] State state_of(const Elements& elements, double mu);

/// Size and form of a conic by q and 1 - e, which keep their digits for every conic: near the parabola e does
/// not tell an ellipse from a hyperbola.
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

/// Where a conic lies: sines and cosines of i, Omega and omega of Elements, which sine_cosine_of_degrees()
/// gives exactly for quarter turns.
struct Orientation {
  SineCosine inclination;         ///< of i
  SineCosine ascending_node;      ///< of Omega
  SineCosine periapsis_argument;  ///< of omega
};

/// The state on @p conic at a true anomaly, within 16 eps of |r| and |v| for these numbers taken as exact
/// (near an asymptote times the condition). @param half sine and cosine of nu/2
/// @throws std::invalid_argument for mu not positive, a conic that is none, a true anomaly at or beyond the
/// asymptote, and where distance or speed is beyond the range of doubles
[[nodiscard]] State state_at_true_anomaly(const Conic& conic, const Orientation& orientation,
                                          const SineCosine& half, double mu);

/// The state at an eccentric anomaly of an ellipse, given by sine and cosine of E/2.
/// @throws std::invalid_argument as above, and for other conics
[[nodiscard]] State state_at_eccentric_anomaly(const Conic& conic, const Orientation& orientation,
                                               const SineCosine& half, double mu);

/// The state at a hyperbolic anomaly H. @throws std::invalid_argument as above, and for other conics
[[nodiscard]] State state_at_hyperbolic_anomaly(const Conic& conic, const Orientation& orientation,
                                                double anomaly, double mu);

/// The state at a mean anomaly in radians, M = E - e sin E or e sinh H - H.
/// @throws std::invalid_argument as above, and for a parabola
[[nodiscard]] State state_at_mean_anomaly(const Conic& conic, const Orientation& orientation, double anomaly,
                                          double mu);

/// The state at a time since the periapsis, of either sign. @throws std::invalid_argument as above
[[nodiscard]] State state_at_time(const Conic& conic, const Orientation& orientation, double time, double mu);

}  // namespace nlmech::orbit

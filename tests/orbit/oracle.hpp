/// @file
/// References for the tests of orbits: Kepler's motion in 50 digits, and random orbits.
#pragma once

#include <cmath>
#include <limits>

#include "nlmech/support/extended_real.hpp"
#include "tests/orbit/conic.hpp"
#include "tests/random.hpp"

namespace nlmech::orbit::oracle {

/// 50 digits.
using Real = ExtendedReal<50>;

inline constexpr double eps = std::numeric_limits<double>::epsilon();
inline const double pi = std::acos(-1.0);

/// |a - b|/|b|, b in 50 digits.
[[nodiscard]] inline double relative_distance(const Vector3<double>& a, const Vector3<Real>& b) {
  const Vector3<Real> d = a.cast<Real>() - b;
  return static_cast<double>(Real(length(d) / length(b)));
}

/// conic() in 50 digits.
[[nodiscard]] inline BasicState<Real> kepler(const State& start, double time, double gravity) {
  return conic<Real>(start, time, gravity);
}

using tests::between;

/// A state with the given distance, speed over circular speed, and angle from the outward direction, in a
/// random plane.
[[nodiscard]] inline State random_state(double r, double mu, double speed, double flight) {
  const auto turn = [](double angle, int i, int j, Vector3<double>& v) {
    const double c = std::cos(angle), s = std::sin(angle), a = v[i], b = v[j];
    v[i] = c * a - s * b;
    v[j] = s * a + c * b;
  };
  const double v = speed * std::sqrt(mu / r);
  State s{{r, 0, 0}, {v * std::cos(flight), v * std::sin(flight), 0}};
  const double first = *between(-pi, pi), second = *between(-pi, pi), third = *between(-pi, pi);
  for (Vector3<double>* u : {&s.position, &s.velocity}) {
    turn(first, 0, 1, *u);
    turn(second, 1, 2, *u);
    turn(third, 0, 1, *u);
  }
  return s;
}

/// The low and the eccentric orbit of the dissertation, Eqs 3.71 and 3.73.
inline const State low_orbit{{1.702547136867679e6, 6.353992417071098e6, 0},
                             {-7.886014053829254e3, 2.113051097224035e3, 0}};
inline const State eccentric_orbit{{2.096434265330419e6, 7.823999192941453e6, 0},
                                   {-8.834757074967362e3, 2.367266023562654e3, 0}};
inline constexpr double earth_mu = 3.986004418e14;

/// At the periapsis of an ellipse with a = 1, mu = 1.
[[nodiscard]] inline State at_periapsis(double e) {
  return {{1 - e, 0, 0}, {0, std::sqrt((1 + e) / (1 - e)), 0}};
}

}  // namespace nlmech::orbit::oracle

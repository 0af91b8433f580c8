/// @file
/// Position and velocity about a centre of attraction, and the integrals of Kepler motion.
#pragma once

#include <cmath>

#include "nlmech/program/vector.hpp"

namespace nlmech::orbit {

/// Three components in an inertial frame.
template <class T>
using Vector3 = Vector<T, 3>;

/// Position and velocity of a body, in any consistent units.
template <class T>
struct BasicState {
  Vector3<T> position;  ///< r, from the centre of attraction
  Vector3<T> velocity;  ///< dr/dt
};
/// In double precision.
using State = BasicState<double>;

/// Energy per unit mass, E = v.v/2 - mu/r (Elgohary 2015, Eq. 3.70). Rounding error at most 4 eps (v.v/2 +
/// mu/r).
template <class T>
[[nodiscard]] T energy(const BasicState<T>& s, const T& mu) {
  using std::sqrt;
  return s.velocity.dot(s.velocity) / 2 - mu / sqrt(s.position.dot(s.position));
}

/// a x b.
template <class T>
[[nodiscard]] Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// a b - c d with one rounding of the difference (W. Kahan's scheme of two fused multiply-adds): relative
/// error at most 2 eps, however nearly the products cancel.
[[nodiscard]] inline double difference_of_products(double a, double b, double c, double d) {
  const double cd = c * d, rounding = std::fma(-c, d, cd);
  return std::fma(a, b, -cd) + rounding;
}

/// a x b with relative errors of at most 2 eps per component: normal to both even if they are nearly
/// parallel.
[[nodiscard]] inline Vector3<double> accurate_cross(const Vector3<double>& a, const Vector3<double>& b) {
  return {difference_of_products(a[1], b[2], a[2], b[1]), difference_of_products(a[2], b[0], a[0], b[2]),
          difference_of_products(a[0], b[1], a[1], b[0])};
}

/// Angular momentum per unit mass, h = r x v.
template <class T>
[[nodiscard]] Vector3<T> angular_momentum(const BasicState<T>& s) {
  return cross(s.position, s.velocity);
}

/// Eccentricity vector (Laplace vector over mu), e = v x h/mu - r/|r|: points to the periapsis, its norm is
/// the eccentricity. Rounding error at most 8 eps (1 + r v.v/mu).
template <class T>
[[nodiscard]] Vector3<T> eccentricity_vector(const BasicState<T>& s, const T& mu) {
  using std::sqrt;
  // Expanded by v x (r x v) = r v.v - v r.v, which has one cancellation less.
  const T r = sqrt(s.position.dot(s.position)), vv = s.velocity.dot(s.velocity);
  const T along = s.position.dot(s.velocity);
  return (vv / mu - 1 / r) * s.position - (along / mu) * s.velocity;
}

/// 1/a = 2/r - v.v/mu: positive for ellipses, 0 for parabolas, negative for hyperbolas.
template <class T>
[[nodiscard]] T reciprocal_axis(const BasicState<T>& s, const T& mu) {
  using std::sqrt;
  return 2 / sqrt(s.position.dot(s.position)) - s.velocity.dot(s.velocity) / mu;
}

}  // namespace nlmech::orbit

/// @file
/// Gravity of a point mass or of a body with zonal harmonics: energy and acceleration.
#pragma once

#include <array>
#include <cmath>

#include "nlmech/orbit/state.hpp"

namespace nlmech::orbit {

/// The potential (mu/r) (1 - sum_{k=2}^{6} J_k (R/r)^k P_k(z/r)), z along the axis of symmetry.
template <class T>
struct BasicGravity {
  static constexpr int least_degree = 2;  ///< k of zonal[0]
  static constexpr int most_degree = 6;   ///< k of the last one
  T mu = T(1);                            ///< gravitational parameter, positive
  T radius = T(1);                        ///< R, positive; unused without zonal terms
  std::array<T, 5> zonal = {};            ///< J_2 to J_6; zeros: a point mass

  /// The largest k with J_k other than 0; 0 for a point mass.
  [[nodiscard]] int degree() const {
    for (int k = most_degree; k >= least_degree; --k) {
      if (zonal[static_cast<std::size_t>(k - least_degree)] != T(0)) return k;
    }
    return 0;
  }
  /// The same field in another number type.
  template <class S>
  [[nodiscard]] BasicGravity<S> as() const {
    BasicGravity<S> g;
    g.mu = S(mu);
    g.radius = S(radius);
    for (std::size_t i = 0; i < zonal.size(); ++i) g.zonal[i] = S(zonal[i]);
    return g;
  }
};
/// In double precision.
using Gravity = BasicGravity<double>;

/// The Earth in metres and seconds: mu = 3.986004418e14 and R = 6378137 of WGS 84, J_2 = 1.08262668e-3 and
/// the J_3 to J_6 of the zonal studies of this suite. @param degree from 2 to 6: higher terms are left out; 0
/// or 1: the point mass. @throws std::invalid_argument for another degree
[[nodiscard]] Gravity earth(int degree = 0);

/// @throws std::invalid_argument with the name and value of an invalid mu, radius or J
void check(const Gravity& gravity);

/// @throws std::invalid_argument if a component is not finite or the position is 0. @param who start of the
/// message
void check(const State& state, const char* who);

/// Energy per unit mass in the field: v.v/2 minus the potential; constant along the motion.
template <class T>
[[nodiscard]] T energy(const BasicState<T>& s, const BasicGravity<T>& gravity) {
  using std::sqrt;
  const T r = sqrt(s.position.dot(s.position)), sine = s.position[2] / r, ratio = gravity.radius / r;
  T potential = 1, power = ratio, below = 1, p = sine;  // P_{k-1} and P_k from k = 1
  for (int k = 2; k <= BasicGravity<T>::most_degree; ++k) {
    const T next = ((2 * k - 1) * sine * p - (k - 1) * below) / k;
    below = p;
    p = next;
    power *= ratio;
    potential -= gravity.zonal[static_cast<std::size_t>(k - 2)] * power * p;
  }
  return s.velocity.dot(s.velocity) / 2 - gravity.mu / r * potential;
}

/// r'' at @p r: mu q^3 [(-1 + sum_k J_k A_k) r - z^ R sum_k J_k A_{k-1}] with q = 1/|r|, s = z q, u = R q and
/// A_k = u^k P'_{k+1}(s), for which k A_k = (2k + 1) u s A_{k-1} - (k + 1) u^2 A_{k-2}: the formula that
/// Expansion differentiates, with the fewest products. With T = Dual<double, 3> also its gradient. For a
/// point mass the zonal terms are skipped.
/// @param r not 0; not checked
template <class T>
[[nodiscard]] Vector3<T> acceleration(const Vector3<T>& r, const Gravity& gravity) {
  using std::sqrt;
  const T q = 1 / sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]), q2 = q * q, q3 = q2 * q;
  const int degree = gravity.degree();
  if (degree == 0) {
    const T m = -gravity.mu * q3;
    return {m * r[0], m * r[1], m * r[2]};
  }
  const double square = gravity.radius * gravity.radius;
  const T us = gravity.radius * (r[2] * q2), u2 = square * q2;
  T below = 3 * us, a = 1.5 * (5 * (us * us) - u2);  // A_1 and A_2
  T radial = gravity.zonal[0] * a - 1, axial = gravity.zonal[0] * below;
  for (int k = 3; k <= degree; ++k) {
    const T above = ((2 * k + 1) * (us * a) - (k + 1) * (u2 * below)) / k;
    below = a;
    a = above;
    const double j = gravity.zonal[static_cast<std::size_t>(k - 2)];
    radial = radial + j * a;
    axial = axial + j * below;
  }
  const T m = gravity.mu * (q3 * radial);
  return {m * r[0], m * r[1], m * r[2] - gravity.mu * gravity.radius * (q3 * axial)};
}

}  // namespace nlmech::orbit

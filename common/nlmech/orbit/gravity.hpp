/// @file
/// The attraction of a point mass or of a body with zonal harmonics.
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
  T radius = T(1);                        ///< R, positive; of no meaning without zonal terms
  std::array<T, 5> zonal = {};            ///< J_2 to J_6; zeros: a point mass

  /// The largest k with J_k other than 0; 0 for a point mass.
  [[nodiscard]] int degree() const {
    for (int k = most_degree; k >= least_degree; --k) {
      if (zonal[static_cast<std::size_t>(k - least_degree)] != T(0)) return k;
    }
    return 0;
  }
  /// The same in another type of number.
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

/// @throws std::invalid_argument naming mu, the radius or a J that cannot be meant
void check(const Gravity& gravity);

/// @throws std::invalid_argument if a component is not finite or the position is 0; @p who begins the text
void check(const State& state, const char* who);

/// Energy a unit mass in the field: v.v/2 less the potential. Kept by the motion.
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

}  // namespace nlmech::orbit

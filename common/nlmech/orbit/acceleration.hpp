/// @file
/// The acceleration in a zonal field at one place, for any type of number.
#pragma once

#include <cmath>

#include "nlmech/orbit/gravity.hpp"

namespace nlmech::orbit {

/// r'' at @p r, by the formula that Expansion differentiates: mu [(-q^3 + q sum_k J_k w_k P'_{k+1}(s)) r - z^
/// sum_k J_k w_k P'_k(s)] with q = 1/|r|, s = z q, w_k = R^k q^(k+2). With T = Dual<double, 3> also its
/// gradient. A point mass costs no more than that.
/// @param r not 0; not checked
template <class T>
[[nodiscard]] Vector3<T> acceleration(const Vector3<T>& r, const Gravity& gravity) {
  using std::sqrt;
  const T q = 1 / sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
  T radial = -(q * q * q), axial = T(0);
  const int degree = gravity.degree();
  if (degree > 0) {
    const T s = r[2] * q;
    T below = T(1), slope = 3 * s, w = q * q * q * gravity.radius;  // P'_{k-1}, P'_k and w_{k-1} at k = 2
    for (int k = 2; k <= degree; ++k) {
      const T above = ((2 * k + 1) * s * slope - (k + 1) * below) / k;  // P'_{k+1}
      w = w * q * gravity.radius;
      const double j = gravity.zonal[static_cast<std::size_t>(k - 2)];
      radial = radial + j * w * q * above;
      axial = axial + j * w * slope;
      below = slope;
      slope = above;
    }
  }
  const T m = gravity.mu * radial;
  return {m * r[0], m * r[1], m * r[2] - gravity.mu * axial};
}

}  // namespace nlmech::orbit

/// @file
/// The acceleration in a zonal field at one place, for any type of number.
#pragma once

#include <cmath>

#include "nlmech/orbit/gravity.hpp"

namespace nlmech::orbit {

/// r'' at @p r: mu q^3 [(-1 + sum_k J_k A_k) r - z^ R sum_k J_k A_{k-1}] with q = 1/|r|, s = z q, u = R q and
/// A_k = u^k P'_{k+1}(s), for which k A_k = (2k + 1) u s A_{k-1} - (k + 1) u^2 A_{k-2}: the formula that
/// Expansion differentiates, in the fewest products. With T = Dual<double, 3> also its gradient. A point mass
/// costs no more than that.
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

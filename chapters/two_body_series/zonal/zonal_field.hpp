/// @file
/// The attraction of a body with zonal harmonics as an equation for integrators in general.
#pragma once

#include <cmath>

#include "nlmech/orbit/gravity.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::chapters::two_body_series {

/// q'' = mu [(-q^3 + q sum_k J_k w_k P'_{k+1}(s)) r - z^ sum_k J_k w_k P'_k(s)] with q = 1/|r|, s = z q and
/// w_k = R^k q^(k+2), see orbit::Expansion. State (x1, x2, x3, v1, v2, v3).
struct ZonalField {
  static constexpr int dimension = 6;  ///< three positions, then three velocities
  orbit::Gravity gravity;              ///< of the centre

  /// The acceleration at @p r.
  template <class T>
  void acceleration(const T& /*t*/, const Vector<T, 3>& r, const Vector<T, 3>& /*v*/, Vector<T, 3>& a) const {
    using std::sqrt;
    const T q = 1 / sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]), s = r[2] * q;
    T radial = -(q * q * q), axial = 0 * q;
    // P'_1 = 1, P'_2 = 3 s; k P'_{k+1} = (2 k + 1) s P'_k - (k + 1) P'_{k-1}.
    T below = 1 + 0 * q, slope = 3 * s, w = q * q * q * gravity.radius;  // P'_{k-1}, P'_k and w_{k-1}
    for (int k = 2; k <= gravity.degree(); ++k) {
      const T above = ((2 * k + 1) * s * slope - (k + 1) * below) / k;  // P'_{k+1}
      w = w * q * gravity.radius;
      const double j = gravity.zonal[static_cast<std::size_t>(k - 2)];
      radial = radial + j * w * q * above;
      axial = axial + j * w * slope;
      below = slope;
      slope = above;
    }
    for (int i = 0; i < 3; ++i) a[i] = gravity.mu * radial * r[i];
    a[2] = a[2] - gravity.mu * axial;
  }
  /// The equation of first order.
  template <class T>
  void operator()(const T& t, const Vector<T, 6>& x, Vector<T, 6>& dxdt) const {
    problems::first_order_form(*this, t, x, dxdt);
  }
};

}  // namespace nlmech::chapters::two_body_series

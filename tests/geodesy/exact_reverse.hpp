/// @file
/// Reference for the tests and benchmarks: Cartesian to geodetic coordinates to 50 digits.
#pragma once

#include <utility>

#include "nlmech/geodesy/ellipsoid.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::geodesy::reference {

using Real = ExtendedReal<50>;

/// Root w = tan(beta/2) in [0, 1] of the condition that the point of eccentric angle beta is the foot of a
/// normal,
///   2 w (1 + w^2) P - (1 - w^4) Q - 2 w (1 - w^2) gap = 0,
/// which has exactly one for P, Q > 0 (the closest point lies in the quadrant of the given point, the feet of
/// all other normals in other quadrants). Newton's method, kept inside a bracket that every evaluation
/// narrows. Another unknown and another equation than any method under test uses.
inline Real half_angle_tangent(const Real& P, const Real& Q, const Real& gap) {
  Real low = 0, high = 1, w = sqrt(Q / (P + Q));
  for (int n = 0; n < 400; ++n) {
    const Real w2 = w * w;
    const Real value = 2 * w * ((1 + w2) * P - (1 - w2) * gap) - (1 - w2 * w2) * Q;
    (value > 0 ? high : low) = w;
    const Real slope = 2 * ((1 + 3 * w2) * P - (1 - 3 * w2) * gap) + 4 * w * w2 * Q;
    Real next = slope == 0 ? low : Real(w - value / slope);
    if (!(next > low && next < high)) next = (low + high) / 2;
    const Real step = abs(next - w);
    w = next;
    if (step <= 1e-45 * w) break;
  }
  return w;
}

/// Longitude with the sign of y and latitude with the sign of z are left to the caller where these are zero.
inline BasicGeodetic<Real> reverse(const BasicCartesian<Real>& point, const BasicEllipsoid<Real>& ellipsoid) {
  const Real a = ellipsoid.a(), f = ellipsoid.f(), b = a * (1 - f);
  const Real x = point.x, y = point.y, z = fabs(Real(point.z)), r = sqrt(x * x + y * y);
  const bool oblate = f >= 0;
  const Real gap = fabs(f * (2 - f)) * a * a;  // |a^2 - b^2|
  const Real P = oblate ? a * r : b * z, Q = oblate ? b * z : a * r;

  Real along_major, along_minor;
  if (Q == 0) {
    along_major = P < gap ? Real(P / gap) : Real(1);
    along_minor = sqrt(1 - along_major * along_major);
  } else {
    const Real w = half_angle_tangent(P, Q, gap);
    along_major = (1 - w * w) / (1 + w * w);
    along_minor = 2 * w / (1 + w * w);
  }
  const Real cos_beta = oblate ? along_major : along_minor, sin_beta = oblate ? along_minor : along_major;
  const Real n_r = b * cos_beta, n_z = a * sin_beta;
  const Real height = ((r - a * cos_beta) * n_r + (z - b * sin_beta) * n_z) / sqrt(n_r * n_r + n_z * n_z);
  const Real latitude = atan2(n_z, n_r);
  return {point.z < 0 ? Real(-latitude) : latitude, atan2(y, x), height};
}

/// The same for a point and an ellipsoid in double, whose values are taken as exact.
inline BasicGeodetic<Real> reverse(const Cartesian& p, const Ellipsoid& e) {
  return reverse(BasicCartesian<Real>{Real(p.x), Real(p.y), Real(p.z)},
                 BasicEllipsoid<Real>(Real(e.a()), Real(e.f())));
}

}  // namespace nlmech::geodesy::reference

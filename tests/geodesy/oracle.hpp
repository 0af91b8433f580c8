/// @file
/// The reverse transformation in 50 digits, by a method that shares nothing with the library's.
///
/// The foot of the perpendicular from (r, z) is (a^2 r/(a^2 + t), b^2 z/(b^2 + t)) where t is the largest
/// root of
///     g(t) = (a r/(a^2 + t))^2 + (b z/(b^2 + t))^2 - 1.
/// g falls and is convex to the right of its poles, so Newton's iteration from a point with g >= 0 climbs to
/// the root without ever passing it.
#pragma once

#include "nlmech/geodesy/ellipsoid.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::geodesy::oracle {

namespace mp = boost::multiprecision;
using Real = ExtendedReal<50>;

inline Real pi() { return 4 * atan(Real(1)); }

/// Exact up to some 45 digits for every point with r > 0 or |z| beyond the evolute's cusp.
inline BasicGeodetic<Real> reverse(const BasicCartesian<Real>& p, const BasicEllipsoid<Real>& e) {
  const Real a = e.a(), b = e.b(), r = sqrt(p.x * p.x + p.y * p.y), z = p.z;
  Real t = std::max(Real(-a * a + a * r), Real(-b * b + b * abs(z)));
  for (int i = 0; i < 500; ++i) {
    const Real u = a * r / (a * a + t), v = b * z / (b * b + t);
    const Real g = u * u + v * v - 1, slope = -2 * (u * u / (a * a + t) + v * v / (b * b + t));
    const Real step = -g / slope;
    t += step;
    if (abs(step) <= Real(1e-46) * (a * a + abs(t))) break;
  }
  const Real normal_r = r / (a * a + t),
             normal_z = z / (b * b + t);  // foot over squared half axes: along the normal
  return {atan2(normal_z, normal_r), atan2(p.y, p.x), t * sqrt(normal_r * normal_r + normal_z * normal_z)};
}

/// The same for a point and an ellipsoid given in doubles, whose values are taken as exact.
inline BasicGeodetic<Real> reverse(const Cartesian& p, const Ellipsoid& e) {
  return reverse(BasicCartesian<Real>{Real(p.x), Real(p.y), Real(p.z)},
                 BasicEllipsoid<Real>(Real(e.a()), Real(e.f())));
}

}  // namespace nlmech::geodesy::oracle

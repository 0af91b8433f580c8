/// @file
/// Published methods for the reverse geodetic transformation, each as in its paper, for comparison with
/// nlmech methods.
///
/// All are function objects of an ellipsoid that convert a Cartesian point to latitude, longitude and height.
/// They are valid for oblate ellipsoids outside the region around the centre that each paper excludes.
/// Heights of the iterative methods use Bowring's projection (1985), the most accurate of the formulas in
/// use.
#pragma once

#include <cmath>
#include <numbers>

#include "nlmech/geodesy/ellipsoid.hpp"

namespace nlmech::peers::geodesy {

using nlmech::geodesy::Cartesian;
using nlmech::geodesy::Ellipsoid;
using nlmech::geodesy::Geodetic;

/// Constants of the ellipsoid for all methods.
struct EllipsoidConstants {
  /// Computes all constants.
  explicit EllipsoidConstants(const Ellipsoid& e)
      : a(e.a()), b(e.b()), e2(e.e2()), e4(e2 * e2), one_minus_e2(1 - e2), second_e2(e2 / (1 - e2)) {}
  double a;             ///< equatorial radius, m
  double b;             ///< polar radius, m
  double e2;            ///< squared eccentricity
  double e4;            ///< its square
  double one_minus_e2;  ///< b^2/a^2
  double second_e2;     ///< second eccentricity squared, e2/(1 - e2)
};

/// Position from S : C = sin phi : cos phi, phi in the first quadrant.
/// h = r cos phi + |z| sin phi - a sqrt(1 - e^2 sin^2 phi) (Bowring 1985).
inline Geodetic position(double S, double C, double r, const Cartesian& p, const EllipsoidConstants& k) {
  const double H2 = C * C + S * S, inverse = 1 / std::sqrt(H2);
  const double height = (r * C + std::abs(p.z) * S - k.a * std::sqrt(H2 - k.e2 * S * S)) * inverse;
  return {std::copysign(std::atan2(S, C), p.z), std::atan2(p.y, p.x), height};
}

/// Bowring's iteration for the latitude, as sines and cosines up to a common factor:
/// tan phi = (z + e'^2 b sin^3 beta)/(r - e^2 a cos^3 beta), tan beta = (b/a) tan phi.
template <int iterations>
Geodetic bowring(double sin_beta, double cos_beta, double r, const Cartesian& p,
                 const EllipsoidConstants& k) {
  double S = 0, C = 0;
  for (int n = 0; n < iterations; ++n) {
    const double inverse = 1 / std::sqrt(sin_beta * sin_beta + cos_beta * cos_beta);
    const double s = sin_beta * inverse, c = cos_beta * inverse;
    S = std::abs(p.z) + k.second_e2 * k.b * s * s * s;
    C = r - k.e2 * k.a * c * c * c;
    sin_beta = k.b * S;
    cos_beta = k.a * C;
  }
  return position(S, C, r, p, k);
}

/// B. R. Bowring, Transformation from spatial to geographical coordinates, Survey Review 23 (1976) 323-327.
template <int iterations>
class Bowring1976 {
 public:
  /// Computes the constants of the ellipsoid.
  explicit Bowring1976(const Ellipsoid& e) : k_(e) {}
  /// The position in radians and metres.
  Geodetic operator()(const Cartesian& p) const {
    const double r = std::sqrt(p.x * p.x + p.y * p.y);
    return bowring<iterations>(k_.a * std::abs(p.z), k_.b * r, r, p, k_);
  }

 private:
  EllipsoidConstants k_;
};

/// B. R. Bowring, The accuracy of geodetic latitude and height equations, Survey Review 28 (1985) 202-206: as
/// 1976, but for the start tan beta = b z/(a r) (1 + e'^2 b/R).
template <int iterations>
class Bowring1985 {
 public:
  /// Computes the constants of the ellipsoid.
  explicit Bowring1985(const Ellipsoid& e) : k_(e) {}
  /// The position in radians and metres.
  Geodetic operator()(const Cartesian& p) const {
    const double r2 = p.x * p.x + p.y * p.y, r = std::sqrt(r2), R = std::sqrt(r2 + p.z * p.z);
    return bowring<iterations>(k_.b * std::abs(p.z) * (R + k_.second_e2 * k_.b), k_.a * r * R, r, p, k_);
  }

 private:
  EllipsoidConstants k_;
};

/// T. Fukushima, Transformation from Cartesian to geodetic coordinates accelerated by Halley's method,
/// Journal of Geodesy 79 (2006) 689-693. The axis is a special case, because S and C vanish together there.
template <int iterations>
class Fukushima2006 {
 public:
  /// Computes the constants of the ellipsoid.
  explicit Fukushima2006(const Ellipsoid& e) : k_(e), b_over_a_(std::sqrt(k_.one_minus_e2)) {}
  /// The position in radians and metres.
  Geodetic operator()(const Cartesian& p) const {
    const double r = std::sqrt(p.x * p.x + p.y * p.y);
    if (r < 1e-16 * std::abs(p.z)) {
      return {std::copysign(std::numbers::pi / 2, p.z), std::atan2(p.y, p.x), std::abs(p.z) - k_.b};
    }
    const double P = r / k_.a, Z = b_over_a_ * std::abs(p.z) / k_.a, E = k_.e2;
    double S = Z, C = b_over_a_ * P;
    for (int n = 0; n < iterations; ++n) {
      const double A2 = S * S + C * C, A = std::sqrt(A2), A3 = A2 * A;
      const double B = 1.5 * E * S * C * C * ((P * S - Z * C) * A - E * S * C);
      const double D = Z * A3 + E * S * S * S, F = P * A3 - E * C * C * C;
      S = D * F - B * S;
      C = F * F - B * C;
    }
    return position(S, b_over_a_ * C, r, p, k_);
  }

 private:
  EllipsoidConstants k_;
  double b_over_a_;
};

/// H. Vermeille, Direct transformation from geocentric coordinates to geodetic coordinates, Journal of
/// Geodesy 76 (2002) 451-454. Outside the evolute only.
class Vermeille2002 {
 public:
  /// Computes the constants of the ellipsoid.
  explicit Vermeille2002(const Ellipsoid& e) : k_(e) {}
  /// The position in radians and metres.
  Geodetic operator()(const Cartesian& c) const {
    const double xy2 = c.x * c.x + c.y * c.y, xy = std::sqrt(xy2), z2 = c.z * c.z, a2 = k_.a * k_.a;
    const double p = xy2 / a2, q = k_.one_minus_e2 * z2 / a2, r = (p + q - k_.e4) / 6;
    const double s = k_.e4 * p * q / (4 * r * r * r);
    const double t = std::cbrt(1 + s + std::sqrt(s * (2 + s)));
    const double u = r * (1 + t + 1 / t), v = std::sqrt(u * u + k_.e4 * q);
    const double w = k_.e2 * (u + v - q) / (2 * v), k = std::sqrt(u + v + w * w) - w;
    const double D = k * xy / (k + k_.e2), DZ = std::sqrt(D * D + z2);
    return {2 * std::atan2(c.z, D + DZ), std::atan2(c.y, c.x), (k + k_.e2 - 1) / k * DZ};
  }

 private:
  EllipsoidConstants k_;
};

/// H. Vermeille, An analytical method to transform geocentric into geodetic coordinates, Journal of Geodesy
/// 85 (2011) 105-117. Everywhere, the inside of the evolute and the disc included.
class Vermeille2011 {
 public:
  /// Computes the constants of the ellipsoid.
  explicit Vermeille2011(const Ellipsoid& e) : k_(e) {}
  /// The position in radians and metres.
  Geodetic operator()(const Cartesian& c) const {
    const double xy2 = c.x * c.x + c.y * c.y, z2 = c.z * c.z, a2 = k_.a * k_.a;
    const double p = xy2 / a2, q = k_.one_minus_e2 * z2 / a2, r = (p + q - k_.e4) / 6;
    const double e4pq = k_.e4 * p * q, evolute = 8 * r * r * r + e4pq;
    double u = 0;
    if (evolute > 0) {
      const double root = std::cbrt(std::sqrt(evolute) + std::sqrt(e4pq)), l = root * root;
      u = r + l / 2 + 2 * r * r / l;
    } else if (q != 0) {
      const double t = 2. / 3 * std::atan2(std::sqrt(e4pq), std::sqrt(-evolute) + std::sqrt(-8 * r * r * r));
      u = -4 * r * std::sin(t) * std::cos(std::numbers::pi / 6 + t);
    } else {
      return disc(p, c);
    }
    const double v = std::sqrt(u * u + k_.e4 * q), w = k_.e2 * (u + v - q) / (2 * v);
    const double k = (u + v) / (std::sqrt(w * w + u + v) + w);
    const double D = k * std::sqrt(xy2) / (k + k_.e2), DZ = std::sqrt(D * D + z2);
    return {2 * std::atan2(c.z, D + DZ), std::atan2(c.y, c.x), (k + k_.e2 - 1) * DZ / k};
  }

 private:
  Geodetic disc(double p, const Cartesian& c) const {
    const double e = std::sqrt(k_.e2), inside = std::sqrt(k_.e2 - p), axes = std::sqrt(k_.one_minus_e2);
    return {2 * std::atan2(std::sqrt(k_.e4 - p), e * inside + axes * std::sqrt(p)), std::atan2(c.y, c.x),
            -k_.a * axes * inside / e};
  }
  EllipsoidConstants k_;
};

/// D. K. Olson, Converting Earth-centered, Earth-fixed coordinates to geodetic coordinates, IEEE Transactions
/// on Aerospace and Electronic Systems 32 (1996) 473-476. At least 100 km from the centre.
class Olson1996 {
 public:
  /// Computes the constants of the ellipsoid.
  explicit Olson1996(const Ellipsoid& e)
      : k_(e), a1_(k_.a * k_.e2), a2_(a1_ * a1_), a3_(a1_ * k_.e2 / 2), a4_(2.5 * a2_), a5_(a1_ + a3_) {}
  /// The position in radians and metres.
  Geodetic operator()(const Cartesian& p) const {
    const double zp = std::abs(p.z), w2 = p.x * p.x + p.y * p.y, w = std::sqrt(w2), z2 = p.z * p.z;
    const double r2 = w2 + z2, r = std::sqrt(r2), s2 = z2 / r2, c2 = w2 / r2;
    const double near_u = a2_ / r, near_v = a3_ - a4_ / r;
    double s = 0, c = 0, ss = 0, latitude = 0;
    if (c2 > 0.3) {
      s = zp / r * (1 + c2 * (a1_ + near_u + s2 * near_v) / r);
      latitude = std::asin(s);
      ss = s * s;
      c = std::sqrt(1 - ss);
    } else {
      c = w / r * (1 - s2 * (a5_ - near_u - c2 * near_v) / r);
      latitude = std::acos(c);
      ss = 1 - c * c;
      s = std::sqrt(ss);
    }
    const double g = 1 - k_.e2 * ss, rg = k_.a / std::sqrt(g), rf = k_.one_minus_e2 * rg;
    const double u = w - rg * c, v = zp - rf * s, f = c * u + s * v, m = c * v - s * u,
                 correction = m / (rf / g + f);
    return {std::copysign(latitude + correction, p.z), std::atan2(p.y, p.x), f + m * correction / 2};
  }

 private:
  EllipsoidConstants k_;
  double a1_, a2_, a3_, a4_, a5_;
};

/// M. Heikkinen, Geschlossene Formeln zur Berechnung raeumlicher geodaetischer Koordinaten aus rechtwinkligen
/// Koordinaten, Zeitschrift fuer Vermessungswesen 107 (1982) 207-211; as in J. Zhu, IEEE Transactions on
/// Aerospace and Electronic Systems 30 (1994) 957-961. Outside the evolute only.
class Heikkinen1982 {
 public:
  /// Computes the constants of the ellipsoid.
  explicit Heikkinen1982(const Ellipsoid& e) : k_(e) {}
  /// The position in radians and metres.
  Geodetic operator()(const Cartesian& p) const {
    const double a2 = k_.a * k_.a, b2 = k_.b * k_.b, r2 = p.x * p.x + p.y * p.y, r = std::sqrt(r2),
                 z2 = p.z * p.z;
    const double F = 54 * b2 * z2, G = r2 + k_.one_minus_e2 * z2 - k_.e2 * (a2 - b2);
    const double c = k_.e4 * F * r2 / (G * G * G), s = std::cbrt(1 + c + std::sqrt(c * c + 2 * c));
    const double t = s + 1 / s + 1, P = F / (3 * t * t * G * G), Q = std::sqrt(1 + 2 * k_.e4 * P);
    const double r0 = -P * k_.e2 * r / (1 + Q) +
                      std::sqrt(a2 / 2 * (1 + 1 / Q) - P * k_.one_minus_e2 * z2 / (Q * (1 + Q)) - P * r2 / 2);
    const double d = r - k_.e2 * r0, d2 = d * d, U = std::sqrt(d2 + z2),
                 V = std::sqrt(d2 + k_.one_minus_e2 * z2);
    const double ratio = b2 / (k_.a * V);
    return {std::atan2(p.z + k_.second_e2 * ratio * p.z, r), std::atan2(p.y, p.x), U * (1 - ratio)};
  }

 private:
  EllipsoidConstants k_;
};

/// K.-C. Lin, J. Wang, Transformation from geocentric to geodetic coordinates using Newton's iteration,
/// Bulletin Geodesique 69 (1995) 300-303.
template <int iterations>
class LinWang1995 {
 public:
  /// Computes the constants of the ellipsoid.
  explicit LinWang1995(const Ellipsoid& e) : k_(e) {}
  /// The position in radians and metres.
  Geodetic operator()(const Cartesian& c) const {
    const double a = k_.a, b = k_.b, a2 = a * a, b2 = b * b;
    const double p2 = c.x * c.x + c.y * c.y, z2 = c.z * c.z, p = std::sqrt(p2), z = std::abs(c.z);
    const double A = a2 * z2 + b2 * p2;
    double m = (a * b * A * std::sqrt(A) - a2 * b2 * A) / (2 * (a2 * a2 * z2 + b2 * b2 * p2));
    for (int n = 0; n < iterations; ++n) {
      const double da = a + 2 * m / a, db = b + 2 * m / b, ta = p2 / (da * da), tb = z2 / (db * db);
      m += (ta + tb - 1) / (4 * (ta / (a * da) + tb / (b * db)));
    }
    const double pe = p / (1 + 2 * m / a2), ze = z / (1 + 2 * m / b2);
    const double distance = std::sqrt((p - pe) * (p - pe) + (z - ze) * (z - ze));
    return {std::copysign(std::atan2(a2 * ze, b2 * pe), c.z), std::atan2(c.y, c.x),
            p + z < pe + ze ? -distance : distance};
  }

 private:
  EllipsoidConstants k_;
};

}  // namespace nlmech::peers::geodesy

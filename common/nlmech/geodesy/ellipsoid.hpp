/// @file
/// Ellipsoid of revolution, and Cartesian and geodetic positions.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

namespace nlmech::geodesy {

/// Earth-centred Cartesian position; the z axis is the axis of revolution. Metres.
template <class T>
struct BasicCartesian {
  T x{};  ///< towards longitude 0 on the equator, m
  T y{};  ///< towards longitude 90 deg east on the equator, m
  T z{};  ///< towards the north pole, m
};

/// Geodetic position: latitude and longitude in radians, height along the ellipsoid's normal in metres.
template <class T>
struct BasicGeodetic {
  T latitude{};   ///< angle of the normal with the equator, north positive, rad
  T longitude{};  ///< east positive, rad
  T height{};     ///< above the ellipsoid, m
};

/// Ellipsoid of revolution with equatorial radius a and flattening f = (a - b)/a: oblate (f > 0), sphere (f =
/// 0) or prolate (f < 0). Any real type, such as extended precision for references.
template <class T>
class BasicEllipsoid {
 public:
  /// @param a equatorial radius in metres, positive and finite
  /// @param f flattening, below 1 and finite
  /// @throws std::invalid_argument naming the value, if either is out of range
  BasicEllipsoid(T a, T f) : a_(a), f_(f) {
    using std::isfinite;
    if (!(a > 0) || !isfinite(a))
      throw std::invalid_argument(range_error("equatorial radius", a, "positive"));
    if (!(f < 1) || !isfinite(f)) throw std::invalid_argument(range_error("flattening", f, "below 1"));
  }

  /// World Geodetic System 1984: a = 6378137 m, 1/f = 298.257223563.
  static BasicEllipsoid wgs84() { return {T(6378137), T(1000000000) / T(298257223563LL)}; }

  [[nodiscard]] T a() const { return a_; }              ///< equatorial radius (semi-major axis if oblate), m
  [[nodiscard]] T f() const { return f_; }              ///< flattening (a - b)/a
  [[nodiscard]] T b() const { return a_ * (1 - f_); }   ///< polar radius, m
  [[nodiscard]] T e2() const { return f_ * (2 - f_); }  ///< squared first eccentricity (a^2 - b^2)/a^2
  /// Small parameter of the dissertation's series, p = a/b - 1 = f/(1 - f) (Elgohary 2015, Eq. 2.45).
  [[nodiscard]] T p() const { return f_ / (1 - f_); }

 private:
  static std::string range_error(const char* what, const T& value, const char* range) {
    return std::string("Ellipsoid: ") + what + " must be finite and " + range + ", is " +
           std::to_string(static_cast<double>(value));
  }
  T a_, f_;
};

/// In double precision.
/// @{
using Cartesian = BasicCartesian<double>;
using Geodetic = BasicGeodetic<double>;
using Ellipsoid = BasicEllipsoid<double>;
/// @}

/// A named ellipsoid.
struct NamedEllipsoid {
  std::string_view name;          ///< in lower case, without blanks
  double a = 0;                   ///< equatorial radius, m
  double inverse_flattening = 0;  ///< 1/f; 0 for a sphere
};

/// Ellipsoids by name besides WGS84, as the EPSG registry defines them (codes 7043, 7019, 7022, 7024, 7004,
/// 7001, 7008, the last by its polar radius 6356583.8 m, and 7035).
inline constexpr std::array<NamedEllipsoid, 8> named_ellipsoids = {{
    {"wgs72", 6378135, 298.26},
    {"grs80", 6378137, 298.257222101},
    {"international1924", 6378388, 297},
    {"krassowsky1940", 6378245, 298.3},
    {"bessel1841", 6377397.155, 299.1528128},
    {"airy1830", 6377563.396, 299.3249646},
    {"clarke1866", 6378206.4, 6378206.4 / (6378206.4 - 6356583.8)},
    {"sphere", 6371000, 0},
}};

/// Geodetic to Cartesian coordinates (Elgohary 2015, Eq. 2.40), from sines and cosines. For |f| > 1/4 an
/// equivalent form avoids the difference 1 - e^2 sin^2, which cancels for f near 1, and squares of the
/// flattening, which overflow. Infinite only where the position is not representable.
/// @param sin_lat, cos_lat sine and cosine of the latitude @param sin_lon, cos_lon sine and cosine of the
/// longitude
template <class T>
[[nodiscard]] BasicCartesian<T> forward(const T& sin_lat, const T& cos_lat, const T& sin_lon,
                                        const T& cos_lon, const T& height, const BasicEllipsoid<T>& e) {
  using std::sqrt;
  if (e.f() > T(0.25) || e.f() < T(-0.25)) {
    // W^2 = cos^2 + (1-f)^2 sin^2, divided by the larger of 1 and (1-f)^2.
    const T ratio = 1 - e.f(), larger = ratio > 1 ? ratio : T(1);
    const T across = cos_lat / larger, along = sin_lat * (ratio / larger);
    const T W = sqrt(across * across + along * along);
    const T from_axis = e.a() * (across / W) + height * cos_lat;
    return {from_axis * cos_lon, from_axis * sin_lon, e.b() * (along / W) + height * sin_lat};
  }
  const T prime_vertical = e.a() / sqrt(1 - e.e2() * sin_lat * sin_lat);  // N(phi)
  const T from_axis = (prime_vertical + height) * cos_lat;
  return {from_axis * cos_lon, from_axis * sin_lon, (prime_vertical * (1 - e.e2()) + height) * sin_lat};
}

/// Geodetic to Cartesian coordinates from angles in radians. Valid for every latitude, longitude and height;
/// latitudes beyond +-pi/2 are not reduced.
template <class T>
[[nodiscard]] BasicCartesian<T> forward(const BasicGeodetic<T>& g, const BasicEllipsoid<T>& e) {
  using std::cos, std::sin;
  return forward<T>(sin(g.latitude), cos(g.latitude), sin(g.longitude), cos(g.longitude), g.height, e);
}

}  // namespace nlmech::geodesy

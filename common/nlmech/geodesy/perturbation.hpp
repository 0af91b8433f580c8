/// @file
/// Cartesian to geodetic coordinates by the dissertation's perturbation series (Elgohary 2015,
/// section 2.4.1).
///
/// The equatorial radius is written as a = b(1 + p). For p = 0 the ellipsoid is a sphere, whose latitude
/// phi_0 and height h_0 = R - b are known; parametric latitude and height are expanded about them in powers
/// of p (Eqs 2.47-2.52) and the geodetic latitude follows from the parametric one (Eq. 2.53). The method
/// needs no iteration and no branch.
///
/// Accuracy (largest error for WGS84, latitudes -90..90 deg, heights 200..35000 km; asserted by
/// tests/geodesy):
///
/// | order | latitude (deg) | height by the series (m) |
/// | ----: | -------------: | -----------------------: |
/// |     1 |         3.4e-4 |                       26 |
/// |     2 |         1.2e-6 |                     0.06 |
/// |     3 |         4.8e-9 |                   2.1e-4 |
/// |     4 |        2.5e-11 |                   8.0e-7 |
/// |     5 |        1.5e-13 |      2.3e-8 (rounding)   |
/// |     6 |        5.0e-14 |      2.3e-8 (rounding)   |
///
/// The series converges outside a sphere of about 59 km about the Earth's centre, slowly near it.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "nlmech/geodesy/ellipsoid.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::geodesy {

/// Highest tabulated order of the series.
inline constexpr int highest_order = 6;

/// Polynomial of one order: `coefficient[j][i]` multiplies cos(phi_0)^(2j) h_0^i b^(degree - i); the sum is
/// divided by `divisor`.
struct SeriesTerm {
  int degree = 0;   ///< total degree in b and h_0
  int divisor = 1;  ///< common denominator
  std::array<std::array<int, highest_order + 1>, highest_order>
      coefficient{};  ///< coefficients by powers [of cos^2][of h_0]
  /// Term by term.
  [[nodiscard]] bool operator==(const SeriesTerm&) const = default;
};

/// The terms of Eqs 2.49-2.52 and two further orders. With S = sin(2 phi_0), R = b + h_0 and the polynomials
/// P_k, Q_k of the table, phi_k = S P_k / R^k and, from the second order on, h_k = b S^2 Q_k / R^(k-1); h_1 =
/// -b cos(phi_0)^2.
struct SeriesTable {
  std::array<SeriesTerm, highest_order> latitude;  ///< P_1..P_6
  std::array<SeriesTerm, highest_order> height;    ///< Q_1 (unused), Q_2..Q_6
  /// Term by term.
  [[nodiscard]] bool operator==(const SeriesTable&) const = default;
};

/// The corrected table, equal to the result of derive_series() (checked by a test).
[[nodiscard]] const SeriesTable& corrected_series();

/// Computation of the height.
enum class HeightFrom {
  series,     ///< the series of Eq. 2.47, as in the dissertation
  projection  ///< projection of the point on the normal at the computed latitude; latitudes of order 2 give
              ///< full accuracy
};

/// Options of the perturbation series.
struct PerturbationSeries {
  int order = 4;                           ///< 1..6
  HeightFrom height = HeightFrom::series;  ///< computation of the height
};

/// Result of a reverse transformation, with a check.
template <class T>
struct BasicReversed {
  BasicGeodetic<T> position;           ///< NaN unless the outcome is success
  Outcome outcome = Outcome::success;  ///< success, non_finite or outside_validity
  /// Distance between the given point and the forward transform of the position, to rounding_of_miss. Deep
  /// inside the ellipsoid, near its centres of curvature, the latitude error may be large although the miss
  /// is small.
  T miss{};
};
/// In double precision.
using Reversed = BasicReversed<double>;

/// Largest miss relative to the distance from the centre; above it the outcome is `outside_validity`.
inline constexpr double largest_relative_miss = 0.01;

/// Rounding error of a miss, in eps times the longer semi-axis. The miss is a difference of numbers of that
/// size, each rounded about seven times by eps/2, in two coordinates: sqrt(2) 3.5 = 5. Within 800 eps of the
/// axis from the centre (1e-6 m for the Earth) the miss is meaningless.
inline constexpr double rounding_of_miss = 8;

/// Cartesian to geodetic coordinates. Latitude and longitude in radians, longitude in [-pi, pi]; the equator
/// gives the latitude z (so that a zero keeps its sign), the axis exactly +-pi/2. Outcomes: `success`;
/// `non_finite` for NaN or infinite input, `outside_validity` where the series has no correct digit (near the
/// centre, or for strong flattening), that is where the miss plus its rounding exceeds
/// `largest_relative_miss`. The position is NaN in both cases.
/// @param table coefficients; other tables are for comparisons with misprinted ones
/// @throws std::invalid_argument if the order is not 1..6
template <class T>
[[nodiscard]] BasicReversed<T> reverse(const BasicCartesian<T>& point, const BasicEllipsoid<T>& ellipsoid,
                                       const PerturbationSeries& method,
                                       const SeriesTable& table = corrected_series());

namespace detail {

/// Throws std::invalid_argument unless 1 <= order <= highest_order.
void require_order(int order);

/// sqrt(x^2 + y^2); for built-in types without overflow.
template <class T>
T length(const T& x, const T& y) {
  using std::sqrt;
  if constexpr (std::is_floating_point_v<T>)
    return std::hypot(x, y);
  else
    return sqrt(x * x + y * y);
}

/// The polynomial of a term over R^degree, written in b/R and h_0/R so that nothing overflows far from the
/// Earth. Each inner sum is homogeneous: Horner's scheme in h_0/R, with powers of b/R for the remaining
/// degree.
template <class T>
T evaluate(const SeriesTerm& term, const T& b_R, const T& h0_R, const T& cos2) {
  T outer{0};
  for (std::size_t j = term.coefficient.size(); j-- > 0;) {
    T inner{0}, power{1};  // power = (b/R)^(degree - i)
    for (auto i = static_cast<std::size_t>(term.degree) + 1; i-- > 0;) {
      inner = inner * h0_R + T(term.coefficient[j][i]) * power;
      power *= b_R;
    }
    outer = outer * cos2 + inner;
  }
  return outer / T(term.divisor);
}

/// Position in the meridian plane: parametric latitude and height.
template <class T>
struct ParametricPosition {
  T latitude, height;
};

//! [sum of the series]
/// Eq. 2.47 with the terms of Eqs 2.48-2.52: point (r, z) at the distance R > 0 from the centre.
template <class T>
ParametricPosition<T> sum_series(const T& r, const T& z, const T& R, const BasicEllipsoid<T>& e, int order,
                                 const SeriesTable& table) {
  using std::atan2;
  const T b = e.b(), b_R = b / R, h0_R = (R - b) / R;
  const T c = r / R, s = z / R, cos2 = c * c, S = 2 * s * c;
  T latitude{0}, height{0};
  for (auto k = static_cast<std::size_t>(order); k-- > 0;) {  // Horner's scheme in p
    latitude = (latitude + S * evaluate(table.latitude[k], b_R, h0_R, cos2)) * e.p();
    const T h_k = k == 0 ? -b * cos2 : b * S * S * evaluate(table.height[k], b_R, h0_R, cos2);
    height = (height + h_k) * e.p();
  }
  return {atan2(z, r) + latitude, (R - b) + height};
}
//! [sum of the series]

}  // namespace detail

template <class T>
BasicReversed<T> reverse(const BasicCartesian<T>& point, const BasicEllipsoid<T>& ellipsoid,
                         const PerturbationSeries& method, const SeriesTable& table) {
  using std::atan2, std::cos, std::isfinite, std::sin, std::sqrt;
  detail::require_order(method.order);
  const T nan = std::numeric_limits<T>::quiet_NaN();
  const T r = detail::length(point.x, point.y), R = detail::length(r, point.z);
  if (!isfinite(R)) return {{nan, nan, nan}, Outcome::non_finite, nan};
  if (R == 0) return {{nan, nan, nan}, Outcome::outside_validity, nan};

  const auto parametric = detail::sum_series(r, point.z, R, ellipsoid, method.order, table);
  // Eq. 2.53 corrected: tan(phi_g) = (a/b) tan(phi), in the quadrant of the point
  T sin_lat = ellipsoid.a() * sin(parametric.latitude), cos_lat = ellipsoid.b() * cos(parametric.latitude);
  T latitude = atan2(sin_lat, cos_lat);
  if (point.z == 0) latitude = point.z;
  if (r == 0) latitude = atan2(point.z, r);

  sin_lat = sin(latitude);
  cos_lat = cos(latitude);
  // sqrt(1 - e^2 sin^2), for strong flattening without the difference.
  const bool flat = ellipsoid.f() > T(0.25) || ellipsoid.f() < T(-0.25);
  const T ratio = 1 - ellipsoid.f(), along = ratio * sin_lat;
  const T root =
      flat ? T(sqrt(cos_lat * cos_lat + along * along)) : T(sqrt(1 - ellipsoid.e2() * sin_lat * sin_lat));
  const T remainder = flat ? T(ratio * ratio) : T(1 - ellipsoid.e2());
  const T projected = r * cos_lat + point.z * sin_lat - ellipsoid.a() * root;
  const T height = method.height == HeightFrom::series ? parametric.height : projected;
  const T prime_vertical = ellipsoid.a() / root;
  const T miss = detail::length(T(r - (prime_vertical + height) * cos_lat),
                                T(point.z - (prime_vertical * remainder + height) * sin_lat));
  const T longer = ellipsoid.f() < 0 ? ellipsoid.b() : ellipsoid.a();
  const T rounding = T(rounding_of_miss) * std::numeric_limits<T>::epsilon() * longer;
  if (!(miss + rounding <= T(largest_relative_miss) * R))
    return {{nan, nan, nan}, Outcome::outside_validity, miss};
  return {{latitude, atan2(point.y, point.x), height}, Outcome::success, miss};
}

}  // namespace nlmech::geodesy

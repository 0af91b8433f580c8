/// @file
/// Stumpff's functions, in which Kepler's equation is one formula for all conics.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "nlmech/program/value_of.hpp"

namespace nlmech::orbit {

/// c_n(psi) = sum_{k>=0} (-psi)^k/(2k + n)!, n = 0 to 3.
///
/// Tests hold c2 and c3 to 8 eps of themselves, c0 and c1 to 8 eps of max(1, |c|), and all to 1e-47 in 50
/// digits.
template <class T>
struct Stumpff {
  T c0;  ///< cos sqrt(psi), or cosh sqrt(-psi)
  T c1;  ///< sin x/x with x = sqrt(psi), or sinh x/x
  T c2;  ///< (1 - cos x)/x^2, or (cosh x - 1)/x^2
  T c3;  ///< (x - sin x)/x^3, or (sinh x - x)/x^3
};

namespace detail {

/// c_2 and c_3 by their power series. A factor of a Horner step is a quotient of small integers.
template <class T>
[[nodiscard]] Stumpff<T> stumpff_series(const T& psi) {
  using Number = decltype(value_of(psi));
  // The last term is below eps for |psi| <= 4: 4^k/(2k + 2)! falls below 2^-53 at k = 11, 1e-50 at k = 26.
  constexpr int terms = std::numeric_limits<Number>::digits <= 64 ? 12 : 30;
  T c2 = T(1), c3 = T(1);
  for (int k = terms; k >= 1; --k) {
    c2 = 1 - psi * c2 / ((2 * k + 1) * (2 * k + 2));
    c3 = 1 - psi * c3 / ((2 * k + 2) * (2 * k + 3));
  }
  c2 = c2 / 2;
  c3 = c3 / 6;
  return {1 - psi * c2, 1 - psi * c3, c2, c3};
}

/// The same for double: reciprocals of factorials in place of divisions, two sums at once.
[[nodiscard]] inline Stumpff<double> stumpff_series(double psi) {
  constexpr int terms = 12;
  static constexpr auto inverse_factorial = [] {
    std::array<double, 2 * terms + 4> f = {1};
    double product = 1;  // rounded from 23! on, by less than an ulp in all
    for (std::size_t i = 1; i < f.size(); ++i) f[i] = 1 / (product *= static_cast<double>(i));
    return f;
  }();
  double c2 = inverse_factorial[2 * terms + 2], c3 = inverse_factorial[2 * terms + 3];
  for (std::size_t k = terms; k-- > 0;) {
    c2 = inverse_factorial[2 * k + 2] - psi * c2;
    c3 = inverse_factorial[2 * k + 3] - psi * c3;
  }
  return {1 - psi * c2, 1 - psi * c3, c2, c3};
}

}  // namespace detail

/// All four for any finite @p psi, without cancellation: by power series for |psi| <= 4, else by functions of
/// the half argument. c_2 and c_3 are within 8 eps of themselves for psi <= pi^2 (one revolution of
/// propagate_kepler, which leaves out whole ones); infinite where cosh would be.
template <class T>
[[nodiscard]] Stumpff<T> stumpff(const T& psi) {
  using std::cos;
  using std::cosh;
  using std::sin;
  using std::sinh;
  using std::sqrt;
  const auto value = value_of(psi);
  if (value <= 4 && value >= -4) return detail::stumpff_series(psi);
  if (value > 0) {
    const T x = sqrt(psi), s = sin(x / 2), c = cos(x / 2), sine = 2 * s * c;
    return {1 - 2 * s * s, sine / x, 2 * s * s / psi, (x - sine) / (psi * x)};
  }
  const T x = sqrt(-psi), s = sinh(x / 2), c = cosh(x / 2), sine = 2 * s * c;
  return {1 + 2 * s * s, sine / x, -2 * s * s / psi, (x - sine) / (psi * x)};
}

}  // namespace nlmech::orbit

/// @file
/// Stability functions of a straight elastic member: bending stiffness as a function of the axial force.
///
/// Kondoh and Atluri's flexibilities h_a and h_s (Elgohary 2015, Eq. 2.29; the branch for tension is printed
/// with the wrong sign before coth) have poles without physical meaning, so their reciprocals are used: with
/// y = n/4 and c(y) = sqrt(y) coth(sqrt(y)), which is analytic, and real also for y < 0,
///
///     g_s = 1/h_s = 4 c,      g_a = 1/h_a = 4 G,  G = y/(c - 1).
///
/// Both satisfy a Riccati equation, 2 y c' = c - c^2 + y and 2 y G' = 3 G - G^2 + y. It gives the power
/// series, used for |n| < 4 (G: |n| < 16, where its closed form cancels), and the derivatives elsewhere.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>

#include "nlmech/program/value_of.hpp"

namespace nlmech::frames {

/// A stability function of the axial force n, with two derivatives.
template <class T>
struct StabilityFunction {
  T value;      ///< g
  T slope;      ///< dg/dn
  T curvature;  ///< d^2 g/dn^2, negative between the pole below and infinity
};

/// g_a and g_s at one axial force. End moments are M_1 = EI (g_a theta_a + g_s theta_s)/(2 l) and M_2 =
/// EI (g_a theta_a - g_s theta_s)/(2 l); in the usual notation s (1 + c) = g_a/2 and s (1 - c) = g_s/2.
template <class T>
struct StabilityFunctions {
  StabilityFunction<T> antisymmetric;  ///< g_a: both ends rotate in the same direction; 12 at n = 0
  StabilityFunction<T> symmetric;      ///< g_s: the ends rotate in opposite directions; 4 at n = 0
};

/// Pole of g_a, n = -4 x^2 with tan x = x, x = 4.49...: the greatest compression of a member with rotated
/// ends. Rounded to double.
inline constexpr double antisymmetric_pole = -80.76291422570652;

/// 4 pi^2 as a sum of two numbers, the second below half a unit in the last place of the first. g_s has its
/// pole at n = -4 pi^2, Euler's load of a member with clamped ends.
/// @tparam Number floating point of any width; only for double is the second part not 0
template <class Number>
struct FourPiSquared {
  Number high = [] {
    using std::acos;
    const Number pi = acos(Number(-1));
    return Number(4 * pi * pi);
  }();            ///< rounded
  Number low{0};  ///< remainder
};
/// 4 pi^2 for double, to 32 digits.
template <>
struct FourPiSquared<double> {
  double high = 39.47841760435743;      ///< rounded
  double low = 2.5061182034958845e-15;  ///< remainder
};

namespace detail {

/// Coefficients of the solution of 2 y u' = first u - u^2 + y with u(0) = first, in powers of y: c for first
/// = 1, G for first = 3. The recurrence has no cancellation.
template <class Number, int first>
struct StabilitySeries {
  /// The poles are at |y| = pi^2 for c, used up to |y| = 1, and at 20.2 for G, used up to 4: a term adds 3.3
  /// and 2.3 bits. The 7 extra terms serve the second derivative.
  static constexpr std::size_t terms =
      std::size_t{7} + std::numeric_limits<Number>::digits * (first == 1 ? 303 : 430) / 1000;
  /// Number of terms needed at y: few for the members of a fine mesh.
  [[nodiscard]] static std::size_t terms_at(const Number& y) {
    using std::ilogb;
    const double bits =
        (first == 1 ? 3.3 : 4.33) - 1 - static_cast<double>(ilogb(y));  // least number per term
    return std::min(terms,
                    std::size_t{7} + static_cast<std::size_t>(std::numeric_limits<Number>::digits / bits));
  }
  std::array<Number, terms> coefficients{};  ///< coefficients of 1, y, y^2, ... ...

  constexpr StabilitySeries() {
    auto& u = coefficients;
    u[0] = Number(first);
    for (std::size_t k = 1; k < terms; ++k) {
      Number sum = k == 1 ? Number(1) : Number(0);
      for (std::size_t i = 1; i < k; ++i) sum -= u[i] * u[k - i];
      u[k] = sum / Number(2 * static_cast<int>(k) + first);
    }
  }
};

/// 4 u(n/4) and its derivatives in n, from u and its derivatives in y.
template <class T>
[[nodiscard]] StabilityFunction<T> by_force(const T& value, const T& slope, const T& curvature) {
  return {T(4 * value), slope, T(curvature / 4)};
}

/// 4 u(y) by Horner's rule.
template <int first, class T>
[[nodiscard]] StabilityFunction<T> by_series(const T& y) {
  static const StabilitySeries<decltype(value_of(y)), first> series;
  const auto& u = series.coefficients;
  std::size_t k = series.terms_at(value_of(y)) - 1;
  T value(u[k]), slope(0), half_curvature(0);
  while (k-- > 0) {
    half_curvature = half_curvature * y + slope;
    slope = slope * y + value;
    value = value * y + u[k];
  }
  return by_force<T>(value, slope, T(2 * half_curvature));
}

/// Derivatives of c from c and s = c^2 - y, which the caller has without cancellation: 2 y c' = c - s,
/// y s' = s (1 - c).
template <class T>
[[nodiscard]] StabilityFunction<T> symmetric_from(const T& c, const T& s, const T& y) {
  const T slope = (c - s) / (2 * y);
  return by_force<T>(c, slope, T((s * (c - 1) / y - slope) / (2 * y)));
}

/// Tension, y >= 1. Differentiates G e = y with e = c - 1; in the Riccati form G^2 would cancel y.
template <class T>
[[nodiscard]] StabilityFunctions<T> in_tension(const T& y) {
  using std::sinh;
  using std::sqrt;
  using std::tanh;
  const T x = sqrt(y);
  T c = x, s(0);
  // For greater x, tanh x = 1 and s < eps c to working precision, and sinh may overflow.
  if (value_of(x) < std::numeric_limits<decltype(value_of(x))>::digits) {
    const T sine = sinh(x);
    c = x / tanh(x);
    s = y / (sine * sine);
  }
  const StabilityFunction<T> g = symmetric_from<T>(c, s, y);
  if (value_of(y) < 4) return {by_series<3, T>(y), g};
  const T e = c - 1, value = y / e, slope = (1 - value * g.slope) / e;
  const T curvature = -(2 * slope * g.slope + value * (4 * g.curvature)) / e;
  return {by_force<T>(value, slope, curvature), g};
}

/// Compression, y <= -1, with p = n + 4 pi^2 in full relative precision: c = x cot x with x = pi - w. w is
/// computed from p, without loss of digits near the pole of c at w = 0.
template <class T>
[[nodiscard]] StabilityFunctions<T> in_compression(const T& y, const T& p) {
  using std::acos;
  using std::cos;
  using std::sin;
  using std::sqrt;
  using Number = decltype(value_of(y));
  const T x = sqrt(-y), w = p / (4 * (acos(Number(-1)) + x)), sine = sin(w), cosine = cos(w);
  const T c = -x * cosine / sine, s = -y / (sine * sine);
  const StabilityFunction<T> g = symmetric_from<T>(c, s, y);
  if (value_of(y) > -4) return {by_series<3, T>(y), g};
  const T value = -y * sine / (x * cosine + sine), slope = (3 * value - value * value + y) / (2 * y);
  const T curvature = (1 + slope - 2 * value * slope) / (2 * y);
  return {by_force<T>(value, slope, curvature), g};
}

}  // namespace detail

/// Both functions at n = p - 4 pi^2, for use near the pole of g_s at p = 0, where n does not resolve p. All
/// results have relative errors below 1e-13 down to p = 1e-100 (compared with 50 digits).
/// @param p at most 4 pi^2 - 4; not checked
template <class T>
[[nodiscard]] StabilityFunctions<T> stability_functions_above_pole(const T& p) {
  const FourPiSquared<decltype(value_of(p))> pole;
  return detail::in_compression<T>(T(((p - pole.high) - pole.low) / 4), p);
}

/// Both functions at the axial force @p n = N l^2/EI, tension positive, in any type of number: floating
/// point, extended precision, dual numbers. For double, against 50 digits, values g are within 16 eps max(1,
/// |g|), relative errors of slopes within 16 eps and of curvatures within 128 eps, for n from -4 pi^2 to 1e6.
/// At a pole values are infinite or very large; callers near a pole must check n first.
template <class T>
[[nodiscard]] StabilityFunctions<T> stability_functions(const T& n) {
  using Number = decltype(value_of(n));
  const T y = n / 4;
  if (value_of(n) < 4 && value_of(n) > -4) return {detail::by_series<3, T>(y), detail::by_series<1, T>(y)};
  if (value_of(n) > 0) return detail::in_tension<T>(y);
  const FourPiSquared<Number> pole;
  return detail::in_compression<T>(y, T((n + pole.high) + pole.low));
}

}  // namespace nlmech::frames

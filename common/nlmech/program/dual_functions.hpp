/// @file
/// Elementary functions of dual numbers.
#pragma once

#include <cmath>
#include <concepts>
#include <type_traits>

#include "nlmech/program/dual.hpp"

namespace nlmech {

/// Square root; see Dual for the argument 0.
template <class T, int n>
[[nodiscard]] Dual<T, n> sqrt(const Dual<T, n>& x) {
  using std::sqrt;
  const T root = sqrt(x.value);
  return Dual<T, n>::chained(root, 1 / (2 * root), x);
}

/// Exponential function.
template <class T, int n>
[[nodiscard]] Dual<T, n> exp(const Dual<T, n>& x) {
  using std::exp;
  const T value = exp(x.value);
  return Dual<T, n>::chained(value, value, x);
}

/// Natural logarithm.
template <class T, int n>
[[nodiscard]] Dual<T, n> log(const Dual<T, n>& x) {
  using std::log;
  return Dual<T, n>::chained(log(x.value), 1 / x.value, x);
}

/// Sine.
template <class T, int n>
[[nodiscard]] Dual<T, n> sin(const Dual<T, n>& x) {
  using std::cos;
  using std::sin;
  return Dual<T, n>::chained(sin(x.value), cos(x.value), x);
}

/// Cosine.
template <class T, int n>
[[nodiscard]] Dual<T, n> cos(const Dual<T, n>& x) {
  using std::cos;
  using std::sin;
  return Dual<T, n>::chained(cos(x.value), -sin(x.value), x);
}

/// Tangent.
template <class T, int n>
[[nodiscard]] Dual<T, n> tan(const Dual<T, n>& x) {
  using std::tan;
  const T value = tan(x.value);
  return Dual<T, n>::chained(value, 1 + value * value, x);
}

/// Hyperbolic sine.
template <class T, int n>
[[nodiscard]] Dual<T, n> sinh(const Dual<T, n>& x) {
  using std::cosh;
  using std::sinh;
  return Dual<T, n>::chained(sinh(x.value), cosh(x.value), x);
}

/// Hyperbolic cosine.
template <class T, int n>
[[nodiscard]] Dual<T, n> cosh(const Dual<T, n>& x) {
  using std::cosh;
  using std::sinh;
  return Dual<T, n>::chained(cosh(x.value), sinh(x.value), x);
}

/// Hyperbolic tangent. Its slope is formed as 1/cosh^2, which keeps all digits where 1 - tanh^2 loses them.
template <class T, int n>
[[nodiscard]] Dual<T, n> tanh(const Dual<T, n>& x) {
  using std::cosh;
  using std::tanh;
  const T secant = 1 / cosh(x.value);
  return Dual<T, n>::chained(tanh(x.value), secant * secant, x);
}

/// Arc sine. Its slope is formed from (1 - x)(1 + x), which keeps all digits near the ends; at the ends see
/// Dual.
template <class T, int n>
[[nodiscard]] Dual<T, n> asin(const Dual<T, n>& x) {
  using std::asin;
  using std::sqrt;
  return Dual<T, n>::chained(asin(x.value), 1 / sqrt((1 - x.value) * (1 + x.value)), x);
}

/// Arc cosine; as asin().
template <class T, int n>
[[nodiscard]] Dual<T, n> acos(const Dual<T, n>& x) {
  using std::acos;
  using std::sqrt;
  return Dual<T, n>::chained(acos(x.value), -1 / sqrt((1 - x.value) * (1 + x.value)), x);
}

/// Arc tangent.
template <class T, int n>
[[nodiscard]] Dual<T, n> atan(const Dual<T, n>& x) {
  using std::atan;
  return Dual<T, n>::chained(atan(x.value), 1 / (1 + x.value * x.value), x);
}

/// Inverse of sinh.
template <class T, int n>
[[nodiscard]] Dual<T, n> asinh(const Dual<T, n>& x) {
  using std::asinh;
  using std::sqrt;
  return Dual<T, n>::chained(asinh(x.value), 1 / sqrt(1 + x.value * x.value), x);
}

/// Angle of the point (x, y), from -pi to pi. At the origin, where there is no derivative, those that are
/// asked for are not finite.
template <class T, int n>
[[nodiscard]] Dual<T, n> atan2(const Dual<T, n>& y, const Dual<T, n>& x) {
  using std::abs;
  using std::atan2;
  // In units of the larger coordinate, so that no square leaves the range of T.
  const T unit = abs(value_of(x)) < abs(value_of(y)) ? T(abs(y.value)) : T(abs(x.value));
  const T a = x.value / unit, b = y.value / unit, square = (a * a + b * b) * unit;
  return Dual<T, n>::chained(atan2(y.value, x.value), a / square, y) +
         Dual<T, n>::chained(T(0), -b / square, x);
}
/// The same on a line parallel to an axis.
template <class T, int n, class S>
requires std::convertible_to<S, T>
[[nodiscard]] Dual<T, n> atan2(const Dual<T, n>& y, const S& x) {
  return atan2(y, Dual<T, n>(static_cast<T>(x)));
}
/// The same on a line parallel to an axis.
template <class T, int n, class S>
requires std::convertible_to<S, T>
[[nodiscard]] Dual<T, n> atan2(const S& y, const Dual<T, n>& x) {
  return atan2(Dual<T, n>(static_cast<T>(y)), x);
}

/// Error function.
template <class T, int n>
[[nodiscard]] Dual<T, n> erf(const Dual<T, n>& x) {
  using std::atan;
  using std::erf;
  using std::exp;
  using std::sqrt;
  const T slope = exp(-x.value * x.value) / sqrt(atan(T(1)));  // 2/sqrt(pi) = 1/sqrt(pi/4)
  return Dual<T, n>::chained(erf(x.value), slope, x);
}

/// Absolute value; at 0 the derivative from the right.
template <class T, int n>
[[nodiscard]] constexpr Dual<T, n> abs(const Dual<T, n>& x) {
  return value_of(x) < 0 ? -x : x;
}

/// x^p for a constant exponent, an integer or a real number. x^0 is the constant 1, also at 0.
template <class T, int n, class P>
requires std::is_arithmetic_v<P>
[[nodiscard]] Dual<T, n> pow(const Dual<T, n>& x, P p) {
  using std::pow;
  if (p == P{0}) return T(1);
  return Dual<T, n>::chained(pow(x.value, p), p * pow(x.value, p - P{1}), x);
}

/// x^y for x > 0; at x = 0 with y > 0 the limits from the right.
template <class T, int n>
[[nodiscard]] Dual<T, n> pow(const Dual<T, n>& x, const Dual<T, n>& y) {
  using std::log;
  using std::pow;
  const T power = pow(x.value, y.value);
  Dual<T, n> r = Dual<T, n>::chained(power, y.value * pow(x.value, y.value - 1), x);
  // x^y log x -> 0 as x -> 0.
  const T by_exponent = value_of(x) == 0 ? T(0) : T(power * log(x.value));
  return r += Dual<T, n>::chained(T(0), by_exponent, y);
}

}  // namespace nlmech

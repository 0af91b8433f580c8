/// @file
/// Elementary functions of power series, by the recurrences of their coefficients.
#pragma once

#include <cmath>
#include <concepts>
#include <utility>

#include "nlmech/program/recurrences.hpp"

namespace nlmech {

/// A series with recurrences, evaluated at once (PowerSeries) or in passes (GrowingSeries). Functions of a
/// constant are constants.
template <class S>
concept RecurrentSeries = requires(const S& a) {
  typename S::Coefficient;
  a.by_recurrence(recurrence::root<typename S::Coefficient>);
};

/// Square root, for c_0 != 0.
template <RecurrentSeries S>
[[nodiscard]] S sqrt(const S& a) {
  return a.by_recurrence(recurrence::root<typename S::Coefficient>);
}

/// Exponential function.
template <RecurrentSeries S>
[[nodiscard]] S exp(const S& a) {
  return a.by_recurrence(recurrence::exponential<typename S::Coefficient>);
}

/// Natural logarithm, for c_0 > 0.
template <RecurrentSeries S>
[[nodiscard]] S log(const S& a) {
  return a.by_recurrence(recurrence::logarithm<typename S::Coefficient>);
}

/// Sine and cosine of one argument, by coupled recurrences.
template <RecurrentSeries S>
[[nodiscard]] std::pair<S, S> sin_cos(const S& a) {
  using T = typename S::Coefficient;
  return a.by_recurrences(recurrence::sine<T>, recurrence::cosine<T>);
}

/// Sine.
template <RecurrentSeries S>
[[nodiscard]] S sin(const S& a) {
  return sin_cos(a).first;
}

/// Cosine.
template <RecurrentSeries S>
[[nodiscard]] S cos(const S& a) {
  return sin_cos(a).second;
}

/// Hyperbolic sine and cosine of one argument, by coupled recurrences.
template <RecurrentSeries S>
[[nodiscard]] std::pair<S, S> sinh_cosh(const S& a) {
  using T = typename S::Coefficient;
  return a.by_recurrences(recurrence::hyperbolic_sine<T>, recurrence::hyperbolic_cosine<T>);
}

/// Hyperbolic sine.
template <RecurrentSeries S>
[[nodiscard]] S sinh(const S& a) {
  return sinh_cosh(a).first;
}

/// Hyperbolic cosine.
template <RecurrentSeries S>
[[nodiscard]] S cosh(const S& a) {
  return sinh_cosh(a).second;
}

/// Tangent.
template <RecurrentSeries S>
[[nodiscard]] S tan(const S& a) {
  using T = typename S::Coefficient;
  const auto slope = [](const T*, const T* r, std::size_t k) {
    return k == 0 ? T(1 + r[0] * r[0]) : recurrence::product(r, r, k);
  };
  return a.by_recurrences(recurrence::tangent<T>, slope).first;
}

/// Hyperbolic tangent.
template <RecurrentSeries S>
[[nodiscard]] S tanh(const S& a) {
  using std::cosh;
  using T = typename S::Coefficient;
  const auto slope = [](const T* c, const T* r, std::size_t k) {
    const T root = cosh(c[0]);
    return k == 0 ? T(1 / (root * root)) : T(-recurrence::product(r, r, k));
  };
  return a.by_recurrences(recurrence::hyperbolic_tangent<T>, slope).first;
}

/// a^p for a real exponent, for c_0 > 0, by a recurrence whose cost does not depend on p.
template <RecurrentSeries S, class P>
requires(!std::integral<P> && std::convertible_to<P, typename S::Coefficient>) [[nodiscard]] S
    pow(const S& a, const P& p) {
  using T = typename S::Coefficient;
  const T exponent = static_cast<T>(p);
  return a.by_recurrence(
      [&](const T* c, const T* r, std::size_t k) { return recurrence::power(c, exponent, r, k); });
}

/// Arc sine, for |c_0| < 1; as for the other inverse functions, the integral of its slope.
template <RecurrentSeries S>
[[nodiscard]] S asin(const S& a) {
  using std::asin;
  return S(asin(a[0])) + a.integral_of(pow((1 - a) * (1 + a), -0.5));
}

/// Arc cosine, for |c_0| < 1.
template <RecurrentSeries S>
[[nodiscard]] S acos(const S& a) {
  using std::acos;
  return S(acos(a[0])) - a.integral_of(pow((1 - a) * (1 + a), -0.5));
}

/// Arc tangent.
template <RecurrentSeries S>
[[nodiscard]] S atan(const S& a) {
  using std::atan;
  return S(atan(a[0])) + a.integral_of(1 / (1 + a * a));
}

/// Inverse of sinh.
template <RecurrentSeries S>
[[nodiscard]] S asinh(const S& a) {
  using std::asinh;
  return S(asinh(a[0])) + a.integral_of(pow(1 + a * a, -0.5));
}

/// Angle of the point (x, y), except the origin.
template <RecurrentSeries S>
[[nodiscard]] S atan2(const S& y, const S& x) {
  using std::atan2;
  const S slope = 1 / (x * x + y * y);
  return S(atan2(y[0], x[0])) + y.integral_of(x * slope) - x.integral_of(y * slope);
}

/// Error function.
template <RecurrentSeries S>
[[nodiscard]] S erf(const S& a) {
  using std::atan;
  using std::erf;
  using std::sqrt;
  using T = typename S::Coefficient;
  const T factor = 1 / sqrt(atan(T(1)));  // 2/sqrt(pi) = 1/sqrt(pi/4)
  return S(erf(a[0])) + a.integral_of(factor * exp(-(a * a)));
}

/// x^y = exp(y log x), for x_0 > 0.
template <RecurrentSeries S>
[[nodiscard]] S pow(const S& x, const S& y) {
  return exp(y * log(x));
}

/// a^p for an integer exponent, by repeated squaring; a^0 is the constant 1. A negative exponent needs
/// c_0 != 0.
template <RecurrentSeries S>
[[nodiscard]] S pow(const S& a, int p) {
  using T = typename S::Coefficient;
  S result(T(1)), square = a;
  for (unsigned rest = p < 0 ? 0U - static_cast<unsigned>(p) : static_cast<unsigned>(p); rest > 0;
       rest /= 2) {
    if (rest % 2 == 1) result *= square;
    if (rest > 1) square *= square;
  }
  return p < 0 ? S(T(1)) / result : result;
}

}  // namespace nlmech

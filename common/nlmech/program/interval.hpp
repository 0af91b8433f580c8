/// @file
/// Interval arithmetic: bounds on the values of a program.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nlmech::program {

/// All numbers from low to high. Ends are rounded outwards, so the result of a program on intervals contains
/// its values for all numbers in them (Moore, Interval Analysis, 1966). A function that is undefined for some
/// of the numbers is bounded for the others; if it is undefined for all, the result is the whole line.
struct Interval {
  double low = -std::numeric_limits<double>::infinity();  ///< lower end
  double high = std::numeric_limits<double>::infinity();  ///< upper end

  /// The whole line.
  constexpr Interval() = default;
  /// One number.
  constexpr explicit Interval(double x) : low(x), high(x) {}
  /// From @p a to @p b >= a; the whole line if one is NaN.
  constexpr Interval(double a, double b) {
    if (a <= b) {
      low = a;
      high = b;
    }
  }

  /// Is @p x in the interval?
  [[nodiscard]] constexpr bool has(double x) const { return low <= x && x <= high; }
  /// high - low
  [[nodiscard]] constexpr double width() const { return high - low; }
  /// The largest absolute value.
  [[nodiscard]] constexpr double magnitude() const { return std::max(std::abs(low), std::abs(high)); }
  /// The interval widened by @p by on both sides.
  [[nodiscard]] Interval inflated(double by) const { return outwards(low - by, high + by); }

  /// From a to b, widened by four roundings, which exceeds the error of the functions of the C library.
  [[nodiscard]] static Interval outwards(double a, double b) {
    constexpr double share = 4 * std::numeric_limits<double>::epsilon();
    constexpr double least = std::numeric_limits<double>::denorm_min(),
                     most = std::numeric_limits<double>::max();
    // Infinities have no next double: the range ends at the largest one.
    const double low = a <= most ? a - (share * std::abs(a) + least) : a > most ? most : a;
    const double high = b >= -most ? b + (share * std::abs(b) + least) : b < -most ? -most : b;
    return {low, high};
  }
};

/// The smallest interval that holds both.
[[nodiscard]] inline Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

/// Arithmetic.
/// @{
[[nodiscard]] inline Interval operator+(const Interval& a, const Interval& b) {
  return Interval::outwards(a.low + b.low, a.high + b.high);
}
[[nodiscard]] inline Interval operator-(const Interval& a, const Interval& b) {
  return Interval::outwards(a.low - b.high, a.high - b.low);
}
[[nodiscard]] inline Interval operator+(const Interval& a, double b) { return a + Interval(b); }
[[nodiscard]] inline Interval operator*(double b, const Interval& a) {
  return b < 0 ? Interval::outwards(b * a.high, b * a.low) : Interval::outwards(b * a.low, b * a.high);
}
[[nodiscard]] inline Interval operator*(const Interval& a, const Interval& b) {
  const double p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
  if (std::isnan(p + q + r + s) &&
      !(std::isfinite(p) && std::isfinite(q) && std::isfinite(r) && std::isfinite(s)))
    return {};
  return Interval::outwards(std::min({p, q, r, s}), std::max({p, q, r, s}));
}
/// a a
[[nodiscard]] inline Interval square(const Interval& a) {
  const double least = a.has(0) ? 0 : std::min(std::abs(a.low), std::abs(a.high));
  const Interval r = Interval::outwards(least * least, a.magnitude() * a.magnitude());
  return {std::max(r.low, 0.), r.high};
}
[[nodiscard]] inline Interval operator/(double c, const Interval& a) {
  if (a.low < 0 && a.high > 0) return {};
  const double one = c / a.low, other = c / a.high;
  if (a.low == 0 && a.high == 0) return {};
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (a.low == 0)
    return c == 0  ? Interval(0)
           : c > 0 ? Interval::outwards(other, infinity)
                   : Interval::outwards(-infinity, other);
  if (a.high == 0)
    return c == 0  ? Interval(0)
           : c > 0 ? Interval::outwards(-infinity, one)
                   : Interval::outwards(one, infinity);
  return Interval::outwards(std::min(one, other), std::max(one, other));
}
[[nodiscard]] inline Interval operator/(const Interval& a, const Interval& b) { return a * (1 / b); }
[[nodiscard]] inline Interval operator/(const Interval& a, double c) { return a / Interval(c); }
/// @}

/// Functions.
/// @{
/// @cond
namespace detail {
template <class F>
[[nodiscard]] Interval growing(const F& f, const Interval& a) {
  return Interval::outwards(f(a.low), f(a.high));
}
/// Is there an integer k with low <= first + k period <= high, to some roundings?
[[nodiscard]] inline bool has_multiple(const Interval& a, double first, double period) {
  const double margin = 8 * std::numeric_limits<double>::epsilon() * a.magnitude();
  const double k = std::ceil((a.low - margin - first) / period);
  return first + k * period <= a.high + margin;
}
}  // namespace detail
/// @endcond
[[nodiscard]] inline Interval sqrt(const Interval& a) {
  if (a.high < 0) return {};
  const Interval r = Interval::outwards(std::sqrt(std::max(a.low, 0.)), std::sqrt(a.high));
  return {std::max(r.low, 0.), r.high};
}
[[nodiscard]] inline Interval exp(const Interval& a) {
  const Interval r = detail::growing([](double x) { return std::exp(x); }, a);
  return {std::max(r.low, 0.), r.high};
}
[[nodiscard]] inline Interval log(const Interval& a) {
  if (a.high <= 0) return {};
  return Interval::outwards(std::log(std::max(a.low, 0.)), std::log(a.high));
}
[[nodiscard]] inline Interval cos(const Interval& a) {
  constexpr double pi = std::numbers::pi;
  // Above 1e14 the rounding margin of has_multiple() is not small against a quarter period.
  if (!(a.width() < 2 * pi) || a.magnitude() > 1e14) return {-1, 1};
  const double one = std::cos(a.low), other = std::cos(a.high);
  const Interval ends = Interval::outwards(std::min(one, other), std::max(one, other));
  return {detail::has_multiple(a, pi, 2 * pi) ? -1 : std::max(ends.low, -1.),
          detail::has_multiple(a, 0, 2 * pi) ? 1 : std::min(ends.high, 1.)};
}
[[nodiscard]] inline Interval sin(const Interval& a) {
  constexpr double pi = std::numbers::pi;
  if (!(a.width() < 2 * pi) || a.magnitude() > 1e14) return {-1, 1};
  const double one = std::sin(a.low), other = std::sin(a.high);
  const Interval ends = Interval::outwards(std::min(one, other), std::max(one, other));
  return {detail::has_multiple(a, -pi / 2, 2 * pi) ? -1 : std::max(ends.low, -1.),
          detail::has_multiple(a, pi / 2, 2 * pi) ? 1 : std::min(ends.high, 1.)};
}
[[nodiscard]] inline Interval tan(const Interval& a) {
  constexpr double pi = std::numbers::pi;
  if (!(a.width() < pi) || a.magnitude() > 1e14 || detail::has_multiple(a, pi / 2, pi)) return {};
  return detail::growing([](double x) { return std::tan(x); }, a);
}
[[nodiscard]] inline Interval asin(const Interval& a) {
  if (a.high < -1 || a.low > 1) return {};
  return detail::growing([](double x) { return std::asin(std::clamp(x, -1., 1.)); }, a);
}
[[nodiscard]] inline Interval acos(const Interval& a) {
  if (a.high < -1 || a.low > 1) return {};
  return Interval::outwards(std::acos(std::min(a.high, 1.)), std::acos(std::max(a.low, -1.)));
}
[[nodiscard]] inline Interval atan(const Interval& a) {
  return detail::growing([](double x) { return std::atan(x); }, a);
}
[[nodiscard]] inline Interval sinh(const Interval& a) {
  return detail::growing([](double x) { return std::sinh(x); }, a);
}
[[nodiscard]] inline Interval cosh(const Interval& a) {
  const double least = a.has(0) ? 0 : std::min(std::abs(a.low), std::abs(a.high));
  return Interval::outwards(std::cosh(least), std::cosh(a.magnitude()));
}
[[nodiscard]] inline Interval tanh(const Interval& a) {
  return detail::growing([](double x) { return std::tanh(x); }, a);
}
[[nodiscard]] inline Interval erf(const Interval& a) {
  return detail::growing([](double x) { return std::erf(x); }, a);
}
[[nodiscard]] inline Interval asinh(const Interval& a) {
  return detail::growing([](double x) { return std::asinh(x); }, a);
}
[[nodiscard]] inline Interval floor(const Interval& a) { return {std::floor(a.low), std::floor(a.high)}; }
[[nodiscard]] inline Interval pow(const Interval& a, double c) {
  if (c < 0) return 1 / pow(a, -c);
  if (c == std::floor(c) && a.low < 0) {
    if (std::fmod(c, 2) != 0) return detail::growing([c](double x) { return std::pow(x, c); }, a);
    return pow(square(a), c / 2);
  }
  if (a.high < 0) return {};
  const Interval r = Interval::outwards(std::pow(std::max(a.low, 0.), c), std::pow(a.high, c));
  return {std::max(r.low, 0.), r.high};
}
[[nodiscard]] inline Interval atan2(const Interval& y, const Interval& x) {
  if (y.has(0) && x.low <= 0) return {-std::numbers::pi, std::numbers::pi};
  // Away from the branch cut the largest and smallest angles are at corners.
  const double a = std::atan2(y.low, x.low), b = std::atan2(y.low, x.high), c = std::atan2(y.high, x.low),
               d = std::atan2(y.high, x.high);
  return Interval::outwards(std::min({a, b, c, d}), std::max({a, b, c, d}));
}
/// @p yes if @p decides is not negative, @p no if it is negative, otherwise the hull of both.
[[nodiscard]] inline Interval choice(const Interval& decides, const Interval& yes, const Interval& no) {
  return decides.low >= 0 ? yes : decides.high < 0 ? no : hull(yes, no);
}
/// @}

}  // namespace nlmech::program

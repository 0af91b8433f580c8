/// @file
/// A number that is several numbers: what a problem is evaluated with for several trajectories at once.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <type_traits>

#include "nlmech/series/number_traits.hpp"

namespace nlmech::ivp {

/// Doubles in a register of the processor that the source is compiled for.
#if defined(__AVX512F__)
inline constexpr int register_lanes = 8;
#elif defined(__AVX__)
inline constexpr int register_lanes = 4;
#else
inline constexpr int register_lanes = 2;
#endif

namespace detail {
/// The compiler's own vectors.
template <int n>
struct PackVector {
  using Numbers [[gnu::vector_size(n * sizeof(double))]] = double;  ///< of n numbers
};
}  // namespace detail

/// A number a trajectory, each as if it were alone: sums, products and roots round alike in any company.
/// @tparam n how many, a power of two
template <int n>
struct Pack {
  static constexpr int lanes = n;                           ///< how many
  using Numbers = typename detail::PackVector<n>::Numbers;  ///< the compiler's vector
  Numbers v = {};                                           ///< the numbers

  Pack() = default;
  /// The same number in all lanes.
  template <class T>
  requires std::is_arithmetic_v<T>
  [[gnu::always_inline]] Pack(T x) : v(static_cast<double>(x) - Numbers{}) {}
  /// Lane by lane. @param numbers the compiler's vector
  [[gnu::always_inline]] static Pack of(const Numbers& numbers) {
    Pack p;
    p.v = numbers;
    return p;
  }

  /// Lane by lane.
  /// @{
  [[gnu::always_inline]] friend Pack operator+(const Pack& a, const Pack& b) { return of(a.v + b.v); }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a, const Pack& b) { return of(a.v - b.v); }
  [[gnu::always_inline]] friend Pack operator*(const Pack& a, const Pack& b) { return of(a.v * b.v); }
  [[gnu::always_inline]] friend Pack operator/(const Pack& a, const Pack& b) { return of(a.v / b.v); }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a) { return of(-a.v); }
  [[gnu::always_inline]] Pack& operator+=(const Pack& b) { return *this = *this + b; }
  [[gnu::always_inline]] Pack& operator-=(const Pack& b) { return *this = *this - b; }
  [[gnu::always_inline]] Pack& operator*=(const Pack& b) { return *this = *this * b; }
  [[gnu::always_inline]] Pack& operator/=(const Pack& b) { return *this = *this / b; }
  /// @}

  /// A function of the standard library, lane by lane.
  template <class F>
  [[nodiscard]] Pack each(const F& f) const {
    Pack p;
    for (int i = 0; i < lanes; ++i) p.v[i] = f(v[i]);
    return p;
  }
  /// The standard library's functions.
  /// @{
  friend Pack sqrt(const Pack& a) {
    return a.each([](double x) { return std::sqrt(x); });
  }
  friend Pack exp(const Pack& a) {
    return a.each([](double x) { return std::exp(x); });
  }
  friend Pack log(const Pack& a) {
    return a.each([](double x) { return std::log(x); });
  }
  friend Pack sin(const Pack& a) {
    return a.each([](double x) { return std::sin(x); });
  }
  friend Pack cos(const Pack& a) {
    return a.each([](double x) { return std::cos(x); });
  }
  friend Pack tan(const Pack& a) {
    return a.each([](double x) { return std::tan(x); });
  }
  friend Pack pow(const Pack& a, double b) {
    return a.each([b](double x) { return std::pow(x, b); });
  }
  /// @}
};

}  // namespace nlmech::ivp

/// @cond Doxygen cannot follow specialisations of another library's templates
// What Eigen has to know about it as entries of vectors.
template <int n>
struct Eigen::NumTraits<nlmech::ivp::Pack<n>> : nlmech::detail::NumberTraits<nlmech::ivp::Pack<n>, n, n, n> {
};
/// @endcond

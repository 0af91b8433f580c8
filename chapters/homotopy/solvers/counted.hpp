/// @file
/// Number type that counts arithmetic operations, for templates on the number type.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <limits>

namespace nlmech::chapters::homotopy {

/// A double with an operation counter. Additions, subtractions, multiplications, divisions and elementary
/// functions count one each; signs, comparisons, absolute values and rounding to integers count nothing. The
/// result uses the counter of its first operand that has one. Operations on constants alone are not counted.
struct Counted {
  double value = 0;
  std::int64_t* counter = nullptr;  ///< null for a constant

  constexpr Counted() = default;
  constexpr Counted(double constant) : value(constant) {}                    // NOLINT: implicit, like double
  constexpr Counted(int constant) : value(static_cast<double>(constant)) {}  // NOLINT: implicit, like double
  constexpr Counted(double v, std::int64_t* count) : value(v), counter(count) {}  ///< a variable

  /// Counts one operation on @p a and @p b with the result @p v.
  [[nodiscard]] static constexpr Counted made(double v, const Counted& a, const Counted& b) {
    std::int64_t* const counter = a.counter != nullptr ? a.counter : b.counter;
    if (counter != nullptr) ++*counter;
    return {v, counter};
  }
  constexpr Counted& operator+=(const Counted& b) { return *this = made(value + b.value, *this, b); }
  constexpr Counted& operator-=(const Counted& b) { return *this = made(value - b.value, *this, b); }
  constexpr Counted& operator*=(const Counted& b) { return *this = made(value * b.value, *this, b); }
  constexpr Counted& operator/=(const Counted& b) { return *this = made(value / b.value, *this, b); }
  friend constexpr Counted operator+(Counted a, const Counted& b) { return a += b; }
  friend constexpr Counted operator-(Counted a, const Counted& b) { return a -= b; }
  friend constexpr Counted operator*(Counted a, const Counted& b) { return a *= b; }
  friend constexpr Counted operator/(Counted a, const Counted& b) { return a /= b; }
  friend constexpr Counted operator-(const Counted& a) { return {-a.value, a.counter}; }
  friend constexpr bool operator==(const Counted& a, const Counted& b) { return a.value == b.value; }
  friend constexpr auto operator<=>(const Counted& a, const Counted& b) { return a.value <=> b.value; }

  friend Counted abs(const Counted& x) { return {std::abs(x.value), x.counter}; }
  friend Counted floor(const Counted& x) { return {std::floor(x.value), x.counter}; }
  friend bool isfinite(const Counted& x) { return std::isfinite(x.value); }
  friend int ilogb(const Counted& x) { return std::ilogb(x.value); }
  friend Counted sqrt(const Counted& x) { return made(std::sqrt(x.value), x, x); }
  friend Counted sin(const Counted& x) { return made(std::sin(x.value), x, x); }
  friend Counted cos(const Counted& x) { return made(std::cos(x.value), x, x); }
  friend Counted acos(const Counted& x) { return made(std::acos(x.value), x, x); }
  friend Counted sinh(const Counted& x) { return made(std::sinh(x.value), x, x); }
  friend Counted tanh(const Counted& x) { return made(std::tanh(x.value), x, x); }
  friend Counted atan2(const Counted& y, const Counted& x) {
    return made(std::atan2(y.value, x.value), y, x);
  }
};

}  // namespace nlmech::chapters::homotopy

/// The limits of double.
template <>
struct std::numeric_limits<nlmech::chapters::homotopy::Counted> : std::numeric_limits<double> {};

/// The traits of double; the types are Counted.
template <>
struct Eigen::NumTraits<nlmech::chapters::homotopy::Counted> : Eigen::NumTraits<double> {
  using Real = nlmech::chapters::homotopy::Counted;
  using NonInteger = nlmech::chapters::homotopy::Counted;
  using Nested = nlmech::chapters::homotopy::Counted;
  using Literal = nlmech::chapters::homotopy::Counted;
  enum : std::uint8_t { RequireInitialization = 1 };
};

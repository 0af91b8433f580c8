/// @file
/// Dual numbers: a value together with its n partial derivatives, so that a function also gives its Jacobian,
/// exact to rounding. They nest: Dual<Dual<double, 2>, 2> gives second derivatives.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <type_traits>

#include "nlmech/program/value_of.hpp"
#include "nlmech/program/vector.hpp"

namespace nlmech {

/// Value and n partial derivatives of a quantity that depends on n variables.
///
/// Arithmetic follows the rules of differentiation; each partial derivative costs a few operations of T, and
/// nothing is allocated. Operations are always inlined, which GCC at -O2 would not do. Against derivatives in
/// 50 digits every function here is right to 8 units in the last place of the largest term of its rule, a
/// power x^p to 8 + |p log x| (tests/series).
///
/// There is no order (<, >): a program branches on value_of() of a dual number.
///
/// Where a function is not differentiable:
/// - sqrt, log and pow at 0 have an infinite slope, which becomes the partial derivative. A partial
///   derivative that is exactly 0 stays 0, not 0 * inf: a variable that the argument does not depend on has
///   no influence.
/// - abs at 0 has the derivative from the right.
/// - Products follow IEEE arithmetic: x * sqrt(x) at 0 gives 0 * inf = NaN although x^1.5 has the derivative
///   0 there; pow(x, 1.5) gives it.
template <class T, int n>
struct Dual {
  static_assert(n >= 1, "a dual number has at least one partial derivative");

  T value{};                   ///< value of the quantity
  std::array<T, n> partial{};  ///< derivative by each of the n variables

  /// Zero, constant.
  constexpr Dual() = default;

  /// A constant: its partial derivatives are zero.
  template <class S>
  requires std::convertible_to<S, T>
  constexpr Dual(const S& constant) : value(static_cast<T>(constant)) {}

  /// The variable number @p index (from 0) where it has the value @p at.
  [[nodiscard]] static constexpr Dual variable(const T& at, int index) {
    Dual x(at);
    x.partial[static_cast<std::size_t>(index)] = T(1);
    return x;
  }

  /// Adds a quantity.
  [[gnu::always_inline]] constexpr Dual& operator+=(const Dual& b) {
    value += b.value;
    for (std::size_t i = 0; i < n; ++i) partial[i] += b.partial[i];
    return *this;
  }
  /// Subtracts a quantity.
  [[gnu::always_inline]] constexpr Dual& operator-=(const Dual& b) {
    value -= b.value;
    for (std::size_t i = 0; i < n; ++i) partial[i] -= b.partial[i];
    return *this;
  }
  /// Multiplies by a quantity.
  [[gnu::always_inline]] constexpr Dual& operator*=(const Dual& b) { return *this = *this * b; }
  /// Divides by a quantity.
  [[gnu::always_inline]] constexpr Dual& operator/=(const Dual& b) { return *this = *this / b; }

  /// Adds a constant.
  template <class S>
  requires std::convertible_to<S, T>
  [[gnu::always_inline]] constexpr Dual& operator+=(const S& s) {
    value += s;
    return *this;
  }
  /// Subtracts a constant.
  template <class S>
  requires std::convertible_to<S, T>
  [[gnu::always_inline]] constexpr Dual& operator-=(const S& s) {
    value -= s;
    return *this;
  }
  /// Multiplies by a constant.
  template <class S>
  requires std::convertible_to<S, T>
  [[gnu::always_inline]] constexpr Dual& operator*=(const S& s) {
    value *= s;
    for (T& p : partial) p *= s;
    return *this;
  }
  /// Divides by a constant.
  template <class S>
  requires std::convertible_to<S, T>
  [[gnu::always_inline]] constexpr Dual& operator/=(const S& s) {
    value /= s;
    for (T& p : partial) p /= s;
    return *this;
  }

  /// The same quantity.
  [[gnu::always_inline]] constexpr Dual operator+() const { return *this; }
  /// Its negative.
  [[gnu::always_inline]] constexpr Dual operator-() const {
    Dual r;
    r.value = -value;
    for (std::size_t i = 0; i < n; ++i) r.partial[i] = -partial[i];
    return r;
  }

  /// Sum.
  [[gnu::always_inline]] friend constexpr Dual operator+(Dual a, const Dual& b) { return a += b; }
  /// Difference.
  [[gnu::always_inline]] friend constexpr Dual operator-(Dual a, const Dual& b) { return a -= b; }
  /// Product.
  [[gnu::always_inline]] friend constexpr Dual operator*(const Dual& a, const Dual& b) {
    Dual r;
    r.value = a.value * b.value;
    for (std::size_t i = 0; i < n; ++i) r.partial[i] = a.value * b.partial[i] + b.value * a.partial[i];
    return r;
  }
  /// Quotient.
  [[gnu::always_inline]] friend constexpr Dual operator/(const Dual& a, const Dual& b) {
    Dual r;
    r.value = a.value / b.value;
    for (std::size_t i = 0; i < n; ++i) r.partial[i] = (a.partial[i] - r.value * b.partial[i]) / b.value;
    return r;
  }

  /// Sum with a constant.
  template <class S>
  requires std::convertible_to<S, T>
  [[gnu::always_inline]] friend constexpr Dual operator+(Dual a, const S& s) { return a += s; }
  /// Sum with a constant.
  template <class S>
  requires std::convertible_to<S, T>
  [[gnu::always_inline]] friend constexpr Dual operator+(const S& s, Dual a) { return a += s; }
  /// Difference with a constant.
  template <class S>
  requires std::convertible_to<S, T>
  [[gnu::always_inline]] friend constexpr Dual operator-(Dual a, const S& s) { return a -= s; }
  /// Difference with a constant.
  template <class S>
  requires std::convertible_to<S, T>
  [[gnu::always_inline]] friend constexpr Dual operator-(const S& s, const Dual& a) { return -a += s; }
  /// Product with a constant.
  template <class S>
  requires std::convertible_to<S, T>
  [[gnu::always_inline]] friend constexpr Dual operator*(Dual a, const S& s) { return a *= s; }
  /// Product with a constant.
  template <class S>
  requires std::convertible_to<S, T>
  [[gnu::always_inline]] friend constexpr Dual operator*(const S& s, Dual a) { return a *= s; }
  /// Quotient by a constant.
  template <class S>
  requires std::convertible_to<S, T>
  [[gnu::always_inline]] friend constexpr Dual operator/(Dual a, const S& s) { return a /= s; }
  /// Quotient of a constant.
  template <class S>
  requires std::convertible_to<S, T>
  [[gnu::always_inline]] friend constexpr Dual operator/(const S& s, const Dual& a) {
    const T quotient = static_cast<T>(s) / a.value;
    return chained(quotient, -quotient / a.value, a);
  }

  /// Are value and all partial derivatives equal?
  friend constexpr bool operator==(const Dual& a, const Dual& b) = default;

  /// A function of @p x by the chain rule: @p value is the function's, @p slope its derivative there. A
  /// partial derivative of 0 stays 0 for any slope.
  [[nodiscard]] static constexpr Dual chained(const T& value, const T& slope, const Dual& x) {
    Dual r(value);
    for (std::size_t i = 0; i < n; ++i) {
      if (!(x.partial[i] == T{})) r.partial[i] = slope * x.partial[i];
    }
    return r;
  }
};

/// The innermost value, for any nesting.
template <class T, int n>
[[nodiscard]] constexpr auto value_of(const Dual<T, n>& x) {
  return value_of(x.value);
}

/// The point @p x as n independent variables, the argument for a Jacobian.
template <class T, int n>
[[nodiscard]] Vector<Dual<T, n>, n> variables(const Vector<T, n>& x) {
  Vector<Dual<T, n>, n> v;
  for (int i = 0; i < n; ++i) v[i] = Dual<T, n>::variable(x[i], i);
  return v;
}

/// The partial derivatives of @p f as a matrix: row i belongs to f_i, column j to the variable j.
template <class T, int n, int rows>
[[nodiscard]] Matrix<T, rows, n> jacobian_of(const Vector<Dual<T, n>, rows>& f) {
  Matrix<T, rows, n> m;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < n; ++j) m(i, j) = f[i].partial[static_cast<std::size_t>(j)];
  }
  return m;
}

}  // namespace nlmech

/// @cond Doxygen cannot follow specialisations of another library's templates
// Traits of dual numbers as entries of Eigen vectors and matrices.
template <class T, int n>
struct Eigen::NumTraits<nlmech::Dual<T, n>> : Eigen::GenericNumTraits<nlmech::Dual<T, n>> {
  using Real = nlmech::Dual<T, n>;        ///< not complex
  using NonInteger = nlmech::Dual<T, n>;  ///< fractions are of the same type
  using Nested = nlmech::Dual<T, n>;      ///< held by value in expressions
  using Literal = nlmech::Dual<T, n>;     ///< type of constants in Eigen's algorithms
  /// Properties for Eigen; costs in units of its cost model.
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = (n + 1) * Eigen::NumTraits<T>::ReadCost,
    AddCost = (n + 1) * Eigen::NumTraits<T>::AddCost,
    MulCost = (2 * n + 1) * Eigen::NumTraits<T>::MulCost
  };
  /// Spacing of numbers at 1, of the value's type.
  static Real epsilon() { return Eigen::NumTraits<T>::epsilon(); }
  /// Tolerance of Eigen for equality.
  static Real dummy_precision() { return Eigen::NumTraits<T>::dummy_precision(); }
  /// Decimal digits of the value's type.
  static int digits10() { return Eigen::NumTraits<T>::digits10(); }
};

/// Operations of numbers with dual numbers give dual numbers.
template <class T, int n, class S, class Operation>
requires std::convertible_to<S, T>
struct Eigen::ScalarBinaryOpTraits<nlmech::Dual<T, n>, S, Operation> {
  using ReturnType = nlmech::Dual<T, n>;  ///< type of the result
};
/// The same with the operands exchanged.
template <class T, int n, class S, class Operation>
requires std::convertible_to<S, T>
struct Eigen::ScalarBinaryOpTraits<S, nlmech::Dual<T, n>, Operation> {
  using ReturnType = nlmech::Dual<T, n>;  ///< type of the result
};
/// @endcond

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

/// Hyperbolic tangent. Its slope is 1/cosh^2, without the cancellation of 1 - tanh^2.
template <class T, int n>
[[nodiscard]] Dual<T, n> tanh(const Dual<T, n>& x) {
  using std::cosh;
  using std::tanh;
  const T secant = 1 / cosh(x.value);
  return Dual<T, n>::chained(tanh(x.value), secant * secant, x);
}

/// Arc sine. Its slope uses (1 - x)(1 + x), without cancellation near the ends; at the ends see Dual.
template <class T, int n>
[[nodiscard]] Dual<T, n> asin(const Dual<T, n>& x) {
  using std::asin;
  using std::sqrt;
  return Dual<T, n>::chained(asin(x.value), 1 / sqrt((1 - x.value) * (1 + x.value)), x);
}

/// Arc cosine; accuracy as asin().
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

/// Angle of the point (x, y), from -pi to pi. At the origin the derivatives are not finite.
template <class T, int n>
[[nodiscard]] Dual<T, n> atan2(const Dual<T, n>& y, const Dual<T, n>& x) {
  using std::abs;
  using std::atan2;
  // In units of the larger coordinate, so that squares do not overflow.
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

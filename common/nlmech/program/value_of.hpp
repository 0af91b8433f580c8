/// @file
/// The value of a number, dual number or power series, for branches of a problem.
#pragma once

namespace nlmech {

/// The leading scalar of @p x. A number (double, long double, a multiprecision type) is returned unchanged;
/// dual numbers and power series have recursive overloads. A piecewise right-hand side compares value_of(t)
/// with the ends of the pieces, because dual numbers and series have no order.
template <class T>
[[nodiscard]] constexpr T value_of(const T& x) {
  return x;
}

}  // namespace nlmech

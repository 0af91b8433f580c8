/// @file
/// The plain number inside a dual number or a power series: what a problem branches on.
#pragma once

namespace nlmech {

/// The leading scalar of @p x. A number (double, long double, a multiprecision type) is its own; dual numbers
/// and power series add overloads, which look inside until they meet a number. Equations whose right-hand
/// side has pieces compare value_of(t) with the ends of the pieces, because dual numbers and series
/// themselves have no order.
template <class T>
[[nodiscard]] constexpr T value_of(const T& x) {
  return x;
}

}  // namespace nlmech

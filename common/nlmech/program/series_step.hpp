/// @file
/// The last terms of a series and the end of a step, for one solution or one per lane of a simd::Pack.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace nlmech {

namespace detail {
/// The operations of simd::Pack on one number. Always inlined: kernels of all instruction sets use them.
/// @{
[[gnu::always_inline]] inline double larger(double a, double b) { return std::max(a, b); }
[[gnu::always_inline]] inline double magnitude(double a) { return std::abs(a); }
/// @}

/// The same number in all lanes.
template <class T>
[[gnu::always_inline]] inline T in_all(double x) {
  if constexpr (std::is_same_v<T, double>)
    return x;
  else
    return T::all(x);
}
}  // namespace detail

/// The last two terms in the norm max_i |e_i| / (atol + rtol |x_i|), and a sum to detect coefficients that
/// are not finite. @tparam T number type
template <class T>
struct SeriesTail {
  T last{};    ///< norm of the term of order N
  T before{};  ///< norm of the term of order N - 1
  T sum{};     ///< sum of the absolute values of the first and last coefficients

  /// Adds a component by its coefficients 0, 1, N - 1 and N.
  [[gnu::always_inline]] void add(T x, T first, T previous, T end, double atol, double rtol) {
    using detail::larger;
    using detail::magnitude;
    const T unit = detail::in_all<T>(1) / (detail::in_all<T>(atol) + detail::in_all<T>(rtol) * magnitude(x));
    last = larger(last, unit * magnitude(end));
    before = larger(before, unit * magnitude(previous));
    sum = sum + (magnitude(end) + magnitude(first));
  }
};

/// Compensated sum x1 = x0 + carry + @p increment of one component; @p next_carry is its rounding error.
template <class T>
[[gnu::always_inline]] inline void add_increment(T x0, T carry, T increment, T& x1, T& next_carry) {
  const T term = carry + increment;
  x1 = x0 + term;
  const T taken = x1 - x0;
  next_carry = (x0 - (x1 - taken)) + (term - taken);
}

}  // namespace nlmech

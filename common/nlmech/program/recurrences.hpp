/// @file
/// The next Taylor coefficient of a product, quotient or elementary function from the previous ones.
///
/// In all functions a and b are the coefficients of the arguments up to k, r those of the result below k.
#pragma once

#include <cmath>
#include <cstddef>

namespace nlmech::recurrence {
// [product and quotient]
/// Coefficient k of a b: the sum of a_i b_{k-i} (Cauchy's product).
template <class T>
[[nodiscard]] T product(const T* a, const T* b, std::size_t k) {
  T sum = a[0] * b[k];
  for (std::size_t i = 1; i <= k; ++i) sum += a[i] * b[k - i];
  return sum;
}

/// Coefficient k of a/b, for b_0 != 0, from a = r b; @p a_k is coefficient k of the numerator.
template <class T>
[[nodiscard]] T quotient(T a_k, const T* b, const T* r, std::size_t k) {
  for (std::size_t i = 1; i <= k; ++i) a_k -= b[i] * r[k - i];
  return a_k / b[0];
}
// [product and quotient]
/// Coefficient k of the root of a, for a_0 != 0, from a = r r.
template <class T>
[[nodiscard]] T root(const T* a, const T* r, std::size_t k) {
  using std::sqrt;
  if (k == 0) return sqrt(a[0]);
  T sum = a[k];
  for (std::size_t i = 1; i < k; ++i) sum -= r[i] * r[k - i];
  return sum / (2 * r[0]);
}

/// Coefficient k - 1 of a' r, the sum of i a_i r_{k-i}, for functions with a differential equation.
template <class T>
[[nodiscard]] T slope_product(const T* a, const T* r, std::size_t k) {
  T sum = T(0);
  for (std::size_t i = 1; i <= k; ++i) sum += static_cast<int>(i) * a[i] * r[k - i];
  return sum;
}

/// Coefficient k of exp(a), from r' = a' r.
template <class T>
[[nodiscard]] T exponential(const T* a, const T* r, std::size_t k) {
  using std::exp;
  if (k == 0) return exp(a[0]);
  return slope_product(a, r, k) / static_cast<int>(k);
}

/// Coefficient k of sin(a), from s' = a' c; @p c are the coefficients of cos(a) below k.
template <class T>
[[nodiscard]] T sine(const T* a, const T* c, std::size_t k) {
  using std::sin;
  if (k == 0) return sin(a[0]);
  return slope_product(a, c, k) / static_cast<int>(k);
}

/// Coefficient k of cos(a), from c' = -a' s; @p s are the coefficients of sin(a) below k.
template <class T>
[[nodiscard]] T cosine(const T* a, const T* s, std::size_t k) {
  using std::cos;
  if (k == 0) return cos(a[0]);
  return -slope_product(a, s, k) / static_cast<int>(k);
}

/// Coefficient k of log(a), for a_0 > 0, from a r' = a'.
template <class T>
[[nodiscard]] T logarithm(const T* a, const T* r, std::size_t k) {
  using std::log;
  if (k == 0) return log(a[0]);
  T sum = static_cast<int>(k) * a[k];
  for (std::size_t i = 1; i < k; ++i) sum -= static_cast<int>(i) * r[i] * a[k - i];
  return sum / (static_cast<int>(k) * a[0]);
}

/// Coefficient k of a^p for a real exponent and a_0 > 0, from a r' = p a' r: O(k) operations for any p.
template <class T, class P>
[[nodiscard]] T power(const T* a, const P& p, const T* r, std::size_t k) {
  using std::pow;
  if (k == 0) return pow(a[0], p);
  T sum = T(0);
  for (std::size_t j = 0; j < k; ++j) {
    sum += (p * static_cast<int>(k - j) - static_cast<int>(j)) * a[k - j] * r[j];
  }
  return sum / (static_cast<int>(k) * a[0]);
}

/// Coefficient k of sinh(a), from s' = a' c; @p c are the coefficients of cosh(a) below k.
template <class T>
[[nodiscard]] T hyperbolic_sine(const T* a, const T* c, std::size_t k) {
  using std::sinh;
  if (k == 0) return sinh(a[0]);
  return slope_product(a, c, k) / static_cast<int>(k);
}

/// Coefficient k of cosh(a), from c' = a' s; @p s are the coefficients of sinh(a) below k.
template <class T>
[[nodiscard]] T hyperbolic_cosine(const T* a, const T* s, std::size_t k) {
  using std::cosh;
  if (k == 0) return cosh(a[0]);
  return slope_product(a, s, k) / static_cast<int>(k);
}

/// Coefficient k of tan(a), from r' = a' g; @p g are the coefficients of 1 + tan^2(a) below k.
template <class T>
[[nodiscard]] T tangent(const T* a, const T* g, std::size_t k) {
  using std::tan;
  if (k == 0) return tan(a[0]);
  return slope_product(a, g, k) / static_cast<int>(k);
}

/// Coefficient k of tanh(a), from r' = a' g; @p g are the coefficients of 1 - tanh^2(a) below k.
template <class T>
[[nodiscard]] T hyperbolic_tangent(const T* a, const T* g, std::size_t k) {
  using std::tanh;
  if (k == 0) return tanh(a[0]);
  return slope_product(a, g, k) / static_cast<int>(k);
}

}  // namespace nlmech::recurrence

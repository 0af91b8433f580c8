/// @file
/// Zeros of the Jacobi polynomials, of which the nodes of Gauss, Radau and Lobatto are special cases.
#pragma once

#include <cmath>
#include <limits>

#include "nlmech/collocation/matrix.hpp"

namespace nlmech::collocation {

/// P_m^(a,b) and its derivative at one point.
template <class T>
struct JacobiValue {
  T value;       ///< P_m^(a,b)(x)
  T derivative;  ///< dP_m^(a,b)/dx
};

/// Evaluates the Jacobi polynomial of degree @p m >= 0, orthogonal on [-1, 1] to the weight (1-x)^a (1+x)^b,
/// by the three-term recurrence in the degree (Abramowitz & Stegun 22.7.1) and 22.8.1 for the derivative.
/// @param a,b 0 or 1
/// @param x   -1 < x < 1
template <class T>
[[nodiscard]] JacobiValue<T> jacobi(int m, int a, int b, const T& x) {
  if (m == 0) return {T(1), T(0)};
  T previous = 1, value = (T(a - b) + T(a + b + 2) * x) / T(2);
  for (int k = 1; k < m; ++k) {
    const int s = 2 * k + a + b;
    const T next = (T(s + 1) * (T(a * a - b * b) + T(s * (s + 2)) * x) * value -
                    T(2 * (k + a) * (k + b) * (s + 2)) * previous) /
                   T(2 * (k + 1) * (k + 1 + a + b) * s);
    previous = value;
    value = next;
  }
  const int s = 2 * m + a + b;
  const T slope =
      (T(m) * (T(a - b) - T(s) * x) * value + T(2 * (m + a) * (m + b)) * previous) / (T(s) * (1 - x * x));
  return {value, slope};
}

/// All zeros of P_m^(a,b), ascending; for a = b exactly symmetric, with an exact zero in the middle of an odd
/// number of them.
///
/// Newton's iteration from the leading term of the asymptotic expansion for large m,
///     arccos x_j = (4 j + 2 a - 1)/(2 m + a + b + 1) pi/2.
///
/// Accuracy: 2e-16 in double, for m up to max_nodes.
/// @param m   0 to max_nodes
/// @param a,b 0 or 1
template <class T>
[[nodiscard]] Vector<T> jacobi_zeros(int m, int a, int b) {
  using std::abs, std::acos, std::cos, std::sqrt;
  // The error of an iterate is at most about m^2 times the square of the step that led to it.
  const T pi = acos(T(-1)), last_step = sqrt(std::numeric_limits<T>::epsilon()) / T(m * m + 1);
  constexpr int most_steps = 20;  // never taken: there are 3 in double, 5 with 50 digits
  Vector<T> zeros(m);
  for (int j = 1; j <= m; ++j) {
    if (a == b && 2 * j > m) break;
    T x = cos(T(4 * j + 2 * a - 1) * pi / T(2 * (2 * m + a + b + 1)));
    for (int n = 0; n < most_steps; ++n) {
      const auto [value, slope] = jacobi(m, a, b, x);
      const T step = value / slope;
      x -= step;
      if (abs(step) <= last_step) break;
    }
    zeros[m - j] = x;
  }
  if (a == b) {
    for (int j = 0; j < m / 2; ++j) zeros[j] = -zeros[m - 1 - j];
    if (m % 2 == 1) zeros[m / 2] = 0;
  }
  return zeros;
}

}  // namespace nlmech::collocation

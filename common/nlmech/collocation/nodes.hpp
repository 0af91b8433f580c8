/// @file
/// Families of collocation nodes on [-1, 1].
///
/// All are ascending; symmetric families are exactly symmetric, and ends are exact. In double the error of
/// every node is at most 2e-16 for all n up to max_nodes. With another real type T they have the digits of T.
#pragma once

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "nlmech/collocation/matrix.hpp"

namespace nlmech::collocation {

/// Jacobi polynomial P_m^(a,b) and its derivative at one point.
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

/// All zeros of P_m^(a,b), ascending; for a = b exactly symmetric, with an exact zero in the middle if m is
/// odd.
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
  // The error of an iterate is at most about m^2 times the square of the last step.
  const T pi = acos(T(-1)), last_step = sqrt(std::numeric_limits<T>::epsilon()) / T(m * m + 1);
  constexpr int most_steps = 20;  // never reached: double needs 3 steps, 50 digits need 5
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

/// The n Legendre-Gauss nodes: zeros of the Legendre polynomial P_n. Their quadrature is exact up to degree
/// 2n - 1.
/// @throws std::invalid_argument unless 1 <= @p n <= max_nodes
template <class T = double>
[[nodiscard]] Vector<T> legendre_gauss(int n) {
  require_node_count("legendre_gauss", n, 1);
  return jacobi_zeros<T>(n, 0, 0);
}

/// The n Legendre-Gauss-Lobatto nodes (LGL): -1, 1 and the zeros of P'_{n-1} (Eq. 4.9, where N = n - 1).
/// Their quadrature is exact up to degree 2n - 3.
/// @throws std::invalid_argument unless 2 <= @p n <= max_nodes
template <class T = double>
[[nodiscard]] Vector<T> legendre_gauss_lobatto(int n) {
  require_node_count("legendre_gauss_lobatto", n, 2);
  Vector<T> nodes(n);
  nodes[0] = -1;
  nodes.segment(1, n - 2) = jacobi_zeros<T>(n - 2, 1, 1);  // P'_{n-1} is P_{n-2}^(1,1), up to a factor
  nodes[n - 1] = 1;
  return nodes;
}

/// The n Radau nodes that include the right end: zeros of P_n - P_{n-1}, as in Radau IIA with n stages. Their
/// quadrature is exact up to degree 2n - 2.
/// @throws std::invalid_argument unless 1 <= @p n <= max_nodes
template <class T = double>
[[nodiscard]] Vector<T> radau_right(int n) {
  require_node_count("radau_right", n, 1);
  Vector<T> nodes(n);
  nodes.head(n - 1) = jacobi_zeros<T>(n - 1, 1, 0);  // P_n - P_{n-1} is (x - 1) P_{n-1}^(1,0)
  nodes[n - 1] = 1;
  return nodes;
}

/// -1, followed by radau_right(n - 1). Collocation with the initial value at the first node is Radau IIA with
/// n - 1 stages.
/// @throws std::invalid_argument unless 2 <= @p n <= max_nodes
template <class T = double>
[[nodiscard]] Vector<T> left_end_and_radau(int n) {
  require_node_count("left_end_and_radau", n, 2);
  Vector<T> nodes(n);
  nodes[0] = -1;
  nodes.tail(n - 1) = radau_right<T>(n - 1);
  return nodes;
}

/// The n Chebyshev-Gauss-Lobatto nodes (CGL): -cos(pi j/(n - 1)), the extrema of the Chebyshev polynomial
/// T_{n-1}.
/// @throws std::invalid_argument unless 2 <= @p n <= max_nodes
template <class T = double>
[[nodiscard]] Vector<T> chebyshev_gauss_lobatto(int n) {
  using std::acos, std::sin;
  require_node_count("chebyshev_gauss_lobatto", n, 2);
  const T pi = acos(T(-1));
  Vector<T> nodes(n);
  // The sine makes the nodes exactly antisymmetric in floating point.
  for (int j = 0; j < n; ++j) nodes[j] = sin(T(2 * j - n + 1) * pi / T(2 * (n - 1)));
  nodes[0] = -1;
  nodes[n - 1] = 1;
  return nodes;
}

/// Families of nodes that include both ends of the interval.
enum class NodeFamily {
  legendre_gauss_lobatto,  ///< as in the dissertation (Eq. 4.9)
  left_end_and_radau,      ///< order 2n - 3 and L-stable, where the others reach n - 1
  chebyshev_gauss_lobatto  ///< as in modified Chebyshev-Picard iteration
};

/// As on a command line: "legendre-gauss-lobatto".
[[nodiscard]] std::string_view to_string(NodeFamily family);

/// The n nodes of a family.
/// @throws std::invalid_argument unless 2 <= @p n <= max_nodes
template <class T = double>
[[nodiscard]] Vector<T> nodes(NodeFamily family, int n) {
  switch (family) {
    case NodeFamily::legendre_gauss_lobatto: return legendre_gauss_lobatto<T>(n);
    case NodeFamily::left_end_and_radau: return left_end_and_radau<T>(n);
    case NodeFamily::chebyshev_gauss_lobatto: return chebyshev_gauss_lobatto<T>(n);
  }
  throw std::invalid_argument("nodes: no such family");
}

/// @cond instances compiled in the library
extern template Vector<double> jacobi_zeros(int m, int a, int b);
/// @endcond

}  // namespace nlmech::collocation

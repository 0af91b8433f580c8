/// @file
/// Where on an interval the equations are collocated: families of nodes on [-1, 1].
///
/// All are ascending; symmetric families are so exactly, and ends are exact. In double every node is within
/// 2e-16 of the true one, for all n up to max_nodes. With another real type T they have the digits of T.
#pragma once

#include <stdexcept>
#include <string_view>

#include "nlmech/collocation/jacobi.hpp"

namespace nlmech::collocation {

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
  nodes.segment(1, n - 2) = jacobi_zeros<T>(n - 2, 1, 1);  // P'_{n-1} is P_{n-2}^(1,1), but for a factor
  nodes[n - 1] = 1;
  return nodes;
}

/// The n Radau nodes that include the right end: zeros of P_n - P_{n-1}, as in the method Radau IIA of n
/// stages. Their quadrature is exact up to degree 2n - 2.
/// @throws std::invalid_argument unless 1 <= @p n <= max_nodes
template <class T = double>
[[nodiscard]] Vector<T> radau_right(int n) {
  require_node_count("radau_right", n, 1);
  Vector<T> nodes(n);
  nodes.head(n - 1) = jacobi_zeros<T>(n - 1, 1, 0);  // P_n - P_{n-1} is (x - 1) P_{n-1}^(1,0)
  nodes[n - 1] = 1;
  return nodes;
}

/// -1, followed by radau_right(n - 1). Collocation with the initial value at the first of them is Radau IIA
/// of n - 1 stages.
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
  // As a sine the nodes are antisymmetric in floating point too.
  for (int j = 0; j < n; ++j) nodes[j] = sin(T(2 * j - n + 1) * pi / T(2 * (n - 1)));
  nodes[0] = -1;
  nodes[n - 1] = 1;
  return nodes;
}

/// A choice among the families that include both ends of the interval.
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

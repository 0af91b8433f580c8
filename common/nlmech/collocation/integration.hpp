/// @file
/// Integration matrices: from the values of a function at nodes to those of its integral.
#pragma once

#include "nlmech/collocation/barycentric.hpp"
#include "nlmech/collocation/nodes.hpp"

namespace nlmech::collocation {

/// Integration matrix S_ij = integral of l_j from -1 to tau_i, where l_j is the polynomial of degree n - 1
/// that is 1 at node j and 0 at the others. For an interval of length h multiply by h/2.
///
/// Between adjacent nodes the Gauss rule that is exact for l_j is used. If the last node is 1, the last row
/// contains the quadrature weights of the nodes.
/// @param nodes ascending, 1 to max_nodes of them, within [-1, 1]; -1 need not be a node
/// @throws std::invalid_argument if the nodes are too many, not ascending or outside [-1, 1]
///
/// Accuracy: 1e-15 for n up to max_nodes in all families of nodes.hpp. If the l_j become large, as for many
/// equidistant nodes, the error grows in proportion.
template <class T>
[[nodiscard]] Matrix<T> integration_matrix(const Vector<T>& nodes) {
  const Vector<T> weights = barycentric_weights(nodes);
  const Eigen::Index n = nodes.size();
  if (nodes[0] < T(-1)) refuse_node("integration_matrix", 0, static_cast<double>(nodes[0]), "is below -1");
  if (nodes[n - 1] > T(1)) {
    refuse_node("integration_matrix", n - 1, static_cast<double>(nodes[n - 1]), "is above 1");
  }
  const int points = static_cast<int>(n + 1) / 2;
  const Vector<T> gauss = legendre_gauss<T>(points);
  Matrix<T> S(n, n);
  RowVector<T> sum = RowVector<T>::Zero(n), row(n);
  T left = -1;
  for (Eigen::Index i = 0; i < n; ++i) {
    const T half = (nodes[i] - left) / 2, middle = (nodes[i] + left) / 2;
    for (const T& x : gauss) {
      const T slope = jacobi(points, 0, 0, x).derivative;
      polynomial_row(nodes, weights, T(middle + half * x), row);
      sum += (half * 2 / ((1 - x * x) * slope * slope)) * row;
    }
    S.row(i) = sum;
    left = nodes[i];
  }
  return S;
}

/// Throws std::invalid_argument unless 0 <= @p degree < @p n.
void require_chebyshev_degree(int n, int degree);

/// Integration matrix of modified Chebyshev-Picard iteration: maps the values of g at the n CGL nodes to
/// those of the integral from -1 of the Chebyshev series of g, truncated to a degree. For an interval of
/// length h multiply by h/2; the result is x - x_0.
///
/// The coefficients of g follow from the discrete orthogonality of the T_k on N + 1 = n nodes,
///     c_k = 2/N sum'' g(tau_j) T_k(tau_j),      with the first and last terms of the sum halved, and c_0 and
///     c_N halved,
/// and integral T_k = (T_{k+1}/(k+1) - T_{k-1}/(k-1))/2 + const for k > 1.
///
/// A series of x of order M has M + 1 nodes and g of degree M - 1: chebyshev_picard_matrix(M + 1, M - 1).
/// @param n      number of nodes, 2 to max_nodes
/// @param degree highest degree of g after truncation, 0 to n - 1. For n - 1 the matrix is
/// integration_matrix(chebyshev_gauss_lobatto(n))
/// @throws std::invalid_argument if an argument is out of range
///
/// Accuracy: 1e-15 for n up to max_nodes.
template <class T = double>
[[nodiscard]] Matrix<T> chebyshev_picard_matrix(int n, int degree) {
  const Vector<T> nodes = chebyshev_gauss_lobatto<T>(n);
  require_chebyshev_degree(n, degree);
  const int N = n - 1;
  // T_k(tau_j) = cos(k (N - j) pi/N) is the node N - m, where m = k (N - j), folded into 0..N.
  const auto chebyshev = [&nodes, N](int k, int j) -> const T& {
    const int m = k * (N - j) % (2 * N);
    return nodes[m <= N ? N - m : m - N];
  };
  Matrix<T> S = Matrix<T>::Zero(n, n);
  for (int k = 0; k <= degree; ++k) {
    RowVector<T> coefficient(n);  // c_k = coefficient * g
    for (int j = 0; j <= N; ++j) coefficient[j] = chebyshev(k, j) * T(2) / T(N);
    coefficient[0] /= 2;
    coefficient[N] /= 2;
    if (k == 0 || k == N) coefficient /= T(2);
    for (int i = 0; i <= N; ++i) {
      const T at_least = k % 2 == 0 ? 1 : -1;  // T_k(-1)
      const T integral = k == 0   ? T(nodes[i] + 1)
                         : k == 1 ? T((nodes[i] - 1) * (nodes[i] + 1) / 2)
                                  : T((chebyshev(k + 1, i) / T(k + 1) - chebyshev(k - 1, i) / T(k - 1)) / 2 -
                                      at_least / T(k * k - 1));
      S.row(i) += integral * coefficient;
    }
  }
  return S;
}

}  // namespace nlmech::collocation

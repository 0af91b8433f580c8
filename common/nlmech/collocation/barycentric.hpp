/// @file
/// Polynomial interpolation at given nodes: values and differentiation matrix.
///
/// The interpolant is the limit c -> 0 of the radial functions (Driscoll & Fornberg 2002), without shape
/// parameter and matrix inverse. Barycentric form: Berrut & Trefethen, SIAM Review 46 (2004).
#pragma once

#include <cmath>
#include <limits>

#include "nlmech/collocation/matrix.hpp"

namespace nlmech::collocation {

/// Barycentric weights w_j = 1/prod_{k != j} 4 (t_j - t_k)/L, where L is the distance between the first and
/// the last node. The factor 4/L scales the interval to capacity 1, which avoids overflow and underflow.
/// @param nodes times or points, ascending; 1 to max_nodes of them
/// @throws std::invalid_argument if the nodes are too many, not finite, not ascending, or so close to each
/// other that a weight overflows
///
/// Relative accuracy of each weight: 2 n times 2.2e-16.
template <class T>
[[nodiscard]] Vector<T> barycentric_weights(const Vector<T>& nodes) {
  require_nodes("barycentric_weights", nodes);
  const Eigen::Index n = nodes.size();
  const T length = nodes[n - 1] - nodes[0];
  Vector<T> weights(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    T product = 1;
    for (Eigen::Index k = 0; k < n; ++k) {
      if (k != j) product *= (nodes[j] - nodes[k]) / length * 4;
    }
    weights[j] = 1 / product;
    if (!is_finite(weights[j])) {
      refuse_node("barycentric_weights", j, static_cast<double>(nodes[j]), "is too close to another one");
    }
  }
  return weights;
}

/// Differentiation matrix D: maps the values of a polynomial of degree < n at the nodes to those of its
/// derivative.
/// @param nodes times, ascending; 1 to max_nodes of them
/// @return n by n, 1/time. The sum of each row is zero up to its rounding, so constants have zero derivative.
/// For LGL nodes on an interval of length 1, |D 1| is below 8e-15 (n = 7) to 8e-12 (n = 100).
/// @throws std::invalid_argument as barycentric_weights, and if an entry overflows
template <class T>
[[nodiscard]] Matrix<T> polynomial_differentiation_matrix(const Vector<T>& nodes) {
  const Vector<T> weights = barycentric_weights(nodes);
  const Eigen::Index n = nodes.size();
  Matrix<T> D(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    T sum = 0;
    for (Eigen::Index j = 0; j < n; ++j) {
      if (j == i) continue;
      D(i, j) = weights[j] / weights[i] / (nodes[i] - nodes[j]);
      sum += D(i, j);
    }
    D(i, i) = -sum;
    if (!is_finite(sum)) {
      refuse_node("polynomial_differentiation_matrix", i, static_cast<double>(nodes[i]),
                  "is too close to another one");
    }
  }
  return D;
}

/// Interpolation row r: r X is the value at @p t of the polynomial with the values X at the nodes. At a node
/// it is exactly a row of the unit matrix.
/// @param nodes   as given to barycentric_weights
/// @param weights result of barycentric_weights(nodes)
/// @param t       finite time; outside the interval of the nodes the polynomial is extrapolated
/// @param row     the result; no allocation if it has n entries
/// @throws std::invalid_argument if @p t is not finite
///
/// Accuracy, for the families of nodes.hpp: inside the interval the error is at most 5 n times 2.2e-16 for
/// polynomials with values between -1 and 1; outside, the relative error of each entry of the row is at most
/// 4 n times 2.2e-16.
template <class T>
void polynomial_row(const Vector<T>& nodes, const Vector<T>& weights, const T& t, RowVector<T>& row) {
  using std::abs;
  require_time("polynomial_row", t);
  const Eigen::Index n = nodes.size();
  row.resize(n);
  if (n > 1 && (t < nodes[0] || t > nodes[n - 1])) {
    // r_k = w_k l(t)/(t - t_k), l(t) = prod (t - t_k): without the cancellation of the formula below.
    const T unit = (nodes[n - 1] - nodes[0]) / 4;
    T product = 1;
    for (const T& node : nodes) product *= (t - node) / unit;
    for (Eigen::Index k = 0; k < n; ++k) row[k] = weights[k] * (product / ((t - nodes[k]) / unit));
    return;
  }
  // r_k = w_k/(t - t_k)/sum, with the sum of all w_j/(t - t_j), because sum r_k = 1.
  T sum = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const T distance = t - nodes[k];
    if (abs(distance) <= std::numeric_limits<T>::min()) {
      row.setZero();
      row[k] = 1;
      return;
    }
    row[k] = weights[k] / distance;
    sum += row[k];
  }
  row /= sum;
}

}  // namespace nlmech::collocation

/// @file
/// Vector and matrix types of the component, and checks of nodes.
#pragma once

#include <Eigen/Core>

namespace nlmech::collocation {

/// Column of run-time length. T is double or another real scalar type of Eigen, such as one with 50 digits.
template <class T>
using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;

/// Row of run-time length.
template <class T>
using RowVector = Eigen::Matrix<T, 1, Eigen::Dynamic>;

/// Matrix of run-time size.
template <class T>
using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

/// Largest number of nodes on one interval. The accuracies stated in this component hold up to this number.
inline constexpr int max_nodes = 200;

/// Neither infinite nor NaN; for every real type.
template <class T>
[[nodiscard]] bool is_finite(const T& x) {
  return x - x == T(0);  // NOLINT(misc-redundant-expression): NaN for infinity and NaN
}

/// Throws std::invalid_argument unless @p least <= @p n <= max_nodes; the text names @p what and n.
void require_node_count(const char* what, Eigen::Index n, int least);

/// Throws std::invalid_argument with a text that names @p what and the node number @p k (from 0) at @p node.
[[noreturn]] void refuse_node(const char* what, Eigen::Index k, double node, const char* why);

/// Throws std::invalid_argument with a text that names @p what and the time @p t, which is not finite.
[[noreturn]] void refuse_time(const char* what, double t);

/// Throws std::invalid_argument unless there are 1 to max_nodes nodes, finite and strictly ascending.
template <class T>
void require_nodes(const char* what, const Vector<T>& nodes) {
  require_node_count(what, nodes.size(), 1);
  for (Eigen::Index k = 0; k < nodes.size(); ++k) {
    if (!is_finite(nodes[k])) {
      refuse_node(what, k, static_cast<double>(nodes[k]), "is not finite");
    }
    if (k > 0 && !(nodes[k] > nodes[k - 1])) {
      refuse_node(what, k, static_cast<double>(nodes[k]), "is not larger than the one before it");
    }
  }
}

/// Throws std::invalid_argument unless the time @p t is finite.
template <class T>
void require_time(const char* what, const T& t) {
  if (!is_finite(t)) refuse_time(what, static_cast<double>(t));
}

}  // namespace nlmech::collocation

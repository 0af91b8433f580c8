/// @file
/// Aliases of Eigen vectors and matrices of fixed size.
#pragma once

#include <Eigen/Core>

namespace nlmech {

/// Column of n numbers of type T. With fixed n it allocates nothing.
template <class T, int n>
using Vector = Eigen::Matrix<T, n, 1>;

/// Matrix of numbers of type T, stored by columns; square by default.
template <class T, int rows, int columns = rows>
using Matrix = Eigen::Matrix<T, rows, columns>;

}  // namespace nlmech

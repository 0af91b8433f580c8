/// @file
/// Vectors and matrices of fixed size: Eigen's, under two short names.
#pragma once

#include <Eigen/Core>

namespace nlmech {

/// Column of n numbers of type T. With fixed n it lives on the stack and allocates nothing.
template <class T, int n>
using Vector = Eigen::Matrix<T, n, 1>;

/// Matrix of numbers of type T, stored by columns; square unless told otherwise.
template <class T, int rows, int columns = rows>
using Matrix = Eigen::Matrix<T, rows, columns>;

}  // namespace nlmech

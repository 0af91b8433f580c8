/// @file
/// Traits of the number types of this component as entries of Eigen vectors and matrices.
#pragma once

#include <Eigen/Core>

namespace nlmech::detail {

/// Base of Eigen::NumTraits<T> for a real, signed number that is expensive to copy. Costs are in units of
/// Eigen's cost model.
template <class T, int read, int add, int multiply>
struct NumberTraits : Eigen::GenericNumTraits<T> {
  using Real = T;        ///< not complex
  using NonInteger = T;  ///< fractions are of the same type
  using Nested = T;      ///< held by value in expressions
  using Literal = T;     ///< type of constants in Eigen's algorithms
  /// Properties for Eigen.
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = read,
    AddCost = add,
    MulCost = multiply
  };
};

}  // namespace nlmech::detail

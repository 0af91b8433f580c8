/// @file
/// The state of a system.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "nlmech/program/vector.hpp"

namespace nlmech::ivp {

/// State vector: an Eigen vector of dynamic size that is constructed from its components, as `State{1, 0}`.
/// (Eigen::VectorXd takes two numbers in braces as the numbers of rows and columns.)
template <class T>
class BasicState : public Vector<T, Eigen::Dynamic> {
 public:
  using Base = Vector<T, Eigen::Dynamic>;  ///< Eigen type

  /// No components.
  BasicState() = default;
  /// @p size uninitialised components. Integers only: State(1.0) does not compile.
  explicit BasicState(std::integral auto size) : Base(static_cast<Eigen::Index>(size)) {}
  /// From its components.
  BasicState(std::initializer_list<T> x) : Base(static_cast<Eigen::Index>(x.size())) {
    std::copy(x.begin(), x.end(), this->begin());
  }
  /// The value of an expression.
  template <class Derived>
  BasicState(const Eigen::EigenBase<Derived>& x) : Base(x) {}
  /// The value of an expression.
  template <class Derived>
  BasicState& operator=(const Eigen::EigenBase<Derived>& x) {
    Base::operator=(x);
    return *this;
  }
};
/// The state of a system.
using State = BasicState<double>;
/// State in long double (18 digits), for references.
using LongState = BasicState<long double>;

/// States at many nodes, one per column.
using Nodes = Eigen::MatrixXd;
/// df/dx.
using Jacobian = Eigen::MatrixXd;
/// Cell of each switching function: 1 where it is positive, -1 where it is negative; 2 n + 1 between n and n
/// + 1 for a function that switches at every integer. Even, 0 or 2 n, for a motion that stays on the surface.
using Mode = std::vector<int>;

}  // namespace nlmech::ivp

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

/// A column of numbers: Eigen's vector of run-time length, made of its components as `State{1, 0}`. (An
/// Eigen::VectorXd would take two numbers in braces for a count of rows and of columns.)
template <class T>
class BasicState : public Vector<T, Eigen::Dynamic> {
 public:
  using Base = Vector<T, Eigen::Dynamic>;  ///< what it is to Eigen

  /// No components.
  BasicState() = default;
  /// So many components, not set. Of whole numbers alone: State(1.0) is no state.
  explicit BasicState(std::integral auto size) : Base(static_cast<Eigen::Index>(size)) {}
  /// Of these components.
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
/// The same to some 18 digits, for references.
using LongState = BasicState<long double>;

/// States at many nodes, one a column.
using Nodes = Eigen::MatrixXd;
/// df/dx.
using Jacobian = Eigen::MatrixXd;
/// On which side of each surface a system switches: 1 where its function is positive, -1 where it is
/// negative, 0 for a motion that stays on the surface.
using Mode = std::vector<std::int8_t>;

}  // namespace nlmech::ivp

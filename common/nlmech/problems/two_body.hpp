/// @file
/// The relative motion of two bodies, for integrators of equations in general; the component orbit knows more
/// of it.
#pragma once

#include <array>
#include <cmath>
#include <string_view>

#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// q'' = -mu q/|q|^3 (Elgohary 2015, Eq. 3.67). State (x1, x2, x3, v1, v2, v3).
struct TwoBody {
  static constexpr int dimension = 6;                   ///< three positions, then three velocities
  using compiled_once = TwoBody;                        ///< its System is compiled in the library
  static constexpr std::string_view name = "two-body";  ///< on command lines and in tables
  static constexpr double initial_time = 0;             ///< t_0
  static constexpr double final_time = 124363.0;        ///< twenty of the low orbits, in seconds
  double mu = 3.986004418e14;                           ///< gravitational parameter, positive

  /// The equation as one types it.
  static constexpr std::string_view equation = "q'' = -mu q/|q|^3";

  /// By name.
  static constexpr std::array parameters = {Parameter<TwoBody>{"mu", &TwoBody::mu}};

  /// The low orbit of Eq. 3.71, in metres and seconds.
  [[nodiscard]] static Vector<double, 6> initial_state() {
    return {1.702547136867679e6, 6.353992417071098e6, 0, -7.886014053829254e3, 2.113051097224035e3, 0};
  }

  /// a = -mu q/|q|^3.
  template <class T>
  void acceleration(const T& /*t*/, const Vector<T, 3>& q, const Vector<T, 3>& /*v*/, Vector<T, 3>& a) const {
    using std::sqrt;
    const T square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
    const T factor = -mu / (square * sqrt(square));
    for (int i = 0; i < 3; ++i) a[i] = factor * q[i];
  }
  /// The equation of first order.
  template <class T>
  void operator()(const T& t, const Vector<T, 6>& x, Vector<T, 6>& dxdt) const {
    first_order_form(*this, t, x, dxdt);
  }
};

}  // namespace nlmech::problems

/// @file
/// Van der Pol's oscillator: a limit cycle that becomes stiff with its parameter.
#pragma once

#include <array>
#include <string_view>

#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// x'' - mu (1 - x^2) x' + x = 0 (B. van der Pol, On relaxation-oscillations, Phil. Mag. (7) 2 (1926)
/// 978-992). State (x, v).
///
/// For large mu the solution creeps along v = x/(mu (1 - x^2)), where the second eigenvalue is close to
/// mu (1 - x^2), and jumps at |x| = 1 to the other side: half a period takes about (3/2 - ln 2) mu.
struct VanDerPol {
  static constexpr int dimension = 2;                      ///< position and velocity
  using compiled_once = VanDerPol;                         ///< its System is compiled in the library
  static constexpr std::string_view name = "van-der-pol";  ///< on command lines and in tables
  static constexpr double initial_time = 0;                ///< t_0
  static constexpr double final_time = 20;                 ///< four jumps for mu = 10 lie in between
  double mu = 10;                                          ///< strength of the damping; 0 or more

  /// The equation as one types it.
  static constexpr std::string_view equation = "x'' - mu (1 - x^2) x' + x = 0";

  /// By name.
  static constexpr std::array parameters = {Parameter<VanDerPol>{"mu", &VanDerPol::mu}};

  /// The usual start x(0) = 2, v(0) = 0.
  [[nodiscard]] static Vector<double, 2> initial_state() { return {2, 0}; }

  /// a = mu (1 - q^2) v - q.
  template <class T>
  void acceleration(const T& /*t*/, const Vector<T, 1>& q, const Vector<T, 1>& v, Vector<T, 1>& a) const {
    a[0] = mu * ((1 - q[0] * q[0]) * v[0]) - q[0];
  }

  /// dx/dt for the state x = (position, velocity).
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    first_order_form(*this, t, x, dxdt);
  }
};

}  // namespace nlmech::problems

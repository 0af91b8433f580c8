/// @file
/// A pendulum whose rod is a stiff spring with a damper: slow swings beside a motion that dies out at once.
#pragma once

#include <array>
#include <cmath>
#include <string_view>

#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// m q'' = -(k (r - L) + c r') q/r - (0, m g), r = |q|, for a mass that hangs on a spring with a damper along
/// it. State (x1, x2, v1, v2), x2 upwards from the pivot.
///
/// With the default values the spring's own motion has the rates -101 and -9899, and the pendulum swings once
/// in two seconds: stiff. Without damping its frequency is sqrt(k/m).
struct SpringPendulum {
  static constexpr int dimension = 4;                          ///< two positions, then two velocities
  using compiled_once = SpringPendulum;                        ///< its System is compiled in the library
  static constexpr std::string_view name = "spring-pendulum";  ///< on command lines and in tables
  static constexpr double initial_time = 0;                    ///< t_0
  static constexpr double final_time = 10;                     ///< s, some four swings
  double mass = 1;                                             ///< m, kg
  double length = 1;                                           ///< L, of the spring at rest, m
  double stiffness = 1e6;                                      ///< k, N/m
  double damping = 1e4;                                        ///< c, along the spring, N s/m
  double gravity = 9.81;                                       ///< g, m/s^2

  /// The equation as one types it.
  static constexpr std::string_view equation =
      "m q'' = -(k (r - L) + c r') q/r - (0, m g), r = |q|; m mass, L length, k stiffness, c damping, g "
      "gravity";

  /// By name.
  static constexpr std::array parameters = {
      Parameter<SpringPendulum>{"mass", &SpringPendulum::mass, Range::positive},
      Parameter<SpringPendulum>{"length", &SpringPendulum::length, Range::positive},
      Parameter<SpringPendulum>{"stiffness", &SpringPendulum::stiffness},
      Parameter<SpringPendulum>{"damping", &SpringPendulum::damping},
      Parameter<SpringPendulum>{"gravity", &SpringPendulum::gravity}};

  /// Held out to the side, the spring at rest.
  [[nodiscard]] Vector<double, 4> initial_state() const { return {length, 0, 0, 0}; }

  /// Acceleration of the mass.
  template <class T>
  void acceleration(const T& /*t*/, const Vector<T, 2>& q, const Vector<T, 2>& v, Vector<T, 2>& a) const {
    using std::sqrt;
    const T square = q[0] * q[0] + q[1] * q[1], r = sqrt(square);
    // The force along q over r, for q/r and r' = q v/r.
    const T force = (stiffness * (r - length) + damping * (q[0] * v[0] + q[1] * v[1]) / r) / (mass * r);
    a[0] = -force * q[0];
    a[1] = -force * q[1] - gravity;
  }

  /// dx/dt for the state x = (positions, velocities).
  template <class T>
  void operator()(const T& t, const Vector<T, 4>& x, Vector<T, 4>& dxdt) const {
    first_order_form(*this, t, x, dxdt);
  }

  /// Kinetic and potential energy, which the damper alone lessens.
  template <class T>
  [[nodiscard]] T energy(const Vector<T, 4>& x) const {
    using std::sqrt;
    const T stretch = sqrt(T(x[0] * x[0] + x[1] * x[1])) - length;
    return mass / 2 * (x[2] * x[2] + x[3] * x[3]) + stiffness / 2 * (stretch * stretch) +
           mass * gravity * x[1];
  }
};

}  // namespace nlmech::problems

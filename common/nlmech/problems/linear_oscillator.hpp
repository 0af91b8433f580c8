/// @file
/// The linear oscillator, damped and driven: the problem whose solution every method can be held to.
#pragma once

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// x'' + 2 zeta w x' + w^2 x = F cos(W t). State (x, v).
struct LinearOscillator {
  static constexpr int dimension = 2;                 ///< position and velocity
  using compiled_once = LinearOscillator;             ///< its System is compiled in the library
  static constexpr std::string_view name = "linear";  ///< on command lines and in tables
  static constexpr double initial_time = 0;           ///< t_0
  static constexpr double final_time = 10;            ///< some periods
  double natural_frequency = 1;                       ///< w, rad/time
  double damping_ratio = 0;                           ///< zeta
  double force = 0;                                   ///< F
  double frequency = 1;                               ///< W of the force, rad/time

  /// The equation as one types it.
  static constexpr std::string_view equation =
      "x'' + 2 z w x' + w^2 x = F cos(W t); w natural-frequency, z damping-ratio, F "
      "force, W frequency";

  /// By name.
  static constexpr std::array parameters = {
      Parameter<LinearOscillator>{"natural-frequency", &LinearOscillator::natural_frequency},
      Parameter<LinearOscillator>{"damping-ratio", &LinearOscillator::damping_ratio},
      Parameter<LinearOscillator>{"force", &LinearOscillator::force},
      Parameter<LinearOscillator>{"frequency", &LinearOscillator::frequency}};

  /// x(0) = 1, v(0) = 0.
  [[nodiscard]] static Vector<double, 2> initial_state() { return {1, 0}; }

  /// a = F cos(W t) - 2 zeta w v - w^2 q.
  template <class T>
  void acceleration(const T& t, const Vector<T, 1>& q, const Vector<T, 1>& v, Vector<T, 1>& a) const {
    using std::cos;
    const double w = natural_frequency;
    a[0] = force * cos(frequency * t) - 2 * damping_ratio * (w * v[0]) - w * (w * q[0]);
  }

  /// dx/dt for the state x = (position, velocity).
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    first_order_form(*this, t, x, dxdt);
  }
};

}  // namespace nlmech::problems

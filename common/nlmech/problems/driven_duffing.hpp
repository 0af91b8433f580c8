/// @file
/// Duffing's oscillator with all its terms: damping, a linear and a cubic spring, a harmonic force.
#pragma once

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// x'' + c x' + k x + m x^3 = f cos(w t). State (x, v). The values are those of x'' + x + x^3 = cos t.
struct DrivenDuffing {
  static constexpr int dimension = 2;                         ///< position and velocity
  using compiled_once = DrivenDuffing;                        ///< its System is compiled in the library
  static constexpr std::string_view name = "driven-duffing";  ///< on command lines and in tables
  static constexpr double initial_time = 0;                   ///< t_0
  static constexpr double final_time = 50;                    ///< some periods of the force
  double damping = 0;                                         ///< c
  double stiffness = 1;                                       ///< k
  double hardening = 1;                                       ///< m
  double force = 1;                                           ///< f
  double frequency = 1;                                       ///< w, rad/time

  /// The equation as one types it.
  static constexpr std::string_view equation =
      "x'' + c x' + k x + m x^3 = f cos(w t); c damping, k stiffness, m hardening, f "
      "force, w frequency";

  /// By name.
  static constexpr std::array parameters = {Parameter<DrivenDuffing>{"damping", &DrivenDuffing::damping},
                                            Parameter<DrivenDuffing>{"stiffness", &DrivenDuffing::stiffness},
                                            Parameter<DrivenDuffing>{"hardening", &DrivenDuffing::hardening},
                                            Parameter<DrivenDuffing>{"force", &DrivenDuffing::force},
                                            Parameter<DrivenDuffing>{"frequency", &DrivenDuffing::frequency}};

  /// x(0) = 1, v(0) = 0.
  [[nodiscard]] static Vector<double, 2> initial_state() { return {1, 0}; }

  /// a = f cos(w t) - c v - k q - m q^3.
  template <class T>
  void acceleration(const T& t, const Vector<T, 1>& q, const Vector<T, 1>& v, Vector<T, 1>& a) const {
    using std::cos;
    const T& x = q[0];
    a[0] = force * cos(frequency * t) - damping * v[0] - stiffness * x - hardening * (x * x * x);
  }

  /// dx/dt for the state x = (position, velocity).
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    first_order_form(*this, t, x, dxdt);
  }

  /// v^2/2 + k x^2/2 + m x^4/4, constant where there is neither damping nor force.
  [[nodiscard]] double energy(const Vector<double, 2>& x) const {
    const double square = x[0] * x[0];
    return (x[1] * x[1] + stiffness * square) / 2 + hardening / 4 * (square * square);
  }
};

}  // namespace nlmech::problems

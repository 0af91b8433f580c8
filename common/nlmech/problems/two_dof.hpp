/// @file
/// Two coupled Duffing oscillators: a problem of two degrees of freedom.
#pragma once

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// Two unit masses, each on a spring k x + m x^3 and a damper c of its own, tied by a spring s, the first one
/// driven:
///
///     x1'' + c x1' + k x1 + m x1^3 + s (x1 - x2) = f cos(w t),
///     x2'' + c x2' + k x2 + m x2^3 - s (x1 - x2) = 0.
///
/// State (x1, x2, v1, v2). Without force the masses may move as one, x1 = x2, or against each other,
/// x1 = -x2: each is then a Duffing oscillator, of the stiffness k or k + 2 s.
struct TwoDof {
  static constexpr int dimension = 4;                  ///< two positions, two velocities
  using compiled_once = TwoDof;                        ///< its System is compiled in the library
  static constexpr std::string_view name = "two-dof";  ///< on command lines and in tables
  static constexpr double initial_time = 0;            ///< t_0
  static constexpr double final_time = 20;             ///< some periods of the force
  double damping = 0.1;                                ///< c
  double stiffness = 1;                                ///< k
  double hardening = 1;                                ///< m
  double coupling = 0.5;                               ///< s
  double force = 1;                                    ///< f
  double frequency = 1;                                ///< w, rad/time

  /// The equation as one types it.
  static constexpr std::string_view equation =
      "x1'' + c x1' + k x1 + m x1^3 + s (x1 - x2) = f cos(w t), x2'' + c x2' + k x2 + m "
      "x2^3 - s (x1 - x2) = 0; c damping, k stiffness, m hardening, s coupling, f "
      "force, w frequency";

  /// By name.
  static constexpr std::array parameters = {
      Parameter<TwoDof>{"damping", &TwoDof::damping},     Parameter<TwoDof>{"stiffness", &TwoDof::stiffness},
      Parameter<TwoDof>{"hardening", &TwoDof::hardening}, Parameter<TwoDof>{"coupling", &TwoDof::coupling},
      Parameter<TwoDof>{"force", &TwoDof::force},         Parameter<TwoDof>{"frequency", &TwoDof::frequency}};

  /// x1(0) = 1, all else 0.
  [[nodiscard]] static Vector<double, 4> initial_state() { return {1, 0, 0, 0}; }

  /// Accelerations of both masses.
  template <class T>
  void acceleration(const T& t, const Vector<T, 2>& q, const Vector<T, 2>& v, Vector<T, 2>& a) const {
    using std::cos;
    const T pull = coupling * (q[0] - q[1]);
    for (int i = 0; i < 2; ++i)
      a[i] = -(damping * v[i]) - stiffness * q[i] - hardening * (q[i] * q[i] * q[i]);
    a[0] += force * cos(frequency * t) - pull;
    a[1] += pull;
  }

  /// dx/dt for the state x = (positions, velocities).
  template <class T>
  void operator()(const T& t, const Vector<T, 4>& x, Vector<T, 4>& dxdt) const {
    first_order_form(*this, t, x, dxdt);
  }
};

}  // namespace nlmech::problems

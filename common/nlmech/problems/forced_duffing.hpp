/// @file
/// Duffing's equation without a linear spring, damped and forced (Filipich and Rosales, Eq. 39).
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// u'' + P u' + Q u^3 = B cos(omega t) (Filipich and Rosales, Eqs. 39 and 47, with the values of section
/// 4.4). State (u, u'). P = 0.05 is no double, so a reference in extended precision takes Real from the type
/// it computes with.
/// @tparam Real type of the parameters; at most as precise as the T that the equation is evaluated with
template <class Real>
struct BasicForcedDuffing {
  static constexpr int dimension = 2;                         ///< position and velocity
  using compiled_once = BasicForcedDuffing<double>;           ///< its System is compiled in the library
  static constexpr std::string_view name = "forced-duffing";  ///< on command lines and in tables
  static constexpr double initial_time = 0;                   ///< t_0
  static constexpr double final_time = 50;                    ///< of a reference value; Fig. 4 gives none

  Real damping = Real(1) / 20;  ///< P*
  Real hardening = 1;           ///< Q*
  Real force = 15 / Real(2);    ///< B*
  Real frequency = 1;           ///< omega, rad/time

  /// The equation as one types it.
  static constexpr std::string_view equation =
      "u'' + P u' + Q u^3 = B cos(w t); P damping, Q hardening, B force, w frequency";

  /// By name.
  static constexpr std::array parameters = {
      Parameter<BasicForcedDuffing, Real>{"damping", &BasicForcedDuffing::damping},
      Parameter<BasicForcedDuffing, Real>{"hardening", &BasicForcedDuffing::hardening},
      Parameter<BasicForcedDuffing, Real>{"force", &BasicForcedDuffing::force},
      Parameter<BasicForcedDuffing, Real>{"frequency", &BasicForcedDuffing::frequency}};

  /// Section 4.4: u(0) = 3, u'(0) = 4.
  [[nodiscard]] static Vector<double, 2> initial_state() { return {3, 4}; }

  /// Heads of columns.
  [[nodiscard]] static std::vector<std::string> state_names() { return {"u", "v"}; }

  /// a = B cos(omega t) - P v - Q q^3.
  template <class T>
  void acceleration(const T& t, const Vector<T, 1>& q, const Vector<T, 1>& v, Vector<T, 1>& a) const {
    using std::cos;
    const T& u = q[0];
    a[0] = force * cos(frequency * t) - damping * v[0] - hardening * (u * u * u);
  }

  /// dx/dt for the state x = (position, velocity).
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    first_order_form(*this, t, x, dxdt);
  }
};

/// With parameters in double precision.
using ForcedDuffing = BasicForcedDuffing<double>;

}  // namespace nlmech::problems

/// @file
/// A strongly nonlinear oscillator with periodic damping (Filipich and Rosales, section 4.5).
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// x'' + omega^2 x + epsilon x' x^2 sin 2t = 0 (Filipich and Rosales, Eq. 70 in physical time). State (x,
/// x').
///
/// Reversible under (x, x', t) -> (x, -x', -t), with a period of pi: the printed motion, which starts on the
/// line of symmetry, can have no transient. omega^2 = 0.306 is no double, so a reference in extended
/// precision takes Real from the type it computes with.
/// @tparam Real type of the parameters; at most as precise as the T that the equation is evaluated with
template <class Real>
struct BasicStrongOscillator {
  static constexpr int dimension = 2;                             ///< position and velocity
  using compiled_once = BasicStrongOscillator<double>;            ///< its System is compiled in the library
  static constexpr std::string_view name = "oscillator";          ///< on command lines and in tables
  static constexpr double initial_time = 3.14159265358979323846;  ///< t_0 = pi
  static constexpr double final_time = 378.14159265358979323846;  ///< 375 later, as in Fig. 5

  Real stiffness = Real(306) / 1000;  ///< omega^2
  Real epsilon = 5;                   ///< strength of the nonlinear term

  /// The equation as one types it.
  static constexpr std::string_view equation = "x'' + w2 x + e x' x^2 sin 2t = 0; w2 stiffness, e epsilon";

  /// By name.
  static constexpr std::array parameters = {
      Parameter<BasicStrongOscillator, Real>{"stiffness", &BasicStrongOscillator::stiffness},
      Parameter<BasicStrongOscillator, Real>{"epsilon", &BasicStrongOscillator::epsilon}};

  /// Section 4.5: x = -0.5 at rest at t = pi.
  [[nodiscard]] static Vector<double, 2> initial_state() { return {-0.5, 0}; }

  /// Heads of columns.
  [[nodiscard]] static std::vector<std::string> state_names() { return {"x", "v"}; }

  /// a = -omega^2 q - epsilon v q^2 sin 2t.
  template <class T>
  void acceleration(const T& t, const Vector<T, 1>& q, const Vector<T, 1>& v, Vector<T, 1>& a) const {
    using std::sin;
    const T& x = q[0];
    a[0] = -(stiffness * x) - epsilon * (v[0] * (x * x) * sin(2 * t));
  }

  /// dx/dt for the state x = (position, velocity).
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    first_order_form(*this, t, x, dxdt);
  }
};

/// With parameters in double precision.
using StrongOscillator = BasicStrongOscillator<double>;

}  // namespace nlmech::problems

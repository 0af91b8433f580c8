/// @file
/// A projectile in air that thins with height, under wind that grows with it (Filipich and Rosales, section
/// 4.1).
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// r'' = -beta (r' - V(z)) e^{-z/h} - g e_z with the wind V = (a z, b z, 0): Filipich and Rosales, Eq. 58 in
/// physical time, corrected (the printed equation loses a factor T at r' and has z' in the exponent). State
/// (x, y, z, x', y', z').
///
/// The printed initial velocity (4, 0, 0.5) is read as one a step of T = 0.01 s, 400 and 50 m/s: the only
/// reading in which the printed height and steps make sense. beta and T are no doubles, so a reference in
/// extended precision takes Real from the type it computes with.
/// @tparam Real type of the parameters; at most as precise as the T that the equation is evaluated with
template <class Real>
struct BasicProjectile {
  static constexpr int dimension = 6;                     ///< three positions, then three velocities
  using compiled_once = BasicProjectile<double>;          ///< its System is compiled in the library
  static constexpr std::string_view name = "projectile";  ///< on command lines and in tables
  static constexpr double initial_time = 0;               ///< t_0
  static constexpr double final_time = 9.84601516944855;  ///< it lands

  Real drag = Real(1) / 100;  ///< beta, 1/s, at z = 0
  Real gravity = 10;          ///< g, m/s^2
  Real scale_height = 1000;   ///< h, m, over which the air thins by e
  Real wind_x = 1000;         ///< a, 1/s, growth of the wind along x with height
  Real wind_y = 500;          ///< b, 1/s, growth of the wind along y with height

  /// The equation as one types it.
  static constexpr std::string_view equation =
      "r'' = -beta exp(-z/h) (r' - (a z, b z, 0)) - (0, 0, g); beta drag, g gravity, h "
      "scale-height, a wind-x, b wind-y";

  /// By name.
  static constexpr std::array parameters = {
      Parameter<BasicProjectile, Real>{"drag", &BasicProjectile::drag},
      Parameter<BasicProjectile, Real>{"gravity", &BasicProjectile::gravity},
      Parameter<BasicProjectile, Real>{"scale-height", &BasicProjectile::scale_height, Range::positive},
      Parameter<BasicProjectile, Real>{"wind-x", &BasicProjectile::wind_x},
      Parameter<BasicProjectile, Real>{"wind-y", &BasicProjectile::wind_y}};

  /// Section 4.1 as read above: at the origin with (400, 0, 50) m/s.
  [[nodiscard]] static Vector<double, 6> initial_state() { return {0, 0, 0, 400, 0, 50}; }

  /// Heads of columns.
  [[nodiscard]] static std::vector<std::string> state_names() { return {"x", "y", "z", "vx", "vy", "vz"}; }

  /// Accelerations.
  template <class T>
  void acceleration(const T& /*t*/, const Vector<T, 3>& q, const Vector<T, 3>& v, Vector<T, 3>& a) const {
    using std::exp;
    const T resistance = drag * exp(-q[2] / scale_height);
    a[0] = -(resistance * (v[0] - wind_x * q[2]));
    a[1] = -(resistance * (v[1] - wind_y * q[2]));
    a[2] = -(resistance * v[2]) - gravity;
  }

  /// dx/dt for the state x = (positions, velocities).
  template <class T>
  void operator()(const T& t, const Vector<T, 6>& x, Vector<T, 6>& dxdt) const {
    first_order_form(*this, t, x, dxdt);
  }
};

/// With parameters in double precision.
using Projectile = BasicProjectile<double>;

}  // namespace nlmech::problems

/// @file
/// Arenstorf's orbit: a satellite between earth and moon that comes back to where it began.
#pragma once

#include <array>
#include <cmath>
#include <string_view>

#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// x'' = x + 2 y' - m' (x + m)/D1 - m (x - m')/D2, y'' = y - 2 x' - m' y/D1 - m y/D2 with m' = 1 - m,
/// D1 = ((x + m)^2 + y^2)^(3/2), D2 = ((x - m')^2 + y^2)^(3/2): the plane restricted problem of three bodies
/// in rotating axes (R. F. Arenstorf 1963; E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential
/// Equations I, section II.0). State (x, y, x', y').
///
/// The orbit of initial_state() closes after final_time. It passes the moon at a distance of 0.006, which
/// multiplies errors.
struct Arenstorf {
  static constexpr int dimension = 4;                    ///< two positions, then two velocities
  using compiled_once = Arenstorf;                       ///< its System is compiled in the library
  static constexpr std::string_view name = "arenstorf";  ///< on command lines and in tables
  static constexpr double initial_time = 0;              ///< t_0
  static constexpr double final_time = 17.0652165601579625588917206249;  ///< the period
  double moon = 0.012277471;                                             ///< share of the moon in the mass

  /// The equation as one types it.
  static constexpr std::string_view equation =
      "x'' = x + 2 y' - (1 - m) (x + m)/D1 - m (x - 1 + m)/D2, y'' = y - 2 x' - (1 - m) y/D1 - m y/D2; "
      "D1 = ((x + m)^2 + y^2)^(3/2), D2 = ((x - 1 + m)^2 + y^2)^(3/2), m moon";

  /// By name.
  static constexpr std::array parameters = {Parameter<Arenstorf>{"moon", &Arenstorf::moon, Range::share}};

  /// Behind the moon, at right angles to the line from the earth.
  [[nodiscard]] static Vector<double, 4> initial_state() {
    return {0.994, 0, 0, -2.00158510637908252240537862224};
  }

  /// The acceleration in rotating axes.
  template <class T>
  void acceleration(const T& /*t*/, const Vector<T, 2>& q, const Vector<T, 2>& v, Vector<T, 2>& a) const {
    using std::sqrt;
    const double rest = 1 - moon;
    const T &x = q[0], &y = q[1];
    const T from_earth = x + moon, from_moon = x - rest, high = y * y;
    const T square1 = from_earth * from_earth + high, square2 = from_moon * from_moon + high;
    const T pull1 = rest / (square1 * sqrt(square1)), pull2 = moon / (square2 * sqrt(square2));
    a[0] = x + 2 * v[1] - pull1 * from_earth - pull2 * from_moon;
    a[1] = y - 2 * v[0] - (pull1 + pull2) * y;
  }

  /// The equation of first order.
  template <class T>
  void operator()(const T& t, const Vector<T, 4>& x, Vector<T, 4>& dxdt) const {
    first_order_form(*this, t, x, dxdt);
  }

  /// Jacobi's integral, x^2 + y^2 + 2 m'/r1 + 2 m/r2 - v^2.
  template <class T>
  [[nodiscard]] Vector<T, 1> invariants(const T& /*t*/, const Vector<T, 4>& x) const {
    using std::sqrt;
    const double rest = 1 - moon;
    const T a = x[0] + moon, b = x[0] - rest, high = x[1] * x[1];
    const T to_earth = sqrt(T(a * a + high)), to_moon = sqrt(T(b * b + high));
    return Vector<T, 1>(
        T(x[0] * x[0] + high + 2 * rest / to_earth + 2 * moon / to_moon - (x[2] * x[2] + x[3] * x[3])));
  }
};

}  // namespace nlmech::problems

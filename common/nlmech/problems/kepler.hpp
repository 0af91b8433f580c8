/// @file
/// Kepler's ellipse in its plane, in units of its period: as eccentric as one likes.
#pragma once

#include <array>
#include <cmath>
#include <string_view>

#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// q'' = -mu q/|q|^3 in a plane, from the pericentre of an ellipse of semi-major axis 1 (problem class D of
/// T. E. Hull, W. H. Enright, B. M. Fellen, A. E. Sedgwick, Comparing numerical methods for ordinary
/// differential equations, SIAM J. Numer. Anal. 9 (1972) 603-637). State (x1, x2, v1, v2).
///
/// The period is 2 pi/sqrt(mu). Near the pericentre all is ((1 + e)/(1 - e))^(3/2) times as fast as at the
/// mean distance: steps of one length are hopeless for e close to 1.
struct Kepler {
  static constexpr int dimension = 4;                 ///< two positions, then two velocities
  using compiled_once = Kepler;                       ///< its System is compiled in the library
  static constexpr std::string_view name = "kepler";  ///< on command lines and in tables
  static constexpr double initial_time = 0;           ///< t_0
  static constexpr double final_time = 16;            ///< two and a half turns: away from the pericentre
  double mu = 1;                                      ///< gravitational parameter, positive
  double eccentricity = 0.7;                          ///< e of initial_state(), at least 0 and below 1

  /// The equation as one types it.
  static constexpr std::string_view equation =
      "q'' = -mu q/|q|^3; q(0) = (1 - e, 0), q'(0) = (0, sqrt(mu (1 + e)/(1 - e))), e eccentricity";

  /// By name.
  static constexpr std::array parameters = {
      Parameter<Kepler>{"mu", &Kepler::mu, Range::positive},
      Parameter<Kepler>{"eccentricity", &Kepler::eccentricity, Range::share}};

  /// At the pericentre of the ellipse of semi-major axis 1.
  [[nodiscard]] Vector<double, 4> initial_state() const {
    return {1 - eccentricity, 0, 0, std::sqrt(mu * ((1 + eccentricity) / (1 - eccentricity)))};
  }

  /// a = -mu q/|q|^3.
  template <class T>
  void acceleration(const T& /*t*/, const Vector<T, 2>& q, const Vector<T, 2>& /*v*/, Vector<T, 2>& a) const {
    using std::sqrt;
    const T square = q[0] * q[0] + q[1] * q[1];
    const T factor = -mu / (square * sqrt(square));
    a[0] = factor * q[0];
    a[1] = factor * q[1];
  }

  /// The equation of first order.
  template <class T>
  void operator()(const T& t, const Vector<T, 4>& x, Vector<T, 4>& dxdt) const {
    first_order_form(*this, t, x, dxdt);
  }

  /// Energy and angular momentum, for a unit of mass.
  template <class T>
  [[nodiscard]] Vector<T, 2> invariants(const T& /*t*/, const Vector<T, 4>& x) const {
    using std::sqrt;
    const T distance = sqrt(T(x[0] * x[0] + x[1] * x[1]));
    return {T((x[2] * x[2] + x[3] * x[3]) / 2 - mu / distance), T(x[0] * x[3] - x[1] * x[2])};
  }
};

}  // namespace nlmech::problems

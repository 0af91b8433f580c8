/// @file
/// Boundary value problems with known solutions.
#pragma once

#include <cmath>
#include <numbers>

#include "nlmech/bvp/optimal_control/control_model.hpp"
#include "nlmech/bvp/optimal_control/dual_problem.hpp"

namespace nlmech::bvp::tests {

/// x'' = -exp(x) mu on [0, 1], x(0) = x(1) = 0 (Bratu). With theta/cosh(theta/4) = sqrt(2 mu):
/// x = -2 log(cosh((t - 1/2) theta/2)/cosh(theta/4)).
struct Bratu {
  static constexpr int states = 2, parameters = 0;
  double mu = 1;
  [[nodiscard]] std::vector<double> points() const { return {0, 1}; }
  template <class T>
  void rhs(const T& /*t*/, const Vector<T, 2>& x, const Vector<T, 0>& /*p*/, Vector<T, 2>& f) const {
    using std::exp;
    f[0] = x[1];
    f[1] = -mu * exp(x[0]);
  }
  template <class T>
  void conditions(const Matrix<T, 2, Eigen::Dynamic>& ends, const Vector<T, 0>& /*p*/,
                  Vector<T, Eigen::Dynamic>& r) const {
    r[0] = ends(0, 0);
    r[1] = ends(0, 1);
  }
};

/// theta of the lower (or upper) solution by bisection.
inline double bratu_theta(double mu, bool upper) {
  // theta/cosh(theta/4) increases up to theta = 4.7987145..., where tanh(theta/4) theta/4 = 1, and decreases
  // beyond.
  constexpr double turn = 4.79871456103;
  double a = upper ? turn : 0, b = upper ? 40 : turn;
  for (int k = 0; k < 200; ++k) {
    const double m = (a + b) / 2;
    const bool below = m / std::cosh(m / 4) < std::sqrt(2 * mu);
    ((below != upper) ? a : b) = m;
  }
  return (a + b) / 2;
}

inline double bratu_exact(double t, double theta) {
  return -2 * std::log(std::cosh((t - 0.5) * theta / 2) / std::cosh(theta / 4));
}

/// A mass moved from rest at 0 to rest at 1 with J = integral (u^2/2 + price): without bound u = 6/T^2 (1 -
/// 2t/T), J = 6/T^3 + price T; the cheapest T for price 1 is 18^(1/4). |u| <= m is feasible for m >= 4/T^2.
struct Mass {
  static constexpr int states = 2, controls = 1;
  double price = 0;
  template <class T>
  void dynamics(const T& /*t*/, const Vector<T, 2>& x, const Vector<T, 1>& u, const T& /*mu*/,
                Vector<T, 2>& g) const {
    g[0] = x[1];
    g[1] = u[0];
  }
  template <class T>
  T running_cost(const T& /*t*/, const Vector<T, 2>& /*x*/, const Vector<T, 1>& u, const T& /*mu*/) const {
    return u[0] * u[0] / 2.0 + price;
  }
  template <class T>
  T end_cost(const Vector<T, 2>& /*x0*/, const Vector<T, 2>& /*xF*/, const T& /*tF*/) const {
    return T(0);
  }
};

}  // namespace nlmech::bvp::tests

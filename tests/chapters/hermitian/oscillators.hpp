/// @file
/// References for the tests of Laier's equations: operators with accelerations and jerks from dual numbers.
#pragma once

#include <gtest/gtest.h>

#include <type_traits>
#include <utility>

#include "nlmech/ivp/hermitian/hermitian_operators.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::laier_test {

using ivp::HermitianOperator;

/// Position, velocity, the load and its rate at one end of a step.
struct End {
  double y, v, f, df;
};

/// y'' + C y' + K y + mu y^3 = f.
struct DuffingEquation {
  double C = 0.4, K = 1.3, mu = 0.5;
};
/// y'' - d y' + K y + d y^2 y' = f.
struct VanDerPolEquation {
  double d = 1.5, K = 1.3;
};

/// The equation for y'' with numbers of any type; time enters through the load, f + df t at t = 0.
template <class Equation>
struct Generic {
  static constexpr int dimension = 2;
  Equation p;
  double f, df;
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    const T load = f + df * t, y = x[0], v = x[1];
    dxdt[0] = v;
    if constexpr (std::is_same_v<Equation, DuffingEquation>) {
      dxdt[1] = load - p.C * v - p.K * y - p.mu * (y * y * y);
    } else {
      dxdt[1] = load + p.d * ((1 - y * y) * v) - p.K * y;
    }
  }
};

/// Acceleration, jerk and their derivatives with respect to y and v.
struct Rates {
  double a, j, ay, av, jy, jv;
};
template <class Equation>
Rates rates(const Equation& p, const End& e) {
  const ivp::System system(Generic<Equation>{p, e.f, e.df});
  ivp::State f(2), g(2);
  ivp::Jacobian fx, gx;
  EXPECT_TRUE(system.second_derivative(0, {e.y, e.v}, f, g, fx, gx));
  return {f[1], g[1], fx(1, 0), fx(1, 1), gx(1, 0), gx(1, 1)};
}

/// Residual of the operator for a step, from a and j.
template <class Equation>
double residual(const HermitianOperator& o, const Equation& p, const End& e0, const End& e1, double h) {
  const Rates r0 = rates(p, e0), r1 = rates(p, e1);
  return o.A * e0.y + o.B * e1.y + h * (o.C * e0.v + o.D * e1.v) + h * h * (o.E * r0.a + o.F * r1.a) +
         h * h * h * (o.G * r0.j + o.H * r1.j);
}

/// Derivatives of an operator with respect to y1 and v1, from a and j.
template <class Equation>
std::pair<double, double> slopes(const HermitianOperator& o, const Equation& p, const End& b, double h) {
  const Rates r = rates(p, b);
  return {o.B + h * h * o.F * r.ay + h * h * h * o.H * r.jy,
          h * o.D + h * h * o.F * r.av + h * h * h * o.H * r.jv};
}

inline constexpr End start = {0.7, -0.4, 0.3, 0.9}, end = {0.5, -0.6, 0.45, 1.1};
inline constexpr double step = 0.3;
inline constexpr HermitianOperator both = {12, -12, 6, 6, 1, -1, 0.5, -0.3};  ///< no coefficient is zero

/// Rounding error of sums of some twenty terms below 100.
inline constexpr double rounding = 2e-13;

}  // namespace nlmech::laier_test

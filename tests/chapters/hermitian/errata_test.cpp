/// The paper's equations (4) to (10), as printed and corrected, against the operators with accelerations and
/// jerks that dual numbers give. Table 1 and equation (1) are tested with the operators
/// (tests/ivp/hermitian_operators_test.cpp).
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "nlmech/ivp/hermitian_operators.hpp"
#include "nlmech/ivp/system.hpp"
#include "nlmech/problems/driven_duffing.hpp"
#include "nlmech/problems/van_der_pol.hpp"

namespace nlmech {
namespace {

using ivp::HermitianOperator;

/// Position, velocity and the load at one end of a step.
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

double acceleration(const DuffingEquation& p, const End& e) {
  return e.f - p.C * e.v - p.K * e.y - p.mu * e.y * e.y * e.y;
}
double acceleration(const VanDerPolEquation& p, const End& e) {
  return e.f + p.d * (1 - e.y * e.y) * e.v - p.K * e.y;
}

// a and j by dual numbers: time enters through the load, f + df t at t = 0.
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

/// a, j and their derivatives by y and v.
struct Rates {
  double a, j, ay, av, jy, jv;
};
template <class Equation>
Rates rates(const Equation& p, const End& e) {
  const ivp::System<2> system(Generic<Equation>{p, e.f, e.df});
  ivp::State<2> f, g;
  ivp::Jacobian<2> fx, gx;
  EXPECT_TRUE(system.second_derivative(0, {e.y, e.v}, f, g, fx, gx));
  EXPECT_NEAR(f[1], acceleration(p, e), 1e-13);
  return {f[1], g[1], fx(1, 0), fx(1, 1), gx(1, 0), gx(1, 1)};
}

/// What the operator leaves of a step, by a and j.
template <class Equation>
double residual(const HermitianOperator& o, const Equation& p, const End& e0, const End& e1, double h) {
  const Rates r0 = rates(p, e0), r1 = rates(p, e1);
  return o.A * e0.y + o.B * e1.y + h * (o.C * e0.v + o.D * e1.v) + h * h * (o.E * r0.a + o.F * r1.a) +
         h * h * h * (o.G * r0.j + o.H * r1.j);
}

constexpr End begin = {0.7, -0.4, 0.3, 0.9}, end = {0.5, -0.6, 0.45, 1.1};
constexpr double step = 0.3;
constexpr HermitianOperator both = {12, -12, 6, 6, 1, -1, 0.5, -0.3};  // all coefficients count

// Rounding of sums of some twenty terms below 100.
constexpr double rounding = 2e-13;

End any_end() {
  const auto number = [] { return *rc::gen::inRange(-200, 200) / 100.0; };
  return {number(), number(), number(), number()};
}

// (4), second line: dots are lost.
TEST(Errata, Equation4IsTheDerivative) {
  const DuffingEquation p;
  const Rates r = rates(p, begin);
  const double y = begin.y, v = begin.v;
  EXPECT_NEAR(r.j + p.C * r.a + p.K * v + 3 * p.mu * y * y * v - begin.df, 0, rounding);
  EXPECT_GT(std::abs(r.a + p.C * v + p.K * y + 3 * p.mu * y * y * v - begin.df), 0.1);  // printed
}

// (5): signs, y^2 y' for y'^2, and in the derivative dots, y^2 y'' and the sign of 2 d y'^2 y.
TEST(Errata, Equation5IsVanDerPol) {
  const VanDerPolEquation p;
  const Rates r = rates(p, begin);
  const double y = begin.y, v = begin.v;
  EXPECT_NEAR(r.a - p.d * v + p.K * y + p.d * y * y * v - begin.f, 0, rounding);
  EXPECT_GT(std::abs(r.a + p.d * v + p.K * y + p.d * v * v - begin.f), 0.1);
  EXPECT_NEAR(r.j - p.d * r.a + p.K * v + p.d * y * y * r.a + 2 * p.d * y * v * v - begin.df, 0, rounding);
  EXPECT_GT(std::abs(r.a - p.d * v + p.K * y + p.d * v * v - 2 * p.d * v * v * y - begin.df), 0.1);
}

double cube(double x) { return x * x * x; }

/// Equation (6). Printed: the damping C* for the operator's C, C^2 + K for C^2 - K, y_i for y_{i+1} in the
/// last term of v1.
double equation_6(const HermitianOperator& o, const DuffingEquation& p, const End& a, const End& b, double h,
                  bool printed) {
  const double h2 = h * h, h3 = h2 * h, square = printed ? p.C * p.C + p.K : p.C * p.C - p.K;
  const double late = printed ? a.y : b.y;
  return a.y * (o.A - o.E * h2 * p.K + o.G * p.C * p.K * h3) +
         b.y * (o.B - o.F * p.K * h2 + o.H * p.C * p.K * h3) +
         a.v * ((printed ? p.C : o.C) * h - o.E * p.C * h2 + o.G * square * h3 -
                3 * o.G * p.mu * h3 * a.y * a.y) +
         b.v * (o.D * h - o.F * p.C * h2 + o.H * square * h3 - 3 * o.H * p.mu * h3 * late * late) +
         cube(a.y) * (-o.E * p.mu * h2 + o.G * p.C * p.mu * h3) +
         cube(b.y) * (-o.F * p.mu * h2 + o.H * p.C * p.mu * h3) + a.f * (o.E * h2 - o.G * p.C * h3) +
         b.f * (o.F * h2 - o.H * p.C * h3) + a.df * o.G * h3 + b.df * o.H * h3;
}

RC_GTEST_PROP(Errata, Equation6CorrectedIsTheOperator, ()) {
  const DuffingEquation p;
  const End a = any_end(), b = any_end();
  for (const ivp::HermitianPair& pair : ivp::hermitian_table) {
    for (const HermitianOperator& o : {pair.first, pair.second, both})
      RC_ASSERT(std::abs(equation_6(o, p, a, b, step, false) - residual(o, p, a, b, step)) <= rounding);
  }
}

TEST(Errata, Equation6PrintedIsNot) {
  EXPECT_GT(std::abs(equation_6(both, {}, begin, end, step, true) -
                     residual(both, DuffingEquation{}, begin, end, step)),
            0.1);
}

/// Equation (7) corrected.
double equation_7(const HermitianOperator& o, const VanDerPolEquation& p, const End& a, const End& b,
                  double h) {
  const double h2 = h * h, h3 = h2 * h, q = 1 - a.y * a.y, Q = 1 - b.y * b.y, d = p.d, K = p.K;
  return a.y * (o.A - o.E * K * h2 - o.G * d * K * q * h3) +
         b.y * (o.B - o.F * K * h2 - o.H * d * K * Q * h3) +
         a.v * (o.C * h + o.E * d * q * h2 + o.G * (d * d * q * q - K) * h3) +
         b.v * (o.D * h + o.F * d * Q * h2 + o.H * (d * d * Q * Q - K) * h3) -
         2 * d * h3 * (o.G * a.y * a.v * a.v + o.H * b.y * b.v * b.v) + a.f * (o.E * h2 + o.G * d * q * h3) +
         b.f * (o.F * h2 + o.H * d * Q * h3) + h3 * (o.G * a.df + o.H * b.df);
}

/// Equation (7) as printed. @param c the damping of the Duffing oscillator, whose term is left in
double equation_7_printed(const HermitianOperator& o, const VanDerPolEquation& p, const End& a, const End& b,
                          double h, double c) {
  const double h2 = h * h, h3 = h2 * h, q = 1 - a.y * a.y, Q = 1 - b.y * b.y, d = p.d, K = p.K;
  return a.y * (o.A - o.E * h2 * K + o.G * c * K * h3) + b.y * (o.B - o.F * K * h2) +
         a.v * (d * o.E * h2 * q + o.H * d * q * q * h3) +
         b.v * (d * o.F * h2 * Q + o.G * d * d * q * q * h3) + a.y * d * q * o.H * K * h3 -
         d * b.y * Q * o.G * h3 - 2 * d * o.H * a.v * a.v * a.y * h3 - 2 * d * o.G * b.v * b.v * b.y * h3 +
         a.f * (o.E * h2 - o.H * q * h3) + b.f * (o.F * h2 - o.G * d * h3 * Q) - a.df * o.H * h3 -
         b.df * o.G * h3;
}

RC_GTEST_PROP(Errata, Equation7CorrectedIsTheOperator, ()) {
  const VanDerPolEquation p;
  const End a = any_end(), b = any_end();
  for (const ivp::HermitianPair& pair : ivp::hermitian_table) {
    for (const HermitianOperator& o : {pair.first, pair.second, both})
      RC_ASSERT(std::abs(equation_7(o, p, a, b, step) - residual(o, p, a, b, step)) <= rounding);
  }
}

TEST(Errata, Equation7PrintedIsNot) {
  for (const double c : {0.0, 0.4}) {
    EXPECT_GT(std::abs(equation_7_printed(both, {}, begin, end, step, c) -
                       residual(both, VanDerPolEquation{}, begin, end, step)),
              0.1);
  }
  // Nor with G and H exchanged back: C h and D h are missing.
  HermitianOperator exchanged = both;
  std::swap(exchanged.G, exchanged.H);
  EXPECT_GT(std::abs(equation_7_printed(exchanged, {}, begin, end, step, 0) -
                     residual(both, VanDerPolEquation{}, begin, end, step)),
            0.1);
}

/// Derivatives of an operator by y1 and v1, by a and j.
template <class Equation>
std::pair<double, double> slopes(const HermitianOperator& o, const Equation& p, const End& b, double h) {
  const Rates r = rates(p, b);
  return {o.B + h * h * o.F * r.ay + h * h * h * o.H * r.jy,
          h * o.D + h * h * o.F * r.av + h * h * h * o.H * r.jv};
}

// (8): with the printed sign Newton's iteration leaves a root as fast as it would reach it.
TEST(Errata, Equation8HasTheOtherSign) {
  const DuffingEquation p;
  const ivp::HermitianPair& pair = ivp::laier;
  for (const double sign : {-1.0, 1.0}) {
    End b = end;
    const auto norm = [&] {
      return std::hypot(residual(pair.first, p, begin, b, step), residual(pair.second, p, begin, b, step));
    };
    const double at_first = norm();
    for (int k = 0; k < 6; ++k) {
      const double F = residual(pair.first, p, begin, b, step), G = residual(pair.second, p, begin, b, step);
      const auto [fy, fv] = slopes(pair.first, p, b, step);
      const auto [gy, gv] = slopes(pair.second, p, b, step);
      const double determinant = fy * gv - fv * gy;
      b.y += sign * (gv * F - fv * G) / determinant;
      b.v += sign * (fy * G - gy * F) / determinant;
    }
    if (sign < 0) {
      EXPECT_LT(norm(), 1e-12);
    } else {
      EXPECT_GT(norm(), 10 * at_first);
    }
  }
}

// (9): right but for the last term of G_v, where H stands for H1 (and C1, K1 for the damping and the
// stiffness).
RC_GTEST_PROP(Errata, Equation9HasTheWrongH, ()) {
  const DuffingEquation p;
  const End b = any_end();
  const double h2 = step * step, h3 = h2 * step;
  const auto by_y = [&](const HermitianOperator& o) {
    return o.B - o.F * p.K * h2 + o.H * p.C * p.K * h3 +
           3 * b.y * b.y * (o.H * h3 * p.C * p.mu - o.F * p.mu * h2) - 6 * b.v * o.H * h3 * p.mu * b.y;
  };
  const auto by_v = [&](const HermitianOperator& o, double last) {
    return o.D * step - o.F * p.C * h2 + o.H * h3 * (p.C * p.C - p.K) - 3 * last * p.mu * h3 * b.y * b.y;
  };
  const HermitianOperator &first = ivp::argyris.first, &second = ivp::argyris.second;
  for (const HermitianOperator& o : {first, second}) {
    const auto [fy, fv] = slopes(o, p, b, step);
    RC_ASSERT(std::abs(by_y(o) - fy) <= rounding);
    RC_ASSERT(std::abs(by_v(o, o.H) - fv) <= rounding);
  }
  const double printed = by_v(second, first.H) - slopes(second, p, b, step).second;
  RC_ASSERT(std::abs(printed - 3 * (second.H - first.H) * p.mu * h3 * b.y * b.y) <= rounding);
}

// (10), for K = 1 without load: -4 d y v for -2 d y v, 2 d v - 1 for -2 d v^2; in F_v the sign of F and 2 d y
// for -4 d y v - 1.
TEST(Errata, Equation10Corrected) {
  const VanDerPolEquation p{.d = 1.5, .K = 1};
  const double d = p.d, h = step, h2 = h * h, h3 = h2 * h;
  for (const double y : {0.5, -1.2, 1.9}) {
    for (const double v : {-0.6, 0.8}) {
      const End b{y, v, 0, 0};
      const double q = 1 - y * y;
      const HermitianOperator& o = both;
      const auto [fy, fv] = slopes(o, p, b, h);
      EXPECT_NEAR(o.B + o.F * h2 * (-2 * d * y * v - 1) +
                      o.H * h3 * (-4 * d * d * y * v * q - d * q + 2 * d * y * y - 2 * d * v * v),
                  fy, rounding);
      EXPECT_NEAR(o.D * h + o.F * h2 * d * q + o.H * h3 * (d * d * q * q - 4 * d * y * v - 1), fv, rounding);
      const double printed_y = o.B + o.F * h2 * (-4 * d * y * v - 1) +
                               o.H * h3 * (-4 * d * d * y * v * q - d * q + 2 * d * y * y + 2 * d * v - 1);
      const double printed_v = o.D * h - o.F * h2 * d * q + o.H * h3 * (d * d * q * q + 2 * d * y);
      EXPECT_GT(std::abs(printed_y - fy), 1e-3);
      EXPECT_GT(std::abs(printed_v - fv), 1e-3);
    }
  }
}

}  // namespace
}  // namespace nlmech

/// The paper's equations (1), (3) to (5), (8) to (10) as printed and corrected, against accelerations and
/// jerks from dual numbers. Equations (6) and (7): errata_residual_test.cpp; Table 1 and the signs of (1):
/// tests/ivp/hermitian/hermitian_operators_test.cpp.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>

#include "tests/chapters/hermitian/oscillators.hpp"
#include "tests/errata/erratum.hpp"

namespace nlmech::laier_test::errata_test {
namespace {

using tests::expect_erratum;

// (1) has y'' where h^3 asks for the jerk. Argyris' operator gives the end of y = t^3 over 0 to 1 from y'' =
// 0 and 6, y''' = 6 and 6; its C and A count nothing. (3): the derivative of (2), whose N is mu y^3 here.
TEST(Errata, JerksNeedThreeDots) {
  const HermitianOperator& o = ivp::argyris.first;
  const auto end_of = [&](double j0, double j1) { return -(o.F * 6 + o.G * j0 + o.H * j1) / o.B; };
  expect_erratum("hermitian-1-jerk", {end_of(0, 6), end_of(6, 6), 1, 1e-15});
  const DuffingEquation p;
  const Rates r = rates(p, start);
  const double y = start.y, v = start.v, nonlinear = 3 * p.mu * y * y * v;
  expect_erratum("hermitian-1-jerk", {.printed = r.a + p.C * v + p.K * y + nonlinear,
                                      .corrected = r.j + p.C * r.a + p.K * v + nonlinear,
                                      .oracle = start.df,
                                      .tolerance = rounding});
}

// (4), second line, lacks dots. It must give the rate of the load.
TEST(Errata, Equation4IsTheDerivative) {
  const DuffingEquation p;
  const Rates r = rates(p, end);
  const double y = end.y, v = end.v, nonlinear = 3 * p.mu * y * y * v;
  expect_erratum("hermitian-4", {.printed = r.a + p.C * v + p.K * y + nonlinear,
                                 .corrected = r.j + p.C * r.a + p.K * v + nonlinear,
                                 .oracle = end.df,
                                 .tolerance = rounding});
}

// (5): wrong signs, y^2 y' for y'^2; in the derivative missing dots, y^2 y'', and the sign of 2 d y'^2 y. The
// lines must give the load and its rate.
TEST(Errata, Equation5IsVanDerPol) {
  const VanDerPolEquation p;
  const Rates r = rates(p, start);
  const double y = start.y, v = start.v;
  expect_erratum("hermitian-5-first", {.printed = r.a + p.d * v + p.K * y + p.d * v * v,
                                       .corrected = r.a - p.d * v + p.K * y + p.d * y * y * v,
                                       .oracle = start.f,
                                       .tolerance = rounding});
  expect_erratum("hermitian-5-second",
                 {.printed = r.a - p.d * v + p.K * y + p.d * v * v - 2 * p.d * v * v * y,
                  .corrected = r.j - p.d * r.a + p.K * v + p.d * y * y * r.a + 2 * p.d * y * v * v,
                  .oracle = start.df,
                  .tolerance = rounding});
}

/// Newton's iteration for Laier's operators from @p b; sign -1 is Newton's, +1 the printed one.
End iterate(const DuffingEquation& p, const End& a, End b, double h, int iterations, double sign) {
  const ivp::HermitianPair& pair = ivp::laier;
  for (int k = 0; k < iterations; ++k) {
    const double F = residual(pair.first, p, a, b, h), G = residual(pair.second, p, a, b, h);
    const auto [fy, fv] = slopes(pair.first, p, b, h);
    const auto [gy, gv] = slopes(pair.second, p, b, h);
    const double determinant = fy * gv - fv * gy;
    b.y += sign * (gv * F - fv * G) / determinant;
    b.v += sign * (fy * G - gy * F) / determinant;
  }
  return b;
}

// (8): with the printed sign Newton's iteration diverges as fast as it would converge.
TEST(Errata, Equation8HasTheOtherSign) {
  // y'' + y = 0 from (1, 0) over a step z: one iteration finds the end, the Pade approximation of cos z.
  const DuffingEquation linear{.C = 0, .K = 1, .mu = 0};
  const double z = 0.8, z2 = z * z, z4 = z2 * z2;
  const auto once = [&](double sign) { return iterate(linear, {1, 0, 0, 0}, {1, 0, 0, 0}, z, 1, sign).y; };
  expect_erratum("hermitian-8", {.printed = once(1),
                                 .corrected = once(-1),
                                 .oracle = (z4 - 60 * z2 + 144) / (z4 + 12 * z2 + 144),
                                 .tolerance = 1e-14});
  const DuffingEquation p;
  const auto norm = [&](const End& b) {
    return std::hypot(residual(ivp::laier.first, p, start, b, step),
                      residual(ivp::laier.second, p, start, b, step));
  };
  EXPECT_LT(norm(iterate(p, start, end, step, 6, -1)), 1e-12);
  EXPECT_GT(norm(iterate(p, start, end, step, 6, 1)), 10 * norm(end));
}

/// F_y and G_y of (9). @param C the damping
double slope_by_y(const HermitianOperator& o, const DuffingEquation& p, const End& b, double C) {
  const double h2 = step * step, h3 = h2 * step;
  return o.B - o.F * p.K * h2 + o.H * C * p.K * h3 + 3 * b.y * b.y * (o.H * h3 * C * p.mu - o.F * p.mu * h2) -
         6 * b.v * o.H * h3 * p.mu * b.y;
}

/// F_v and G_v of (9). @param last the H of its last term
double slope_by_v(const HermitianOperator& o, const DuffingEquation& p, const End& b, double C, double last) {
  const double h2 = step * step, h3 = h2 * step;
  return o.D * step - o.F * C * h2 + o.H * h3 * (C * C - p.K) - 3 * last * p.mu * h3 * b.y * b.y;
}

// (9) divides F by y instead of differentiating by y; the last term of G_v has H for H1; C1 and K1 are
// damping and stiffness there, as in (6).
TEST(Errata, Equation9) {
  const DuffingEquation p;
  const HermitianOperator &first = ivp::argyris.first, &second = ivp::argyris.second;
  const auto [fy, fv] = slopes(both, p, end, step);
  const double left = residual(both, p, start, end, step);
  expect_erratum("hermitian-9-partial", {.printed = left / end.y,
                                         .corrected = slope_by_y(both, p, end, p.C),
                                         .oracle = fy,
                                         .tolerance = rounding});
  expect_erratum("hermitian-9-partial", {.printed = left / end.v,
                                         .corrected = slope_by_v(both, p, end, p.C, both.H),
                                         .oracle = fv,
                                         .tolerance = rounding});
  const auto [gy, gv] = slopes(second, p, end, step);
  expect_erratum("hermitian-9-h", {.printed = slope_by_v(second, p, end, p.C, first.H),
                                   .corrected = slope_by_v(second, p, end, p.C, second.H),
                                   .oracle = gv,
                                   .tolerance = rounding});
  expect_erratum("hermitian-6-one", {.printed = slope_by_y(second, p, end, second.C),
                                     .corrected = slope_by_y(second, p, end, p.C),
                                     .oracle = gy,
                                     .tolerance = rounding,
                                     .scale = 1});
}

RC_GTEST_PROP(Errata, Equation9CorrectedIsTheSlope, ()) {
  const DuffingEquation p;
  const auto number = [] { return *rc::gen::inRange(-200, 200) / 100.0; };
  const End b{number(), number(), number(), number()};
  for (const HermitianOperator& o : {ivp::argyris.first, ivp::argyris.second, both}) {
    const auto [by_y, by_v] = slopes(o, p, b, step);
    RC_ASSERT(std::abs(slope_by_y(o, p, b, p.C) - by_y) <= rounding);
    RC_ASSERT(std::abs(slope_by_v(o, p, b, p.C, o.H) - by_v) <= rounding);
  }
}

// (10), for K = 1 without load: -4 d y v for -2 d y v, 2 d v - 1 for -2 d v^2; in F_v the sign of F and 2 d y
// for -4 d y v - 1.
TEST(Errata, Equation10OneMisprintAtATime) {
  const VanDerPolEquation p{.d = 1.5, .K = 1};
  const double d = p.d, h = step, h2 = h * h, h3 = h2 * h;
  const HermitianOperator& o = both;
  for (const double y : {0.5, -1.2, 1.9}) {
    for (const double v : {-0.6, 0.8}) {
      const double q = 1 - y * y;
      const auto [fy, fv] = slopes(o, p, End{y, v, 0, 0}, h);
      const auto by_y = [&](double of_f, double of_h) {
        return o.B + o.F * h2 * of_f + o.H * h3 * (-4 * d * d * y * v * q - d * q + 2 * d * y * y + of_h);
      };
      const auto by_v = [&](double of_f, double of_h) {
        return o.D * h + o.F * h2 * of_f + o.H * h3 * (d * d * q * q + of_h);
      };
      const double f_y = -2 * d * y * v - 1, h_y = -2 * d * v * v, f_v = d * q, h_v = -4 * d * y * v - 1;
      const double y_right = by_y(f_y, h_y), v_right = by_v(f_v, h_v);
      expect_erratum("hermitian-10-y-2", {by_y(-4 * d * y * v - 1, h_y), y_right, fy, rounding, 1});
      expect_erratum("hermitian-10-y-3", {by_y(f_y, 2 * d * v - 1), y_right, fy, rounding, 1});
      expect_erratum("hermitian-10-v-2", {by_v(-d * q, h_v), v_right, fv, rounding, 1});
      expect_erratum("hermitian-10-v-3", {by_v(f_v, 2 * d * y), v_right, fv, rounding, 1});
    }
  }
}

}  // namespace
}  // namespace nlmech::laier_test::errata_test

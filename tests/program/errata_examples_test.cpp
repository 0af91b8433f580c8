/// Equations of section 4 of Filipich and Rosales as printed and as corrected: against exact derivatives, an
/// orbit in closed form, and the classical Runge-Kutta rule on the equations in physical time.
#include <gtest/gtest.h>

#include <limits>

#include "nlmech/program/power_series.hpp"
#include "tests/errata/erratum.hpp"
#include "tests/program/numbers.hpp"
#include "tests/program/runge_kutta.hpp"

namespace nlmech::tests::errata_examples_test {
namespace {

using S = PowerSeries<Real>;
const Real tiny = 1e-45;

/// The sum of all coefficients: the value at tau = 1.
template <class T>
double at_one(const std::vector<T>& c) {
  T sum = 0;
  for (std::size_t i = c.size(); i-- > 0;) sum += c[i];
  return static_cast<double>(sum);
}

// ------------------------------------------------------------ projectile (58-60)

const Real beta = 0.01, g = 10, height = 1000, wind = 1000, T = 0.01, u0 = 400, v0 = 50;

/// How (58) and (59) are read.
struct Reading {
  Real factor = T;               ///< before x' in the brackets
  bool air_of_velocity = false;  ///< e^{-z'/h}
  Real fall = T * T * g;         ///< the constant of the last line
};

/// x_2, z_2 and x_3 in powers of tau = t/T by (60).
std::array<Real, 3> projectile(const Reading& read) {
  std::vector<Real> x = {0, T * u0}, z = {0, T * v0};
  for (int k = 0; k < 2; ++k) {
    // u_k, w_k: coefficients of the bracket times e^{-z/h}; x and z are known to order k + 1.
    std::vector<Real> dx, dz;
    for (std::size_t j = 1; j < x.size(); ++j) {
      dx.push_back(static_cast<int>(j) * x[j]);
      dz.push_back(static_cast<int>(j) * z[j]);
    }
    const auto i = static_cast<std::size_t>(k);
    const S zs(z), air = exp(-(read.air_of_velocity ? S(dz) : zs) / height);
    const S bracket_x = read.factor * S(dx) - T * T * wind * zs, bracket_z = read.factor * S(dz);
    const int phi = (k + 1) * (k + 2);
    x.push_back(-beta * (bracket_x * air)[i] / phi);
    z.push_back(-(beta * (bracket_z * air)[i] + (k == 0 ? read.fall : Real(0))) / phi);
  }
  return {x[2], z[2], x[3]};
}

// x and z along a step, from the exact derivatives in physical time: z'' = -beta e^{-z/h} z' - g at z = 0
// with z' = v_0, and x'' = -beta e^{-z/h} (x' - wind z).
TEST(PaperErrata, Eqs58To60TheFactorTOfTheVelocity) {
  const Real z2 = -beta * v0 - g, x2 = -beta * u0;  // second derivatives at t = 0
  const Real x3 = beta * v0 / height * u0 - beta * (x2 - wind * v0);
  const std::array<Real, 3> exact = {T * T * x2 / 2, T * T * z2 / 2, T * T * T * x3 / 6},
                            corrected = projectile({});
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(abs(corrected[i] - exact[i]), tiny);
  const auto show = [&](std::string_view id, const Real& printed, std::size_t i) {
    expect_erratum(id, {.printed = static_cast<double>(printed),
                        .corrected = static_cast<double>(corrected[i]),
                        .oracle = static_cast<double>(exact[i]),
                        .tolerance = epsilon});
  };
  // As printed the resistance is 1/T = 100 times too strong.
  const auto strong = projectile({.factor = 1});
  EXPECT_LT(abs(strong[0] / corrected[0] - 1 / T), Real(1e-40));
  show("algebraic_series-58-factor", strong[0], 0);
  show("algebraic_series-58-exponent", projectile({.air_of_velocity = true})[0], 0);
  // G is the paper's constant of gravitation in (61): nothing falls.
  show("algebraic_series-59", projectile({.fall = T * T * Real(6.674e-11)})[1], 1);
  // A twice in (60): the last line leaves z's coefficient in x.
  show("algebraic_series-60", corrected[1], 0);
}

// ------------------------------------------------------------ bodies (61-64)

/// x of the first of two bodies of mass 1 at tau = 1: (63) with @p constant for G and (64) with sigma the
/// coefficients of R^-3. They turn about each other at the distance 1, once in 2 pi, for G = 1/2.
double first_body(const Real& step, const Real& constant) {
  std::vector<Real> x = {Real(-1) / 2, 0}, y = {0, -step / 2};
  for (int k = 0; k < 24; ++k) {
    const S dx = -2 * S(x), dy = -2 * S(y), sigma = pow(dx * dx + dy * dy, Real(-3) / 2);
    const auto i = static_cast<std::size_t>(k);
    const int phi = (k + 1) * (k + 2);
    x.push_back(constant * (sigma * dx)[i] / phi);
    y.push_back(constant * (sigma * dy)[i] / phi);
  }
  return at_one(x);
}

TEST(PaperErrata, Eqs61To64TheAttractionOfTwoBodies) {
  const Real step = Real(1) / 10, G = Real(1) / 2;
  const auto circle = static_cast<double>(Real(-cos(step) / 2));  // in closed form
  const double corrected = first_body(step, G * step * step);
  expect_erratum(
      "algebraic_series-61",
      {.printed = first_body(step, G), .corrected = corrected, .oracle = circle, .tolerance = epsilon});
  // What is not defined has no value.
  expect_erratum("algebraic_series-64", {.printed = std::numeric_limits<double>::quiet_NaN(),
                                         .corrected = corrected,
                                         .oracle = circle,
                                         .tolerance = epsilon});
}

// ------------------------------------------------------------ oscillators (67-70)

// Eq. 67: A_{i+1} = sigma (B_i - A_i)/(i + 1). From (0, 1, 0) over one step of 0.05, 30 terms: 1e-13 is left
// out, with a radius of 0.15.
TEST(PaperErrata, Eq67TheSignOfTheLorenzEquation) {
  const double step = 0.05, sigma = 10 * step, r = 28 * step, b = 8.0 / 3 * step;
  const auto recurrence = [&](double sign) {
    std::vector<double> x = {0}, y = {1}, z = {0};
    for (std::size_t i = 0; i < 30; ++i) {
      double s = 0, product = 0;  // Eq. 68
      for (std::size_t p = 0; p <= i; ++p) {
        s += x[p] * z[i - p];
        product += x[p] * y[i - p];
      }
      const auto phi = static_cast<double>(i + 1);
      const double next = sign * sigma * (y[i] - x[i]) / phi;
      const double next_y = (r * x[i] - step * y[i] - step * s) / phi,
                   next_z = (step * product - b * z[i]) / phi;
      x.push_back(next);
      y.push_back(next_y);
      z.push_back(next_z);
    }
    return at_one(x);
  };
  const auto field = [](double, const std::array<double, 3>& x) {  // Eq. 65
    return std::array{10 * (x[1] - x[0]), 28 * x[0] - x[1] - x[0] * x[2], x[0] * x[1] - 8.0 / 3 * x[2]};
  };
  expect_erratum("algebraic_series-67",
                 {.printed = recurrence(-1),
                  .corrected = recurrence(1),
                  .oracle = runge_kutta(field, std::array{0.0, 1.0, 0.0}, 0, step, 1000)[0],
                  .tolerance = 1e-11});
}

// Eq. 69 calls alpha_i what must be the braces of Eq. 56, the coefficients of f(t) in the step; alpha_i are
// those of the cosine in Eq. 50. Step p = 3 of T = 0.1, from u = 3, u' = 4; 20 terms leave out 1e-14.
TEST(PaperErrata, Eq69TheForceOfTheStep) {
  const double step = 0.1, P = 0.05 * step, Q = step * step, B = 7.5 * step * step;
  const auto recurrence = [&](bool printed) {
    std::vector<double> a = {3, 4 * step};
    double over = 1, power = 1;  // 1/i!, (omega T)^i
    for (std::size_t i = 0; i < 20; ++i) {
      const double sign = i % 4 < 2 ? 1 : -1;
      const double alpha = i % 2 == 0 ? sign * over : 0, beta_i = i % 2 == 1 ? sign * over : 0;  // Eq. 50
      const double braces = power * (std::cos(2 * step) * alpha - std::sin(2 * step) * beta_i);
      const PowerSeries<double> u(a);
      const auto phi = static_cast<double>(i + 1);
      a.push_back((B * (printed ? alpha : braces) - P * phi * a[i + 1] - Q * (u * u * u)[i]) /
                  (phi * (phi + 1)));
      over /= phi;
      power *= step;
    }
    return at_one(a);
  };
  const auto field = [](double t, const std::array<double, 2>& x) {  // Eq. 39
    return std::array{x[1], 7.5 * std::cos(t) - 0.05 * x[1] - x[0] * x[0] * x[0]};
  };
  expect_erratum("algebraic_series-69",
                 {.printed = recurrence(true),
                  .corrected = recurrence(false),
                  .oracle = runge_kutta(field, std::array{3.0, 4.0}, 2 * step, 3 * step, 1000)[0],
                  .tolerance = 1e-12});
}

// Eq. 70 has sin 2 T tau in every step. With t_0 = pi that is the first step's; in step p it is
// sin 2 (T (tau + p - 1) + t_0). p = 3, T = 0.125 from x = -0.5, dx/dt = 0.1; 30 terms leave out nothing.
TEST(PaperErrata, Eq70ThePhaseOfTheStep) {
  const double step = 0.125, A = 0.306 * step * step, B = 5 * step, t0 = std::acos(-1.0) + 2 * step;
  const auto recurrence = [&](double phase) {
    const PowerSeries<double> sine = sin(2 * step * PowerSeries<double>::variable(0, 30) + phase);
    std::vector<double> a = {-0.5, 0.1 * step};
    for (std::size_t k = 0; k < 30; ++k) {
      std::vector<double> slope;
      for (std::size_t j = 1; j < a.size(); ++j) slope.push_back(static_cast<double>(j) * a[j]);
      const PowerSeries<double> x(a);
      const double lambda = (PowerSeries<double>(slope) * x * x * sine)[k];
      a.push_back(-(A * a[k] + B * lambda) / static_cast<double>((k + 1) * (k + 2)));  // Eq. 71
    }
    return at_one(a);
  };
  const auto field = [](double t, const std::array<double, 2>& x) {
    return std::array{x[1], -0.306 * x[0] - 5 * x[1] * x[0] * x[0] * std::sin(2 * t)};
  };
  expect_erratum("algebraic_series-70",
                 {.printed = recurrence(0),
                  .corrected = recurrence(2 * t0),
                  .oracle = runge_kutta(field, std::array{-0.5, 0.1}, t0, t0 + step, 1000)[0],
                  .tolerance = 1e-12});
}

}  // namespace
}  // namespace nlmech::tests::errata_examples_test

/// Recurrences of Filipich and Rosales as printed and as corrected, against independent closed forms and
/// series arithmetic in 50 digits.
#include <gtest/gtest.h>

#include <limits>

#include "nlmech/program/power_series.hpp"
#include "tests/errata/erratum.hpp"
#include "tests/program/numbers.hpp"
#include "tests/program/runge_kutta.hpp"

namespace nlmech::tests::errata_test {
namespace {

using S = PowerSeries<Real>;
constexpr std::size_t terms = 20;
const Real tiny = 1e-45;

S tau() { return S::variable(0, terms); }

/// The sum of c_i at^i.
Real sum_of(const std::vector<Real>& c, const Real& at) {
  Real sum = 0;
  for (std::size_t i = c.size(); i-- > 0;) sum = sum * at + c[i];
  return sum;
}
double value(const std::vector<Real>& c, const Real& at) { return static_cast<double>(sum_of(c, at)); }

// Eq. 20: the sum starts with s = 1. With s = 0 it contains the unknown as B_0 D_i; solved for it, the
// printed equation has 2 B_0 instead of B_0.
TEST(PaperErrata, Eq20TheUnknownStandsInItsOwnSum) {
  const S f = exp(tau()), g = 2 + sin(tau()), quotient = exp(tau()) / (2 + sin(tau()));
  const auto divide = [&](const Real& b0) {
    std::vector<Real> d;
    for (std::size_t i = 0; i <= terms; ++i) {
      Real sum = f[i];
      for (std::size_t s = 1; s <= i; ++s) sum -= g[s] * d[i - s];
      d.push_back(sum / b0);
    }
    return d;
  };
  const std::vector<Real> corrected = divide(g[0]), printed = divide(2 * g[0]);
  for (std::size_t i = 0; i <= terms; ++i) EXPECT_LT(abs(corrected[i] - quotient[i]), tiny);
  // The truncation error is 0.1^21 over the radius, 2.05: negligible.
  const Real at = Real(1) / 10;
  expect_erratum("algebraic_series-20", {.printed = value(printed, at),
                                         .corrected = value(corrected, at),
                                         .oracle = static_cast<double>(Real(exp(at) / (2 + sin(at)))),
                                         .tolerance = epsilon});
}

// Eqs. 24-26 from P_10, which the paper does not give.
std::vector<Real> fractional_power(const S& f, int n, std::size_t count, const Real& first) {
  const auto size = static_cast<std::size_t>(n);
  std::vector<std::vector<Real>> p(size + 1, std::vector<Real>(count + 1, Real(0)));
  p[1][0] = first;
  for (std::size_t r = 2; r <= size; ++r) p[r][0] = p[r - 1][0] * p[1][0];
  Real d = pow(p[1][0], n - 1);  // Eq. 25
  for (std::size_t j = 1; j < size; ++j) d += pow(p[1][0], static_cast<int>(j) - 1) * p[size - j][0];
  EXPECT_LT(abs(d - n * pow(p[1][0], n - 1)), tiny);  // the sum is n P^(n-1)
  for (std::size_t i = 1; i <= count; ++i) {
    Real sum = f[i];
    for (std::size_t j = 1; j < size; ++j) {
      Real z = 0;  // Eq. 24
      for (std::size_t s = 1; s < i; ++s) z += p[size - j][s] * p[1][i - s];
      sum -= pow(p[1][0], static_cast<int>(j) - 1) * z;
    }
    p[1][i] = sum / d;  // Eq. 26
    for (std::size_t r = 2; r <= size; ++r) {
      for (std::size_t s = 0; s <= i; ++s) p[r][i] += p[r - 1][s] * p[1][i - s];
    }
  }
  return p[1];
}

/// f = 1 + 0.3 tau + 0.2 tau^2, with zeros at the distance sqrt(5); f(1) = 1.5.
S quadratic(std::size_t count) {
  const S t = S::variable(0, count);
  return 1 + Real(3) / 10 * t + Real(2) / 10 * t * t;
}

// Eq. 23 with i = 0 is P_10^n = A_0, the start of the recurrence.
TEST(PaperErrata, Eqs24To26StartFromEq23) {
  const S f = quadratic(60);
  EXPECT_NEAR(value(fractional_power(f, 5, 60, pow(f[0], Real(1) / 5)), 1), std::pow(1.5, 0.2), epsilon);
}

// The recurrence is correct as printed; the note that n = 5 needs 3000 terms is wrong: sixty terms give 24
// digits at tau = 1 if the nearest zero of f lies beyond, and few digits if it lies on the circle.
TEST(PaperErrata, Eqs24To26DependOnTheNearestZeroNotOnN) {
  const std::size_t count = 60;
  const S f = quadratic(count);
  const std::vector<Real> p = fractional_power(f, 5, count, 1);
  const S power = pow(f, Real(1) / 5);
  const Real reference = pow(Real(3) / 2, Real(1) / 5);
  Real sum = 0;
  std::size_t needed = 0;  // for ten digits
  for (std::size_t i = 0; i <= count; ++i) {
    EXPECT_LT(abs(p[i] - power[i]), tiny) << i;
    sum += p[i];
    if (abs(sum - reference) > 1e-10) needed = i + 1;
  }
  EXPECT_LT(abs(sum - reference), 1e-22);
  // Darboux: two zeros at the distance sqrt(5) give terms of 2 i^(-6/5) sqrt(5)^-i/|Gamma(-1/5)|, up to the
  // phase, which is worth a few terms. The number of terms for 1e-10:
  double theory = 20;
  for (int turn = 0; turn < 50; ++turn) {
    const double factor = 2 / std::abs(std::tgamma(-0.2)) * std::pow(theory, -1.2);
    theory = std::log(1e10 * factor) / std::log(std::sqrt(5.0));
  }
  expect_erratum(
      "algebraic_series-26-terms",
      {.printed = 3000, .corrected = static_cast<double>(needed), .oracle = theory, .tolerance = 0.15});
  // f = 1 - tau: the recurrence for any exponent, 3000 terms, at tau = 1, where the exact value is 0. The
  // partial sums of (1 - tau)^p at 1 are the product of (1 - p/k), about 3000^-p/Gamma(1 - p) = 0.173.
  std::vector<double> line = {1, -1};
  line.resize(3001);
  const PowerSeries<double> root = pow(PowerSeries<double>(line), 0.2);
  double far = 0;
  for (std::size_t i = 0; i <= 3000; ++i) far += root[i];
  EXPECT_NEAR(far, std::pow(3000.5, -0.2) / std::tgamma(0.8), 1e-4);
  EXPECT_GT(far, 0.17);
}

// Before Eq. 36 the text takes the coefficients of tau^2 v'' about tau = 1 from (20), a quotient; correct is
// (30), a product. v = exp(tau - 1), at tau = 1.2.
TEST(PaperErrata, Eq36IsAProduct) {
  std::vector<Real> v = {1}, product, quotient;  // A_i
  for (std::size_t i = 1; i <= terms + 2; ++i) v.push_back(v.back() / static_cast<int>(i));
  const Real beta[] = {1, 2, 1};  // Eq. 33
  const auto second = [&](std::size_t i) {
    return Real(static_cast<int>((i + 1) * (i + 2)) * v[i + 2]);  // phi_2i A_{i+2}
  };
  for (std::size_t i = 0; i <= terms; ++i) {
    Real times = beta[0] * second(i), by = second(i);
    for (std::size_t s = 1; s <= std::min<std::size_t>(i, 2); ++s) {
      times += beta[s] * second(i - s);  // Eq. 30
      by -= beta[s] * quotient[i - s];   // Eq. 20
    }
    product.push_back(times);
    quotient.push_back(by / beta[0]);
  }
  const Real at = Real(2) / 10;
  expect_erratum("algebraic_series-36", {.printed = value(quotient, at),
                                         .corrected = value(product, at),
                                         .oracle = static_cast<double>(Real((1 + at) * (1 + at) * exp(at))),
                                         .tolerance = epsilon});
}

// Eq. 41 starts step p at t = p - 1. It starts where step p - 1 ends.
TEST(PaperErrata, Eq41StepsAdjoin) {
  const double T = 0.35;
  const int p = 4;
  double end = 0;
  for (int step = 1; step < p; ++step) end += T;
  expect_erratum("algebraic_series-41-start",
                 {.printed = p - 1, .corrected = (p - 1) * T, .oracle = end, .tolerance = 4 * epsilon});
}

// "The domain of each tau is unitary which ensures the convergence": dx/dt = -x^2 from 1 has the solution
// 1/(1 + t), smooth for all t >= 0; its series about t has the radius 1 + t, for any T.
TEST(PaperErrata, Eq41AUnitDomainDoesNotConverge) {
  const auto solve = [](int steps, int order) {
    const Real T = Real(2) / steps;
    Real x = 1;
    for (int p = 1; p <= steps; ++p) {
      std::vector<Real> a = {x};
      for (int k = 0; k < order; ++k) {
        const S series(a);
        a.push_back(-T * (series * series)[static_cast<std::size_t>(k)] / (k + 1));
      }
      x = sum_of(a, 1);
    }
    return static_cast<double>(x);
  };
  // Eight steps of 0.25: the truncation error of each is 4^-21.
  expect_erratum("algebraic_series-41-convergence",
                 {.printed = solve(1, 20), .corrected = solve(8, 20), .oracle = 1.0 / 3, .tolerance = 1e-12});
  EXPECT_GT(std::abs(solve(1, 40)), 1e4 * std::abs(solve(1, 20)));  // more terms increase the error
}

// Eq. 52 prints B_1i = omega T for i = 0; x = omega T tau has it at i = 1, as in Eq. 53. The cosine by Eqs.
// 15, 50 and 55 at tau = 1/2.
TEST(PaperErrata, Eq52TheCoefficientOfALine) {
  const Real wT = Real(35) / 100;
  const S x = wT * tau();
  EXPECT_EQ(x[0], 0);
  EXPECT_EQ(x[1], wT);
  const S square = x * x;
  EXPECT_LT(abs(square[2] - wT * wT), tiny);  // Eq. 53 for m = 2, from the corrected one
  const auto cosine = [&](std::size_t place) {
    std::vector<Real> line(terms + 1, Real(0)), c(terms + 1, Real(0));
    line[place] = wT;  // B_1i
    S power(std::vector<Real>(terms + 1, Real(0)));
    power += 1;  // B_0i
    Real alpha = 1;
    for (std::size_t j = 0; j <= terms; j += 2) {
      for (std::size_t i = 0; i <= terms; ++i) c[i] += alpha * power[i];
      power = power * S(line) * S(line);
      alpha /= -static_cast<int>((j + 1) * (j + 2));
    }
    return value(c, Real(1) / 2);
  };
  expect_erratum("algebraic_series-52", {.printed = cosine(0),
                                         .corrected = cosine(1),
                                         .oracle = static_cast<double>(Real(cos(wT / 2))),
                                         .tolerance = epsilon});
}

// Eq. 56: cos[omega T (p - 1)] C_i, not cos[omega T (p - 1) C_i].
TEST(PaperErrata, Eq56TheBracketOfTheCosine) {
  const Real wT = 0.35;
  const int p = 4;
  const S exact = cos(wT * (tau() + Real(p - 1))), c = cos(wT * tau()), s = sin(wT * tau());
  std::vector<Real> printed, corrected;
  for (std::size_t i = 0; i <= terms; ++i) {
    corrected.push_back(cos(wT * (p - 1)) * c[i] - sin(wT * (p - 1)) * s[i]);
    printed.push_back(cos(wT * (p - 1) * c[i]) - sin(wT * (p - 1)) * s[i]);
    EXPECT_LT(abs(corrected[i] - exact[i]), tiny) << i;
  }
  EXPECT_GT(abs(printed[1] - exact[1]), 0.5);  // cos 0 = 1 for every odd i
  const Real half = Real(1) / 2;
  expect_erratum("algebraic_series-56", {.printed = value(printed, half),
                                         .corrected = value(corrected, half),
                                         .oracle = static_cast<double>(Real(cos(wT * (half + p - 1)))),
                                         .tolerance = 4 * epsilon});
}

// ---- Equations of section 4 of Filipich and Rosales as printed and as corrected, against exact derivatives,
// an orbit in closed form, and the classical Runge-Kutta method on the equations in physical time.

/// The sum of all coefficients: the value at tau = 1.
template <class T>
double at_one(const std::vector<T>& c) {
  T sum = 0;
  for (std::size_t i = c.size(); i-- > 0;) sum += c[i];
  return static_cast<double>(sum);
}

// ------------------------------------------------------------ projectile (58-60)

const Real beta = 0.01, g = 10, height = 1000, wind = 1000, T = 0.01, u0 = 400, v0 = 50;

/// x_2, z_2 and x_3 in powers of tau = t/T by (60), with beta in 1/s: beta T [x' - T V].
/// @param air_of_velocity the factor e^{-z'/h} that (58) prints
std::array<Real, 3> projectile(bool air_of_velocity) {
  std::vector<Real> x = {0, T * u0}, z = {0, T * v0};
  for (int k = 0; k < 2; ++k) {
    // u_k, w_k: coefficients of the bracket times e^{-z/h}; x and z are known up to order k + 1.
    std::vector<Real> dx, dz;
    for (std::size_t j = 1; j < x.size(); ++j) {
      dx.push_back(static_cast<int>(j) * x[j]);
      dz.push_back(static_cast<int>(j) * z[j]);
    }
    const auto i = static_cast<std::size_t>(k);
    const S zs(z), air = exp(-(air_of_velocity ? S(dz) : zs) / height);
    const S bracket_x = T * S(dx) - T * T * wind * zs, bracket_z = T * S(dz);
    const int phi = (k + 1) * (k + 2);
    x.push_back(-beta * (bracket_x * air)[i] / phi);
    z.push_back(-(beta * (bracket_z * air)[i] + (k == 0 ? T * T * g : Real(0))) / phi);
  }
  return {x[2], z[2], x[3]};
}

// Series of x and z in a step, from the exact derivatives in physical time: z'' = -beta e^{-z/h} z' - g at z
// = 0 with z' = v_0, and x'' = -beta e^{-z/h} (x' - wind z).
TEST(PaperErrata, Eqs58To60TheFactorTOfTheVelocity) {
  const Real z2 = -beta * v0 - g, x2 = -beta * u0;  // second derivatives at t = 0
  const Real x3 = beta * v0 / height * u0 - beta * (x2 - wind * v0);
  const std::array<Real, 3> exact = {T * T * x2 / 2, T * T * z2 / 2, T * T * T * x3 / 6},
                            corrected = projectile(false);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(abs(corrected[i] - exact[i]), tiny);
  const auto show = [&](std::string_view id, const Real& printed, std::size_t i) {
    expect_erratum(id, {.printed = static_cast<double>(printed),
                        .corrected = static_cast<double>(corrected[i]),
                        .oracle = static_cast<double>(exact[i]),
                        .tolerance = epsilon});
  };
  show("algebraic_series-58-exponent", projectile(true)[0], 0);
  // A occurs twice in (60): the last line gives x a coefficient of z.
  show("algebraic_series-60", corrected[1], 0);
  // The brackets of (58) for a body that moves with the wind, dx/dt = V: x' = T V. The drag is zero for any
  // unit of beta.
  const Real speed = T * wind;
  expect_erratum("algebraic_series-58-factor", {.printed = static_cast<double>(Real(speed - T * T * wind)),
                                                .corrected = static_cast<double>(Real(speed - T * wind)),
                                                .oracle = 0,
                                                .tolerance = epsilon,
                                                .scale = static_cast<double>(speed)});
}

// ------------------------------------------------------------ bodies (61-64)

/// x of the first of two bodies of mass 1 at tau = 1: (63) with @p constant for G and (64) with sigma the
/// coefficients of R^-3. The bodies move on a circle at the distance 1 with period 2 pi for G = 1/2.
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
  // The printed equation is undefined.
  expect_erratum("algebraic_series-64", {.printed = std::numeric_limits<double>::quiet_NaN(),
                                         .corrected = corrected,
                                         .oracle = circle,
                                         .tolerance = epsilon});
}

// ------------------------------------------------------------ oscillators (67-70)

// Eq. 67: A_{i+1} = sigma (B_i - A_i)/(i + 1). From (0, 1, 0) over one step of 0.05 with 30 terms: the
// truncation error is 1e-13, for a radius of 0.15.
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

// Eq. 69 uses alpha_i for the braces of Eq. 56, the coefficients of f(t) in the step; alpha_i are those of
// the cosine in Eq. 50. Step p = 3 of T = 0.1, from u = 3, u' = 4; the truncation error of 20 terms is 1e-14.
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

// Eq. 70 has sin 2 T tau in every step. With t_0 = pi this is correct for the first step only; in step p it
// is sin 2 (T (tau + p - 1) + t_0). p = 3, T = 0.125 from x = -0.5, dx/dt = 0.1; the truncation error of 30
// terms is negligible.
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
}  // namespace nlmech::tests::errata_test

/// Recurrences of Filipich and Rosales as printed and as corrected, against series arithmetic in 50 digits
/// that shares nothing with them.
#include <gtest/gtest.h>

#include "nlmech/series/power_series.hpp"
#include "tests/series/numbers.hpp"

namespace nlmech::tests {
namespace {

using S = PowerSeries<Real>;
constexpr std::size_t terms = 20;
const Real tiny = 1e-45;

S tau() { return S::variable(0, terms); }

// Eq. 20: the sum begins with s = 1; with s = 0 it would contain B_0 D_i, which is sought (taken as 0 there,
// which is what a program finds in fresh memory, the printed sum changes nothing at i = 0 and is the
// corrected one; taken as the value itself, the equation contradicts itself).
TEST(PaperErrata, Eq20TheUnknownStandsInItsOwnSum) {
  const S f = exp(tau()), g = 2 + sin(tau()), quotient = exp(tau()) / (2 + sin(tau()));
  for (std::size_t i = 0; i <= terms; ++i) {
    Real corrected = f[i], printed = f[i];
    for (std::size_t s = 0; s <= i; ++s) {
      if (s > 0) corrected -= g[s] * quotient[i - s];
      printed -= g[s] * quotient[i - s];
    }
    EXPECT_LT(abs(corrected / g[0] - quotient[i]), tiny);
    EXPECT_LT(abs(printed / g[0]), tiny) << "as printed every coefficient is 0";
  }
  EXPECT_GT(abs(quotient[3]), 1e-3);
}

// Eqs. 24-26, with P_10 = A_0^(1/n), which the paper leaves out.
std::vector<Real> fractional_power(const S& f, int n, std::size_t count) {
  const auto size = static_cast<std::size_t>(n);
  std::vector<std::vector<Real>> p(size + 1, std::vector<Real>(count + 1, Real(0)));
  p[1][0] = pow(f[0], Real(1) / n);
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

// Right as printed, and the note that n = 5 needs 3000 terms is not: sixty give 24 digits at tau = 1 where
// the nearest zero of f lies beyond, and none give much where it lies on the circle.
TEST(PaperErrata, Eqs24To26DependOnTheNearestZeroNotOnN) {
  const std::size_t count = 60;
  const S t = S::variable(0, count), f = 1 + Real(0.3) * t + Real(0.2) * t * t;
  const std::vector<Real> p = fractional_power(f, 5, count);
  const S power = pow(f, Real(1) / 5);
  Real sum = 0;
  for (std::size_t i = 0; i <= count; ++i) {
    EXPECT_LT(abs(p[i] - power[i]), tiny) << i;
    sum += p[i];
  }
  EXPECT_LT(abs(sum - pow(Real(1.5), Real(1) / 5)), 1e-22);
  // f = 1 - tau: the recurrence for any exponent, 3000 terms, at tau = 1 where the value is 0. The partial
  // sums of (1 - tau)^p at 1 are the product of (1 - p/k), about 3000^-p/Gamma(1 - p) = 0.173.
  std::vector<double> line = {1, -1};
  line.resize(3001);
  const PowerSeries<double> root = pow(PowerSeries<double>(line), 0.2);
  double far = 0;
  for (std::size_t i = 0; i <= 3000; ++i) far += root[i];
  EXPECT_NEAR(far, std::pow(3000.5, -0.2) / std::tgamma(0.8), 1e-4);
  EXPECT_GT(far, 0.17);
}

// Eq. 52 prints B_1i = omega T for i = 0, where x = omega T tau has it at i = 1, as Eq. 53 says.
TEST(PaperErrata, Eq52TheCoefficientOfALine) {
  const Real wT = 0.35;
  const S x = wT * tau();
  EXPECT_EQ(x[0], 0);
  EXPECT_EQ(x[1], wT);
  const S square = x * x;
  EXPECT_LT(abs(square[2] - wT * wT), tiny);                  // Eq. 53 for m = 2, from the corrected one
  EXPECT_GT(abs((S(wT) * S(wT))[0] - square[0]), Real(0.1));  // the printed one gives a constant
}

// Eq. 56: cos[omega T (p - 1)] C_i, not cos[omega T (p - 1) C_i].
TEST(PaperErrata, Eq56TheBracketOfTheCosine) {
  const Real wT = 0.35;
  const int p = 4;
  const S exact = cos(wT * (tau() + Real(p - 1))), c = cos(wT * tau()), s = sin(wT * tau());
  Real printed_error = 0;
  for (std::size_t i = 0; i <= terms; ++i) {
    EXPECT_LT(abs(cos(wT * (p - 1)) * c[i] - sin(wT * (p - 1)) * s[i] - exact[i]), tiny) << i;
    const Real printed = cos(wT * (p - 1) * c[i]) - sin(wT * (p - 1)) * s[i];
    printed_error = std::max(printed_error, Real(abs(printed - exact[i])));
  }
  EXPECT_GT(printed_error, 0.5);  // cos 0 = 1 for every odd i
}

// x and z of the projectile along a step: two coefficients from the exact derivatives of r'' in physical
// time. z'' = -beta e^{-z/h} z' - g at z = 0 with z' = v, and x'' = -beta e^{-z/h} (x' - a z).
TEST(PaperErrata, Eqs58To60TheFactorTOfTheVelocity) {
  const Real beta = 0.01, g = 10, h = 1000, a = 1000, T = 0.01, u = 400, v = 50;
  const Real z2 = -beta * v - g, x2 = -beta * u;  // second derivatives at t = 0
  const Real x3 = beta * v / h * u - beta * (x2 - a * v);
  const auto series = [&](const Real& factor, bool constant_g) {
    std::vector<Real> x = {0, T * u}, z = {0, T * v};  // in powers of tau = t/T
    for (int k = 0; k < 2; ++k) {
      // u_k, w_k: coefficients of the bracket times e^{-z/h}; x and z are known to order k + 1.
      const S xs(x), zs(z), air = exp(-zs / h);
      const auto i = static_cast<std::size_t>(k);
      std::vector<Real> dx, dz;
      for (std::size_t j = 1; j < x.size(); ++j) {
        dx.push_back(static_cast<int>(j) * x[j]);
        dz.push_back(static_cast<int>(j) * z[j]);
      }
      const S bracket_x = factor * S(dx) - T * T * a * zs, bracket_z = factor * S(dz);
      const int phi = (k + 1) * (k + 2);
      x.push_back(-beta * (bracket_x * air)[i] / phi);
      z.push_back(-(beta * (bracket_z * air)[i] + (k == 0 && constant_g ? T * T * g : Real(0))) / phi);
    }
    return std::array{x[2], z[2], x[3]};
  };
  const auto corrected = series(T, true), printed = series(1, true);
  EXPECT_LT(abs(corrected[0] - T * T * x2 / 2), tiny);
  EXPECT_LT(abs(corrected[1] - T * T * z2 / 2), tiny);
  EXPECT_LT(abs(corrected[2] - T * T * T * x3 / 6), tiny);
  // As printed the resistance is 1/T = 100 times too strong.
  EXPECT_LT(abs(printed[0] / corrected[0] - 1 / T), Real(1e-40));
  EXPECT_GT(abs(printed[1] - corrected[1]), Real(1e-3));
  // Eq. 59 prints G T^2 for g T^2: without it nothing falls.
  EXPECT_GT(abs(series(T, false)[1] - corrected[1]), T * T * g / 3);
}

// Eq. 67: A_{i+1} = sigma (B_i - A_i)/(i + 1). From (0, 1, 0) u' = sigma v > 0.
TEST(PaperErrata, Eq67TheSignOfTheLorenzEquation) {
  const Real sigma = Real(10) / 10, A0 = 0, B0 = 1;  // T = 0.1
  const Real slope = Real(10) * (B0 - A0) / 10;      // T u' from Eq. 65
  EXPECT_EQ(sigma * (B0 - A0), slope);
  EXPECT_EQ(sigma * (A0 - B0), -slope);
}

// Eq. 69 calls alpha_i what must be the braces of Eq. 56, the coefficients of f(t) in the step; alpha_i are
// 1/i! in Eq. 50. omega = 1, step p = 3 of T = 0.35, from u = 3, u' = 4: coefficient 2.
TEST(PaperErrata, Eq69TheForceOfTheStep) {
  const Real T = 0.35, P = T * Real(0.05), Q = T * T, B = T * T * Real(7.5), t = 2 * T, u = 3, v = 4;
  const Real acceleration = Real(7.5) * cos(t) - Real(0.05) * v - u * u * u;
  const S force = cos(T * (tau() + Real(2)));
  const Real corrected = (B * force[0] - P * (T * v) - Q * u * u * u) / 2;
  const Real printed = (B * 1 - P * (T * v) - Q * u * u * u) / 2;  // alpha_0 = 1
  EXPECT_LT(abs(corrected - T * T * acceleration / 2), tiny);
  EXPECT_GT(abs(printed - corrected), Real(0.1));
}

}  // namespace
}  // namespace nlmech::tests

/// Misprints of the source about the open loop (Eqs. 3.22 to 3.49): the printed form is wrong, the corrected
/// right.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>

#include "nlmech/spacecraft/assumed_modes.hpp"
#include "nlmech/spacecraft/closed_form.hpp"
#include "nlmech/spacecraft/plant.hpp"
#include "nlmech/spacecraft/poles.hpp"

namespace nlmech::spacecraft {
namespace {

using Solution = GssSolution<Complex>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

double unit_of(const Parameters& p) { return p.mass_per_length / p.bending_stiffness(); }

/// The middle of the bracket in which f rises through zero.
double rise(const std::function<double(double)>& f, double low, double high) {
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (f(middle) > 0 ? high : low) = middle;
  }
  return low;
}

/// exp(A x) by Taylor's series of A x/64, squared 6 times: 1e-14 of its largest entry.
Matrix6 exponential(const Matrix6& a, double x) {
  const Matrix6 small = a * (x / 64);
  Matrix6 term = Matrix6::Identity(), sum = term;
  for (int k = 1; k < 25; ++k) {
    term = term * small / k;
    sum += term;
  }
  for (int k = 0; k < 6; ++k) sum = sum * sum;
  return sum;
}

/// The matrix of Eq. 3.25; as printed its fifth row is [0 0 0 0 1 0].
Matrix6 state_matrix(double beta, bool printed) {
  Matrix6 a = Matrix6::Zero();
  for (int i = 0; i < 5; ++i) a(i, i + 1) = 1;
  if (printed) {
    a(4, 5) = 0;
    a(4, 4) = 1;
  }
  a(5, 2) = -beta;
  return a;
}

/// f and three derivatives for real beta > 0, from Eq. 3.30.
std::array<double, 4> f_of(double beta, double x) {
  const double k = std::pow(beta, 0.25) / std::numbers::sqrt2, c = std::cos(k * x), s = std::sin(k * x),
               ch = std::cosh(k * x), sh = std::sinh(k * x);
  return {c * ch, k * (c * sh - s * ch), -2 * k * k * s * sh, -2 * k * k * k * (c * sh + s * ch)};
}

// Eqs. 3.22, 3.38, 3.39, 3.42, 3.43: (r + x) g_2(x) - g_1(x) is to be taken at x = L.
TEST(Errata, PolesDoNotDependOnThePlaceLookedAt) {
  const auto pole = [](const Parameters& p, double x, bool literal) {
    const auto sum = [&](double omega) {
      return Solution(p, {0, omega}, {.literal_x = literal}).effective_inertia(x).real();
    };
    return p.has_tip() ? rise(sum, 5, 8) : rise(sum, 11.52, 14);
  };
  const Parameters none = without_tip(table_3_1()), tip = table_3_1();
  // Five printed digits; the closed form in doubles is right to 1e-12 here.
  EXPECT_NEAR(pole(none, 2, true), 11.625, 6e-4);
  EXPECT_NEAR(pole(tip, 2, true), 5.9363, 2e-4);
  for (const double x : {2., 4.}) {
    EXPECT_NEAR(pole(none, x, false), 12.85700141881, 1e-9);
    EXPECT_NEAR(pole(tip, x, false), 6.452959965749, 1e-9);
  }
  EXPECT_NEAR(pole(none, 4, true), 12.85700141881, 1e-9);  // x = L is the truth
}

// Eq. 3.21 with the boundary term at x = L, against quadrature of g_3.
TEST(Errata, TheIntegralsOfTheStateAreThoseOfTheDeflection) {
  const Parameters p = table_3_1();
  const Solution z(p, {0.5, 20});
  const int n = 2000;
  const double h = p.length / n;
  Complex sum = 0;
  for (int i = 0; i <= n; ++i) {
    const double weight = i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2, x = i * h;
    sum += weight * h / 3 * (p.hub_radius + x) * z.state(x)[2];
  }
  const auto at = [&](double x) { return (p.hub_radius + x) * z.state(x)[1] - z.state(x)[0]; };
  EXPECT_LE(std::abs(at(p.length) - sum), 1e-9 * std::abs(sum));
  EXPECT_GT(std::abs(at(2) - sum), 0.1 * std::abs(sum));
}

// Eqs. 3.25 and 3.28: the fifth row of A, and the sign before z_6 in the first row of the solution.
TEST(Errata, TheHomogeneousSolutionIsTheMatrixExponential) {
  const double beta = 9 * unit_of(table_3_1()), x = 4;
  const auto f = f_of(beta, x);
  const Matrix6 e = exponential(state_matrix(beta, false), x);
  Eigen::Matrix<double, 6, 2> corrected;
  corrected << (1 - f[0]) / beta, (beta * x + f[3]) / (beta * beta), -f[1] / beta, (1 - f[0]) / beta,
      -f[2] / beta, -f[1] / beta, -f[3] / beta, -f[2] / beta, f[0], -f[3] / beta, f[1], f[0];
  // Differences of f lose up to 4 digits by 1/beta^2.
  EXPECT_LE((e.rightCols<2>() - corrected).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_NEAR(e(0, 5), 8.53096393846971, 1e-12);
  EXPECT_NEAR(-(beta * x + f[3]) / (beta * beta), -8.53096393846971, 1e-8);
  // As printed the moment would grow by itself.
  const Matrix6 printed = exponential(state_matrix(beta, true), x);
  EXPECT_GT((printed.rightCols<2>() - corrected).cwiseAbs().maxCoeff(), 1);
  const Solution right(table_3_1(), {3, 0}), wrong(table_3_1(), {3, 0}, {.minus_in_z1 = true});
  EXPECT_GT(std::abs(right.state(4)[0] - wrong.state(4)[0]), 0.01 * std::abs(right.state(4)[0]));
  EXPECT_EQ(right.state(4)[2], wrong.state(4)[2]);
}

// Eqs. 3.30 and 3.31: f is the real part of cos(sigma x) only where s is real.
TEST(Errata, FIsTheMeanOfCosineAndHyperbolicCosine) {
  const double unit = unit_of(table_3_1());
  const auto sigma = [](Complex beta) { return std::sqrt(Complex(0, 1) * std::sqrt(beta)); };
  const Complex fast = sigma(-1e4 * unit), slow = sigma(9 * unit);
  EXPECT_NEAR(std::cos(fast * 4.).real(), 125.665, 5e-4);
  EXPECT_NEAR(((std::cos(fast * 4.) + std::cosh(fast * 4.)) / 2.).real(), 63.1961, 5e-5);
  EXPECT_NEAR(std::cos(slow * 4.).real(), f_of(9 * unit, 4)[0], 1e-14);
  // Eq. 3.30 for complex beta is the mean as well.
  const Complex k = std::pow(Complex(-1e4 * unit), 0.25) / std::numbers::sqrt2;
  EXPECT_NEAR((std::cos(4. * k) * std::cosh(4. * k)).real(), 63.1961, 5e-5);
}

// Eqs. 3.32-3.34, 3.37, 3.41: cos(sigma x) does not satisfy y(0) = 0, and hub-locked resonances vanish.
TEST(Errata, TheCosineAloneIsNoSolution) {
  const Parameters p = without_tip(table_3_1());
  const Solution right(p, {0, 1}), wrong(p, {0, 1}, {.cosine = true});
  EXPECT_NEAR(wrong.state(0)[2].real(), 0.576, 5e-4);
  EXPECT_NEAR(wrong.deflection(2).real(), -0.016110, 5e-7);
  EXPECT_NEAR(right.deflection(2).real(), -0.00155990461324693, 1e-14);
  EXPECT_LE(std::abs(right.state(0)[2]), 1e-12);
  // Eq. 3.37: its determinant with sin squared is cos^2 + sin^2 = 1 whatever s; f^2 + f' f'''/beta is D_0.
  for (const double omega : {11.51094878903, 72.13788468598}) {
    const double beta = -omega * omega * unit_of(p);
    const Complex sigma = std::sqrt(Complex(0, 1) * std::sqrt(Complex(beta))), a = sigma * p.length;
    const Complex fourth = std::pow(sigma, 4), c = std::cos(a), s = std::sin(a);
    EXPECT_LE(std::abs(c * c - fourth * s * s / beta - 1.), 1e-10 * std::norm(c));
    const Complex f = (c + std::cosh(a)) / 2., f1 = sigma * (std::sinh(a) - s) / 2.,
                  f3 = std::pow(sigma, 3) * (s + std::sinh(a)) / 2.;
    EXPECT_LE(std::abs(f * f + f1 * f3 / beta), 1e-9 * std::norm(f)) << omega;
    // As printed, sin not squared, it is neither.
    EXPECT_GT(std::abs(fourth * s / beta - c * c + 1.), 0.1);
  }
}

// Eq. 3.33: I_3 by the convolution of Eq. 3.29, at real s, where the real part of the cosine is f.
TEST(Errata, TheThirdForcedIntegral) {
  const Parameters p = table_3_1();
  const double beta = 9 * unit_of(p), x = 3, r = p.hub_radius;
  const int n = 2000;
  double sum = 0;
  for (int i = 0; i <= n; ++i) {
    const double weight = i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2, tau = x * i / n;
    sum += weight * x / n / 3 * (r + tau) * f_of(beta, x - tau)[1];
  }
  const Complex sigma = std::sqrt(Complex(0, 1) * std::sqrt(beta)), c = std::cos(sigma * x),
                s = std::sin(sigma * x);
  const Complex correct = (sigma * r * c + s - sigma * r - sigma * x) / sigma;
  const Complex printed = (-sigma * r * c + s - sigma * r - sigma * x) / (2. * sigma * sigma);
  EXPECT_NEAR(correct.real(), sum, 1e-10 * std::abs(sum));
  EXPECT_GT(std::abs(printed.real() - sum), 0.1 * std::abs(sum));
  const auto f = f_of(beta, x);
  EXPECT_NEAR(r * f[0] - f[3] / beta - r - x, sum, 1e-10 * std::abs(sum));
  // The real parts of the others are right there: their constants, of sigma^2, are imaginary.
  const Complex square = sigma * sigma;
  const Complex i1 = (-3 * beta * r * x * x - beta * x * x * x + 6. * square * r * c + 6. * sigma * s -
                      6. * square * (r + x)) /
                     (6 * beta);
  const Complex i5 = -sigma * (sigma * r * c + s - sigma * (r + x)),
                i6 = -beta / square * (sigma * r * s - c + 1.);
  EXPECT_NEAR(i1.real(), -(r * f[2] + f[1]) / beta - r * x * x / 2 - x * x * x / 6, 1e-10);
  EXPECT_NEAR(i5.real(), r * f[2] + f[1], 1e-13);
  EXPECT_NEAR(i6.real(), r * f[3] + f[2], 1e-13);
  EXPECT_GT(std::abs(i5.imag()), 1e-4);
}

// Eq. 3.41: the prefactor's sign. With the printed one the tip's condition z_5(L) = -alpha (z_4(L) + 1) is
// missed.
TEST(Errata, TheSignOfTheTipsPrefactor) {
  const Parameters p = table_3_1();
  const double omega = 20, beta = -omega * omega * unit_of(p), l = p.length,
               alpha = beta * p.tip_inertia / p.mass_per_length,
               gamma = beta * p.tip_mass / p.mass_per_length;
  const Solution z(p, {0, omega});
  const auto end = z.state(l), root = z.state(0);
  const double q = std::pow(-beta, 0.25), a = q * l, f = (std::cos(a) + std::cosh(a)) / 2,
               f1 = q * (std::sinh(a) - std::sin(a)) / 2, f2 = q * q * (std::cosh(a) - std::cos(a)) / 2,
               f3 = q * q * q * (std::sinh(a) + std::sin(a)) / 2, r = p.hub_radius;
  // z_5(L) = f z_5 - f''' z_6/beta + I_5 and z_6(L) = f' z_5 + f z_6 + I_6, solved with z_3(L), z_4(L) given.
  const double i5 = r * f2 + f1, i6 = r * f3 + f2;
  const double h5 = -alpha * (end[3].real() + 1) - i5, h6 = gamma * (end[2].real() + r + l) - i6;
  const double determinant = f * f + f1 * f3 / beta;
  EXPECT_NEAR((f * h5 + f3 / beta * h6) / determinant / root[4].real(), 1, 1e-9);
  EXPECT_NEAR((f * h6 - f1 * h5) / determinant / root[5].real(), 1, 1e-9);
  EXPECT_NEAR(-(f * h5 + f3 / beta * h6) / determinant / root[4].real(), -1, 1e-9);
  // Eq. 3.40 lists five entries of six: z_1 to z_4 are 0 at the root.
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LE(std::abs(root[i]), 1e-9);
}

// Eq. 3.45: cos(i pi x)/L is no admissible function, cos(i pi x/L) is.
TEST(Errata, TheAssumedFunctionsAreHeldAtTheRoot) {
  const double l = 4, pi = std::numbers::pi;
  const auto printed = [&](double x) { return 1 - std::cos(pi * x) / l + std::pow(pi * x / l, 2) / 2; };
  EXPECT_NEAR(printed(0), 0.75, 1e-15);
  const DiscreteModel model = assumed_modes(table_3_1(), 5);
  EXPECT_EQ(model.shape(0).cwiseAbs().maxCoeff(), 0);
  EXPECT_LE(model.shape(1e-8).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_NEAR(model.shape(4)[0], 2 + pi * pi / 2, 1e-14 * 7);
  EXPECT_NEAR(model.shape(4)[1], -2 * pi * pi, 1e-14 * 20);
}

// Eq. 3.48: without EI in the stiffness the first mode is off by 1/sqrt(EI) = 0.116.
TEST(Errata, TheStiffnessHoldsTheBendingStiffness) {
  const Parameters p = without_tip(table_3_1());
  DiscreteModel model = assumed_modes(p, 10);
  EXPECT_NEAR(diagonalise(model).omega[0] / 12.85700141881, 1, 3e-5);
  model.stiffness /= p.bending_stiffness();
  EXPECT_NEAR(diagonalise(model).omega[0], 12.857 / std::sqrt(p.bending_stiffness()), 1e-3);
  // M_qq, missing, for phi = 1 - cos k + k^2/2 with k = pi x/L: integrals over x/L of (1 - cos k)^2, of (1 -
  // cos k) k^2, of k^4/4.
  const double pi = std::numbers::pi, square = 1.5 + (pi * pi / 3 + 2) + std::pow(pi, 4) / 20;
  EXPECT_NEAR(assumed_modes(p, 1).mass(0, 0) / (2 * p.mass_per_length * p.length * square), 1, 1e-14);
}

// Eq. 3.49: two appendages act on the hub. With one, the first poles are 5.53133 and 51.7418 rad/s.
TEST(Errata, TwoAppendagesActOnTheHub) {
  const Plant plant(table_3_1());
  const auto with = [&](double kappa) {
    return [&plant, kappa](Complex s) {
      return plant.effective_inertia(plant.appendage().motion_with_slope(s), kappa);
    };
  };
  const Roots one = find_roots(with(1), {-1, 1.3, 1, 60}), two = find_roots(with(2), {-1, 1.3, 1, 60});
  ASSERT_EQ(one.roots.size(), 2U);
  ASSERT_EQ(two.roots.size(), 2U);
  EXPECT_NEAR(one.roots[0].imag(), 5.53133, 5e-6);
  EXPECT_NEAR(one.roots[1].imag(), 51.7418, 5e-5);
  EXPECT_NEAR(two.roots[0].imag(), 6.452959965749, 1e-11);
  EXPECT_NEAR(two.roots[1].imag(), 52.08177896598, 1e-10);
}

// The closed form is right on paper and loses digits: e^(2 q L) at high frequency, 1/omega^2 at low.
TEST(Errata, TheClosedFormLosesDigitsAtBothEnds) {
  const Plant plant(table_3_1());
  const auto error = [&](double omega) {
    const Solution z(plant.parameters(), {0, omega});
    const AxisResponse r = plant.at_frequency(omega, 2);
    return std::array<double, 2>{std::abs(z.theta(2) / r.theta - 1.),
                                 std::abs(z.deflection(2) / r.deflection - 1.)};
  };
  EXPECT_LT(error(1)[0], 1e-14);
  EXPECT_LT(error(10)[1], 1e-13);
  EXPECT_GT(error(300)[0], 1e-11);
  EXPECT_GT(error(1000)[0], 1e-3);
  EXPECT_GT(error(1e-3)[1], 1e-10);
  EXPECT_GT(error(1e-6)[1], 1e-4);
  EXPECT_FALSE(std::isfinite(std::abs(Solution(plant.parameters(), {0, 4e5}).theta(2))));
}

}  // namespace
}  // namespace nlmech::spacecraft

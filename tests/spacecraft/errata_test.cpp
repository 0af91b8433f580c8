/// Misprints of the source in the state space (Eqs. 3.22 to 3.41) and in assumed modes (3.45 to 3.48): the
/// printed form is wrong, the corrected one right.
#include <gtest/gtest.h>
#include <Eigen/Core>
#include <Eigen/LU>
#include <unsupported/Eigen/MatrixFunctions>

#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <tuple>

#include "nlmech/spacecraft/plant/appendage.hpp"
#include "nlmech/spacecraft/plant/closed_form.hpp"
#include "nlmech/spacecraft/plant/discrete_model.hpp"
#include "nlmech/spacecraft/plant/plant.hpp"
#include "nlmech/spacecraft/plant/poles.hpp"
#include "tests/errata/erratum.hpp"
#include "tests/spacecraft/oracle.hpp"

namespace nlmech::spacecraft::errata_test {
namespace {

using Solution = GssSolution<Complex>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using oracle::integral;
using tests::expect_erratum;

double unit_of(const Parameters& p) { return p.mass_per_length / p.bending_stiffness(); }

/// The root of Eq. 3.31 with a positive real or imaginary part.
Complex sigma_of(Complex beta) { return std::sqrt(Complex(0, 1) * std::sqrt(beta)); }

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

/// f and three derivatives for real beta: positive, by Eq. 3.30, or negative, s being imaginary.
std::array<double, 4> f_of(double beta, double x) {
  if (beta < 0) {
    const double q = std::pow(-beta, 0.25), c = std::cos(q * x), s = std::sin(q * x), ch = std::cosh(q * x),
                 sh = std::sinh(q * x);
    return {(c + ch) / 2, q * (sh - s) / 2, q * q * (ch - c) / 2, q * q * q * (sh + s) / 2};
  }
  const double k = std::pow(beta, 0.25) / std::numbers::sqrt2, c = std::cos(k * x), s = std::sin(k * x),
               ch = std::cosh(k * x), sh = std::sinh(k * x);
  return {c * ch, k * (c * sh - s * ch), -2 * k * k * s * sh, -2 * k * k * k * (c * sh + s * ch)};
}

// Eqs. 3.22, 3.38, 3.39, 3.42, 3.43: (r + x) g_2(x) - g_1(x) must be evaluated at x = L.
TEST(Errata, PolesDoNotDependOnThePlaceLookedAt) {
  const auto pole = [](const Parameters& p, double x, bool literal) {
    const auto sum = [&](double omega) {
      return Solution(p, {0, omega}, {.literal_x = literal}).effective_inertia(x).real();
    };
    return p.has_tip() ? oracle::rise(sum, 5, 8) : oracle::rise(sum, 11.52, 14);
  };
  const Parameters none = without_tip(table_3_1()), tip = table_3_1();
  // Five printed digits; the closed form in double is accurate to 1e-12 here.
  EXPECT_NEAR(pole(none, 2, true), 11.625, 6e-4);
  EXPECT_NEAR(pole(tip, 2, true), 5.9363, 2e-4);
  for (const auto& [p, low, high] : {std::tuple(none, 11.52, 14.), std::tuple(tip, 5., 8.)}) {
    const double exact = oracle::pole(p, low, high);
    for (const double x : {2., 4.}) EXPECT_NEAR(pole(p, x, false), exact, 1e-10 * exact);
    EXPECT_NEAR(pole(p, 4, true), exact, 1e-10 * exact);  // x = L is the reference
    expect_erratum(
        "gss_control-3.22-place",
        {.printed = pole(p, 2, true), .corrected = pole(p, 2, false), .oracle = exact, .tolerance = 1e-10});
  }
}

// Eq. 3.21 with the boundary term at x = L, against quadrature of the deflection, which is a series here.
TEST(Errata, TheIntegralsOfTheStateAreThoseOfTheDeflection) {
  const Parameters p = table_3_1();
  const Complex s(0.5, 20);
  const Solution z(p, s);
  const Appendage appendage(p);
  const Complex sum =
      integral(p.length, [&](double x) { return (p.hub_radius + x) * appendage.deflection(s, x); });
  const auto at = [&](double x) { return (p.hub_radius + x) * z.state(x)[1] - z.state(x)[0]; };
  // Errors of Gauss quadrature and of the closed form.
  expect_erratum("gss_control-3.22-place", oracle::distances(at(2), at(p.length), sum, 1e-9));
}

// Eq. 3.25: b has six rows. Taken as rows 1 to 4, as printed, its entry loads z_4'. The deflection with a
// root at rest and theta = 1 is w - r - x with w'''' = -beta w, w = r and w' = 1 at x = 0: a power series.
TEST(Errata, TheLoadIsInTheSixthRow) {
  const Parameters p = table_3_1();
  const double beta = 9 * unit_of(p), x = 2, r = p.hub_radius;
  const Matrix6 a = state_matrix(beta, false);
  const auto deflection = [&](Eigen::Index row) {
    return integral(x,
                    [&](double tau) { return -beta * (r + tau) * Matrix6((a * (x - tau)).exp())(2, row); });
  };
  double series = 0, power = 1;
  for (int k = 4; k < 40; k += 4) {
    power *= -beta * std::pow(x, 4) / (k * (k - 1.) * (k - 2.) * (k - 3.));
    series += power * (r + x / (k + 1));
  }
  expect_erratum(
      "gss_control-3.25-load",
      {.printed = deflection(3), .corrected = deflection(5), .oracle = series, .tolerance = 1e-10});
}

// Eqs. 3.25 and 3.28: the fifth row of A, and the sign before z_6 in the first row of the solution.
TEST(Errata, TheHomogeneousSolutionIsTheMatrixExponential) {
  const double beta = 9 * unit_of(table_3_1()), x = 4;
  const auto f = f_of(beta, x);
  const Matrix6 e = (state_matrix(beta, false) * x).exp();
  Eigen::Matrix<double, 6, 2> corrected;
  corrected << (1 - f[0]) / beta, (beta * x + f[3]) / (beta * beta), -f[1] / beta, (1 - f[0]) / beta,
      -f[2] / beta, -f[1] / beta, -f[3] / beta, -f[2] / beta, f[0], -f[3] / beta, f[1], f[0];
  // Differences of f lose up to 4 digits by 1/beta^2.
  EXPECT_LE((e.rightCols<2>() - corrected).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_NEAR(e(0, 5), 8.53096393846971, 1e-12);
  expect_erratum(
      "gss_control-3.28-sign",
      {.printed = -corrected(0, 1), .corrected = corrected(0, 1), .oracle = e(0, 5), .tolerance = 1e-9});
  // As printed the moment would grow without load.
  const Matrix6 printed = (state_matrix(beta, true) * x).exp();
  EXPECT_GT((printed.rightCols<2>() - corrected).cwiseAbs().maxCoeff(), 1);
  const Solution right(table_3_1(), {3, 0}), wrong(table_3_1(), {3, 0}, {.minus_in_z1 = true});
  EXPECT_GT(std::abs(right.state(4)[0] - wrong.state(4)[0]), 0.01 * std::abs(right.state(4)[0]));
  EXPECT_EQ(right.state(4)[2], wrong.state(4)[2]);
}

// Eqs. 3.30 and 3.31: f is the real part of cos(sigma x) only where s is real.
TEST(Errata, FIsTheMeanOfCosineAndHyperbolicCosine) {
  const double unit = unit_of(table_3_1()), x = 4, beta = -1e4 * unit;
  const Complex fast = sigma_of(beta) * x, slow = sigma_of(9 * unit) * x;
  // f'''' = -beta f, f = 1 and f' = f'' = f''' = 0 at x = 0: a series of positive terms.
  double series = 1, power = 1;
  for (int k = 4; k < 60; k += 4) {
    power *= -beta * std::pow(x, 4) / (k * (k - 1.) * (k - 2.) * (k - 3.));
    series += power;
  }
  expect_erratum("gss_control-3.31", {.printed = std::cos(fast).real(),
                                      .corrected = ((std::cos(fast) + std::cosh(fast)) / 2.).real(),
                                      .oracle = series,
                                      .tolerance = 1e-13});
  EXPECT_NEAR(std::cos(slow).real(), f_of(9 * unit, x)[0], 1e-14);
  // Eq. 3.30 for complex beta is the mean as well.
  const Complex k = std::pow(Complex(beta), 0.25) / std::numbers::sqrt2;
  EXPECT_NEAR((std::cos(x * k) * std::cosh(x * k)).real(), series, 1e-13 * series);
}

// Eqs. 3.32-3.34, 3.37, 3.41: cos(sigma x) does not satisfy y(0) = 0, and hub-locked resonances vanish.
TEST(Errata, TheCosineAloneIsNoSolution) {
  const Parameters p = without_tip(table_3_1());
  const Solution right(p, {0, 1}), wrong(p, {0, 1}, {.cosine = true});
  EXPECT_NEAR(wrong.state(0)[2].real(), 0.576, 5e-4);
  EXPECT_LE(std::abs(right.state(0)[2]), 1e-12);
  expect_erratum("gss_control-3.32-cosine",
                 {.printed = wrong.deflection(2).real(),
                  .corrected = right.deflection(2).real(),
                  .oracle = oracle::by_exponentials(p, {0, 1}, 2).deflection.real(),
                  .tolerance = 1e-11});
  // Eq. 3.37: its determinant with sin squared is cos^2 + sin^2 = 1 whatever s; f^2 + f' f'''/beta is that of
  // a clamped beam, (1 + cos q cosh q)/2.
  for (const double omega : {11.51094878903, 20., 72.13788468598}) {
    const double beta = -omega * omega * unit_of(p), q = std::pow(-beta, 0.25) * p.length;
    const Complex sigma = sigma_of(beta), a = sigma * p.length, c = std::cos(a), s = std::sin(a);
    const Complex cosines = c * c - std::pow(sigma, 4) * s * s / beta;
    EXPECT_LE(std::abs(cosines - 1.), 1e-10 * std::norm(c));
    const auto f = f_of(beta, p.length);
    expect_erratum("gss_control-3.32-cosine", {.printed = cosines.real(),
                                               .corrected = f[0] * f[0] + f[1] * f[3] / beta,
                                               .oracle = (1 + std::cos(q) * std::cosh(q)) / 2,
                                               .tolerance = 1e-12,
                                               .scale = f[0] * f[0]});
  }
}

// Eq. 3.33: I_3 by the convolution of Eq. 3.29, at real s, where the real part of the cosine is f.
TEST(Errata, TheThirdForcedIntegral) {
  const Parameters p = table_3_1();
  const double beta = 9 * unit_of(p), x = 3, r = p.hub_radius;
  const double sum = integral(x, [&](double tau) { return (r + tau) * f_of(beta, x - tau)[1]; });
  const Complex sigma = sigma_of(beta), c = std::cos(sigma * x), s = std::sin(sigma * x);
  const Complex correct = (sigma * r * c + s - sigma * r - sigma * x) / sigma;
  const Complex printed = (-sigma * r * c + s - sigma * r - sigma * x) / (2. * sigma * sigma);
  expect_erratum("gss_control-3.33-i3", {printed.real(), correct.real(), sum, 1e-10});
  const auto f = f_of(beta, x);
  EXPECT_NEAR(r * f[0] - f[3] / beta - r - x, sum, 1e-10 * std::abs(sum));
}

// Eq. 3.33: the other integrals on the imaginary axis. With f and its derivatives instead of the cosine the
// constants of the printed rows must be omitted: they are the value of the cosine's f'' at 0.
TEST(Errata, TheConstantsOfTheForcedIntegrals) {
  const Parameters p = table_3_1();
  const double beta = -400 * unit_of(p), x = 3, r = p.hub_radius,
               square = (sigma_of(beta) * sigma_of(beta)).real();
  const auto f = f_of(beta, x);
  // Rows 1, 2, 5, 6: corrected; the printed constant; the sixth column of the matrix exponential (Eq. 3.29).
  struct Row {
    double corrected, constant;
    std::function<double(double)> column;
  };
  const std::array<Row, 4> rows = {
      Row{-(r * f[2] + f[1]) / beta - r * x * x / 2 - x * x * x / 6, -square * (r + x) / beta,
          [&](double t) { return (beta * t + f_of(beta, t)[3]) / (beta * beta); }},
      Row{-(r * f[3] + f[2]) / beta - r * x - x * x / 2, 1 / square,
          [&](double t) { return (1 - f_of(beta, t)[0]) / beta; }},
      Row{r * f[2] + f[1], square * (r + x), [&](double t) { return -f_of(beta, t)[3] / beta; }},
      Row{r * f[3] + f[2], -beta / square, [&](double t) { return f_of(beta, t)[0]; }}};
  const auto exact = [&](const Row& row) {
    return -beta * integral(x, [&](double tau) { return (r + tau) * row.column(x - tau); });
  };
  for (const Row& row : rows)
    expect_erratum("gss_control-3.33-constants",
                   {row.corrected + row.constant, row.corrected, exact(row), 1e-10});
  // The second row is named I_1 like the first.
  expect_erratum("gss_control-3.33-names", {rows[0].corrected, rows[1].corrected, exact(rows[1]), 1e-10});
  // At real s the printed rows are right in their real parts: there the constants are imaginary.
  const double real = 9 * unit_of(p);
  const auto g = f_of(real, x);
  const Complex sigma = sigma_of(real), c = std::cos(sigma * x), s = std::sin(sigma * x);
  const Complex i5 = -sigma * (sigma * r * c + s - sigma * (r + x)),
                i6 = -real / (sigma * sigma) * (sigma * r * s - c + 1.);
  EXPECT_NEAR(i5.real(), r * g[2] + g[1], 1e-13);
  EXPECT_NEAR(i6.real(), r * g[3] + g[2], 1e-13);
  EXPECT_GT(std::abs(i5.imag()), 1e-4);
}

// Eq. 3.37 solves the last two rows of Eq. 3.34 for z_5(L) = z_6(L) = 0; elimination says how.
TEST(Errata, TheSineOfTheDeterminantIsSquared) {
  const double beta = -400 * unit_of(table_3_1()), l = 4;
  const Complex sigma = sigma_of(beta), c = std::cos(sigma * l), s = std::sin(sigma * l),
                cube = std::pow(sigma, 3);
  Eigen::Matrix2cd rows, adjoint;
  rows << c, -cube * s / beta, -sigma * s, c;
  adjoint << c, cube * s / beta, sigma * s, c;
  const Eigen::Vector2cd forced(0.7, -0.2);  // any I_5(L), I_6(L)
  const Eigen::Vector2cd exact = rows.fullPivLu().solve(-forced);
  const Complex printed = 1. / (sigma * cube * s / beta - c * c),
                corrected = 1. / (sigma * cube * s * s / beta - c * c);
  for (const Eigen::Index i : {0, 1}) {
    const Complex product = (adjoint * forced)[i];
    // cos^2 - sigma^4 sin^2/beta = 1 is a difference of numbers of size 40.
    expect_erratum("gss_control-3.37",
                   oracle::distances(printed * product, corrected * product, exact[i], 1e-12));
  }
}

/// Slope and curvature of the deflection at the root for theta = 1, from 110 digits at h and 2h: y = a h^2 +
/// b h^3 + O(h^4), to about h^2 of the curvature.
struct Root {
  double slope, curvature;
};
Root exact_root(const Parameters& p, Complex s) {
  const double h = 1e-4;
  const auto y = [&](double x) {
    const auto r = oracle::by_hyperbolics(p, s, x);
    return (r.deflection / r.theta).real();
  };
  return {(4 * y(h) - y(2 * h)) / (2 * h), (8 * y(h) - y(2 * h)) / (2 * h * h)};
}

// Eq. 3.40 lists five states at the root, [0 0 0 z_5 z_6]. Taken as states 1 to 5, the slope y'(0) is z_5.
TEST(Errata, TheRootHasSixStates) {
  const Parameters p = table_3_1();
  const auto root = Solution(p, {0, 20}).state(0);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LE(std::abs(root[i]), 1e-9);
  expect_erratum("gss_control-3.40", {.printed = root[4].real(),
                                      .corrected = root[3].real(),
                                      .oracle = exact_root(p, {0, 20}).slope,
                                      .tolerance = 1e-6,
                                      .scale = std::abs(root[4])});
}

// Eq. 3.41: the prefactor's sign. With the printed one the tip's condition z_5(L) = -alpha (z_4(L) + 1) is
// missed.
TEST(Errata, TheSignOfTheTipsPrefactor) {
  const Parameters p = table_3_1();
  const double omega = 20, beta = -omega * omega * unit_of(p), l = p.length, r = p.hub_radius,
               alpha = beta * p.tip_inertia / p.mass_per_length,
               gamma = beta * p.tip_mass / p.mass_per_length;
  const Solution z(p, {0, omega});
  const auto end = z.state(l), root = z.state(0);
  const auto f = f_of(beta, l);
  // z_5(L) = f z_5 - f''' z_6/beta + I_5 and z_6(L) = f' z_5 + f z_6 + I_6, solved with z_3(L), z_4(L) given.
  const double i5 = r * f[2] + f[1], i6 = r * f[3] + f[2];
  const double h5 = -alpha * (end[3].real() + 1) - i5, h6 = gamma * (end[2].real() + r + l) - i6;
  const double determinant = f[0] * f[0] + f[1] * f[3] / beta;
  const double z5 = (f[0] * h5 + f[3] / beta * h6) / determinant;
  expect_erratum("gss_control-3.41-sign", {-z5, z5, exact_root(p, {0, omega}).curvature, 1e-7});
  EXPECT_NEAR((f[0] * h6 - f[1] * h5) / determinant / root[5].real(), 1, 1e-9);
}

// ---- Misprints of the source about assumed modes and the hub (Eqs. 3.45 to 3.49), and the accuracy of its
// closed form in double.

// Eq. 3.45: cos(i pi x)/L is no admissible function, cos(i pi x/L) is: phi(0) must be 0.
TEST(Errata, TheAssumedFunctionsAreHeldAtTheRoot) {
  const double l = 4, pi = std::numbers::pi;
  const auto printed = [&](double x) { return 1 - std::cos(pi * x) / l + std::pow(pi * x / l, 2) / 2; };
  const DiscreteModel model = assumed_modes(table_3_1(), 5);
  expect_erratum(
      "gss_control-3.45",
      {.printed = printed(0), .corrected = model.shape(0)[0], .oracle = 0, .tolerance = 1e-15, .scale = 1});
  EXPECT_EQ(model.shape(0).cwiseAbs().maxCoeff(), 0);
  EXPECT_LE(model.shape(1e-8).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_NEAR(model.shape(4)[0], 2 + pi * pi / 2, 1e-14 * 7);
  EXPECT_NEAR(model.shape(4)[1], -2 * pi * pi, 1e-14 * 20);
}

// Eq. 3.48: without EI in the stiffness the first mode is off by 1/sqrt(EI) = 0.116.
TEST(Errata, TheStiffnessHoldsTheBendingStiffness) {
  const Parameters p = without_tip(table_3_1());
  DiscreteModel model = assumed_modes(p, 10);
  const double corrected = diagonalise(model).omega[0];
  model.stiffness /= p.bending_stiffness();
  const double printed = diagonalise(model).omega[0];
  EXPECT_NEAR(printed, 12.857 / std::sqrt(p.bending_stiffness()), 1e-3);
  // Ten modes have the first frequency to 2e-5.
  expect_erratum("gss_control-3.48", {printed, corrected, oracle::pole(p, 11.52, 14), 3e-5});
  // M_qq, missing, for phi = 1 - cos k + k^2/2 with k = pi x/L: integrals over x/L of (1 - cos k)^2, of (1 -
  // cos k) k^2, of k^4/4.
  const double pi = std::numbers::pi, square = 1.5 + (pi * pi / 3 + 2) + std::pow(pi, 4) / 20;
  EXPECT_NEAR(assumed_modes(p, 1).mass(0, 0) / (2 * p.mass_per_length * p.length * square), 1, 1e-14);
}

// Figures 3.5 and 3.6: "a slight truncation error". With tips the tenth frequency of ten modes is 17 % high.
TEST(Errata, TenModesDoNotMeetTheTip) {
  const Parameters p = table_3_1();
  const double exact = oracle::pole(p, 2348.2, 2400);  // after the hub-locked frequency 2348.19
  EXPECT_NEAR(diagonalise(assumed_modes(p, 10)).omega[9] / exact, 1.17, 0.005);
  EXPECT_NEAR(poles(Plant(p), 10).omega[9], exact, 1e-12 * exact);
}

// The closed form is exact, but loses digits: e^(2 q L) at high frequency, 1/omega^2 at low frequency.
TEST(Errata, TheClosedFormLosesDigitsAtBothEnds) {
  const Plant plant(table_3_1());
  const auto error = [&](double omega) {
    const GssSolution<Complex> z(plant.parameters(), {0, omega});
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
  EXPECT_FALSE(std::isfinite(std::abs(GssSolution<Complex>(plant.parameters(), {0, 4e5}).theta(2))));
}

}  // namespace
}  // namespace nlmech::spacecraft::errata_test

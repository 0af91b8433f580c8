/// Misprints and statements of sections 2.1 to 2.3: printed and corrected form against an independent oracle.
/// Those of the element (2.26 to 2.37) and of Williams' equation (2.20, 2.21): tests/frames.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string_view>
#include <vector>

#include "chapters/homotopy/solvers/iterations.hpp"
#include "tests/chapters/homotopy/toggle_oracle.hpp"
#include "tests/errata/erratum.hpp"

namespace nlmech::chapters::homotopy::errata_test {
namespace {

using tests::expect_erratum;

/// A function with one simple root, at 1.5; convex, and not odd about it.
double f(double x) { return std::exp(x) - std::exp(1.5); }
double slope(double x) { return std::exp(x); }

/// x(t) of dx/dt = v(t, x) by the classical Runge-Kutta method in 4000 steps: errors of at most 1e-10 here.
double flow(const std::function<double(double, double)>& v, double x, double end) {
  constexpr int steps = 4000;
  const double h = end / steps;
  for (int k = 0; k < steps; ++k) {
    const double t = k * h, a = v(t, x), b = v(t + h / 2, x + h / 2 * a), c = v(t + h / 2, x + h / 2 * b),
                 d = v(t + h, x + h * c);
    x += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return x;
}

/// The deflection, inch, after at most 1000 iterations from rest with |F| to 1e-9 lb.
double last_deflection(Model model, double height, double load, Iteration iteration) {
  LoadedToggle toggle(model, height, load);
  iteration.tolerance = 1e-9;
  std::vector<IterationRecord> trace;
  const Count count = iterate(toggle, iteration, &trace);
  EXPECT_EQ(trace.size(), static_cast<std::size_t>(count.iterations) + 1);
  return trace.back().deflection;
}

/// Relative error of a deflection for a residual of 1e-9 lb: over half a stiffness of at least 6 lb/in, and a
/// deflection of at least 0.26 in.
constexpr double residual_allows = 1e-9;

// Eq. 2.6 descends along "grad F" to a minimum of J = F^2/2, whose derivative is F' F. The oracle is a
// central difference of J.
TEST(Errata, DescentIsAlongTheGradientOfTheCost) {
  const auto J = [](double x) { return f(x) * f(x) / 2; };
  const double x = 1.8, d = 1e-4;
  expect_erratum("homotopy-2.6",
                 {.printed = slope(x),
                  .corrected = slope(x) * f(x),
                  .oracle = (8 * (J(x + d) - J(x - d)) - (J(x + 2 * d) - J(x - 2 * d))) / (12 * d),
                  .tolerance = 1e-10});
}

// Eqs 2.12 and 2.13 print a sum of squares: it vanishes only where both squares do, so h = 0 is no path.
// Along 2.16 the difference stays zero.
TEST(Errata, HomotopyFunctionsAreDifferences) {
  const double x0 = 0.3, f0 = f(x0);
  for (const double t : {0.5, 2.0, 6.0}) {
    const auto newton = [](double, double x) { return -f(x) / slope(x) / 2; };  // 2.16, one unknown
    const double x = flow(newton, x0, t), q = std::exp(t), scale = f0 * f0 / q;
    const double difference = f(x) * f(x) / 2 - f0 * f0 / (2 * q), sum = f(x) * f(x) / 2 + f0 * f0 / (2 * q);
    EXPECT_LT(std::abs(difference), 1e-8 * scale) << t;  // error of the Runge-Kutta method, relative to F
    EXPECT_NEAR(sum, scale, 1e-8 * scale) << t;
    expect_erratum("homotopy-2.13", {.printed = sum,
                                     .corrected = difference,
                                     .oracle = 0,  // the path is where h = 0
                                     .tolerance = 1e-8,
                                     .scale = scale});
  }
}

// Eq. 2.15 prints Q B^T F + x - x(0). Started where |F| = |x - x(0)|, so that h = 0 there, the path stays on
// Q |F|^2 = |x - x(0)|^2 with the minus of h's derivative, and leaves it with the plus.
TEST(Errata, FixedPointFlowHasAMinus) {
  const double x0 = 0.3;
  double low = x0 + 0.1, high = 1.4;  // F + (x - x0) changes its sign between
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (f(middle) + middle - x0 < 0 ? low : high) = middle;
  }
  const auto ratio = [&](double sign) {
    const auto v = [&](double t, double x) {
      const double q = std::exp(t);
      return -q * f(x) * f(x) / 2 / (q * slope(x) * f(x) + sign * (x - x0));
    };
    const double x = flow(v, low, 4);
    return std::exp(4.0) * f(x) * f(x) / ((x - x0) * (x - x0));
  };
  const double plus = ratio(1), minus = ratio(-1);
  EXPECT_NEAR(minus, 1, 1e-7);
  EXPECT_GT(std::abs(plus - 1), 0.05);
  expect_erratum("homotopy-2.15", {.printed = plus, .corrected = minus, .oracle = 1, .tolerance = 1e-7});
  // h_f over |x - x(0)|^2/(2 Q) on the path on which it is zero: 2.12 with both signs.
  expect_erratum("homotopy-2.12",
                 {.printed = minus + 1, .corrected = minus - 1, .oracle = 0, .tolerance = 1e-7});
}

// From x(0), as in the text, h_f = |F|^2/2 is not zero for either sign.
TEST(Errata, FixedPointPathDoesNotStartOnZero) {
  const double x0 = 0.3, q = 1;  // Q(0) = e^0
  const auto h = [&](double x, double sign) {
    return f(x) * f(x) / 2 + sign * (x - x0) * (x - x0) / (2 * q);
  };
  EXPECT_EQ(h(x0, 1), h(x0, -1));
  using oracle::Real;
  const Real root = Real(3) / 2, wide = exp(Real(x0)) - exp(root);
  expect_erratum("homotopy-text-2.12", {.printed = 0,
                                        .corrected = h(x0, -1),
                                        .oracle = static_cast<double>(Real(wide * wide / 2)),
                                        .tolerance = 8 * std::numeric_limits<double>::epsilon()});
}

// "The Scalar Newton Homotopy Method in Eq. (2.16) only works for a system of NAEs": with one unknown it is
// Newton's method with shorter steps, and so is 2.15 except for a term that decays.
TEST(Claims, NewtonHomotopySolvesTheScalarEquation) {
  LoadedToggle toggle(Model::williams, 0.32, low_load);
  const Count count = iterate(toggle, {.scheme = Scheme::newton_homotopy, .step = example_step});
  EXPECT_TRUE(count.converged);
  EXPECT_NEAR(count.iterations, 30, 2);
  // A method that does not work on one equation would stay at its start, 0.
  expect_erratum("homotopy-2.3.1-scalar",
                 {.printed = 0,
                  .corrected = last_deflection(Model::williams, 0.32, low_load,
                                               {.scheme = Scheme::newton_homotopy, .step = example_step}),
                  .oracle = oracle::deflection_under(oracle::williams_load, 0.32, low_load),
                  .tolerance = residual_allows});
}

// "Newton's Method 1000 0.044" at 43.79 lb: with the derivative of Eq. 2.21 it converges from every start.
TEST(Claims, NewtonConvergesAboveTheLimitLoad) {
  expect_erratum("homotopy-table-2.3",
                 {.printed = last_deflection(Model::williams_frozen, 0.44, near_load, {}),
                  .corrected = last_deflection(Model::williams, 0.44, near_load, {}),
                  .oracle = oracle::deflection_under(oracle::williams_load, 0.44, near_load),
                  .tolerance = residual_allows});
  LoadedToggle toggle(Model::williams, 0.44, near_load);
  for (int i = 0; i <= 100; ++i) EXPECT_TRUE(iterate(toggle, {.start = 0.01 * i}).converged) << i;
}

// The same on elements, Tables 2.4 and 2.5: it converges, and with Eq. 2.35 as printed it does not.
TEST(Claims, NewtonConvergesOnElements) {
  const auto show = [](std::string_view id, double load) {
    expect_erratum(id, {.printed = last_deflection(Model::element_printed, 0.44, load, {}),
                        .corrected = last_deflection(Model::element, 0.44, load, {}),
                        .oracle = oracle::deflection_under(oracle::element_load, 0.44, load),
                        .tolerance = residual_allows});
  };
  show("homotopy-table-2.4", near_load);
  show("homotopy-table-2.5", last_load);
}

// "Near the limit point": the loads are above the first branch of the curve.
TEST(Claims, PublishedLoadsAreAboveTheLimit) {
  for (const bool williams : {true, false}) {
    const auto curve = williams ? williams_curve(0.44) : element_curve(0.44);
    const double limit = limit_points(*curve).value().maximum.load;
    EXPECT_GT(near_load, 1.023 * limit);
    EXPECT_LT(last_load, 1.04 * limit);
    EXPECT_EQ(deflections_under(*curve, near_load).size(), 1U);
    EXPECT_EQ(deflections_under(*curve, 0.99 * limit).size(), 3U);
    // The maximum load is as accurate as its formula: an error of the bisected place enters in second order
    // only.
    const double exact = oracle::limit_load(williams ? oracle::williams_load : oracle::element_load, 0.44);
    EXPECT_NEAR(limit, exact, 1e-13 * exact);
  }
}

// Table 2.1 gives EI in lb/in^2. EI/l^2 must be a force, as EA sin^2(beta) in Eq. 2.21: a unit of half an
// inch must not change W, with EI in lb in^2.
TEST(Errata, RigidityIsAForceTimesAnArea) {
  const frames::Williams inch{.height = 0.44};
  frames::Williams half = inch;  // lengths in half inches
  half.height *= 2;
  half.length *= 2;
  half.ei *= 4;
  EXPECT_NEAR(half.load(0.4), inch.load(0.2), 1e-12);
  const double corrected = half.load(0.4);
  half.ei = inch.ei / 4;  // as of lb/in^2
  EXPECT_GT(std::abs(half.load(0.4) - inch.load(0.2)), 1);
  // The load does not depend on the unit of length. Terms of ten times their sum, with a few rounding errors
  // each.
  expect_erratum("homotopy-table-2.1", {.printed = half.load(0.4),
                                        .corrected = corrected,
                                        .oracle = inch.load(0.2),
                                        .tolerance = 128 * std::numeric_limits<double>::epsilon()});
}

}  // namespace
}  // namespace nlmech::chapters::homotopy::errata_test

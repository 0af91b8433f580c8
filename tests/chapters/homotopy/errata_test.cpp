/// Misprints and claims of sections 2.1 to 2.3: printed and corrected form, both against an independent
/// oracle. Those of the element (2.26 to 2.37) and of Williams' equation (2.20, 2.21) stand in tests/frames.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "chapters/homotopy/iterations.hpp"

namespace nlmech::chapters {
namespace {

/// A function with one simple root, at 1.5; convex, and not odd about it.
double f(double x) { return std::exp(x) - std::exp(1.5); }
double slope(double x) { return std::exp(x); }

/// x(t) of dx/dt = v(t, x) by the classical Runge-Kutta rule in 4000 steps: errors of 1e-10 and below here.
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

// Eqs 2.12 and 2.13 print a sum of squares: it vanishes only where both do, so h = 0 is no path. Along 2.16
// the difference stays zero.
TEST(Errata, HomotopyFunctionsAreDifferences) {
  const double x0 = 0.3, f0 = f(x0);
  for (const double t : {0.5, 2.0, 6.0}) {
    const auto newton = [](double, double x) { return -f(x) / slope(x) / 2; };  // 2.16, one unknown
    const double x = flow(newton, x0, t), q = std::exp(t), scale = f0 * f0 / q;
    const double difference = f(x) * f(x) / 2 - f0 * f0 / (2 * q), sum = f(x) * f(x) / 2 + f0 * f0 / (2 * q);
    EXPECT_LT(std::abs(difference), 1e-8 * scale) << t;  // Runge and Kutta's error, relative to F
    EXPECT_NEAR(sum, scale, 1e-8 * scale) << t;
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
  EXPECT_NEAR(ratio(-1), 1, 1e-7);
  EXPECT_GT(std::abs(ratio(1) - 1), 0.05);
}

// Started at x(0) = x(0), as the text does, h_f = |F|^2/2 is not zero for either sign.
TEST(Errata, FixedPointPathDoesNotStartOnZero) { EXPECT_GT(f(0.3) * f(0.3) / 2, 1); }

// "The Scalar Newton Homotopy Method in Eq. (2.16) only works for a system of NAEs": with one unknown it is
// Newton's method with shortened steps, and so is 2.15 but for a term that dies out.
TEST(Claims, NewtonHomotopySolvesTheScalarEquation) {
  LoadedToggle toggle(Model::williams, 0.32, low_load);
  const Count count = iterate(toggle, {.scheme = Scheme::newton_homotopy, .step = example_step});
  EXPECT_TRUE(count.converged);
  EXPECT_NEAR(count.iterations, 30, 2);
}

// "Newton's Method 1000 0.044" at 43.79 lb: with the derivative of Eq. 2.21 it converges from every start.
TEST(Claims, NewtonConvergesAboveTheLimitLoad) {
  LoadedToggle toggle(Model::williams, 0.44, near_load);
  for (int i = 0; i <= 100; ++i) EXPECT_TRUE(iterate(toggle, {.start = 0.01 * i}).converged) << i;
}

// "Near the limit point": the loads are not on the curve's first branch at all.
TEST(Claims, PublishedLoadsAreAboveTheLimit) {
  for (const bool williams : {true, false}) {
    const auto curve = williams ? williams_curve(0.44) : element_curve(0.44);
    const double limit = limit_points(*curve).value().maximum.load;
    EXPECT_GT(near_load, 1.023 * limit);
    EXPECT_LT(last_load, 1.04 * limit);
    EXPECT_EQ(deflections_under(*curve, near_load).size(), 1U);
    EXPECT_EQ(deflections_under(*curve, 0.99 * limit).size(), 3U);
  }
}

// Table 2.1 gives EI in lb/in^2. EI/l^2 must be a force to stand beside EA sin^2(beta) in Eq. 2.21: scaling
// the inch by 2 must scale W by nothing, with EI in lb in^2.
TEST(Errata, RigidityIsAForceTimesAnArea) {
  const frames::Williams inch{.height = 0.44};
  frames::Williams half = inch;  // lengths in half inches
  half.height *= 2;
  half.length *= 2;
  half.ei *= 4;
  EXPECT_NEAR(half.load(0.4), inch.load(0.2), 1e-12);
  half.ei = inch.ei / 4;  // as of lb/in^2
  EXPECT_GT(std::abs(half.load(0.4) - inch.load(0.2)), 1);
}

}  // namespace
}  // namespace nlmech::chapters

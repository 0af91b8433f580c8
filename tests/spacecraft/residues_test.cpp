/// Sums of exponentials: values, derivatives, samples, extremes and settling times of known functions; nodes
/// that replace coincident poles.
#include "nlmech/spacecraft/residues.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "nlmech/spacecraft/plant/roots.hpp"

namespace nlmech::spacecraft::residues_test {
namespace {

using std::numbers::pi;

/// 1 + 2 t + 3 t^2 + e^(-t/2) cos 5t + e^-2t.
ExponentialSum example() { return {{1, 2, 3}, {{-0.5, 5}, {-2, 0}}, {0.5, 0.5}}; }

TEST(ExponentialSum, IsItsClosedForm) {
  const ExponentialSum f = example();
  for (const double t : {0., 0.3, 2., 9.}) {
    const double e = std::exp(-t / 2), exact = 1 + 2 * t + 3 * t * t + e * std::cos(5 * t) + std::exp(-2 * t);
    const double slope =
        2 + 6 * t + e * (-0.5 * std::cos(5 * t) - 5 * std::sin(5 * t)) - 2 * std::exp(-2 * t);
    const double second = 6 + e * (-24.75 * std::cos(5 * t) + 5 * std::sin(5 * t)) + 4 * std::exp(-2 * t);
    // A few roundings of terms up to 30 and 300.
    EXPECT_NEAR(f.value(t), exact, 1e-13);
    EXPECT_NEAR(f.value(t, 1), slope, 1e-13);
    EXPECT_NEAR(f.derivative().value(t), slope, 1e-13);
    EXPECT_NEAR(f.value(t, 2), second, 1e-13);
  }
  EXPECT_DOUBLE_EQ(f.envelope(0), 2);
}

TEST(ExponentialSum, SamplesAreItsValues) {
  const ExponentialSum f = example();
  const std::vector<double> samples = f.samples(0.1, 0.013, 700);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double t = 0.1 + 0.013 * static_cast<double>(i);
    // 64 rotations, a rounding each.
    EXPECT_NEAR(samples[i], f.value(t), 1e-13 * (1 + t * t));
  }
}

// int (e^(-t/2) cos 5t + e^(-2t))^2: parts in closed form, with 2 Re of e^(-(2.5 - 5i) t) for the mixed one.
TEST(ExponentialSum, SquareIntegralIsTheClosedForm) {
  const double cosine = (1 + 0.25 / (0.25 + 25)) / 2, mixed = 2 * 2.5 / (2.5 * 2.5 + 25);
  const SquareIntegral square = square_integral(example());
  EXPECT_NEAR(square.value, cosine + mixed + 0.25, 1e-15);
  EXPECT_LT(square.uncertainty, 1e-12);
}

TEST(ExponentialSum, RefusesBadInput) {
  EXPECT_THROW(ExponentialSum({}, {1.}, {}), std::invalid_argument);
  EXPECT_THROW(ExponentialSum({std::nan(""), 0, 0}, {}, {}), std::invalid_argument);
  EXPECT_THROW((void)extremes(example(), 1, 1), std::invalid_argument);
  EXPECT_THROW((void)extremes(example(), -1, 1), std::invalid_argument);
  EXPECT_THROW((void)settling_time(example(), 0, 0, 1), std::invalid_argument);
  EXPECT_EQ(ExponentialSum().value(3), 0);
}

/// 1 - e^(-a t) (cos w t + a/w sin w t): a second order step response, with overshoot e^(-pi a/w) at pi/w.
ExponentialSum step(double a, double w) { return {{1, 0, 0}, {{-a, w}}, {Complex(-0.5, a / (2 * w))}}; }

TEST(Extremes, AreThoseOfASecondOrderStep) {
  for (const double a : {0.01, 0.3, 2.}) {
    const ExponentialSum f = step(a, 3);
    const Extremes e = extremes(f, 0, 10);
    EXPECT_NEAR(e.largest.value, 1 + std::exp(-pi * a / 3), 1e-14);
    EXPECT_NEAR(e.largest.time, pi / 3, 1e-9);
    EXPECT_NEAR(e.least.value, 0, 1e-15);
    EXPECT_EQ(e.least.time, 0);
  }
}

// A fast ripple of a ten-thousandth determines the maximum of a slow wave.
TEST(Extremes, SeeFastSmallTerms) {
  const double small = 1e-4, fast = 997;
  const ExponentialSum f({0, 0, 0}, {{0, 1}, {0, fast}}, {Complex(0, -0.5), small / 2});
  const Extremes e = extremes(f, 0, 3);
  double best = 0, at = 0;
  for (int i = 0; i <= 3'000'000; ++i) {
    const double t = i * 1e-6, value = std::sin(t) + small * std::cos(fast * t);
    if (value > best) best = value, at = t;
  }
  EXPECT_GE(e.largest.value, best - 1e-15);
  EXPECT_NEAR(e.largest.value, best, 1e-10);
  EXPECT_NEAR(e.largest.time, at, 2e-6);
}

// The maxima of e^(-a t) (cos w t + a/w sin w t) are e^(-a k pi/w): the function leaves the band for the last
// time on the falling side of the last maximum above it.
TEST(Settling, IsThatOfASecondOrderStep) {
  const double a = 0.05, w = 4, band = 0.02;
  const Settling s = settling_time(step(a, w), 1, band, 1e4);
  ASSERT_TRUE(s.status.ok());
  const double crest = std::floor(-std::log(band) / a / (pi / w)) * pi / w;
  EXPECT_GT(s.time, crest);
  EXPECT_LT(s.time, crest + pi / w / 2);
  EXPECT_NEAR(std::abs(step(a, w).value(s.time) - 1), band, 1e-14);
}

TEST(Settling, SeesACrestThatBarelyPasses) {
  const double a = 0.05, w = 4;
  for (const double factor : {1 - 1e-6, 1 + 1e-6}) {
    const double crest = 40 * pi / w, band = std::exp(-a * crest) * factor;
    const Settling s = settling_time(step(a, w), 1, band, 1e4);
    // With the narrower band the maximum counts, with the wider one the maximum before it.
    if (factor < 1) {
      EXPECT_NEAR(s.time, crest, 1e-2);
    } else {
      EXPECT_LT(s.time, crest - pi / w / 2);
    }
  }
}

TEST(Settling, SaysIfItDoesNot) {
  const ExponentialSum undamped({0, 0, 0}, {{0, 1}}, {0.5});
  EXPECT_EQ(settling_time(undamped, 0, 0.1, 100).status.outcome(), Outcome::not_converged);
  EXPECT_EQ(settling_time(example(), 1, 0.1, 100).status.outcome(), Outcome::not_converged);
  EXPECT_EQ(settling_time(step(0.3, 3), 2, 0.1, 100).status.outcome(), Outcome::not_converged);
  const Settling within = settling_time(undamped, 0, 2, 100);
  EXPECT_TRUE(within.status.ok());
  EXPECT_EQ(within.time, 0);
}

// ---- Zeros by their power sums, and nodes that replace coincident poles, against closed forms.

/// Polynomial with the given zeros times an entire function without zeros.
Jet with_zeros(Complex s, const std::vector<Complex>& zeros) {
  Jet product(1.);
  for (const Complex& z : zeros) product = product * (Jet::variable(s) - Jet(z));
  return product * exp(Jet::variable(s));
}

TEST(ZerosInCircle, AreRightWhereTheyCoincide) {
  for (const double apart : {0., 1e-12, 1e-6, 0.1}) {
    const std::vector<Complex> zeros = {Complex(1, 2), Complex(1 + apart, 2), Complex(1, 2 + apart),
                                        Complex(4, 9)};
    const ZeroCluster c =
        zeros_in_circle([&](Complex s) { return with_zeros(s, zeros); }, Complex(1, 2), 0.5);
    ASSERT_TRUE(c.status.ok()) << c.status.text();
    ASSERT_EQ(c.zeros.size(), 3U);
    Complex sum = 0, product = 1;
    for (const Complex& z : c.zeros) {
      sum += z;
      product *= Complex(0.2, 0) - z;
    }
    // The polynomial is accurate to rounding, its zeros to the cube root of that.
    EXPECT_LT(std::abs(sum - apart * Complex(1, 1)), 1e-14);
    EXPECT_LT(std::abs(product - 0.2 * (0.2 - apart) * Complex(0.2, -apart)), 1e-14);
  }
}

TEST(ZerosInCircle, RefusesZerosNearTheCircle) {
  const auto f = [](Complex s) { return with_zeros(s, {Complex(0.1), Complex(1.05)}); };
  EXPECT_EQ(zeros_in_circle(f, 0., 1).status.outcome(), Outcome::not_converged);
  EXPECT_TRUE(zeros_in_circle(f, 0., 0.4).status.ok());
  EXPECT_THROW((void)zeros_in_circle(f, 0., 0), std::invalid_argument);
}

// 1/((s + 1)(s + 1 + d)): t e^(-t) and its neighbours.
TEST(ClusterNodes, StandForCoincidentPoles) {
  for (const double d : {0., 1e-9, 1e-3, 0.2}) {
    const std::vector<Complex> zeros = {Complex(-1), Complex(-1 - d)};
    const double radius = 0.5;
    const Complex centre(-1 - d / 2);
    const ZeroCluster c = zeros_in_circle([&](Complex s) { return with_zeros(s, zeros); }, centre, radius);
    ASSERT_TRUE(c.status.ok()) << c.status.text();
    // Residues of 1, s, ... at both: 0 and 1.
    const ClusterNodes n = cluster_nodes(c, {{0., 1.}}, 1, true);
    for (const double t : {0., 0.3, 1., 5., 40.}) {
      double value = 0;
      for (std::size_t k = 0; k < n.nodes.size(); ++k)
        value += 2 * (n.weights[0][k] * std::exp((centre + n.nodes[k]) * t)).real();
      const double exact = d == 0 ? t * std::exp(-t) : -std::exp(-t) * std::expm1(-d * t) / d;
      EXPECT_NEAR(value, exact, 1e-13) << d << " at " << t;
    }
  }
}

// Five zeros: two coincide, and one is a hundred billion times closer to 0.
TEST(FindRoots, SeparatesWhatLiesNextToZero) {
  const std::vector<Complex> zeros = {Complex(-1e-11), Complex(-3e-11), Complex(-0.5, 1), Complex(-0.5, 1),
                                      Complex(-2, 0.1)};
  const Roots r = find_roots([&](Complex s) { return with_zeros(s, zeros); }, {-3, 1, -2, 2});
  ASSERT_TRUE(r.status.ok()) << r.status.text();
  ASSERT_EQ(r.roots.size(), 5U);
  EXPECT_NEAR(r.roots[0].real() / -3e-11, 1, 1e-9);
  EXPECT_NEAR(r.roots[1].real() / -1e-11, 1, 1e-9);
  EXPECT_LT(std::abs(r.roots[2] - zeros[4]), 1e-14);
  EXPECT_LT(std::abs((r.roots[3] + r.roots[4]) / 2. - zeros[2]), 1e-13);
}

}  // namespace
}  // namespace nlmech::spacecraft::residues_test

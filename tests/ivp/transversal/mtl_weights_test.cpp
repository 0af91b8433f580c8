/// Weights of multi-step transversal linearisation: exactness for polynomials, the rules of Newton and Cotes,
/// the propagator.
#include "nlmech/ivp/transversal/mtl_weights.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace nlmech::ivp::mtl_weights_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// [0 1; -w^2 -2 zeta w].
Eigen::Matrix2d oscillator(double w, double zeta) {
  return (Eigen::Matrix2d() << 0, 1, -w * w, -2 * zeta * w).finished();
}

// A load t^m with m up to p is its own interpolating polynomial: a block that starts on x = (t/(p h))^m stays
// on it. All powers together determine each weight, for slow, fast, damped and growing linear parts.
TEST(MtlWeights, AreExactForPolynomials) {
  const double h = 0.1;
  for (const double z : {0., 1e-8, 0.3, 7., 1e3}) {
    for (const double zeta : {0., 0.1, 5., -0.5}) {
      if (std::abs(zeta) * z > 40) continue;  // growth or decay by e^40 or more a step needs another scale
      for (const int p : {1, 2, 3, 5, 8}) {
        const double w = z / h, end = p * h;
        MtlWeights weights(2, 1, MtlBasis::lagrange, p, {});
        ASSERT_EQ(weights.compute(oscillator(w, zeta), h), Outcome::success);
        for (int m = 0; m <= p; ++m) {
          const auto power = [&](int k, int times) {  // derivatives at the point k
            double value = 1;
            for (int i = 0; i < times; ++i) value *= (m - i) / end;
            return m < times ? 0 : value * std::pow(static_cast<double>(k) / p, m - times);
          };
          for (int l = 1; l <= p; ++l) {
            MtlPropagator flow(2, 1, 1, {});
            ASSERT_EQ(flow.compute(oscillator(w, zeta), l * h), Outcome::success);
            Eigen::Vector2d x = flow.exponential() * Eigen::Vector2d(power(0, 0), power(0, 1));
            double terms = x.norm();
            for (int k = 0; k <= p; ++k) {
              const double load = power(k, 2) + 2 * zeta * w * power(k, 1) + w * w * power(k, 0);
              const Eigen::Vector2d term = weights.weight(l, k) * load;
              terms += term.norm();
              x += term;
            }
            // Rounding errors of all terms. Those of a velocity enter the position with the factor time or
            // 1/w; the exponential has the rounding error of its angle.
            const double room = 60 * p * eps * terms * (1 + z) * (1 + zeta * zeta);
            const double time = std::min(end, z > 0 ? 1 / w : end);
            EXPECT_NEAR(x[1], power(l, 1), room) << z << ' ' << zeta << ' ' << p << ' ' << m << ' ' << l;
            EXPECT_NEAR(x[0], power(l, 0), room * std::max(time, 1.0))
                << z << ' ' << zeta << ' ' << p << ' ' << m << ' ' << l;
          }
        }
      }
    }
  }
}

// Without spring and damper the velocities are integrals of interpolating polynomials: over all p steps the
// weights are those of Newton and Cotes, with the sum p, not 1.
TEST(MtlWeights, AreNewtonAndCotesWithoutLinearPart) {
  const std::vector<std::vector<double>> rules = {{0.5, 0.5},
                                                  {1. / 3, 4. / 3, 1. / 3},
                                                  {3. / 8, 9. / 8, 9. / 8, 3. / 8},
                                                  {14. / 45, 64. / 45, 24. / 45, 64. / 45, 14. / 45}};
  for (int p = 1; p <= 4; ++p) {
    MtlWeights weights(2, 1, MtlBasis::lagrange, p, {});
    const double h = 0.25;
    ASSERT_EQ(weights.compute((Eigen::Matrix2d() << 0, 1, 0, 0).finished(), h), Outcome::success);
    double sum = 0;
    for (int k = 0; k <= p; ++k) {
      const double weight = weights.weight(p, k)(1, 0) / h;
      EXPECT_NEAR(weight, rules[static_cast<std::size_t>(p - 1)][static_cast<std::size_t>(k)], 20 * eps);
      sum += weight;
    }
    EXPECT_NEAR(sum, p, 40 * eps);
  }
}

// Conditions on a basis: phi_k(t_i) = delta_ki, and the sum 1 everywhere. The printed condition, an integral
// of one over p steps, holds for no Lagrange basis at every h.
TEST(MtlBasis, InterpolatesAndSumsToOne) {
  for (const MtlBasis basis : {MtlBasis::lagrange, MtlBasis::interpolet}) {
    for (int p = 1; p <= 8; ++p) {
      const auto pieces = mtl_pieces(basis, p);
      ASSERT_EQ(pieces.size(), static_cast<std::size_t>(p));
      for (int j = 0; j < p; ++j) {
        const Eigen::MatrixXd& c = pieces[static_cast<std::size_t>(j)];
        for (int k = 0; k <= p; ++k) {
          EXPECT_NEAR(c(k, 0), j == k, 100 * eps);
          EXPECT_NEAR(c.row(k).sum(), j + 1 == k, 1e3 * eps);
        }
        EXPECT_NEAR(c.col(0).sum(), 1, 1e3 * eps);
        for (Eigen::Index m = 1; m < c.cols(); ++m) EXPECT_NEAR(c.col(m).sum(), 0, 1e3 * eps);
      }
    }
  }
}

// The definition: Lagrange polynomials times a Gaussian about the point, which is one for an infinite width.
TEST(MtlBasis, DistributedApproximatingFunctionalsAreAsDefined) {
  for (const double width : {2., 3., 10., HUGE_VAL}) {
    for (int p = 1; p <= 8; ++p) {
      const auto pieces = mtl_pieces(MtlBasis::daf, p, width);
      for (int j = 0; j < p; ++j) {
        const Eigen::MatrixXd& c = pieces[static_cast<std::size_t>(j)];
        for (int k = 0; k <= p; ++k) {
          for (const double s : {0., 0.3, 0.5, 1.}) {
            double polynomial = 1, series = 0;
            for (int i = 0; i <= p; ++i) polynomial *= i == k ? 1 : (j + s - i) / (k - i);
            for (Eigen::Index m = c.cols() - 1; m >= 0; --m) series = series * s + c(k, m);
            const double z = (j + s - k) / width;
            EXPECT_NEAR(series, polynomial * std::exp(-z * z / 2), 1e-14)
                << width << ' ' << p << ' ' << j << ' ' << k;
          }
        }
      }
    }
  }
}

// Response from rest at t = 0.7 to a harmonic load: x'' + w^2 x = cos W t.
TEST(MtlPropagator, AnswersHarmonicLoads) {
  const double w = 3, wf = 1.2, t0 = 0.7, tau = 2.5;
  const std::vector<Harmonic> load = {{1, wf, 1, 0}, {1, 0, 0.5, 0}, {1, wf, 0, 0.25}};
  MtlPropagator flow(2, 1, 2, load);
  EXPECT_EQ(flow.phase_count(), 4);
  ASSERT_EQ(flow.compute(oscillator(w, 0), tau), Outcome::success);
  Eigen::VectorXd phases(4);
  flow.phases(t0, phases);
  const Eigen::Vector2d x = flow.response() * phases;
  const double gap = w * w - wf * wf;
  const auto steady = [&](double t) { return (std::cos(wf * t) + 0.25 * std::sin(wf * t)) / gap + 0.5 / 9; };
  const auto rate = [&](double t) { return wf * (-std::sin(wf * t) + 0.25 * std::cos(wf * t)) / gap; };
  const double c = std::cos(w * tau), s = std::sin(w * tau);
  EXPECT_NEAR(x[0], steady(t0 + tau) - steady(t0) * c - rate(t0) * s / w, 20 * eps);
  EXPECT_NEAR(x[1], rate(t0 + tau) + steady(t0) * w * s - rate(t0) * c, 60 * eps);
}

RC_GTEST_PROP(MtlPropagator, IsAGroup, ()) {
  const auto number = [](int from, int to) { return *rc::gen::inRange(from, to) / 100.; };
  Eigen::Matrix3d a;
  for (int i = 0; i < 9; ++i) a(i) = number(-200, 200);
  const double s = number(1, 100), t = number(1, 100);
  MtlPropagator one(3, 3, 1, {}), two(3, 3, 1, {}), both(3, 3, 1, {});
  RC_ASSERT(one.compute(a, s) == Outcome::success && two.compute(a, t) == Outcome::success &&
            both.compute(a, s + t) == Outcome::success);
  const Eigen::Matrix3d product = one.exponential() * two.exponential();
  const double norm = one.exponential().cwiseAbs().sum() * two.exponential().cwiseAbs().sum();
  RC_ASSERT((product - both.exponential()).cwiseAbs().maxCoeff() <= 200 * eps * norm);
  // phi_1 E over s + t: that over t, and that over s moved on.
  const Eigen::Matrix3d sum = two.exponential() * one.phi(1) + two.phi(1);
  RC_ASSERT((sum - both.phi(1)).cwiseAbs().maxCoeff() <= 200 * eps * norm * (s + t));
}

TEST(MtlPropagator, OverflowIsAnOutcome) {
  MtlPropagator flow(1, 1, 1, {});
  EXPECT_EQ(flow.compute(Eigen::MatrixXd::Constant(1, 1, 710), 1), Outcome::non_finite);
  EXPECT_EQ(flow.compute(Eigen::MatrixXd::Constant(1, 1, -710), 1), Outcome::success);
  EXPECT_EQ(flow.compute(Eigen::MatrixXd::Constant(1, 1, NAN), 1), Outcome::non_finite);
  EXPECT_EQ(flow.compute(Eigen::MatrixXd::Constant(1, 1, 1), HUGE_VAL), Outcome::non_finite);
}

}  // namespace
}  // namespace nlmech::ivp::mtl_weights_test

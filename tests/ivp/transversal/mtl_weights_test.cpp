/// Weights of multi-step transversal linearisation against closed forms in 60 digits and Newton and Cotes'
/// rules.
#include "nlmech/ivp/transversal/mtl_weights.hpp"
#include "nlmech/support/extended_real.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace nlmech::ivp::mtl_weights_test {
namespace {

using Real = ExtendedReal<60>;
using Matrix2 = Eigen::Matrix<Real, 2, 2>;
constexpr double eps = std::numeric_limits<double>::epsilon();

/// [0 1; -w^2 -2 zeta w].
Eigen::Matrix2d oscillator(double w, double zeta) {
  return (Eigen::Matrix2d() << 0, 1, -w * w, -2 * zeta * w).finished();
}

/// phi_0, ..., phi_q of a matrix in 60 digits: the power series of a 2^-s part of it, doubled s times by
/// phi_k(2 z) = 2^-k [e^z phi_k(z) + sum over j = 1..k of phi_j(z)/(k - j)!].
std::vector<Matrix2> phi_functions(const Matrix2& z, int q) {
  Real norm = 0;
  for (int i = 0; i < 4; ++i) norm += abs(z(i));
  int doublings = 0;
  for (; norm > Real(1) / 4; norm /= 2) ++doublings;
  const Matrix2 small = z * Real(pow(Real(2), -doublings));
  std::vector<Matrix2> phi;
  std::vector<Real> factorial = {1};
  for (int k = 1; k <= q + 60; ++k) factorial.push_back(factorial.back() * k);
  for (int k = 0; k <= q; ++k) {
    Matrix2 sum = Matrix2::Zero();
    for (int m = 60; m >= 0; --m) {
      sum = (small * sum).eval();
      sum.diagonal().array() += 1 / factorial[static_cast<std::size_t>(k) + static_cast<std::size_t>(m)];
    }
    phi.push_back(sum);
  }
  // The loop above is Horner's rule with coefficients 1/(k + m)!.
  for (int s = 0; s < doublings; ++s) {
    std::vector<Matrix2> next;
    for (int k = 0; k <= q; ++k) {
      Matrix2 sum = phi[0] * phi[static_cast<std::size_t>(k)];
      for (int j = 1; j <= k; ++j)
        sum += phi[static_cast<std::size_t>(j)] * Real(1 / factorial[static_cast<std::size_t>(k - j)]);
      next.push_back(sum * Real(pow(Real(2), -k)));
    }
    phi = next;
  }
  return phi;
}

/// Coefficients c_km of the Lagrange polynomials about theta = 0: the inverse of a Vandermonde matrix.
Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> lagrange(int p) {
  Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> all(p + 1, p + 1);
  for (int k = 0; k <= p; ++k) {
    std::vector<Real> c = {1};
    for (int i = 0; i <= p; ++i) {
      if (i == k) continue;
      std::vector<Real> next(c.size() + 1, Real(0));
      for (std::size_t m = 0; m < c.size(); ++m) {
        next[m] -= c[m] * i / (k - i);
        next[m + 1] += c[m] / (k - i);
      }
      c = next;
    }
    for (int m = 0; m <= p; ++m) all(k, m) = c[static_cast<std::size_t>(m)];
  }
  return all;
}

/// W_lk = sum over m of c_km m! l^(m+1) h phi_{m+1}(A l h) e_2, the closed form in one piece from 0.
/// @param c Lagrange's coefficients @param phi functions of A l h
Eigen::Matrix<Real, 2, 1> closed_form(const Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>& c,
                                      const std::vector<Matrix2>& phi, double h, int l, int k) {
  Eigen::Matrix<Real, 2, 1> sum = Eigen::Matrix<Real, 2, 1>::Zero();
  Real factor = h;
  for (int m = 0; m < c.cols(); ++m) {
    factor *= l;
    if (m > 0) factor *= m;
    sum += phi[static_cast<std::size_t>(m) + 1].col(1) * Real(c(k, m) * factor);
  }
  return sum;
}

// Each weight to roundings of the largest in its row, for slow, fast, damped and growing linear parts.
TEST(MtlWeights, AreTheClosedForm) {
  for (const double z : {0., 1e-8, 0.3, 7., 1e3}) {
    for (const double zeta : {0., 0.1, 5., -0.5}) {
      if (std::abs(zeta) * z > 40) continue;  // growth or decay by e^40 and more a step: scaled otherwise
      for (const int p : {1, 2, 3, 5, 8}) {
        const double h = 0.1, w = z / h;
        const Eigen::Matrix2d a = oscillator(w, zeta);
        MtlWeights weights(2, 1, MtlBasis::lagrange, p, {});
        ASSERT_EQ(weights.compute(a, h), Outcome::success);
        const auto c = lagrange(p);
        for (int l = 1; l <= p; ++l) {
          const auto phi = phi_functions(a.cast<Real>() * (Real(h) * l), p + 1);
          std::vector<Eigen::Matrix<Real, 2, 1>> row;
          Eigen::Array2d largest(0, 0);
          for (int k = 0; k <= p; ++k) {
            row.push_back(closed_form(c, phi, h, l, k));
            for (int i = 0; i < 2; ++i)
              largest[i] = std::max(largest[i], static_cast<double>(abs(row.back()[i])));
          }
          // A velocity's rounding enters the position by the time or by 1/w, whichever is smaller.
          const double growth = zeta < 0 ? std::exp(-zeta * z * p) : 1;
          const double time = std::min(h * p, z > 0 ? 1 / w : h * p);
          const double scale = std::max(largest[0] / time, largest[1]) * growth * (1 + z) * (1 + zeta * zeta);
          for (int k = 0; k <= p; ++k) {
            const auto found = weights.weight(l, k);
            const auto& truth = row[static_cast<std::size_t>(k)];
            const double bound = 60 * p * eps * scale;
            EXPECT_NEAR(found(1, 0), static_cast<double>(truth[1]), bound) << z << " " << zeta << " " << p;
            EXPECT_NEAR(found(0, 0), static_cast<double>(truth[0]), bound * time)
                << z << " " << zeta << " " << p << " " << l << " " << k;
          }
        }
      }
    }
  }
}

// Without spring and damper the velocities are integrals of interpolating polynomials: over all p steps the
// weights of Newton and Cotes, whose sum is p and not one.
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

// phi_k(t_i) = delta_ki, and a sum of one everywhere: the conditions on a basis. The printed one, an integral
// of one over p steps, holds of no Lagrange basis for every h.
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

// The response to a harmonic load, from rest: x'' + w^2 x = cos W t, from t = 0.7 on.
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

// Tables of Radau IIA: conditions on its matrices, the coordinates in which it decouples, and Gaussians.
#include "nlmech/collocation/radau/radau.hpp"

#include <gtest/gtest.h>
#include <Eigen/LU>
#include <boost/multiprecision/eigen.hpp>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "nlmech/collocation/radau/radau_transform.hpp"
#include "nlmech/collocation/radial/stable_gaussian.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::collocation::radau_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

template <class T>
class Tables : public ::testing::Test {};
template <int s>
struct Stages {
  static constexpr int count = s;
};
using All = ::testing::Types<Stages<3>, Stages<5>, Stages<7>, Stages<8>, Stages<12>, Stages<16>>;
TYPED_TEST_SUITE(Tables, All);

// A integrates powers up to the degree s - 1 to every node, its last row those up to 2s - 2 (the order
// conditions B(2s - 1) and C(s)), and A A twice.
TYPED_TEST(Tables, IntegratePowers) {
  constexpr int s = TypeParam::count;
  const Radau<s>& r = radau<s>();
  EXPECT_EQ(r.nodes[s - 1], 1);
  for (int k = 0; k <= 2 * s - 2; ++k) {
    const Eigen::Matrix<double, s, 1> f = r.nodes.array().pow(k);
    EXPECT_NEAR(r.integral.row(s - 1).dot(f), 1. / (k + 1), 8 * eps) << k;
    if (k > s - 1) continue;
    for (int i = 0; i < s; ++i)
      EXPECT_NEAR(r.integral.row(i).dot(f), std::pow(r.nodes[i], k + 1) / (k + 1), 8 * eps) << k << ' ' << i;
    if (k > s - 2) continue;
    for (int i = 0; i < s; ++i)
      EXPECT_NEAR(r.twice.row(i).dot(f), std::pow(r.nodes[i], k + 2) / ((k + 1) * (k + 2)), 8 * eps) << k;
  }
}

// Values at the start and Legendre coefficients of P_k.
TYPED_TEST(Tables, KnowLegendrePolynomials) {
  constexpr int s = TypeParam::count;
  const Radau<s>& r = radau<s>();
  for (int k = 0; k < s; ++k) {
    Eigen::Matrix<double, s, 1> f;
    for (int i = 0; i < s; ++i) f[i] = std::legendre(static_cast<unsigned>(k), 2 * r.nodes[i] - 1);
    EXPECT_NEAR(r.left.dot(f), k % 2 == 0 ? 1 : -1, 4 * s * s * eps) << k;
    const Eigen::Matrix<double, s, 1> c = r.legendre * f;
    for (int j = 0; j < s; ++j) EXPECT_NEAR(c[j], j == k ? 1 : 0, 4 * s * s * eps) << k << ' ' << j;
  }
}

template <class T>
class Transforms : public ::testing::Test {};
using Odd = ::testing::Types<Stages<3>, Stages<5>, Stages<7>>;
TYPED_TEST_SUITE(Transforms, Odd);

// T^-1 A^-1 T consists of a number and blocks (alpha, -beta; beta, alpha); the rounding error is proportional
// to the condition numbers of A and T.
TYPED_TEST(Transforms, DecoupleTheStages) {
  constexpr int s = TypeParam::count;
  const RadauTransform<s>& t = radau_transform<s>();
  EXPECT_LT((t.to * t.from - Radau<s>::Square::Identity()).cwiseAbs().maxCoeff(), 1000 * eps);
  const typename Radau<s>::Square blocks = t.to * radau<s>().integral.inverse() * t.from;
  typename Radau<s>::Square expected = Radau<s>::Square::Zero();
  expected(0, 0) = t.real;
  for (int p = 0; p < RadauTransform<s>::pairs; ++p) {
    const auto value = t.complex[static_cast<std::size_t>(p)];
    const int a = 2 * p + 1;
    expected(a, a) = expected(a + 1, a + 1) = value.real();
    expected(a, a + 1) = -value.imag();
    expected(a + 1, a) = value.imag();
    EXPECT_GT(value.imag(), 0);
  }
  EXPECT_LT((blocks - expected).cwiseAbs().maxCoeff(), 1e5 * eps) << blocks;
}

// int exp((1 - c) z) r(c) dc for r = M and r = c M against the trapezoidal rule with the first two
// corrections by Richardson, 4096 intervals: |z| < 300 leaves (300/4096)^6/30240 of the largest value.
TYPED_TEST(Transforms, DefectsAreCarriedToTheEnd) {
  constexpr int s = TypeParam::count;
  using Complex = std::complex<double>;
  const RadauTransform<s>& t = radau_transform<s>();
  const RadauDefect<s>& defect = radau_defect<s>();
  const auto node_polynomial = [](double c) { return (1 - c / radau<s>().nodes.array()).prod(); };
  for (const int power : {0, 1}) {
    const auto r = [&](double c) { return (power == 0 ? 1 : c) * node_polynomial(c); };
    for (const double angle : {0.5, 0.6, 0.75, 1.0}) {
      for (const double size : {0.5, 2., 5., 9., 20., 60., 200.}) {
        const Complex z = std::polar(size, angle * std::numbers::pi);
        const auto integral = [&](int intervals) {
          Complex sum = (std::exp(z) * r(0) + r(1)) / 2.;
          for (int i = 1; i < intervals; ++i)
            sum += std::exp((1 - double(i) / intervals) * z) * r(double(i) / intervals);
          return sum / double(intervals);
        };
        const Complex a = integral(1024), b = integral(2048), c = integral(4096);
        const Complex ab = (4. * b - a) / 3., bc = (4. * c - b) / 3., exact = (16. * bc - ab) / 15.;
        // As in NewtonSteps, for J = z and h = 1; the part of a pair is real there and complex here.
        Complex found = (defect.begin[0] * r(0) + defect.inner[0] * r(defect.inner_time)) / (t.real - z);
        for (int p = 0; p < RadauTransform<s>::pairs; ++p) {
          const auto k = static_cast<std::size_t>(p);
          const Complex w = (defect.begin[k + 1] * r(0) + defect.inner[k + 1] * r(defect.inner_time)) / 2.;
          found += w / (t.complex[k] - z) + std::conj(w) / (std::conj(t.complex[k]) - z);
        }
        // The sum of fractions cancels: tolerance eps times their weights, some hundreds.
        const double least = 1e-12;
        EXPECT_GT(std::abs(found) + least, std::abs(exact) / 4) << s << ' ' << power << ' ' << z;
        EXPECT_LT(std::abs(found), std::max(2., size / 5) * std::abs(exact) + least)
            << s << ' ' << power << ' ' << z;
      }
    }
  }
}

// Three stages have known eigenvalues: the roots of s^3 - 9 s^2 + 36 s - 60 (Hairer and Wanner, section
// IV.8).
TEST(Transforms3, CharacteristicPolynomial) {
  const RadauTransform<3>& t = radau_transform<3>();
  const auto p = [](std::complex<double> z) { return ((z - 9.) * z + 36.) * z - 60.; };
  EXPECT_LT(std::abs(p(t.real)), 1000 * eps);
  EXPECT_LT(std::abs(p(t.complex[0])), 1000 * eps);
}

// ---- Gaussians at Radau nodes as tables of quadrature: against extended precision and against polynomials.

using Real = ExtendedReal<150>;
using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

// A = (D without the start)^-1 in 150 digits, from the definitions of Phi and Phi'.
template <int s>
RealMatrix integral(double shape) {
  const Radau<s>& radau_tables = radau<s>();
  std::vector<Real> t = {0};
  for (int i = 0; i < s; ++i) t.push_back(Real(radau_tables.nodes[i]));
  RealMatrix phi(s + 1, s + 1), slope(s + 1, s + 1);
  for (int i = 0; i <= s; ++i) {
    for (int j = 0; j <= s; ++j) {
      const Real x = t[static_cast<std::size_t>(i)] - t[static_cast<std::size_t>(j)],
                 c2 = Real(shape) * shape;
      phi(i, j) = exp(-c2 * x * x);
      slope(i, j) = -2 * c2 * x * phi(i, j);
    }
  }
  const RealMatrix derivative = slope * phi.partialPivLu().inverse();
  return derivative.bottomRightCorner(s, s).partialPivLu().inverse();
}

// D is accurate to 1e-12 of its largest entry (StableGaussian); its inverse amplifies that by its condition
// number, about s^2.
TEST(GaussianRadau, AgreesWithExtendedPrecision) {
  for (const double shape : {0.05, 0.5, 2.0, 6.0}) {
    Radau<8> tables;
    ASSERT_TRUE(gaussian_radau<8>(shape, tables));
    const RealMatrix exact = integral<8>(shape);
    double largest = 0;
    for (int i = 0; i < 8; ++i) {
      for (int j = 0; j < 8; ++j)
        largest = std::max(largest, std::abs(static_cast<double>(exact(i, j) - Real(tables.integral(i, j)))));
    }
    EXPECT_LT(largest, 64e-12) << shape;
  }
}

TEST(GaussianRadau, WideOnesArePolynomials) {
  Radau<12> tables;
  ASSERT_TRUE(gaussian_radau<12>(1e-5, tables));
  EXPECT_LT((tables.integral - radau<12>().integral).cwiseAbs().maxCoeff(), 144e-12);
  EXPECT_LT((tables.twice - radau<12>().twice).cwiseAbs().maxCoeff(), 144e-12);
  EXPECT_LT((tables.left - radau<12>().left).cwiseAbs().maxCoeff(), 1e-9);  // entries of 10, times D's 100
  EXPECT_EQ(tables.nodes, radau<12>().nodes);
}

TEST(GaussianRadau, RefusesShapesOutOfRange) {
  Radau<8> tables;
  EXPECT_THROW((void)gaussian_radau<8>(-1, tables), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(gaussian_radau<8>(2 * StableGaussian::largest_shape, tables)),
               std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::collocation::radau_test

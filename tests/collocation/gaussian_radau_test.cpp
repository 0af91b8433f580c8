// Gaussians at Radau nodes as tables of quadrature: against extended precision and against polynomials.
#include "nlmech/collocation/radial/gaussian_radau.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <boost/multiprecision/eigen.hpp>

#include "nlmech/collocation/radial/stable_gaussian.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::collocation::gaussian_radau_test {
namespace {

using Real = ExtendedReal<150>;
using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

// A = (D without the begin)^-1 in 150 digits, from Phi and Phi' as they are defined.
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

// D is within 1e-12 of its largest entry (StableGaussian); an inverse enlarges that by its condition, some
// s^2.
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
  EXPECT_THROW(static_cast<void>(gaussian_radau<8>(-1, tables)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(gaussian_radau<8>(2 * StableGaussian::largest_shape, tables)),
               std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::collocation::gaussian_radau_test

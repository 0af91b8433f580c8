#include "nlmech/collocation/basis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace nlmech::collocation::basis_test {
namespace {

constexpr double eps = 2.220446049250313e-16;

TEST(Basis, StandsOnTheUnitInterval) {
  for (const auto family : {NodeFamily::legendre_gauss_lobatto, NodeFamily::left_end_and_radau}) {
    const Basis basis = Basis::polynomial(family, 9);
    EXPECT_EQ(basis.nodes()[0], 0);
    EXPECT_EQ(basis.nodes()[8], 1);
    EXPECT_EQ(basis.condition(), 1);
    EXPECT_TRUE(basis.status().ok());
  }
}

// t^8 at nine nodes: derivative and values between come out to rounding, magnified by the norm of D (at most
// 100).
TEST(Basis, PolynomialsAreExactUpToTheirDegree) {
  const Basis basis = Basis::polynomial(NodeFamily::left_end_and_radau, 9);
  const Eigen::VectorXd x = basis.nodes().array().pow(8), slope = 8 * basis.nodes().array().pow(7);
  EXPECT_LE((basis.derivative() * x - slope).cwiseAbs().maxCoeff(), 100 * eps);
  for (const double tau : {0.0, 0.123, 0.5, 0.999, 1.0})
    EXPECT_NEAR(basis.row(tau).dot(x), std::pow(tau, 8), 10 * eps) << tau;
}

// A sum of the functions themselves is in their span: exp(-(c t)^2) about the first node.
TEST(Basis, RadialFunctionsAreExactOnTheirSpan) {
  constexpr double c = 2.5;
  const Basis basis = Basis::radial(NodeFamily::legendre_gauss_lobatto, 7, Kernel::gaussian, c);
  const auto bell = [](double t) { return std::exp(-c * c * t * t); };
  const Eigen::VectorXd x = basis.nodes().unaryExpr(bell);
  const double error = basis.condition() * eps;  // of coefficients of order one
  EXPECT_LT(basis.condition(), 1e7);
  for (const double tau : {0.1, 0.77}) EXPECT_NEAR(basis.row(tau).dot(x), bell(tau), error);
  for (Eigen::Index k = 0; k < 7; ++k) {
    const double t = basis.nodes()[k];
    EXPECT_NEAR(basis.derivative().row(k).dot(x), -2 * c * c * t * bell(t), 100 * error);  // norm of D
  }
}

TEST(Basis, ReportsAShapeThatIsOfNoUse) {
  const Basis wide = Basis::radial(NodeFamily::legendre_gauss_lobatto, 35, Kernel::gaussian, 1e-6);
  EXPECT_FALSE(wide.status().ok());
  const Basis narrow = Basis::radial(NodeFamily::legendre_gauss_lobatto, 35, Kernel::gaussian, 1e6);
  EXPECT_FALSE(narrow.status().ok());
  EXPECT_THROW((void)narrow.row(0.5), std::logic_error);
}

TEST(Basis, RefusesCountsAndShapes) {
  EXPECT_THROW((void)Basis::polynomial(NodeFamily::legendre_gauss_lobatto, 1), std::invalid_argument);
  EXPECT_THROW((void)Basis::polynomial(NodeFamily::legendre_gauss_lobatto, 201), std::invalid_argument);
  EXPECT_THROW((void)Basis::radial(NodeFamily::legendre_gauss_lobatto, 7, Kernel::gaussian, 0),
               std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::collocation::basis_test

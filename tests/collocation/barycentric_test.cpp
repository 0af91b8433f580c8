#include "nlmech/collocation/barycentric.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>

#include "tests/collocation/real.hpp"

namespace nlmech::collocation::barycentric_test {
namespace {

using oracle::eps;
using oracle::legendre;
using oracle::lgl_times;
using oracle::Real;
using oracle::refusal;
using oracle::sample;
using oracle::to_double;

// Henrici: (-1)^j, and half of that at both ends.
TEST(BarycentricWeights, OfChebyshevNodesAreKnown) {
  for (const int n : {2, 3, 16, 35, 200}) {
    Eigen::VectorXd weights = barycentric_weights(chebyshev_gauss_lobatto(n));
    weights /= 2 * weights[n - 1];
    for (int j = 0; j < n; ++j) {
      const double exact = ((n - 1 - j) % 2 == 0 ? 1 : -1) * (j == 0 || j == n - 1 ? 0.5 : 1.);
      // 2 n units in the last place, for the last weight too; and nodes that are 1e-16 off, at distances of
      // about 5/n^2 near the ends.
      EXPECT_NEAR(weights[j], exact, 4 * n * eps + n * n * 2e-16 / 5) << j << " of " << n;
    }
  }
}

// A product of n - 1 factors with three roundings each, of which the promise is that they do not all go one
// way.
TEST(BarycentricWeights, KeepTheirDigits) {
  for (const NodeFamily family : oracle::families) {
    for (const int n : {2, 7, 35, 200}) {
      const Eigen::VectorXd tau = nodes(family, n), weights = barycentric_weights(tau);
      for (int j = 0; j < n; ++j) {
        Real exact = 1;
        for (int k = 0; k < n; ++k) {
          if (k != j) exact /= (Real(tau[j]) - tau[k]) * 2;  // 4/L, L = 2
        }
        EXPECT_LE(to_double(abs(Real(weights[j]) / exact - 1)), 2 * n * eps) << n << ' ' << j;
      }
    }
  }
}

// A sum of n products that are known to within 2 n units in the last place each.
RC_GTEST_PROP(PolynomialDifferentiation, IsExactForPolynomials, ()) {
  const NodeFamily family = *rc::gen::elementOf(oracle::families);
  const int n = *rc::gen::inRange(2, 101), k = *rc::gen::inRange(0, n);
  const Eigen::VectorXd tau = nodes(family, n);
  const Eigen::MatrixXd D = polynomial_differentiation_matrix(tau);
  const Eigen::VectorXd p = sample(tau, [k](const Real& x) { return legendre(k, x).value; });
  const Eigen::VectorXd slope = sample(tau, [k](const Real& x) { return legendre(k, x).slope; });
  const Eigen::VectorXd bound = 2 * n * eps * (D.cwiseAbs() * p.cwiseAbs());
  RC_ASSERT(((D * p - slope).cwiseAbs().array() <= bound.array()).all());
}

TEST(PolynomialDifferentiation, HoldsFor200Nodes) {
  for (const NodeFamily family : oracle::families) {
    const Eigen::VectorXd tau = nodes(family, 200);
    const Eigen::MatrixXd D = polynomial_differentiation_matrix(tau);
    for (const int k : {0, 1, 2, 50, 199}) {
      const Eigen::VectorXd p = sample(tau, [k](const Real& x) { return legendre(k, x).value; });
      const Eigen::VectorXd slope = sample(tau, [k](const Real& x) { return legendre(k, x).slope; });
      // As above; the derivatives reach 2e4 for k = 199, the matrix 1e4.
      EXPECT_LE((D * p - slope).cwiseAbs().maxCoeff(),
                2 * 200 * eps * D.cwiseAbs().rowwise().sum().maxCoeff());
    }
  }
}

// Findings of a study before this code: |D 1| of LGL nodes on an interval of length 1. It is all rounding,
// and depends on the order of a sum: a factor 4.
TEST(PolynomialDifferentiation, OfAConstantIsZero) {
  for (const auto& [n, measured] :
       std::map<int, double>{{7, 2e-15}, {35, 6e-14}, {60, 3.5e-13}, {100, 1.9e-12}}) {
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(n);
    const double error = (polynomial_differentiation_matrix(lgl_times(n)) * ones).cwiseAbs().maxCoeff();
    EXPECT_LE(error, 4 * measured) << n;
    EXPECT_GT(error, 0) << n;
  }
}

TEST(PolynomialDifferentiation, OfTwoAndOfOneNode) {
  const Eigen::MatrixXd two = polynomial_differentiation_matrix<double>(Eigen::Vector2d(3, 3.5));
  EXPECT_EQ(two, (Eigen::MatrixXd(2, 2) << -2, 2, -2, 2).finished());
  EXPECT_EQ(polynomial_differentiation_matrix<double>(Eigen::VectorXd::Constant(1, 7.)),
            Eigen::MatrixXd::Zero(1, 1));
}

TEST(PolynomialDifferentiation, HasTheDigitsOfItsType) {
  const Vector<Real> tau = legendre_gauss_lobatto<Real>(9);
  const Matrix<Real> D = polynomial_differentiation_matrix(tau);
  for (int k = 0; k < 9; ++k) {
    Vector<Real> error = Vector<Real>::Zero(9);
    for (int i = 0; i < 9; ++i) {
      for (int j = 0; j < 9; ++j) error[i] += D(i, j) * legendre(k, tau[j]).value;
      error[i] -= legendre(k, tau[i]).slope;
    }
    EXPECT_LE(to_double(error.cwiseAbs().maxCoeff()), 1e-47) << k;
  }
}

TEST(PolynomialRow, IsExactAtTheNodes) {
  for (const NodeFamily family : oracle::families) {
    const Eigen::VectorXd tau = nodes(family, 35), weights = barycentric_weights(tau);
    RowVector<double> row(35);
    const double* const storage = row.data();
    for (int k = 0; k < 35; ++k) {
      polynomial_row(tau, weights, tau[k], row);
      EXPECT_EQ(row, Eigen::MatrixXd::Identity(35, 35).row(k));
    }
    EXPECT_EQ(row.data(), storage);
  }
}

TEST(PolynomialRow, DoesNotOverflowNextToANode) {
  const Eigen::VectorXd tau = legendre_gauss_lobatto(7), weights = barycentric_weights(tau);
  RowVector<double> row;
  for (const double t : {5e-324, -1e-320, 1e-308, 1e-300, 1e-30, -1e-17}) {
    polynomial_row(tau, weights, t, row);
    EXPECT_LE((row - Eigen::MatrixXd::Identity(7, 7).row(3)).cwiseAbs().maxCoeff(), 1e-16) << t;
  }
}

// Inside, sum |r_k| < 5: the Lebesgue constants of these nodes, which grow as 2/pi log n. Times n eps for
// each entry, of 2 n roundings that do not all go one way.
RC_GTEST_PROP(PolynomialRow, ReproducesPolynomialsInside, ()) {
  const NodeFamily family = *rc::gen::elementOf(oracle::families);
  const int n = *rc::gen::inRange(2, 201), k = *rc::gen::inRange(0, n);
  const Eigen::VectorXd tau = nodes(family, n), weights = barycentric_weights(tau);
  const double t = *rc::gen::inRange(-1000000, 1000001) / 1e6;
  RowVector<double> row;
  polynomial_row(tau, weights, t, row);
  RC_ASSERT(row.cwiseAbs().sum() < 5);
  const Eigen::VectorXd p = sample(tau, [k](const Real& x) { return legendre(k, x).value; });
  RC_ASSERT(std::abs(row.dot(p) - to_double(legendre(k, Real(t)).value)) <= 5 * n * eps);
}

// Outside each entry is a product of known factors, and keeps its digits however large it grows.
RC_GTEST_PROP(PolynomialRow, KeepsItsDigitsOutside, ()) {
  const NodeFamily family = *rc::gen::elementOf(oracle::families);
  const int n = *rc::gen::inRange(2, 41);
  const Eigen::VectorXd tau = nodes(family, n), weights = barycentric_weights(tau);
  const double t = *rc::gen::elementOf(std::vector<double>{-1, 1}) * (1 + *rc::gen::inRange(1, 3000) / 1e3);
  RowVector<double> row;
  polynomial_row(tau, weights, t, row);
  for (int k = 0; k < n; ++k) {
    Real exact = 1;
    for (int j = 0; j < n; ++j) {
      if (j != k) exact *= (Real(t) - tau[j]) / (Real(tau[k]) - tau[j]);
    }
    RC_ASSERT(abs(Real(row[k]) / exact - 1) <= 4 * n * eps);
  }
}

TEST(Barycentric, RefusesWhatIsNoSetOfNodes) {
  const auto message = [](std::initializer_list<double> list) {
    Eigen::VectorXd nodes(static_cast<Eigen::Index>(list.size()));
    std::copy(list.begin(), list.end(), nodes.begin());
    return refusal([&] { (void)polynomial_differentiation_matrix(nodes); });
  };
  EXPECT_EQ(message({}), "barycentric_weights: the number of nodes must lie between 1 and 200, is 0");
  EXPECT_EQ(message({0, 1, 0.5}),
            "barycentric_weights: node number 2, 0.5, is not larger than the one before it");
  EXPECT_EQ(message({0, std::nan("")}), "barycentric_weights: node number 1, nan, is not finite");
  EXPECT_EQ(message({0, INFINITY}), "barycentric_weights: node number 1, inf, is not finite");
  EXPECT_EQ(message({0, 5e-324, 1}), "barycentric_weights: node number 0, 0, is too close to another one");
  EXPECT_EQ(message({0, 1e-310}),
            "polynomial_differentiation_matrix: node number 0, 0, is too close to another one");
  const Eigen::VectorXd tau = legendre_gauss_lobatto(3), weights = barycentric_weights(tau);
  RowVector<double> row;
  EXPECT_EQ(refusal([&] { polynomial_row(tau, weights, std::nan(""), row); }),
            "polynomial_row: the time must be finite, is nan");
}

}  // namespace
}  // namespace nlmech::collocation::barycentric_test

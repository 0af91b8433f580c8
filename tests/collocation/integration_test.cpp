#include "nlmech/collocation/integration.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>

#include "tests/collocation/real.hpp"

namespace nlmech::collocation::integration_test {
namespace {

using namespace oracle;

/// S in 50 digits: integrals of the Legendre polynomials times the inverse of their values at the nodes.
Matrix<Real> exact_integration_matrix(const Eigen::VectorXd& tau) {
  const int n = static_cast<int>(tau.size());
  Matrix<Real> values(n, n), integrals(n, n);
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      values(i, k) = legendre(k, Real(tau[i])).value;
      integrals(i, k) = legendre_integral(k, Real(tau[i]));
    }
  }
  const Matrix<Real> transposed = values.transpose(), right = integrals.transpose();
  return transposed.partialPivLu().solve(right).transpose();
}

double error_of(const Eigen::MatrixXd& S, const Matrix<Real>& exact) {
  return to_double((S.cast<Real>() - exact).cwiseAbs().maxCoeff());
}

// Documented error bound: 1e-15.
TEST(IntegrationMatrix, IsExactToTheLastDigits) {
  for (const int n : {2, 3, 7, 35}) {
    for (const NodeFamily family : oracle::families) {
      const Eigen::VectorXd tau = nodes(family, n);
      EXPECT_LE(error_of(integration_matrix(tau), exact_integration_matrix(tau)), 1e-15)
          << to_string(family) << ' ' << n;
    }
    const Eigen::VectorXd radau = radau_right(n);  // without the left end
    EXPECT_LE(error_of(integration_matrix(radau), exact_integration_matrix(radau)), 1e-15) << n;
  }
  const Eigen::VectorXd many = legendre_gauss_lobatto(80);
  EXPECT_LE(error_of(integration_matrix(many), exact_integration_matrix(many)), 1e-15);
}

// The sum of |P_k| times the documented 1e-15: at most 200 of them, in practice far fewer because |P_199| is
// mostly small.
TEST(IntegrationMatrix, HoldsFor200Nodes) {
  for (const NodeFamily family : oracle::families) {
    const Eigen::VectorXd tau = nodes(family, 200);
    const Eigen::MatrixXd S = integration_matrix(tau);
    for (const int k : {0, 1, 50, 199}) {
      const Eigen::VectorXd p = sample(tau, [k](const Real& x) { return legendre(k, x).value; });
      const Eigen::VectorXd exact = sample(tau, [k](const Real& x) { return legendre_integral(k, x); });
      EXPECT_LE((S * p - exact).cwiseAbs().maxCoeff(), 1e-15 * (1 + p.cwiseAbs().sum()))
          << to_string(family) << ' ' << k;
    }
  }
}

/// Highest degree that the quadrature formula of the nodes integrates exactly.
int degree_of_exactness(NodeFamily family, int n) {
  switch (family) {
    case NodeFamily::legendre_gauss_lobatto: return 2 * n - 3;
    case NodeFamily::left_end_and_radau: return 2 * n - 4 + (n == 2 ? 1 : 0);  // two nodes: the trapezium
    default: return n % 2 == 0 ? n - 1 : n;                                    // Clenshaw & Curtis
  }
}

RC_GTEST_PROP(Quadrature, IsExactToItsDegree, ()) {
  const NodeFamily family = *rc::gen::elementOf(oracle::families);
  const int n = *rc::gen::inRange(2, 101), k = *rc::gen::inRange(0, degree_of_exactness(family, n) + 1);
  const Eigen::VectorXd tau = nodes(family, n);
  const Eigen::RowVectorXd weights = integration_matrix(tau).row(n - 1);
  const Eigen::VectorXd p = sample(tau, [k](const Real& x) { return legendre(k, x).value; });
  // Each weight is within 1e-15; nodes are 1e-16 off, where |P_k'| is below k/sqrt(1 - tau^2) on average.
  RC_ASSERT(std::abs(weights * p - (k == 0 ? 2 : 0)) <= n * 1e-15 + 2 * k * 1e-16);
}

TEST(Quadrature, IsNotExactBeyondItsDegree) {
  for (const NodeFamily family : oracle::families) {
    for (const int n : {3, 4, 7, 10}) {
      const int k = degree_of_exactness(family, n) + 1;
      const Eigen::VectorXd tau = nodes(family, n);
      const Eigen::VectorXd p = sample(tau, [k](const Real& x) { return legendre(k, x).value; });
      EXPECT_GT(std::abs(integration_matrix(tau).row(n - 1) * p), 1e-3) << to_string(family) << ' ' << n;
    }
  }
}

// Radau's quadrature formula does not use the left end.
TEST(Quadrature, OfRadauHasNoWeightAtTheLeftEnd) {
  for (const int n : {3, 7, 35, 100}) {
    const Eigen::VectorXd tau = left_end_and_radau(n);
    EXPECT_LE(std::abs(integration_matrix(tau)(n - 1, 0)), 1e-15) << n;
  }
}

// Differentiation and integration return a polynomial of degree < n, except for its value at -1.
TEST(IntegrationMatrix, UndoesDifferentiation) {
  for (const NodeFamily family : oracle::families) {
    for (const int n : {2, 3, 7, 35, 100, 200}) {
      const Eigen::VectorXd tau = nodes(family, n);
      const Eigen::MatrixXd D = polynomial_differentiation_matrix(tau), S = integration_matrix(tau);
      Eigen::MatrixXd expected = Eigen::MatrixXd::Identity(n, n);
      expected.col(0).array() -= 1;
      // Errors of both factors: 2 n units in the last place of D, and 1e-15 of S times a column of D.
      const Eigen::MatrixXd bound = 2 * n * eps * (S.cwiseAbs() * D.cwiseAbs()) +
                                    1e-15 * Eigen::VectorXd::Ones(n) * D.cwiseAbs().colwise().sum();
      EXPECT_TRUE(((S * D - expected).cwiseAbs().array() <= bound.array()).all())
          << to_string(family) << ' ' << n;
    }
  }
}

TEST(IntegrationMatrix, HasTheDigitsOfItsType) {
  const Eigen::VectorXd tau = legendre_gauss_lobatto(7);
  const Matrix<Real> S = integration_matrix<Real>(tau.cast<Real>());
  EXPECT_LE(to_double((S - exact_integration_matrix(tau)).cwiseAbs().maxCoeff()), 1e-48);
}

/// T_k in 50 digits.
Real chebyshev(int k, const Real& x) { return cos(k * acos(x)); }

/// Integral of T_k from -1 to x in 50 digits, by the angle: cos(k a) sin(a) is a difference of two sines.
Real chebyshev_integral(int k, const Real& x) {
  const Real a = acos(x), pi = oracle::pi();
  const auto primitive = [k](const Real& angle) {
    const Real sum = -cos((k + 1) * angle) / (k + 1);
    return Real((k == 1 ? sum : sum + cos((k - 1) * angle) / (k - 1)) / 2);
  };
  return primitive(pi) - primitive(a);
}

// n = 9, degree 7 and n = 7, degree 5 are those of the published runs.
TEST(ChebyshevPicard, IntegratesWhatItKeepsAndDropsTheRest) {
  for (const auto& [n, degree] :
       {std::pair{9, 7}, {7, 5}, {13, 11}, {2, 0}, {2, 1}, {3, 1}, {7, 6}, {35, 33}, {35, 10}}) {
    const Eigen::VectorXd tau = chebyshev_gauss_lobatto(n);
    const Eigen::MatrixXd S = chebyshev_picard_matrix(n, degree);
    for (int k = 0; k < n; ++k) {
      const int kept = degree, order = k;
      const Eigen::VectorXd T = sample(tau, [order](const Real& x) { return chebyshev(order, x); });
      const Eigen::VectorXd exact =
          sample(tau, [=](const Real& x) { return order <= kept ? chebyshev_integral(order, x) : Real(0); });
      // Entries are within 1e-15, and so are products with numbers up to 1, times the root of their number.
      EXPECT_LE((S * T - exact).cwiseAbs().maxCoeff(), 1e-15 * std::sqrt(n))
          << n << ' ' << degree << ' ' << k;
    }
  }
}

TEST(ChebyshevPicard, WithoutTruncationIntegratesThePolynomial) {
  for (const int n : {2, 3, 7, 8, 35, 100, 200}) {
    const Eigen::VectorXd tau = chebyshev_gauss_lobatto(n);
    const double difference =
        (chebyshev_picard_matrix(n, n - 1) - integration_matrix(tau)).cwiseAbs().maxCoeff();
    EXPECT_LE(difference, 2e-15) << n;  // 1e-15 for either
  }
}

TEST(Integration, RefusesWhatItCannotDo) {
  EXPECT_EQ(refusal([] { (void)integration_matrix<double>(Eigen::Vector2d(-1.5, 1)); }),
            "integration_matrix: node number 0, -1.5, is below -1");
  EXPECT_EQ(refusal([] { (void)integration_matrix<double>(Eigen::Vector2d(0, 2)); }),
            "integration_matrix: node number 1, 2, is above 1");
  EXPECT_EQ(refusal([] { (void)chebyshev_picard_matrix(9, 9); }),
            "chebyshev_picard_matrix: the degree must lie between 0 and 8 for 9 nodes, is 9");
  EXPECT_NE(refusal([] { (void)chebyshev_picard_matrix(9, -1); }), "");
  EXPECT_NE(refusal([] { (void)chebyshev_picard_matrix(1, 0); }), "");
}

}  // namespace
}  // namespace nlmech::collocation::integration_test

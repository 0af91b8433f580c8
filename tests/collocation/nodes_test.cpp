/// Nodes, and interpolating polynomials: weights, differentiation, values between the nodes.
#include "nlmech/collocation/nodes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include "nlmech/collocation/barycentric.hpp"
#include "tests/collocation/real.hpp"

namespace nlmech::collocation::nodes_test {
namespace {

using namespace oracle;

const std::vector<int> counts = {2, 3, 5, 7, 16, 35, 64, 100, 200};

// A sign change between x - delta and x + delta proves that a zero is within delta of x. The brackets are
// disjoint and as many as the zeros, so each node has its own zero.
template <class T>
void expect_zeros(const Vector<T>& zeros, double delta, const std::function<Real(const Real&)>& f) {
  for (Eigen::Index j = 0; j < zeros.size(); ++j) {
    const Real below = Real(zeros[j]) - delta, above = Real(zeros[j]) + delta;
    EXPECT_TRUE(f(below) * f(above) < 0) << "node " << j << " of " << zeros.size();
    if (j > 0) {
      EXPECT_TRUE(below > Real(zeros[j - 1]) + delta) << "node " << j << " of " << zeros.size();
    }
  }
}

// 2e-16, as documented: one unit in the last place of numbers between 1/2 and 1.
TEST(Nodes, AreTheZerosToTheLastDigit) {
  for (const int n : counts) {
    expect_zeros<double>(legendre_gauss(n), 2e-16, [n](const Real& x) { return legendre(n, x).value; });
    expect_zeros<double>(legendre_gauss_lobatto(n).segment(1, n - 2), 2e-16,
                         [n](const Real& x) { return legendre(n - 1, x).slope; });
    expect_zeros<double>(radau_right(n).head(n - 1), 2e-16, [n](const Real& x) {
      const oracle::Legendre p = legendre(n, x);
      return p.value - p.previous;
    });
  }
}

TEST(Nodes, HaveTheDigitsOfTheirType) {
  const int n = 35;
  expect_zeros<Real>(legendre_gauss_lobatto<Real>(n).segment(1, n - 2), 1e-49,
                     [](const Real& x) { return legendre(n - 1, x).slope; });
  expect_zeros<Real>(radau_right<Real>(n).head(n - 1), 1e-49, [](const Real& x) {
    const oracle::Legendre p = legendre(n, x);
    return p.value - p.previous;
  });
}

TEST(Nodes, OfChebyshevAreCosines) {
  for (const int n : counts) {
    const Eigen::VectorXd nodes = chebyshev_gauss_lobatto(n);
    for (int j = 0; j < n; ++j) {
      const Real exact = -cos(oracle::pi() * j / (n - 1));
      EXPECT_LE(oracle::to_double(abs(Real(nodes[j]) - exact)), 2e-16) << j << " of " << n;
    }
  }
}

// Hairer & Wanner II, Tables 5.5 and 5.7: Radau IIA and Lobatto IIIA, as 2 c - 1.
TEST(Nodes, AreThoseOfTheTextbooks) {
  const double r = std::sqrt(6.), l = std::sqrt(1 / 5.), m = std::sqrt(3 / 7.);
  EXPECT_LE((radau_right(2) - Eigen::Vector2d(-1 / 3., 1)).cwiseAbs().maxCoeff(), 2e-16);
  EXPECT_LE((radau_right(3) - Eigen::Vector3d((-1 - r) / 5, (-1 + r) / 5, 1)).cwiseAbs().maxCoeff(), 4e-16);
  EXPECT_LE((legendre_gauss_lobatto(4) - Eigen::Vector4d(-1, -l, l, 1)).cwiseAbs().maxCoeff(), 2e-16);
  EXPECT_LE((legendre_gauss_lobatto(5).segment(1, 3) - Eigen::Vector3d(-m, 0, m)).cwiseAbs().maxCoeff(),
            2e-16);
  EXPECT_EQ(legendre_gauss_lobatto(3), Eigen::Vector3d(-1, 0, 1));
  EXPECT_EQ(chebyshev_gauss_lobatto(3), Eigen::Vector3d(-1, 0, 1));
  EXPECT_EQ(radau_right(1)[0], 1);
  EXPECT_EQ(legendre_gauss(1)[0], 0);
}

TEST(Nodes, AscendFromEndToEndForEveryNumber) {
  for (const NodeFamily family : oracle::families) {
    for (int n = 2; n <= max_nodes; ++n) {
      const Eigen::VectorXd tau = nodes(family, n);
      ASSERT_EQ(tau.size(), n);
      EXPECT_EQ(tau[0], -1);
      EXPECT_EQ(tau[n - 1], 1);
      EXPECT_TRUE(std::adjacent_find(tau.begin(), tau.end(), std::greater_equal<>()) == tau.end())
          << to_string(family) << ' ' << n;
      if (family == NodeFamily::left_end_and_radau) {
        EXPECT_EQ(tau.tail(n - 1), radau_right(n - 1));
      } else {
        EXPECT_EQ(tau.reverse(), -tau) << to_string(family) << ' ' << n;
      }
    }
  }
}

TEST(Nodes, AreRefusedOutsideTheirRange) {
  EXPECT_EQ(refusal([] { (void)legendre_gauss_lobatto(1); }),
            "legendre_gauss_lobatto: the number of nodes must lie between 2 and 200, is 1");
  EXPECT_EQ(refusal([] { (void)radau_right(0); }),
            "radau_right: the number of nodes must lie between 1 and 200, is 0");
  EXPECT_EQ(refusal([] { (void)legendre_gauss(-1); }),
            "legendre_gauss: the number of nodes must lie between 1 and 200, is -1");
  EXPECT_EQ(refusal([] { (void)left_end_and_radau(1); }),
            "left_end_and_radau: the number of nodes must lie between 2 and 200, is 1");
  EXPECT_EQ(refusal([] { (void)chebyshev_gauss_lobatto(201); }),
            "chebyshev_gauss_lobatto: the number of nodes must lie between 2 and 200, is 201");
  EXPECT_NE(refusal([] { (void)nodes(static_cast<NodeFamily>(9), 5); }), "");
  EXPECT_NE(refusal([] { (void)to_string(static_cast<NodeFamily>(9)); }), "");
}

// Henrici: (-1)^j, and half of that at both ends.
TEST(BarycentricWeights, OfChebyshevNodesAreKnown) {
  for (const int n : {2, 3, 16, 35, 200}) {
    Eigen::VectorXd weights = barycentric_weights(chebyshev_gauss_lobatto(n));
    weights /= 2 * weights[n - 1];
    for (int j = 0; j < n; ++j) {
      const double exact = ((n - 1 - j) % 2 == 0 ? 1 : -1) * (j == 0 || j == n - 1 ? 0.5 : 1.);
      // 2 n units in the last place, also for the last weight; and errors of the nodes of 1e-16, at distances
      // of about 5/n^2 near the ends.
      EXPECT_NEAR(weights[j], exact, 4 * n * eps + n * n * 2e-16 / 5) << j << " of " << n;
    }
  }
}

// A product of n - 1 factors with three rounding errors each; the documented bound assumes that they do not
// all have the same sign.
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

// A sum of n products, each accurate to 2 n units in the last place.
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

// Recorded values of |D 1| of LGL nodes on an interval of length 1: rounding errors only, which depend on the
// order of a sum; a factor of 4.
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

// Inside, sum |r_k| < 5: the Lebesgue constants of these nodes grow as 2/pi log n. Times n eps for each
// entry, with 2 n rounding errors of different signs.
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

// Outside, each entry is a product of accurate factors and keeps its digits for any size.
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
}  // namespace nlmech::collocation::nodes_test

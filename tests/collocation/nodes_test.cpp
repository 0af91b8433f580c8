#include "nlmech/collocation/nodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "tests/collocation/real.hpp"

namespace nlmech::collocation::nodes_test {
namespace {

using oracle::legendre;
using oracle::Real;
using oracle::refusal;

const std::vector<int> counts = {2, 3, 5, 7, 16, 35, 64, 100, 200};

// A change of sign between x - delta and x + delta proves that a zero lies within delta of x. As the brackets
// do not overlap, and there are as many as zeros, each node is its own zero.
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

// 2e-16: as the headers promise, one unit in the last place of numbers between 1/2 and 1.
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

}  // namespace
}  // namespace nlmech::collocation::nodes_test

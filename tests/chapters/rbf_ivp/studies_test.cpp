/// What the chapter's studies compute of collocation, against formulas that share nothing with it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/stability/extended.hpp"
#include "chapters/rbf_ivp/stability/stiff_problems.hpp"
#include "tests/ivp/test_set.hpp"

namespace nlmech::chapters::rbf_ivp::studies_test {
namespace {

using collocation::NodeFamily;
using oracle::published_end_state;

// One unknown node at the end: backward Euler, R(z) = 1/(1 - z).
TEST(StabilityFunction, OfTwoNodes) {
  for (const NodeFamily family : {NodeFamily::legendre_gauss_lobatto, NodeFamily::left_end_and_radau}) {
    const auto derivative = polynomial_derivative(family, 2);
    const Digits50 z = Digits50(3) / 10;
    EXPECT_LT(abs(stability_function(derivative, z) - 1 / (1 - z)), Digits50(1e-48));
    EXPECT_NEAR(polynomial_amplification(unit_nodes(family, 2), 2), 1 / std::sqrt(5.0), 1e-15);
  }
}

// Radau IIA of two stages: R(z) = (1 + z/3)/(1 - 2z/3 + z^2/6) (Hairer & Wanner II, Table IV.5.6).
TEST(StabilityFunction, OfRadauWithTwoStages) {
  const auto derivative = polynomial_derivative(NodeFamily::left_end_and_radau, 3);
  for (const double x : {-40.0, -1.0, 0.25, 1.0}) {
    const Digits50 z = x, expected = (1 + z / 3) / (1 - 2 * z / 3 + z * z / 6);
    EXPECT_LT(abs(stability_function(derivative, z) - expected), Digits50(1e-46));
  }
}

// The matrix in double against the formula from the nodes alone with 50 digits.
TEST(StabilityFunction, OnTheImaginaryAxis) {
  for (const NodeFamily family : {NodeFamily::legendre_gauss_lobatto, NodeFamily::left_end_and_radau}) {
    for (const int nodes : {3, 7, 20, 35}) {
      const Eigen::MatrixXd derivative = polynomial_derivative(family, nodes).cast<double>();
      for (const double y : {0.1, 1.0, 8.5, 60.0, 190.0, 900.0}) {
        const double expected = polynomial_amplification(unit_nodes(family, nodes), y);
        // |D| is nodes^2 or so, and its rounding reaches R with the condition of D - iy
        EXPECT_NEAR(std::abs(stability_function(derivative, {0, y})), expected, 1e-12 * (1 + expected))
            << nodes << " nodes, y = " << y;
      }
    }
  }
}

// Without the left end LGL nodes have the quadrature order N - 1, Radau nodes 2 N - 3; collocation inherits
// it.
TEST(LinearOrder, OfPolynomials) {
  const Digits50 z = Digits50(1) / 100;
  for (int n = 3; n <= 8; ++n) {  // from 9 nodes on Radau's error, z^16, drowns in 50 digits
    EXPECT_NEAR(linear_order(polynomial_derivative(NodeFamily::legendre_gauss_lobatto, n), z), n - 1, 0.02);
    EXPECT_NEAR(linear_order(polynomial_derivative(NodeFamily::left_end_and_radau, n), z), 2 * n - 3, 0.02);
  }
}

// D of nodes that are symmetric about the middle is similar to -D, so that with an odd number of them one
// eigenvalue is 0; its vector is symmetric, and a state at rest stays. With an even number it does not.
TEST(Gaussians, KeepAStateAtRestIfTheNodesAreOdd) {
  const auto growth = [](int nodes) {
    const auto derivative = radial_derivative(NodeFamily::legendre_gauss_lobatto, nodes, (nodes - 1) / 4.0);
    return static_cast<double>(abs(stability_function(derivative, Digits50(0)) - 1));
  };
  for (const int nodes : {3, 5, 7, 15, 35}) EXPECT_LT(growth(nodes), 1e-35) << nodes;
  for (const int nodes : {4, 6, 8}) EXPECT_GT(growth(nodes), 1e-5) << nodes;
}

// Yet none of them reproduces constants at the nodes. oracle: rbf_ivp_shapes * slope of 1
TEST(Gaussians, DoNotReproduceConstants) {
  const auto defect = [](int nodes, double shape) {
    const auto derivative = radial_derivative(NodeFamily::legendre_gauss_lobatto, nodes, shape);
    return static_cast<double>(Digits50(derivative.rowwise().sum().cwiseAbs().maxCoeff()));
  };
  EXPECT_NEAR(defect(7, 0.367), 5.0e-8, 0.05e-8);
  EXPECT_NEAR(defect(35, 8.5), 6.6e-5, 0.05e-5);
}

TEST(Windows, OfSevenLobattoNodes) {
  const Eigen::MatrixXd derivative =
      polynomial_derivative(NodeFamily::legendre_gauss_lobatto, 7).cast<double>();
  const auto windows = windows_above(derivative, 100, 1.001, 20);
  ASSERT_EQ(windows.size(), 1U);
  EXPECT_NEAR(windows[0].begin, 5.4, 0.1);  // recorded: [5.4, 9.5], 1.33
  EXPECT_NEAR(windows[0].end, 9.5, 0.05);
  EXPECT_NEAR(windows[0].largest, 1.33, 0.005);
  const auto nodes = unit_nodes(NodeFamily::legendre_gauss_lobatto, 7);
  EXPECT_GE(windows[0].largest, polynomial_amplification(nodes, windows[0].place + 0.01));
  EXPECT_GE(windows[0].largest, polynomial_amplification(nodes, windows[0].place - 0.01));
}

TEST(Windows, RadauNodesHaveNone) {
  for (const int nodes : {3, 7, 20}) {
    const Eigen::MatrixXd derivative =
        polynomial_derivative(NodeFamily::left_end_and_radau, nodes).cast<double>();
    EXPECT_TRUE(windows_above(derivative, 200, 1 + 1e-12, 5).empty()) << nodes;
  }
}

TEST(StiffProblems, CountDigits) {
  const auto problems = stiff_problems(true);
  ASSERT_EQ(problems.size(), 6U);
  const Stiff& duffing = problems[0];
  const Vector<double, 2> truth = duffing.truth.cast<double>();
  EXPECT_GT(duffing.digits(truth), 15.5);
  const double size = truth.cwiseAbs().maxCoeff();
  EXPECT_NEAR(duffing.digits(truth + Vector<double, 2>(1e-5 * size, 0)), 5, 1e-6);
  EXPECT_EQ(duffing.digits(3 * truth), 0);
  EXPECT_EQ(duffing.digits(Vector<double, 2>(NAN, 0)), 0);
}

TEST(StiffProblems, EndWhereTheTestSetSays) {
  const auto expect = [](const auto& problem, std::vector<double> exact) {
    ASSERT_EQ(problem.truth.size(), static_cast<Eigen::Index>(exact.size()));
    for (Eigen::Index i = 0; i < problem.truth.size(); ++i)
      EXPECT_DOUBLE_EQ(static_cast<double>(problem.truth[i]), exact[static_cast<std::size_t>(i)])
          << problem.name;
  };
  expect(robertson(), published_end_state("Robertson"));
  expect(hires(), published_end_state("HIRES"));
  auto creep = published_end_state("van der Pol");
  ASSERT_EQ(creep.size(), 2U);
  creep[1] /= 1000;  // the test set's time is t/mu
  expect(van_der_pol_of_the_test_set(), creep);
}

}  // namespace
}  // namespace nlmech::chapters::rbf_ivp::studies_test

/// Typed boundary conditions: their derivatives.
#include "chapters/rbf_inverse/commands/typed_boundary.hpp"

#include <gtest/gtest.h>

namespace nlmech::typed_boundary_test {
namespace {

// Derivatives of equations and conditions against central differences: h^2 f'''/6 and rounding of f over h.
TEST(TypedBoundary, DerivativesAreSlopes) {
  const chapters::rbf_inverse::TypedBoundary problem(
      program::Equations({"--equation", "x'' + sin(x) y = t; y' = x y^2; z' = exp(x') z; u'' = u^3 x"}), 0, 2,
      "x = y^2, z x' = 1, u = 0", "sin(x) = z, u' + u^3 = y, t x = 3");
  const int n = problem.states();
  ASSERT_EQ(n, 6);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, 0.3, 1.4), none;
  Eigen::MatrixXd by_state(n, n), ends(n, 2), by_ends(n, 2 * n), nothing(n, 0);
  ends << x, 0.5 * x.reverse();
  problem.jacobian(0.7, x, none, by_state, nothing);
  problem.condition_jacobian(ends, none, by_ends, nothing);
  const double h = 1e-5;
  Eigen::VectorXd ahead(n), behind(n);
  for (int j = 0; j < n; ++j) {
    problem.rhs(0.7, x + h * Eigen::VectorXd::Unit(n, j), none, ahead);
    problem.rhs(0.7, x - h * Eigen::VectorXd::Unit(n, j), none, behind);
    EXPECT_LT((by_state.col(j) - (ahead - behind) / (2 * h)).norm(), 1e-8) << j;
  }
  for (int j = 0; j < 2 * n; ++j) {
    Eigen::MatrixXd moved = ends;
    moved(j % n, j / n) += h;
    problem.conditions(moved, none, ahead);
    moved(j % n, j / n) -= 2 * h;
    problem.conditions(moved, none, behind);
    EXPECT_LT((by_ends.col(j) - (ahead - behind) / (2 * h)).norm(), 1e-8) << j;
  }
}

}  // namespace
}  // namespace nlmech::typed_boundary_test

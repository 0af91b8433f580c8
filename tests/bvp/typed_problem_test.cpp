/// Typed boundary value problems: reading, derivatives, solutions.
#include "nlmech/bvp/typed/typed_problem.hpp"

#include <gtest/gtest.h>

#include "nlmech/bvp/typed/typed_solve.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::bvp::typed_problem_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Checks all derivatives against central differences: h^2 f'''/6 and rounding of f over h.
void expect_derivatives(const TypedProblem& problem, const VectorXd& x, const VectorXd& p) {
  const int n = problem.states(), m = problem.parameters(), columns = 2 * problem.phases(),
            count = problem.condition_count();
  const double h = 1e-5;
  MatrixXd by_state(n, n), by_parameter(n, m), ends(n, columns), by_ends(count, n * columns),
      of_conditions(count, m);
  VectorXd ahead(n), behind(n), r(count), s(count);
  for (int k = 0; k < columns; ++k) ends.col(k) = (1 - 0.1 * k) * x;
  const double at = 0.3 * problem.points().front() + 0.7 * problem.points().back();
  problem.jacobian(at, x, p, by_state, by_parameter);
  problem.condition_jacobian(ends, p, by_ends, of_conditions);
  for (int j = 0; j < n; ++j) {
    problem.rhs(at, x + h * VectorXd::Unit(n, j), p, ahead);
    problem.rhs(at, x - h * VectorXd::Unit(n, j), p, behind);
    EXPECT_LT((by_state.col(j) - (ahead - behind) / (2 * h)).norm(), 1e-8) << j;
  }
  for (int j = 0; j < m; ++j) {
    const VectorXd q = p + h * VectorXd::Unit(m, j), o = p - h * VectorXd::Unit(m, j);
    problem.rhs(at, x, q, ahead);
    problem.rhs(at, x, o, behind);
    EXPECT_LT((by_parameter.col(j) - (ahead - behind) / (2 * h)).norm(), 1e-8) << j;
    problem.conditions(ends, q, r);
    problem.conditions(ends, o, s);
    EXPECT_LT((of_conditions.col(j) - (r - s) / (2 * h)).norm(), 1e-8) << j;
  }
  for (int j = 0; j < n * columns; ++j) {
    MatrixXd moved = ends;
    moved(j % n, j / n) += h;
    problem.conditions(moved, p, r);
    moved(j % n, j / n) -= 2 * h;
    problem.conditions(moved, p, s);
    EXPECT_LT((by_ends.col(j) - (r - s) / (2 * h)).norm(), 1e-8) << j;
  }
}

TEST(TypedProblem, DerivativesAreSlopes) {
  const TypedProblem two_ends = read_problem(
      {.name = "--equation",
       .equations = "x'' + sin(x) y = t; y' = x y^2; z' = exp(x') z; u'' = u^3 x",
       .conditions = "x(0) = y(0)^2, z(0) x'(0) = 1; u(0) = x(2); sin(x(2)) = z(2), u'(2) + u(2)^3 = "
                     "y(2), x''(2) = 3"});
  EXPECT_EQ(two_ends.states(), 6);
  EXPECT_EQ(two_ends.parameters(), 0);
  expect_derivatives(two_ends, VectorXd::LinSpaced(6, 0.3, 1.4), VectorXd());

  // Everything at once: an interior point, an integral, constants, an unknown end, a jump, a definition.
  const TypedProblem all = read_problem({.name = "--equation",
                                         .equations = "x'' + k x^2 = sin(t) + step(t - 0.4); r = t x^2 + k",
                                         .conditions = "x(0) = k^2 T; r(0.3) + x''(T) = 2; integral(x^2 r) "
                                                       "= T; r(T) x'(0) = 1",
                                         .unknowns = "k, T",
                                         .until = "T"},
                                        "T = 2");
  EXPECT_EQ(all.states(), 3);
  EXPECT_EQ(all.parameters(), 2);
  EXPECT_EQ(all.points(), (std::vector<double>{0, 0.3, 0.4, 2}));
  expect_derivatives(all, Eigen::Vector3d(0.8, 0.5, 0.2), Eigen::Vector2d(0.7, 2.3));
}

}  // namespace
}  // namespace nlmech::bvp::typed_problem_test

/// Typed boundary value problems: reading, derivatives, solutions.
#include "nlmech/bvp/typed/typed_problem.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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

std::string mistake_in(const ProblemText& text) {
  try {
    static_cast<void>(read_problem(text));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(TypedProblem, TellsConditionsFromEquations) {
  // x(1 - x) is a product, x(1) a value; r = x(2) is a definition with a product.
  const DividedText divided =
      divide("--equation", "x' = r x(1 - x); x(1) = 2\nr = a x(2); integral(x) = k; k = x(0)", {"k"});
  ASSERT_EQ(divided.conditions.size(), 3U);
  EXPECT_EQ(divided.conditions[0].text, "x(1) = 2");
  EXPECT_EQ(divided.conditions[1].text, "integral(x) = k");
  EXPECT_EQ(divided.conditions[2].text, "k = x(0)");
  EXPECT_EQ(divided.equations.find("r = a x(2)"), 26U);  // places stay those of the text
}

TEST(TypedProblem, PointsAtMistakes) {
  EXPECT_EQ(mistake_in({.name = "--equation", .equations = "x'' = 0; x(0) = 1; 2 x(1) = 3 y(1)"}),
            "--equation:1:1: y is not defined: it has neither a derivative (y') nor a definition (y = ...)\n"
            "  y\n  ^");
  EXPECT_EQ(
      mistake_in({.name = "--equation", .equations = "x'' = 0", .conditions = "x(0) = 1, 2 x(1) + (b = 3"})
          .substr(0, 19),
      "--conditions:1:13: ");
}

/// The solution at the first time.
VectorXd first_of(const ProblemText& text, const std::string& guess, Status& status) {
  TypedProblem problem = read_problem(text, guess);
  const Solution solution = solve_typed(problem, problem.guess(), 1e-9);
  status = solution.status;
  return status.ok() ? problem.components_at(solution, problem.points().front()) : VectorXd();
}

// x'' + k x = 0 with x(0) = x(1) = 0 has k = pi^2 for a normalisation of any size;
// the tolerance is 1e-9.
TEST(SolveTyped, EigenvaluesDoNotDependOnSizes) {
  const double pi2 = std::numbers::pi * std::numbers::pi;
  for (const double size : {1e-30, 1e-9, 1., 1e12}) {
    for (const double unit : {0.1, 1., 10.}) {
      Status status;
      const ProblemText text{.name = "--equation",
                             .equations = "x'' + k x = 0; x(0) = 0; x(u) = 0; x'(0) = s; s = 1; u = 1",
                             .settings = {{"s", size}, {"u", unit}},
                             .unknowns = "k"};
      const VectorXd x = first_of(text, "x = s sin(3 t/u), k = 8/u^2", status);
      ASSERT_TRUE(status.ok()) << size << " " << unit << " " << status.text();
      EXPECT_NEAR(x[1] * unit * unit, pi2, 1e-8);
    }
  }
}

TEST(SolveTyped, NamesWhatNothingDetermines) {
  Status status;
  const ProblemText rest{.name = "--equation",
                         .equations = "x'' - 5 (1 - x^2) x' + x = 0; x(0) = x(T); x'(0) = x'(T); x'(0) = 0",
                         .unknowns = "T",
                         .until = "T"};
  first_of(rest, "x = 0.1 cos(t), T = 9", status);
  EXPECT_EQ(status.outcome(), Outcome::singular_matrix);
  EXPECT_NE(status.sentence().find("nothing determines T"), std::string::npos) << status.text();
  // A family of solutions, x = c cos(t), of which Newton's iteration finds one: the matrix there is singular.
  const ProblemText family{
      .name = "--equation",
      .equations = "x'' + x + (x^2 + x'^2 - c)^2 = 0; x(0) = x(2 pi); x'(0) = x'(2 pi); c = x(0)^2 + x'(0)^2",
      .unknowns = "c"};
  first_of(family, "x = cos(t), c = 1", status);
  EXPECT_EQ(status.outcome(), Outcome::singular_matrix) << status.text();
}

// Gauss points do not contain the ends: sin(t)/t solves x'' + 2 x'/t + x = 0.
TEST(SolveTyped, SingularEnds) {
  TypedProblem sphere =
      read_problem({.name = "--equation", .equations = "x'' + 2 x'/t + x = 0; x'(0) = 0; x(2) = sin(2)/2"});
  EXPECT_TRUE(sphere.is_singular_at_ends());
  Solution solution = solve_typed(sphere, sphere.guess(), 1e-9);
  ASSERT_TRUE(solution.status.ok()) << solution.status.text();
  for (const double t : {0.1, 0.7, 1.9}) EXPECT_NEAR(solution.at(t)[0], std::sin(t) / t, 1e-9) << t;
}

// Regular solutions have x'(0) = 0.
TEST(SolveTyped, RefusesSingularSolutions) {
  for (const char* conditions : {"x'(0) = 1; x(2) = 1", "x(0) = 1; x(1) = 0", "x'(0) = 1e-4; x(2) = 1"}) {
    Status status;
    first_of({.name = "--equation", .equations = "x'' + 2 x'/t + x = 0", .conditions = conditions}, "",
             status);
    EXPECT_FALSE(status.ok()) << conditions;
  }
}

// Troesch's problem; x'(0) by Jacobi's elliptic functions (mpmath). Bratu's branch turns back at 3.5138307.
TEST(FollowParameter, ReachesTheEndOrTheFold) {
  const auto troesch = [](double n) {
    return read_problem(
        {.name = "--equation", .equations = "x'' = n sinh(n x); x(0) = 0; x(1) = 1", .settings = {{"n", n}}});
  };
  TypedProblem easy = troesch(1);
  Continuation found = follow_parameter(troesch, 1, 10, solve_typed(easy, easy.guess(), 1e-9), 1e-9);
  ASSERT_TRUE(found.solution.status.ok()) << found.solution.status.text();
  EXPECT_NEAR(found.solution.first()[1], 3.583377846308e-4, 148e-9);  // the tolerance times the largest x'
  const auto bratu = [](double a) {
    return read_problem({.name = "--equation",
                         .equations = "x'' + a exp(x) = 0; x(0) = 0; x(1) = 0",
                         .settings = {{"a", a}}});
  };
  TypedProblem low = bratu(1);
  found = follow_parameter(bratu, 1, 4, solve_typed(low, low.guess(), 1e-9), 1e-9);
  EXPECT_FALSE(found.solution.status.ok());
  EXPECT_NEAR(found.reached, 3.5138307, 0.01);
  EXPECT_LE(found.reached, 3.5138308);
}

}  // namespace
}  // namespace nlmech::bvp::typed_problem_test

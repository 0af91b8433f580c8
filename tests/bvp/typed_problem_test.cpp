/// Typed boundary value problems: reading, derivatives, solutions.
#include "nlmech/bvp/typed/typed_problem.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "nlmech/bvp/typed/follow_parameter.hpp"
#include "nlmech/bvp/typed/typed_solve.hpp"
#include "nlmech/support/errors.hpp"
#include "tests/bvp/problems.hpp"

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
  for (const double t : {0.1, 0.7, 1.9})
    EXPECT_NEAR(sphere.components_at(solution, t)[0], std::sin(t) / t, 1e-9) << t;
}

// Bessel's function of order 2 begins with t^2, where rounding in x counts as x/t^2.
TEST(SolveTyped, SingularEndOfAFunctionThatBeginsWithASquare) {
  for (const char* equation : {"t^2 x'' + t x' + (t^2 - 4) x = 0", "x'' = -x'/t + (4/t^2 - 1) x"}) {
    TypedProblem bessel =
        read_problem({.name = "--equation", .equations = equation, .conditions = "x(0) = 0; x(3) = 1"});
    const Solution solution = solve_typed(bessel, bessel.guess(), 1e-9);
    ASSERT_TRUE(solution.status.ok()) << solution.status.text();
    for (const double t : {0.1, 0.7, 2.9})
      EXPECT_NEAR(bessel.components_at(solution, t)[0], std::cyl_bessel_j(2, t) / std::cyl_bessel_j(2, 3),
                  1e-9)
          << t;
  }
}

// Legendre's equation: regular at both ends for k = l (l + 1).
TEST(SolveTyped, SingularAtBothEnds) {
  const ProblemText legendre{
      .name = "--equation",
      .equations = "(1 - t^2) x'' = 2 t x' - k x; x(1) = 1; 2 x'(1) = k x(1); 2 x'(-1) = -k x(-1)",
      .unknowns = "k"};
  TypedProblem problem = read_problem(legendre, "x = 1.4 t^2 - 0.4, k = 5.5");
  const Solution solution = solve_typed(problem, problem.guess(), 1e-9);
  ASSERT_TRUE(solution.status.ok()) << solution.status.text();
  EXPECT_NEAR(solution.parameters()[0], 6, 1e-9);
  for (const double t : {-0.9, 0., 0.4})
    EXPECT_NEAR(problem.components_at(solution, t)[0], 1.5 * t * t - 0.5, 1e-9) << t;
}

// Ends at which solutions are series in sqrt(t): x'' = 3/(4 sqrt(t)) has t^1.5 and, mapped, a polynomial.
// Thomas and Fermi's atom: x'(0) = -1.588071022611375312718684508 (Boyd 2013).
TEST(SolveTyped, HalfPowersAtAnEnd) {
  TypedProblem power =
      read_problem({.name = "--equation", .equations = "x'' = 0.75/sqrt(t); x(0) = 0; x(1) = 1"});
  const Solution half = solve_typed(power, power.guess(), 1e-9);
  ASSERT_TRUE(half.status.ok()) << half.status.text();
  for (const double t : {0.01, 0.5})
    EXPECT_NEAR(power.components_at(half, t)[0], std::pow(t, 1.5), 1e-12) << t;
  TypedProblem atom = read_problem({.name = "--equation",
                                    .equations = "x'' = max(x, 0)^1.5/sqrt(t)",
                                    .conditions = "x(0) = 1; x(inf) = 0",
                                    .until = "inf"});
  const Solution solution = solve_typed(atom, atom.guess(), 1e-9);
  ASSERT_TRUE(solution.status.ok()) << solution.status.text();
  EXPECT_NEAR(solution.first()[1], -1.5880710226113753, 1e-8);
}

// Sizes of 1 and 1e6 that are coupled: x = cos(t), y = 1e6 sin(t).
TEST(SolveTyped, StatesOfDifferentSizes) {
  for (const double size : {1., 1e6, 1e12}) {
    TypedProblem problem = read_problem({.name = "--equation",
                                         .equations = "x' = -y/s; y' = s x; x(0) = 1; y(1) = s sin(1); s = 1",
                                         .settings = {{"s", size}}});
    const Solution solution = solve_typed(problem, problem.guess(), 1e-11);
    ASSERT_TRUE(solution.status.ok()) << size << " " << solution.status.text();
    EXPECT_NEAR(solution.at(0.5)[0], std::cos(0.5), 1e-13);
    EXPECT_NEAR(solution.at(0.5)[1] / size, std::sin(0.5), 1e-13);
  }
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

/// The solution of @p text at the first value of @p range, followed.
Continuation followed(ProblemText text, const ParameterRange& range, const std::string& guess = "") {
  text.settings = {{range.name, range.from}};
  TypedProblem first = read_problem(text, guess);
  const Solution solution = solve_typed(first, first.guess(), 1e-9);
  EXPECT_TRUE(solution.status.ok()) << solution.status.text();
  return follow_parameter(text, "", range, solution, 1e-9);
}

// Troesch's problem; x'(0) by Jacobi's elliptic functions (mpmath).
TEST(FollowParameter, ReachesTheEnd) {
  const Continuation found =
      followed({.name = "--equation", .equations = "x'' = n sinh(n x); x(0) = 0; x(1) = 1"},
               {.name = "n", .from = 1, .to = 10});
  ASSERT_TRUE(found.status.ok()) << found.status.text();
  ASSERT_EQ(found.solutions.size(), 1U);
  EXPECT_NEAR(found.solutions[0].first()[1], 3.583377846308e-4, 148e-9);  // tolerance times the largest x'
}

// Bratu's branch turns back where theta tanh(theta/4)/4 = 1, at mu = theta^2/(2 cosh^2(theta/4)). Beyond it
// there is no solution; below it there are two, in closed form. Errors: the tolerance times the condition,
// 1/(1 - mu/fold) at most.
TEST(FollowParameter, PassesTheFoldOfBratu) {
  const ProblemText bratu{.name = "--equation", .equations = "x'' + a exp(x) = 0; a = 2; x(0) = 0; x(1) = 0"};
  const double theta = 4.79871456103, fold = std::pow(theta / std::cosh(theta / 4), 2) / 2;
  const Continuation beyond = followed(bratu, {.name = "a", .from = 1, .to = 4});
  EXPECT_EQ(beyond.status.outcome(), Outcome::outside_validity) << beyond.status.text();
  ASSERT_EQ(beyond.folds.size(), 1U);
  EXPECT_NEAR(beyond.folds[0], fold, 1e-9);
  for (const double a : {1., 3.51}) {
    const Continuation both = followed(bratu, {.name = "a", .from = 0, .to = a, .all = true});
    ASSERT_EQ(both.solutions.size(), 2U) << both.status.text();
    for (const bool upper : {false, true})
      EXPECT_NEAR(both.solutions[upper ? 1 : 0].at(0.3)[0],
                  tests::bratu_exact(0.3, tests::bratu_theta(a, upper)), 1e-8 / (1 - a / fold));
  }
}

// x = c cos(t) with c^3 - 3 c = a: folds at a = 2 and -2; three roots 2 cos((acos(a/2) + 2 pi k)/3)
// between.
TEST(FollowParameter, PassesBothFoldsOfACubic) {
  const ProblemText cubic{
      .name = "--equation", .equations = "x'' = -x; a = 0; x'(0) = 0; x(0)^3 - 3 x(0) = a", .until = "1"};
  const Continuation all = followed(cubic, {.name = "a", .from = -4, .to = 1, .all = true}, "x = -2");
  ASSERT_EQ(all.solutions.size(), 3U) << all.status.text();
  ASSERT_EQ(all.folds.size(), 2U);
  EXPECT_NEAR(all.folds[0], 2, 1e-9);
  EXPECT_NEAR(all.folds[1], -2, 1e-9);
  for (const int k : {0, 1, 2})
    EXPECT_NEAR(all.solutions[static_cast<std::size_t>(k)].first()[0],
                2 * std::cos((std::numbers::pi / 3 + 2 * std::numbers::pi * (k + 1)) / 3), 1e-9);
}

// A parameter in the time of a condition has to be known: its branch by values ends at the fold, x(L)' = 0 of
// x'' = -exp(x).
TEST(FollowParameter, EndsWhereTheParameterHasToBeKnown) {
  const Continuation found =
      followed({.name = "--equation", .equations = "x'' + exp(x) = 0; x(0) = 0; x(b) = 0; b = 1"},
               {.name = "b", .from = 1, .to = 2});
  EXPECT_TRUE(found.solutions.empty());
  EXPECT_FALSE(found.status.ok());
  EXPECT_NEAR(found.reached, std::sqrt(3.513830719125161), 0.001);  // x'' + b^2 exp(x) = 0 on [0, 1]
}

// A state that is off by ten times the tolerance of the verification, at the end of any interval, is found:
// where nothing is stiff, where it is to one side, and in the layers of a saddle.
TEST(VerifyByIntegration, FindsAWrongState) {
  for (const char* equations : {"x'' = -x; x(0) = 0; x(1) = 1", "x' = -1e4 (x - cos(t)); x(0) = 1",
                                "x'' = 1e4 x; x(0) = 1; x(1) = 1"}) {
    TypedProblem problem = read_problem({.name = "--equation", .equations = equations, .until = "1"});
    const Options options{.verification = Verification::pieces, .verification_tolerance = 1e-5};
    const Solution right = solve_typed(problem, problem.guess(), 1e-7);
    ASSERT_TRUE(right.status.ok()) << equations << right.status.text();
    for (std::size_t k = 0; k + 1 < right.unknowns.intervals.size(); ++k) {
      Solution wrong = right;
      wrong.unknowns.intervals[k].values.rightCols(1)(0, 0) += 10 * options.verification_tolerance;
      verify_by_integration(problem, options, wrong);
      EXPECT_EQ(wrong.status.outcome(), Outcome::spurious_root) << equations << ", interval " << k;
    }
  }
}

}  // namespace
}  // namespace nlmech::bvp::typed_problem_test

/// `rbf_inverse bvp` as a user types it.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/commands/typed_boundary.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/process.hpp"
#include "tests/places.hpp"

namespace nlmech::own_work_bvp_test {
namespace {

using scene::Finished;
using Words = std::vector<std::string>;

Finished run(const Words& words) {
  Words all = {NLMECH_BINARY_DIR "/bin/rbf_inverse", "bvp"};
  all.insert(all.end(), words.begin(), words.end());
  return scene::run_program(all, {});
}

/// Rows of numbers; none if it failed.
std::vector<std::vector<double>> solved(const Words& words) {
  const Finished f = run(words);
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  std::vector<std::vector<double>> rows;
  if (f.exit_code != 0) return rows;
  const auto all = scene::parse_csv(f.output, "output");
  for (std::size_t i = 1; i < all.size(); ++i) {
    auto& row = rows.emplace_back(all[i].cells.size());
    for (std::size_t k = 0; k < row.size(); ++k) EXPECT_TRUE(scene::parse_number(all[i].cells[k], row[k]));
  }
  return rows;
}

void expect_refused(const Words& words, const std::string& named) {
  const Finished f = run(words);
  EXPECT_EQ(f.exit_code, 2) << named;
  EXPECT_NE(f.errors.find(named), std::string::npos) << f.errors;
  EXPECT_TRUE(f.output.empty()) << f.output;
}

// x = -2 log(cosh(c (t - 1/2)) / cosh(c/2)) with sqrt(2) c = cosh(c/2), which has two roots. Tolerance: 1e-9
// of the residual, times what a solution moves by a unit of it, some tens at the most.
TEST(BoundaryValues, BothSolutionsOfBratusProblem) {
  const auto root = [](double c) {
    for (int i = 0; i < 50; ++i)
      c -= (std::sqrt(2) * c - std::cosh(c / 2)) / (std::sqrt(2) - std::sinh(c / 2) / 2);
    return c;
  };
  const auto exact = [](double c, double t) {
    return -2 * std::log(std::cosh(c * (t - 0.5)) / std::cosh(c / 2));
  };
  const Words words = {"--equation", "x'' + exp(x) = 0", "--begin", "x = 0",   "--end",
                       "x=0",        "--until",          "1",       "--every", "0.25"};
  Words other = words;
  other.insert(other.end(), {"--guess", "x = 16 t*(1 - t)"});
  const auto low = solved(words), high = solved(other);
  ASSERT_EQ(low.size(), 5U);
  ASSERT_EQ(high.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(low[i][1], exact(root(0.7), low[i][0]), 1e-8);
    EXPECT_NEAR(high[i][1], exact(root(6), high[i][0]), 4e-8);
  }
}

// Eigenvalues (n pi)^2, and that of a column that is elastically held: tan(a) = -a for x + x' = 0 at the end.
TEST(BoundaryValues, AConstantThatIsNotKnown) {
  const Words words = {
      "--equation", "x'' + k x = 0; k' = 0", "--begin", "x = 0, x' = 1", "--until", "1", "--every", "1"};
  const auto eigenvalue = [&](const char* end, const char* guess) {
    Words all = words;
    all.insert(all.end(), {"--end", end, "--guess", guess});
    const auto rows = solved(all);
    return rows.size() == 2 ? rows[1][2] : NAN;
  };
  const double pi = std::numbers::pi;
  EXPECT_NEAR(eigenvalue("x = 0", "x = t*(1 - t), k = 8"), pi * pi, 1e-8);
  EXPECT_NEAR(eigenvalue("x = 0", "x = sin(6.3 t)/6.3, k = 38"), 4 * pi * pi, 4e-8);
  double a = 2;
  for (int i = 0; i < 50; ++i) a -= (std::sin(a) + a * std::cos(a)) / (2 * std::cos(a) - a * std::sin(a));
  EXPECT_NEAR(eigenvalue("x + x' = 0", "x = t, k = 4"), a * a, 1e-8);
}

// Layers of exp(-t/sqrt(e)) at both ends, through which nothing can be integrated: verified by pieces, which
// is said. Absolute errors, as the tolerance is.
TEST(BoundaryValues, BoundaryLayers) {
  const Words words = {"--equation", "e x'' = x; e = 1e-4", "--begin", "x=1", "--end", "x=2", "--until", "1"};
  const Finished f = run(words);
  EXPECT_NE(f.errors.find("integration of each"), std::string::npos) << f.errors;
  const auto rows = solved(words);
  ASSERT_GT(rows.size(), 20U);
  for (const auto& row : rows)
    EXPECT_NEAR(row[1], std::exp(-100 * row[0]) + 2 * std::exp(100 * (row[0] - 1)), 1e-8) << row[0];
}

// Neighbours part by exp(1000 t), so that the intervals on which the residual is small are still too long to
// be verified. The solution is k/(k + 1) sin(t) to its end.
TEST(BoundaryValues, IntervalsShortEnoughToBeVerified) {
  const auto rows = solved({"--equation", "x'' = k*(x - sin(t)); k = 1e6", "--begin", "x=0", "--end", "x=0",
                            "--until", "10", "--every", "1"});
  ASSERT_EQ(rows.size(), 11U);
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_NEAR(rows[i][1], 1e6 / (1e6 + 1) * std::sin(rows[i][0]), 1e-12) << i;
  EXPECT_EQ(rows[10][1], 0);
}

// x = p sin(q t + r) solves x'' = g x - (q^2 + g) x_p, which is well posed for g >= 0 with these conditions.
// The residual is 1e-9 of 1 + |x''|, and moves a solution by the square of the time over 8, or less.
RC_GTEST_PROP(BoundaryValues, LinearProblemsWithKnownSolutions, ()) {
  const auto between = [](double low, double high) {
    return low + (high - low) * *rc::gen::inRange(0, 1001) / 1000.;
  };
  const double p = between(0.1, 10), q = between(0.1, 20), r = between(-3, 3), g = between(0, 400),
               c = between(0, 2), until = between(0.1, 5);
  const auto x = [&](double t) { return p * std::sin(q * t + r); };
  const double slope = p * q * std::cos(r);
  const Finished f =
      run({"--equation", fmt::format("x'' = {} x - {} sin({} t + {})", g, (q * q + g) * p, q, r), "--begin",
           fmt::format("x - {} x' = {:.17g}", c, x(0) - c * slope), "--end",
           fmt::format("x = {:.17g}", x(until)), "--until", fmt::format("{}", until)});
  RC_ASSERT(f.exit_code == 0);
  const auto rows = scene::parse_csv(f.output, "output");
  const double allowed = 1e-9 * (1 + p * q * q) * (1 + until * until);
  for (std::size_t i = 1; i < rows.size(); ++i)
    RC_ASSERT(std::abs(std::stod(rows[i].cells[1]) - x(std::stod(rows[i].cells[0]))) <= allowed);
}

// Troesch's problem with the constant 5: x'(0) = 0.0457504614, x'(1) = 12.1004954 (Roberts and
// Shipman 1972, to the digits printed there).
TEST(BoundaryValues, TroeschsProblem) {
  const auto rows = solved({"--equation", "x'' = n sinh(n x); n = 5", "--begin", "x=0", "--end", "x=1",
                            "--until", "1", "--every", "1"});
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_NEAR(rows[0][2], 0.0457504614, 5e-11 + 1e-9);
  EXPECT_NEAR(rows[1][2], 12.1004954, 5e-8 + 1e-8);
}

// A fourth order, a condition on a derivative, a time that does not begin at 0: a beam under its own weight,
// clamped at 1 and free at 3, deflects by q l^4/8.
TEST(BoundaryValues, ABeam) {
  const auto rows = solved({"--equation", "w'''' = 3", "--begin", "w = 0, w' = 0", "--end",
                            "w'' = 0; w''' = 0", "--from", "1", "--until", "3", "--every", "2"});
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_NEAR(rows[1][1], 3 * 16. / 8, 1e-9);
}

// No solution: x'' + x = 0 from 0 to 1 over half a period. None that rounding can tell: oscillations without
// end.
TEST(BoundaryValues, WhereThereIsNoneItSaysSo) {
  for (const char* equation : {"x'' + pi^2 x = 0", "x'' + 4 exp(x) = 0"}) {
    const Finished f = run({"--equation", equation, "--begin", "x=0", "--end", "x=0.5", "--until", "1"});
    EXPECT_EQ(f.exit_code, 1) << equation;
    EXPECT_NE(f.errors.find("--guess"), std::string::npos) << f.errors;
    EXPECT_TRUE(f.output.empty());
  }
}

TEST(BoundaryValues, WrongWordsAreNamed) {
  const auto refused = [](const Words& more, const std::string& named) {
    Words words = {"--equation", "x'' = a x; a = 1", "--until", "1"};
    words.insert(words.end(), more.begin(), more.end());
    expect_refused(words, named);
  };
  refused({"--begin", "x=1"}, "1 conditions; as many are needed as the state has components, 2: x, x'");
  refused({"--begin", "x=1, q=2"}, "--begin:1:1: q is not defined");
  refused({"--begin", "x=1,,x'=2"}, "--begin x=1,,x'=2: nothing stands between two commas");
  refused({"--begin", "x=1", "--end", "x"}, "--end x: is no condition");
  refused({"--begin", "x=1", "--end", "x=0", "--guess", "y=1"}, "--guess y=1: begins with no component");
  refused({"--begin", "x=1", "--end", "x=0", "--guess", "x=x+1"}, "is to be a function of the time t alone");
  refused({"--begin", "x=1", "--end", "x=0", "--guess", "x=t,x=2"}, "x is given a second time");
  refused({"--begin", "x=1", "--end", "x=0", "--from", "1"}, "--until 1: must be later than --from 1");
  refused({"--begin", "x=1", "--end", "x=0", "--every", "1e-9"}, "--every 1e-09: more than a million rows");
  refused({"--begin", "x=1", "--end", "x=0", "--tolerance", "0"}, "--tolerance");
  refused({"--begin", "x=1", "--end", "x=0", "--set", "b=2"}, "b");
  expect_refused({"--equation", "x'' = x; x(0) = 1", "--until", "1", "--begin", "x=1", "--end", "x=0"},
                 "are given by --begin and --end here");
  for (const std::string more : {"; t <= 2", "; x >= 0", "; conserved x"})
    expect_refused({"--equation", "x'' = x" + more, "--until", "1", "--begin", "x=1", "--end", "x=0"},
                   "are for initial value problems");
  expect_refused({"--until", "1"}, "give one of --equation TEXT and --file NAME.ode");
}

// Derivatives of equations and conditions against central differences: h^2 f'''/6 and rounding of f over h.
TEST(BoundaryValues, DerivativesAreSlopes) {
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
}  // namespace nlmech::own_work_bvp_test

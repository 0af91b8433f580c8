// Requirements on every solver, by name.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <set>

#include "nlmech/algebraic/equations.hpp"
#include "nlmech/algebraic/named_solvers.hpp"
#include "tests/algebraic/classics.hpp"
#include "tests/thrown.hpp"

namespace nlmech::algebraic::solvers_test {
namespace {

using namespace classics;

using Names = std::set<std::string_view>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Solvers with a tolerance on the residual.
std::vector<std::string_view> residual_solvers() {
  std::vector<std::string_view> names = solver_names();
  std::erase_if(names, [](std::string_view name) {
    return Names{"energy-trust-region", "riks", "crisfield", "gdc"}.contains(name);
  });
  return names;
}

NamedSolver by(std::string_view name, double tolerance = 1e-10) {
  return {.name = std::string(name), .tolerance = tolerance, .iterations = 20'000};
}

class EverySolver : public testing::TestWithParam<std::string_view> {
 protected:
  [[nodiscard]] static std::string_view name() { return GetParam(); }
  [[nodiscard]] static bool is_one_of(const Names& names) { return names.contains(name()); }
};

std::string test_name(const testing::TestParamInfo<std::string_view>& info) {
  std::string text(info.param);
  std::replace(text.begin(), text.end(), '-', '_');
  return text;
}

INSTANTIATE_TEST_SUITE_P(Named, EverySolver, testing::ValuesIn(residual_solvers()), test_name);

// Expects a failure whose message names the method and |F|, with finite x and norms.
void expect_told(std::string_view name, const Report& report, const VectorXd& x) {
  EXPECT_FALSE(report.status.ok()) << name;
  EXPECT_TRUE(x.allFinite()) << name;
  const std::string& said = report.status.sentence();
  const bool has_name = said.find(name.substr(0, 6)) != std::string::npos;
  EXPECT_TRUE(has_name || said.find("homotopy") != std::string::npos) << said;
  EXPECT_TRUE(said.find("iteration") != std::string::npos || said.find("steps") != std::string::npos) << said;
  EXPECT_TRUE(tests::holds(said, "|F| = "));
}

RC_GTEST_PROP(Solvers, FindTheRootOfDefiniteLinearEquations, ()) {
  const auto n = *rc::gen::inRange<Eigen::Index>(1, 5);
  MatrixXd m(n, n);
  VectorXd root(n), start(n);
  const auto number = rc::gen::map(rc::gen::inRange(-100, 101), [](int k) { return k / 100.0; });
  for (double& v : m.reshaped()) v = *number;
  for (double& v : root) v = *number;
  for (double& v : start) v = *number;
  // Eigenvalues from 1 to 5: no method is slow, and |A^-1| is at most 1.
  const MatrixXd a = MatrixXd::Identity(n, n) + 4 * m * m.transpose() / (1 + m.squaredNorm());
  for (const std::string_view name : residual_solvers()) {
    DenseEquations equations = linear(a, root);
    VectorXd x = start;
    const Report report = find_root(by(name), equations, x);
    if (!report.status.ok()) RC_FAIL(report.status.text());
    RC_ASSERT((x - root).norm() <= 1.01e-10);
    RC_ASSERT(report.last <= 1e-10);
  }
}

TEST_P(EverySolver, FindsTheCircleOnTheHyperbola) {
  const double far = std::sqrt(2 + std::sqrt(3.0));
  const VectorXd root = vector({far, 1 / far});
  DenseEquations equations = circle();
  VectorXd x = vector({2, 1}), f(2);
  const Report report = find_root(by(name()), equations, x);
  ASSERT_TRUE(report.status.ok()) << report.status.text();
  EXPECT_LE((x - root).norm(), 1e-10);  // |B^-1| = 0.6 at the root, times the tolerance
  equations.residual(x, f);
  EXPECT_EQ(report.last, f.norm());
  EXPECT_EQ(report.first, std::hypot(1, 1));
  EXPECT_LE(report.least, report.last);
  EXPECT_GE(report.statistics.right_hand_sides, report.statistics.steps);
}

TEST_P(EverySolver, FindsRosenbrocksRoot) {
  DenseEquations equations = rosenbrock();
  VectorXd x = vector({-1.2, 1});
  const Report report = find_root(by(name()), equations, x);
  // fictitious-time fails because of an eigenvalue of the wrong sign; the path of chow-yorke goes to infinity
  // at t = 1/2, where x cancels in t (1 - x) + (1 - t)(x + 1.2).
  if (is_one_of({"fictitious-time", "chow-yorke"})) {
    expect_told(name(), report, x);
    return;
  }
  ASSERT_TRUE(report.status.ok()) << report.status.text();
  EXPECT_LE((x - vector({1, 1})).norm(), 3e-10);  // |B^-1| = 2.2, times the tolerance
}

TEST_P(EverySolver, FindsARootOfBrownsAlmostLinearSystem) {
  constexpr Eigen::Index n = 5;
  DenseEquations equations = brown_almost_linear(n);
  VectorXd x = VectorXd::Constant(n, 0.5);
  const Report report = find_root(by(name()), equations, x);
  ASSERT_TRUE(report.status.ok()) << report.status.text();
  // All components but the last are equal to a root of 5 a^5 - 6 a^4 + 1. At a = 1 its slope is 1; this and
  // |B^-1| give errors of a few tolerances. The errors of Newton's methods are far smaller.
  const double a = x[0];
  EXPECT_LE((x.head(n - 1).array() - a).abs().maxCoeff(), 1e-9);
  EXPECT_NEAR(x[n - 1], std::pow(a, 1.0 - n), 1e-8);
  EXPECT_NEAR(5 * std::pow(a, 5) - 6 * std::pow(a, 4) + 1, 0, 1e-8);
}

// At Powell's root B has rank 2 of 4: Newton's methods halve |x| in every step, other methods are slower.
TEST_P(EverySolver, EndsAtPowellsSingularRootOrSaysWhyNot) {
  DenseEquations equations = powell_singular();
  VectorXd x = vector({3, -1, 0, 1});
  const Report report = find_root(by(name(), 1e-8), equations, x);
  if (is_one_of({"newton", "damped-newton", "continuous-newton", "broyden", "least-squares",
                 "levenberg-marquardt", "dogleg"})) {
    ASSERT_TRUE(report.status.ok()) << report.status.text();
    EXPECT_LE(x.norm(), 1e-3);  // |F| decreases as |x|^2: the square root of 1e-8, times 10
  } else if (!report.status.ok()) {
    expect_told(name(), report, x);
  }
}

TEST_P(EverySolver, SaysThatThereIsNoRoot) {
  DenseEquations equations = scalar([](double x) { return 1 + x * x; }, [](double x) { return 2 * x; });
  VectorXd x = vector({1});
  NamedSolver method = by(name());
  method.iterations = 2000;
  const Report report = find_root(method, equations, x);
  expect_told(name(), report, x);
  EXPECT_GE(report.least, 1);
}

TEST_P(EverySolver, SaysThatAValueIsNotFinite) {
  DenseEquations bad = scalar([](double) { return nan; }, [](double) { return 1.0; });
  VectorXd x = vector({1});
  const Report report = find_root(by(name()), bad, x);
  EXPECT_EQ(report.status.outcome(), Outcome::non_finite) << report.status.text();
  EXPECT_EQ(x[0], 1);
  DenseEquations bad_slope = scalar([](double v) { return v; }, [](double) { return nan; });
  const Report steep = find_root(by(name()), bad_slope, x);
  if (name() == "fictitious-time") {
    EXPECT_TRUE(steep.status.ok());  // does not use the matrix
  } else if (is_one_of({"vector-homotopy", "chow-yorke"})) {
    EXPECT_FALSE(steep.status.ok());
  } else {
    EXPECT_EQ(steep.status.outcome(), Outcome::non_finite) << steep.status.text();
  }
}

// sqrt is undefined for negative arguments, which Newton's step from 1.5 reaches.
TEST_P(EverySolver, ShortensStepsToWhereTheFunctionExists) {
  DenseEquations equations = scalar([](double v) { return v < 0 ? nan : std::sqrt(v) - 0.1; },
                                    [](double v) { return 0.5 / std::sqrt(v); });
  VectorXd x = vector({1.5});
  const Report report = find_root(by(name()), equations, x);
  const Names search = {"damped-newton",     "broyden",           "steepest-descent", "levenberg-marquardt",
                        "optimal-iterative", "vector-homotopy",   "chow-yorke",       "dogleg",
                        "fictitious-time",   "continuous-newton", "fixed-point",      "newton-homotopy"};
  if (search.contains(name())) {
    ASSERT_TRUE(report.status.ok()) << report.status.text();
    EXPECT_NEAR(x[0], 0.01, 1e-10);  // tolerance over F' = 5
  } else if (!report.status.ok()) {
    EXPECT_EQ(report.status.outcome(), Outcome::non_finite) << report.status.text();
  }
}

// At this start B is singular and B^T F is not 0; roots (1, 2) and (-2, -1).
TEST_P(EverySolver, PassesASingularMatrixOrSaysSo) {
  DenseEquations equations(
      2, [](const VectorXd& x, VectorXd& f) { f << x[0] * x[0] + x[1] - 3, x[0] - x[1] + 1; },
      [](const VectorXd& x, MatrixXd& b) { b << 2 * x[0], 1, 1, -1; });
  VectorXd x = vector({-0.5, 3});
  const Report report = find_root(by(name()), equations, x);
  if (is_one_of({"newton", "damped-newton", "continuous-newton", "broyden"})) {
    EXPECT_EQ(report.status.outcome(), Outcome::singular_matrix) << report.status.text();
  } else if (!is_one_of({"fictitious-time", "vector-homotopy", "chow-yorke"})) {
    // Excluded: fictitious-time has an eigenvalue of the wrong sign; the paths of the other two start with
    // det dH/dx > 0 and go to infinity, because det B < 0 at the nearer root.
    ASSERT_TRUE(report.status.ok()) << report.status.text();
    EXPECT_LE(std::min((x - vector({1, 2})).norm(), (x - vector({-2, -1})).norm()),
              1.5e-10);  // |B^-1| = 1.03
  }
}

TEST_P(EverySolver, StopsWhenTheObserverSaysSo) {
  DenseEquations equations = circle();
  VectorXd x = vector({2, 1});
  std::int64_t seen = 0;
  const Report report = find_root(by(name()), equations, x, [&](const Iterate& i) {
    EXPECT_EQ(i.index, seen++);
    EXPECT_EQ(i.norm, i.f.norm());
    return i.index < 2;
  });
  EXPECT_EQ(report.status.outcome(), Outcome::interrupted) << report.status.text();
  EXPECT_EQ(seen, 3);
}

TEST_P(EverySolver, EndsAtItsLimit) {
  DenseEquations equations = circle();
  VectorXd x = vector({2, 1});
  NamedSolver method = by(name());
  method.iterations = 2;
  const Report report = find_root(method, equations, x);
  EXPECT_FALSE(report.status.ok());
  EXPECT_LE(report.statistics.steps + report.statistics.rejected, 2);
}

TEST_P(EverySolver, GoesTheSameWayWithASparseMatrix) {
  DenseEquations dense[] = {circle(), brown_almost_linear(5), broyden_tridiagonal(8)};
  const VectorXd starts[] = {vector({2, 1}), VectorXd::Constant(5, 0.5), VectorXd::Constant(8, -1)};
  for (int k = 0; k < 3; ++k) {
    Sparse sparse(dense[k]);
    VectorXd x = starts[k], y = starts[k];
    const Report first = find_root(by(name()), dense[k], x);
    const Report second = find_root(by(name()), sparse, y);
    ASSERT_TRUE(first.status.ok() && second.status.ok()) << first.status.text() << second.status.text();
    // Both roots are within the tolerance, with |B^-1| below 10; rounding differs with the order of pivots.
    EXPECT_LE((x - y).norm(), 2e-9);
    EXPECT_NEAR(static_cast<double>(first.statistics.steps), static_cast<double>(second.statistics.steps), 1);
  }
}

TEST_P(EverySolver, LeavesARootAlone) {
  DenseEquations equations = linear(MatrixXd::Identity(3, 3), vector({1, 2, 3}));
  VectorXd x = vector({1, 2, 3});
  const Report report = find_root(by(name()), equations, x);
  ASSERT_TRUE(report.status.ok());
  EXPECT_EQ(x, vector({1, 2, 3}));
  EXPECT_EQ(report.statistics.steps, 0);
  EXPECT_EQ(report.statistics.right_hand_sides, 1);
  EXPECT_EQ(report.statistics.jacobians, 0);
}

TEST_P(EverySolver, RefusesAnotherSize) {
  DenseEquations equations = circle();
  VectorXd x = vector({1, 2, 3});
  EXPECT_THROW((void)find_root(by(name()), equations, x), std::invalid_argument);
}

// 1e20 (x^2 - 2): near the root F is a multiple of 1e4, so no smaller tolerance can be met.
TEST(NamedSolver, NamesTheFloorOfRounding) {
  for (const std::string_view name : {"newton", "damped-newton", "dogleg", "levenberg-marquardt", "riks"}) {
    for (const bool to_rounding : {false, true}) {
      DenseEquations equations =
          scalar([](double x) { return 1e20 * (x * x - 2); }, [](double x) { return 2e20 * x; });
      VectorXd x = vector({1});
      NamedSolver method = by(name, 1e-10);
      method.scale = 1e7;
      method.to_rounding = to_rounding;
      const Report report = find_root(method, equations, x);
      EXPECT_NEAR(x[0], std::sqrt(2.), 1e-15) << name;
      if (to_rounding) {
        EXPECT_TRUE(report.status.ok()) << report.status.text();
        EXPECT_LE(report.last, report.bound);
        EXPECT_EQ(report.statistics.fallbacks, 1);
      } else {
        EXPECT_FALSE(report.status.ok()) << name;
        EXPECT_TRUE(tests::holds(report.status.sentence(), "rounding"));
      }
    }
  }
}

// An update of zero, or a square that underflows, is no convergence.
TEST(NamedSolver, AStandstillIsNoSuccess) {
  for (const std::string_view name : solver_names()) {
    if (name == "energy-trust-region") continue;
    DenseEquations still = scalar([](double) { return 1e-20; }, [](double) { return 1e308; });
    DenseEquations small = scalar([](double) { return 1e-170; }, [](double) { return 1.; });
    VectorXd x = vector({1});
    NamedSolver method = by(name, 1e-30);
    method.iterations = 50;
    EXPECT_FALSE(find_root(method, still, x).status.ok()) << name;
    method.tolerance = 1e-200;
    x[0] = 1;
    EXPECT_FALSE(find_root(method, small, x).status.ok()) << name;
  }
}

TEST(NamedSolver, MeasuresByItsScale) {
  for (const std::string_view name : {"dogleg", "newton", "fixed-point"}) {
    DenseEquations equations = circle();
    VectorXd x = vector({2, 1});
    NamedSolver method = by(name, 1e-3);
    method.scale = 1e-4;
    EXPECT_LE(find_root(method, equations, x).last, 1e-7);
  }
}

/// V = x^4/4 + x^2/2 - 3 x, whose minimum is the root of x^3 + x - 3.
struct Well : Potential {
  double slope = 0;
  [[nodiscard]] Eigen::Index size() const override { return 1; }
  void residual(const VectorXd& x, VectorXd& f) override { f[0] = (x[0] * x[0] + 1) * x[0] - 3; }
  void linearise(const VectorXd& x) override { slope = 3 * x[0] * x[0] + 1; }
  void apply(const VectorXd& v, VectorXd& out) const override { out = slope * v; }
  void apply_transposed(const VectorXd& v, VectorXd& out) const override { out = slope * v; }
  void matrix(MatrixXd& b) const override { b.setConstant(1, 1, slope); }
  [[nodiscard]] double energy(const VectorXd& x) override {
    return x[0] * x[0] * (x[0] * x[0] / 4 + 0.5) - 3 * x[0];
  }
};

TEST(NamedSolver, EnergyAndPathsAreThereByName) {
  const double root = 2 / std::sqrt(3.0) * std::sinh(std::asinh(4.5 * std::sqrt(3.0)) / 3);
  for (const std::string_view name : {"energy-trust-region", "riks", "crisfield", "gdc"}) {
    Well well;
    VectorXd x = vector({0});
    const Report report = find_root(by(name), well, x);
    ASSERT_TRUE(report.status.ok()) << report.status.text();
    EXPECT_NEAR(x[0], root, 1e-14);
  }
  DenseEquations equations = circle();
  VectorXd x = vector({2, 1});
  EXPECT_THROW((void)find_root(by("energy-trust-region"), equations, x), std::logic_error);
}

TEST(NamedSolver, UnknownNamesAndBadOptionsAreRefused) {
  DenseEquations equations = circle();
  VectorXd x = vector({2, 1});
  try {
    static_cast<void>(find_root(NamedSolver{.name = "newtom"}, equations, x));
    FAIL();
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    EXPECT_TRUE(tests::holds(text, "'newtom'"));
    for (const std::string_view name : solver_names()) {
      EXPECT_TRUE(tests::holds(text, name)) << name;
    }
  }
  const auto refused = [&](const NamedSolver& method) {
    EXPECT_THROW((void)find_root(method, equations, x), std::invalid_argument);
  };
  refused({.name = "newton", .tolerance = 0});
  refused({.name = "newton", .tolerance = nan});
  refused({.name = "newton", .scale = 0});
  refused({.name = "newton", .iterations = 0});
}

}  // namespace
}  // namespace nlmech::algebraic::solvers_test

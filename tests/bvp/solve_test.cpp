#include "nlmech/bvp/solve.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/bvp/problems.hpp"

namespace nlmech::bvp::solve_test {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;
using tests::Bratu;

Start zeros(int n) { return constant_start(VectorXd::Zero(n)); }

/// max |x1 - exact| at many times that are not nodes.
double error_of(const Solution& s, double theta) {
  double worst = 0;
  for (int i = 0; i <= 50; ++i) {
    const double t = i / 50.0;
    worst = std::max(worst, std::abs(s.at(t)[0] - tests::bratu_exact(t, theta)));
  }
  return worst;
}

TEST(Solve, FindsBratusLowerAndUpperSolution) {
  const double mu = 2;
  const DualProblem problem(Bratu{mu});
  const Solution lower = solve(problem, zeros(2));
  ASSERT_TRUE(lower.status.ok()) << lower.status.text();
  // The residual is bounded by 1e-9; the solution operator of this problem amplifies it by less than 10.
  EXPECT_LE(error_of(lower, tests::bratu_theta(mu, false)), 1e-8);
  EXPECT_LE(lower.residual, 1e-9);
  EXPECT_LE(lower.integration_error,
            1e-12);  // ends of intervals are superconvergent; the integration is accurate to 1e-13
  const Start high{[](double t, VectorXd& x) { x << 12 * t * (1 - t), 12 - 24 * t; }};
  const Solution upper = solve(problem, high);
  ASSERT_TRUE(upper.status.ok()) << upper.status.text();
  EXPECT_LE(error_of(upper, tests::bratu_theta(mu, true)), 1e-8);
}

TEST(Solve, OnOneIntervalAndOnMany) {
  const DualProblem problem(Bratu{1});
  const double theta = tests::bratu_theta(1, false);
  const Solution one = solve(problem, zeros(2), {.nodes = 16, .intervals = 1, .refine = false});
  ASSERT_TRUE(one.status.ok()) << one.status.text();
  EXPECT_LE(error_of(one, theta), 1e-11);
  const Solution many = solve(problem, zeros(2), {.nodes = 6, .intervals = 8, .refine = false});
  ASSERT_TRUE(many.status.ok()) << many.status.text();
  EXPECT_LE(error_of(many, theta), 1e-7);
}

/// log2 of the ratio of errors at the ends of intervals for h and h/2.
double observed_order(int nodes, int intervals) {
  const DualProblem problem(Bratu{3});
  const double theta = tests::bratu_theta(3, false);
  double errors[2] = {};
  for (int k = 0; k < 2; ++k) {
    const Options options{.nodes = nodes,
                          .intervals = intervals << k,
                          .refine = false,
                          .newton_tolerance = 1e-13,
                          .verification = Verification::none};
    const Solution s = solve(problem, zeros(2), options);
    for (const double t : s.mesh()) {
      errors[k] = std::max(errors[k], std::abs(s.at(t)[0] - tests::bratu_exact(t, theta)));
    }
  }
  return std::log2(errors[0] / errors[1]);
}

TEST(Solve, HasTheOrdersOfItsScheme) {
  // Errors of the finer mesh exceed 1e-11, so rounding does not matter; tolerance of half an order for the
  // next term.
  EXPECT_NEAR(observed_order(3, 4), 4, 0.5);  // 2N - 2
  EXPECT_NEAR(observed_order(4, 2), 6, 0.7);
}

/// x'' + w^2 x = 0 with the unknown w: x(0) = 0, x'(0) = 1, x(1) = 0: w = pi.
struct Eigenvalue {
  static constexpr int states = 2, parameters = 1;
  [[nodiscard]] std::vector<double> points() const { return {0, 1}; }
  template <class T>
  void rhs(const T& /*t*/, const Vector<T, 2>& x, const Vector<T, 1>& p, Vector<T, 2>& f) const {
    f[0] = x[1];
    f[1] = -(p[0] * p[0]) * x[0];
  }
  template <class T>
  void conditions(const Matrix<T, 2, Eigen::Dynamic>& ends, const Vector<T, 1>& /*p*/,
                  Vector<T, Eigen::Dynamic>& r) const {
    r[0] = ends(0, 0);
    r[1] = ends(1, 0) - 1.0;
    r[2] = ends(0, 1);
  }
};

TEST(Solve, FindsAnEigenvalueAsParameter) {
  Start start = constant_start(Vector2d(0.2, 0), VectorXd::Constant(1, 3));
  const Solution s = solve(DualProblem(Eigenvalue{}), start);
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_NEAR(s.parameters()[0], std::numbers::pi, 1e-12);  // superconvergent; Newton's last update 1e-10
}

/// x' = 2 t with x(0) = 1 and a jump of 5 at 1/3.
struct Jump {
  static constexpr int states = 1, parameters = 0;
  [[nodiscard]] std::vector<double> points() const { return {0, 1.0 / 3, 1}; }
  template <class T>
  void rhs(const T& t, const Vector<T, 1>& x, const Vector<T, 0>& /*p*/, Vector<T, 1>& f) const {
    f[0] = 2.0 * t + 0.0 * x[0];
  }
  template <class T>
  void conditions(const Matrix<T, 1, Eigen::Dynamic>& ends, const Vector<T, 0>& /*p*/,
                  Vector<T, Eigen::Dynamic>& r) const {
    r[0] = ends(0, 0) - 1.0;
    r[1] = ends(0, 2) - ends(0, 1) - 5.0;
  }
};

TEST(Solve, JumpsAtAnInteriorPoint) {
  const Solution s = solve(DualProblem(Jump{}), zeros(1));
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  const double t = 1.0 / 3;
  EXPECT_NEAR(s.at(t, Side::before)[0], 1 + t * t, 1e-14);
  EXPECT_NEAR(s.at(t, Side::after)[0], 6 + t * t, 2e-14);
  EXPECT_NEAR(s.last()[0], 7, 2e-14);
  EXPECT_EQ(s.node_times().size(), static_cast<std::size_t>(s.node_values().cols()));
}

/// x'' + x = 0 on [0, T] with x(0) = a and, as second condition, x(0) = b or x(T) = b.
struct Linear {
  static constexpr int states = 2, parameters = 0;
  double length = 1, a = 0, b = 1;
  bool both_at_begin = false;
  [[nodiscard]] std::vector<double> points() const { return {0, length}; }
  template <class T>
  void rhs(const T& /*t*/, const Vector<T, 2>& x, const Vector<T, 0>& /*p*/, Vector<T, 2>& f) const {
    f[0] = x[1];
    f[1] = -x[0];
  }
  template <class T>
  void conditions(const Matrix<T, 2, Eigen::Dynamic>& ends, const Vector<T, 0>& /*p*/,
                  Vector<T, Eigen::Dynamic>& r) const {
    r[0] = ends(0, 0) - a;
    r[1] = ends(0, both_at_begin ? 0 : 1) - b;
  }
};

TEST(Solve, TellsContradictoryFromRepeatedAndFromSingular) {
  const auto outcome = [](Linear problem) { return solve(DualProblem(problem), zeros(2)).status; };
  const Status contradictory = outcome({.a = 0, .b = 1, .both_at_begin = true});
  EXPECT_EQ(contradictory.outcome(), Outcome::infeasible) << contradictory.text();
  EXPECT_NE(contradictory.sentence().find("contradict"), std::string::npos);
  const Status repeated = outcome({.a = 1, .b = 1, .both_at_begin = true});
  EXPECT_EQ(repeated.outcome(), Outcome::singular_matrix) << repeated.text();
  // Half a period: x(pi) = -x(0) for any slope.
  const Status half = outcome({.length = std::numbers::pi, .a = 0, .b = 1});
  EXPECT_EQ(half.outcome(), Outcome::singular_matrix) << half.text();
  EXPECT_TRUE(outcome({.length = 3, .a = 0, .b = 1}).ok());
}

RC_GTEST_PROP(SolveLinear, MatchesTheClosedForm, ()) {
  const double a = *rc::gen::inRange(-50, 50) / 10.0, b = *rc::gen::inRange(-50, 50) / 10.0;
  const double length = *rc::gen::inRange(5, 300) / 100.0;
  const Solution s = solve(DualProblem(Linear{length, a, b, false}), zeros(2));
  RC_ASSERT(s.status.ok());
  const double slope = (b - a * std::cos(length)) / std::sin(length);
  // |1/sin| is at most 8 here; 1e-10 is the tolerance of the last update, quadratic before.
  RC_ASSERT(std::abs(s.first()[1] - slope) <= 1e-11 * (1 + std::abs(slope)));
}

TEST(Solve, RefusesASpuriousRoot) {
  // Bratu's upper solution at small mu has a peak that 4 nodes on one interval do not resolve.
  const DualProblem problem(Bratu{0.05});
  const Start high{[](double t, VectorXd& x) { x << 40 * t * (1 - t), 40 - 80 * t; }};
  const Solution s = solve(problem, high, {.nodes = 4, .intervals = 1, .refine = false});
  EXPECT_EQ(s.status.outcome(), Outcome::spurious_root) << s.status.text();
  EXPECT_GT(s.integration_error, 1e-2);
}

TEST(Solve, RefusesWhatCannotBeMeant) {
  const DualProblem problem(Bratu{});
  EXPECT_THROW((void)solve(problem, Start{}), std::invalid_argument);
  EXPECT_THROW((void)solve(problem, constant_start(Vector2d::Zero(), VectorXd::Zero(1))),
               std::invalid_argument);
  EXPECT_THROW((void)solve(problem, zeros(2), {.intervals = 0}), std::invalid_argument);
  EXPECT_THROW((void)solve(problem, zeros(2), {.nodes = 2}), std::invalid_argument);
  EXPECT_THROW((void)random_start(Vector2d::Ones(), 1, 1, 1), std::invalid_argument);
}

TEST(Solve, ReportsWhatIsNotFinite) {
  const Start bad = constant_start(Vector2d::Constant(1e4));  // exp(1e4) overflows
  EXPECT_EQ(solve(DualProblem(Bratu{}), bad).status.outcome(), Outcome::non_finite);
  // Beyond the fold at mu = 3.51 there is no solution.
  const Status none = solve(DualProblem(Bratu{6}), zeros(2)).status;
  EXPECT_TRUE(none.outcome() == Outcome::newton_diverged || none.outcome() == Outcome::not_converged)
      << none.text();
}

}  // namespace
}  // namespace nlmech::bvp::solve_test

/// Solvers of other libraries for F(x) = 0: roots, failures, options.
#include <gtest/gtest.h>

#include <limits>

#include "nlmech/peers/algebraic/gsl_hybrid.hpp"
#include "nlmech/peers/algebraic/kinsol.hpp"
#include "tests/algebraic/classics.hpp"

namespace nlmech::peers::peers_test {
namespace {

using namespace algebraic::classics;
using algebraic::DenseEquations;
using algebraic::Iterate;
using algebraic::Report;

/// Runs @p test with each solver, KINSOL with both strategies; one that the build lacks has to throw.
template <class Test>
void with_peers(const Test& test) {
  const auto run = [&](bool is_available, const auto& method) {
    if (is_available) return test(method);
    DenseEquations equations = circle();
    VectorXd x = vector({2, 1});
    EXPECT_THROW(static_cast<void>(find_root(method, equations, x)), std::logic_error);
  };
  run(kinsol_available(), Kinsol{.strategy = Kinsol::Strategy::none});
  run(kinsol_available(), Kinsol{});
  run(gsl_hybrid_available(), GslHybrid{});
}
/// Is the method KINSOL's?
template <class Method>
constexpr bool is_kinsol = std::is_same_v<Method, Kinsol>;

TEST(AlgebraicPeers, FindRootsDenseAndSparse) {
  with_peers([]<class Method>(const Method& method) {
    const double far = std::sqrt(2 + std::sqrt(3.0));
    DenseEquations dense = circle();
    algebraic::classics::Sparse sparse(dense);
    VectorXd x = vector({2, 1}), y = x;
    const Report report = find_root(method, dense, x);
    ASSERT_TRUE(report.status.ok()) << report.status.text();
    EXPECT_LE((x - vector({far, 1 / far})).norm(),
              1.5e-10);  // KINSOL: tolerance on the larger of two residuals; |B^-1| = 0.6
    EXPECT_EQ(report.first, std::hypot(1, 1));
    EXPECT_LE(report.last, is_kinsol<Method> ? 1.5e-10 : 1e-10);
    EXPECT_GT(report.statistics.right_hand_sides, report.statistics.jacobians);  // GSL: Broyden's updates
    if (is_kinsol<Method>) {
      EXPECT_EQ(report.statistics.steps, report.statistics.jacobians);  // exact Newton iteration
    }
    ASSERT_TRUE(find_root(method, sparse, y).status.ok());
    EXPECT_EQ(x, y);
  });
}

TEST(AlgebraicPeers, KinsolStartsFromZeroWithAFullStep) {
  with_peers([]<class Method>(const Method& method) {
    if (!is_kinsol<Method>) return;
    // KINSOL's own bound on a step is a multiple of |x(0)|.
    DenseEquations equations = linear(MatrixXd::Identity(2, 2), vector({1e6, -1e6}));
    VectorXd x = VectorXd::Zero(2);
    const Report report = find_root(method, equations, x);
    ASSERT_TRUE(report.status.ok()) << report.status.text();
    EXPECT_EQ(report.statistics.steps, 1);
  });
}

// More, Garbow and Hillstrom 1981, problem 2: a minimum of |F|^2 of 48.9842...
TEST(AlgebraicPeers, EndInAMinimumThatIsNoRoot) {
  with_peers([]<class Method>(const Method& method) {
    if constexpr (is_kinsol<Method>) {
      if (method.strategy == Kinsol::Strategy::none) return;  // takes steps that increase |F|
    }
    DenseEquations equations = freudenstein_roth();
    VectorXd x = vector({0.5, -2});
    const Report report = find_root(method, equations, x);
    EXPECT_EQ(report.status.outcome(), Outcome::not_converged);
    EXPECT_GE(report.last * report.last, 48.9842);
    EXPECT_NE(report.status.sentence().find(is_kinsol<Method> ? "kinsol" : "gsl-hybrid"), std::string::npos);
  });
}

TEST(AlgebraicPeers, FailuresBecomeStatus) {
  with_peers([]<class Method>(const Method& method) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    DenseEquations no_root = scalar([](double v) { return 1 + v * v; }, [](double v) { return 2 * v; });
    VectorXd x = vector({3});
    EXPECT_FALSE(find_root(method, no_root, x).status.ok());
    EXPECT_TRUE(x.allFinite());
    DenseEquations bad = scalar([=](double) { return nan; }, [](double) { return 1.0; });
    EXPECT_EQ(find_root(method, bad, x).status.outcome(), Outcome::non_finite);
    DenseEquations bad_slope = scalar([](double v) { return v - 1; }, [=](double) { return nan; });
    EXPECT_EQ(find_root(method, bad_slope, x).status.outcome(), Outcome::non_finite);
    DenseEquations equations = circle();
    x = vector({2, 1});
    Method few = method;
    few.iterations = 1;
    EXPECT_EQ(find_root(few, equations, x).status.outcome(), Outcome::step_limit);
    if constexpr (is_kinsol<Method>) {
      x = VectorXd::Zero(2);
      EXPECT_EQ(find_root(method, equations, x).status.outcome(), Outcome::singular_matrix);
      x = vector({2, 1});
      const auto stop = [](const Iterate& i) { return i.index < 2; };
      EXPECT_EQ(find_root(method, equations, x, stop).status.outcome(), Outcome::interrupted);
    }
  });
}

TEST(AlgebraicPeers, LetExceptionsPassAndCheckOptions) {
  with_peers([]<class Method>(const Method& method) {
    DenseEquations throwing(
        1, [](const VectorXd&, VectorXd&) { throw std::domain_error("thrown"); },
        [](const VectorXd&, MatrixXd&) {});
    VectorXd x = vector({1});
    EXPECT_THROW(static_cast<void>(find_root(method, throwing, x)), std::domain_error);
    DenseEquations equations = circle();
    EXPECT_THROW(static_cast<void>(find_root(method, equations, x)), std::invalid_argument);
    x = vector({2, 1});
    const auto expect_refused = [&](const Method& wrong) {
      EXPECT_THROW(static_cast<void>(find_root(wrong, equations, x)), std::invalid_argument);
    };
    expect_refused({.tolerance = 0});
    expect_refused({.iterations = 0});
    if constexpr (is_kinsol<Method>) expect_refused({.step_tolerance = -1});
  });
}

}  // namespace
}  // namespace nlmech::peers::peers_test

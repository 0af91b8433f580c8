/// Collocation studies of the chapter against independent formulas.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <boost/multiprecision/eigen.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/examples/cases.hpp"
#include "chapters/rbf_ivp/solvers/collocation_equations.hpp"
#include "chapters/rbf_ivp/stability/stiff_problems.hpp"
#include "chapters/rbf_ivp/stability/windows.hpp"
#include "nlmech/collocation/basis.hpp"
#include "nlmech/ivp/collocation/collocation.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/test_set.hpp"

namespace nlmech::chapters::rbf_ivp::studies_test {
namespace {

using collocation::Basis;
using collocation::NodeFamily;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using oracle::published_end_state;

constexpr auto lobatto = NodeFamily::legendre_gauss_lobatto, radau = NodeFamily::left_end_and_radau;
constexpr double eps = 2.2e-16;

MatrixXd derivative_of(NodeFamily family, int nodes) { return Basis::polynomial(family, nodes).derivative(); }

// One unknown node at the end: backward Euler, R(z) = 1/(1 - z).
TEST(StabilityFunction, OfTwoNodes) {
  for (const NodeFamily family : {lobatto, radau}) {
    EXPECT_NEAR(std::abs(stability_function(derivative_of(family, 2), 0.3) - 1 / 0.7), 0, 1e-15);
    EXPECT_NEAR(polynomial_amplification(family, 2, 2), 1 / std::sqrt(5.0), 1e-15);
  }
}

// Radau IIA of two stages: R(z) = (1 + z/3)/(1 - 2z/3 + z^2/6) (Hairer & Wanner II, Table IV.5.6).
TEST(StabilityFunction, OfRadauWithTwoStages) {
  for (const double z : {-40.0, -1.0, 0.25, 1.0}) {
    const double expected = (1 + z / 3) / (1 - 2 * z / 3 + z * z / 6);
    EXPECT_NEAR(std::abs(stability_function(derivative_of(radau, 3), z) - expected), 0, 1e-14) << z;
  }
}

// The matrix in double against the formula from the nodes alone with 50 digits.
TEST(StabilityFunction, OnTheImaginaryAxis) {
  for (const NodeFamily family : {lobatto, radau}) {
    for (const int nodes : {3, 7, 20, 35}) {
      const MatrixXd derivative = derivative_of(family, nodes);
      for (const double y : {0.1, 1.0, 8.5, 60.0, 190.0, 900.0}) {
        const double expected = polynomial_amplification(family, nodes, y);
        // |D| is nodes^2 or so, and its rounding reaches R with the condition of D - iy
        EXPECT_NEAR(std::abs(stability_function(derivative, {0, y})), expected, 1e-12 * (1 + expected))
            << nodes << " nodes, y = " << y;
      }
    }
  }
}

/// D of Gaussians on the unit interval in 50 digits.
collocation::Matrix<ExtendedReal<50>> gaussian_derivative(int nodes, double shape) {
  using Digits50 = ExtendedReal<50>;
  const collocation::Vector<Digits50> times = (collocation::nodes<Digits50>(lobatto, nodes).array() + 1) / 2;
  return collocation::RadialBasis<Digits50>(times, collocation::Kernel::gaussian, Digits50(shape))
      .differentiation_matrix();
}

// For nodes that are symmetric about the middle D is similar to -D, so for an odd number one eigenvalue is 0;
// its vector is symmetric, and a state at rest is preserved. For an even number it is not.
TEST(Gaussians, KeepAStateAtRestIfTheNodesAreOdd) {
  const auto growth = [](int nodes) {
    using Digits50 = ExtendedReal<50>;
    const auto d = gaussian_derivative(nodes, (nodes - 1) / 4.0);
    const Eigen::Index s = nodes - 1;
    const collocation::Matrix<Digits50> inner = d.bottomRightCorner(s, s);
    const collocation::Vector<Digits50> x =
        inner.partialPivLu().solve(collocation::Vector<Digits50>(-d.col(0).tail(s)));
    return static_cast<double>(Digits50(abs(Digits50(x[s - 1] - 1))));
  };
  for (const int nodes : {3, 5, 7, 15, 35}) EXPECT_LT(growth(nodes), 1e-35) << nodes;
  for (const int nodes : {4, 6, 8}) EXPECT_GT(growth(nodes), 1e-5) << nodes;
}

// None of them reproduces constants at the nodes. oracle: rbf_ivp_shapes * slope of 1
TEST(Gaussians, DoNotReproduceConstants) {
  const auto defect = [](int nodes, double shape) {
    const MatrixXd sums = gaussian_derivative(nodes, shape).rowwise().sum().cast<double>();
    return sums.cwiseAbs().maxCoeff();
  };
  EXPECT_NEAR(defect(7, 0.367), 5.0e-8, 0.05e-8);
  EXPECT_NEAR(defect(35, 8.5), 6.6e-5, 0.05e-5);
}

TEST(Windows, OfSevenLobattoNodes) {
  const auto windows = windows_above(derivative_of(lobatto, 7), 100, 1.001, 20);
  ASSERT_EQ(windows.size(), 1U);
  EXPECT_NEAR(windows[0].start, 5.4, 0.1);  // recorded: [5.4, 9.5], 1.33
  EXPECT_NEAR(windows[0].end, 9.5, 0.05);
  EXPECT_NEAR(windows[0].largest, 1.33, 0.005);
  EXPECT_GE(windows[0].largest, polynomial_amplification(lobatto, 7, windows[0].place + 0.01));
  EXPECT_GE(windows[0].largest, polynomial_amplification(lobatto, 7, windows[0].place - 0.01));
}

TEST(Windows, RadauNodesHaveNone) {
  for (const int nodes : {3, 7, 20})
    EXPECT_TRUE(windows_above(derivative_of(radau, nodes), 200, 1 + 1e-12, 5).empty()) << nodes;
}

// The first of three masses at a spring of k1 = 1e8 grows from 1e-9 by |R| a step: the cubic spring is
// negligible, and from step 20 on the other masses and the initial state have decayed.
TEST(Windows, AStiffSpringGrowsAsTheStabilityFunctionHasIt) {
  const problems::TextProblem chain("three-dof", {{"k1", 1e8}});
  const double frequency = std::sqrt((1e8 + chain.parameter("k2")) / chain.parameter("m1")), step = 1.2e-3;
  std::vector<double> amplitude;
  const ivp::Observer watch = [&](const ivp::Step& s) {
    amplitude.push_back(std::hypot(s.x1[0], s.x1[3] / frequency));
    return true;
  };
  const auto solution = ivp::integrate(ivp::System(chain), {1e-9, 0, 0, 0, 0, 0}, 0, 25 * step,
                                       ivp::PolynomialCollocation{.step = step, .nodes = 7}, watch);
  ASSERT_TRUE(solution.status.ok());
  const double expected = polynomial_amplification(lobatto, 7, frequency * step);
  EXPECT_GT(expected, 1.2);
  EXPECT_NEAR(std::pow(amplitude.at(24) / amplitude.at(19), 0.2), expected, 1e-3 * expected);
}

/// A state without special symmetry.
VectorXd wave(Eigen::Index size, double phase) {
  VectorXd v(size);
  for (Eigen::Index k = 0; k < size; ++k) v[k] = std::cos(2.3 * static_cast<double>(k) + phase);
  return v;
}

Interval interval_of(const Case& c, double t0, double h, int nodes) {
  const Basis basis = Basis::polynomial(radau, nodes);
  return {c.system, t0, h, c.x0, basis.nodes(), basis.derivative()};
}

TEST(CollocationEquations, HaveTheirDerivative) {
  for (const Case* c : {&free_duffing_case(), &impact_case(), &three_mass_case()}) {
    for (const Form form : {Form::printed, Form::integrated}) {
      algebraic::DenseEquations equations = collocation_equations(interval_of(*c, 0.3, 0.7, 6), form);
      const VectorXd x = wave(equations.size(), 0.1), v = wave(equations.size(), 1);
      VectorXd left(x.size()), right(x.size());
      MatrixXd b;
      equations.linearise(x);
      equations.matrix(b);
      // F is cubic: the symmetric difference has an error of d^2/6 F''' v v v, F''' <= 6 h or 6, and rounding
      // errors over d.
      const double d = 1e-5, noise = 100 * eps * b.norm() * v.norm();
      equations.residual(x + d * v, right);
      equations.residual(x - d * v, left);
      EXPECT_LE(((right - left) / (2 * d) - b * v).norm(), 10 * d * d * v.norm() + noise / d);
    }
  }
}

TEST(CollocationEquations, HaveTheRootOfTheIntegrator) {
  const Case& c = free_duffing_case();
  const double h = duffing_period() / 10;
  const auto solution = ivp::integrate(c.system, c.x0, 0.0, h,
                                       ivp::PolynomialCollocation{.step = h, .nodes = 7, .points = radau});
  ASSERT_TRUE(solution.status.ok());
  for (const Form form : {Form::printed, Form::integrated}) {
    const Interval interval = interval_of(c, 0, h, 7);
    algebraic::DenseEquations equations = collocation_equations(interval, form);
    VectorXd x = interval.start();
    ASSERT_TRUE(find_root(algebraic::Newton{}, equations, x).status.ok());
    EXPECT_LE((x.tail(2) - solution.x).norm(), 1e-12);  // two Newton iterations to 1e-13
  }
}

TEST(StiffProblems, CountDigits) {
  const auto problems = stiff_problems(true);
  ASSERT_EQ(problems.size(), 6U);
  const Stiff& duffing = problems[0];
  const Vector<double, 2> reference = duffing.reference.cast<double>();
  EXPECT_GT(duffing.digits(reference), 15.5);
  const double size = reference.cwiseAbs().maxCoeff();
  EXPECT_NEAR(duffing.digits(reference + Vector<double, 2>(1e-5 * size, 0)), 5, 1e-6);
  EXPECT_EQ(duffing.digits(3 * reference), 0);
  EXPECT_EQ(duffing.digits(Vector<double, 2>(NAN, 0)), 0);
}

TEST(StiffProblems, EndStatesAgreeWithTheTestSet) {
  const auto expect = [](const auto& problem, std::vector<double> exact) {
    ASSERT_EQ(problem.reference.size(), static_cast<Eigen::Index>(exact.size()));
    for (Eigen::Index i = 0; i < problem.reference.size(); ++i)
      EXPECT_DOUBLE_EQ(static_cast<double>(problem.reference[i]), exact[static_cast<std::size_t>(i)])
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

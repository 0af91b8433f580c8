/// Libraries called as in their manuals, for benchmarks: they reach the same end state of the same equations.
#include "nlmech/peers/ivp/native.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "chapters/plain_equations.hpp"
#include "nlmech/peers/ivp/odeint/odeint_direct.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/texts.hpp"

namespace nlmech::peers::native_test {
namespace {

/// Largest difference of two orders of summation: some eps of the terms, which are below 30.
template <class Problem, class Plain>
void expect_same(const Plain& plain, const Problem& problem) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> any(-3, 3);
  for (int i = 0; i < 1000; ++i) {
    const int n = static_cast<int>(problem.initial_state().size());
    Vector<double, Problem::dimension> x(n), expected(n), found(n);
    for (double& component : x) component = any(engine);
    const double t = any(engine);
    problem(t, x, expected);
    plain(x, found, t);
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-13 * (1 + expected.cwiseAbs().maxCoeff()));
  }
}

TEST(PlainEquations, AreThoseOfTheProblems) {
  expect_same(chapters::PlainDuffing{}, problems::TextProblem("duffing"));
  expect_same(chapters::PlainDuffing{.natural_frequency = 2, .hardening = 10},
              problems::TextProblem("duffing", {{"natural_frequency", 2}, {"hardening", 10}}));
  expect_same(chapters::PlainImpact{}, problems::TextProblem("impact"));
  expect_same(chapters::PlainLorenz{}, problems::TextProblem("lorenz"));
  expect_same(chapters::PlainChain{}, problems::TextProblem("three-dof"));
  const chapters::PlainChain chain{
      .c1 = 0.1, .c3 = 0.2, .c4 = 0.3, .k4 = 0.4, .l2 = 0.5, .l3 = 0.6, .l4 = 0.7};
  expect_same(
      chain,
      problems::TextProblem(
          "three-dof",
          {{"c1", 0.1}, {"c3", 0.2}, {"c4", 0.3}, {"k4", 0.4}, {"l2", 0.5}, {"l3", 0.6}, {"l4", 0.7}}));
  expect_same(chapters::PlainTwoBody{}, problems::TextProblem("two-body", {{"mu", 1}}));
}

int duffing(double t, const double* x, double* f, void* data) {
  (*static_cast<const chapters::PlainDuffing*>(data))(x, f, t);
  return 0;
}

int duffing_jacobian(double /*t*/, const double* x, double* dfdx, double* dfdt, void* /*data*/) {
  dfdx[0] = 0;
  dfdx[1] = 1;
  dfdx[2] = -1 - 3 * x[0] * x[0];
  dfdx[3] = 0;
  dfdt[0] = dfdt[1] = 0;
  return 0;
}

/// After a period the oscillator returns to its start. Ten digits are requested, seven expected, because the
/// errors of the steps add up.
constexpr double tolerance = 1e-10, expected = 1e-7;
double period() { return problems::Duffing{}.period(1.0); }

chapters::PlainDuffing plain;
const NativeEquations equations = {2, duffing, duffing_jacobian, &plain};

template <class Method, class Run>
void expect_back(const Method& method, const Run& run) {
  std::array<double, 2> x = {1, 0};
  ASSERT_TRUE(run(method, x)) << method.name();
  EXPECT_NEAR(x[0], 1, expected) << method.name();
  EXPECT_NEAR(x[1], 0, expected) << method.name();
}

TEST(Native, GslBringsTheOscillatorBack) {
  if (!gsl_available()) GTEST_SKIP() << "this build has no GSL";
  using enum Gsl::Formula;
  for (const Gsl::Formula formula : {rkf45, rk8pd, bsimp, msadams, msbdf})
    expect_back(Gsl{formula, tolerance, tolerance}, [](const Gsl& method, auto& x) {
      return gsl_natively(method, equations, 0, period(), x.data());
    });
}

TEST(Native, CvodeBringsTheOscillatorBack) {
  if (!cvode_available()) GTEST_SKIP() << "this build has no CVODE";
  for (const auto formula : {Cvode::Formula::adams, Cvode::Formula::bdf})
    expect_back(Cvode{formula, tolerance, tolerance}, [](const Cvode& method, auto& x) {
      return cvode_natively(method, equations, 0, period(), x.data());
    });
}

/// An unsymmetric matrix: with rows and columns exchanged Newton's iteration would not converge.
TEST(Native, CvodeGetsItsMatrixByColumns) {
  if (!cvode_available()) GTEST_SKIP() << "this build has no CVODE";
  const NativeEquations stiff = {2,
                                 [](double, const double* x, double* f, void*) {
                                   f[0] = -x[0];
                                   f[1] = 1e6 * (x[0] - x[1]);
                                   return 0;
                                 },
                                 [](double, const double*, double* dfdx, double*, void*) {
                                   dfdx[0] = -1, dfdx[1] = 0, dfdx[2] = 1e6, dfdx[3] = -1e6;
                                   return 0;
                                 },
                                 nullptr};
  std::array<double, 2> x = {1, 1};
  ASSERT_TRUE(cvode_natively({Cvode::Formula::bdf, 1e-8, 1e-8}, stiff, 0, 1, x.data()));
  EXPECT_NEAR(x[0], std::exp(-1), 1e-6);
  EXPECT_NEAR(x[1], std::exp(-1), 1e-5) << "it follows the first within 1e-6 of it";
}

constexpr Odeint::Formula explicit_formulas[] = {Odeint::Formula::dopri5, Odeint::Formula::fehlberg78,
                                                 Odeint::Formula::bulirsch_stoer};

TEST(Native, OdeintBringsTheOscillatorBack) {
  for (const auto formula : explicit_formulas)
    expect_back(Odeint{formula, tolerance, tolerance},
                [](const Odeint& method, auto& x) { return odeint_natively(method, plain, 0, period(), x); });
  std::array<double, 2> x = {1, 0};
  EXPECT_FALSE(odeint_natively({Odeint::Formula::rosenbrock4}, plain, 0, 1, x));
}

// ------------------------------------------------------------ the inlined Odeint equals the registered
// Odeint

OdeintDirect inlined(Odeint::Formula formula) {
  OdeintDirect method;
  method.formula = formula;
  return method;
}

TEST(OdeintDirect, TakesTheSameSteps) {
  const ivp::Direct direct(plain);
  const ivp::System system(plain);
  for (const auto formula : explicit_formulas) {
    const Odeint method{.formula = formula};
    for (const double end : {20.0, -20.0}) {
      const auto a = ivp::integrate(direct, {1, 0}, 0, end, inlined(formula));
      const auto b = ivp::integrate(system, {1, 0}, 0, end, method);
      ASSERT_TRUE(a.status.ok() && b.status.ok()) << method.name();
      EXPECT_EQ(a.statistics.steps, b.statistics.steps) << method.name();
      EXPECT_EQ(a.statistics.right_hand_sides, b.statistics.right_hand_sides) << method.name();
      // Compiled separately: rounding may differ, by at most a thousandth of the tolerance.
      EXPECT_LT((a.x - b.x).lpNorm<Eigen::Infinity>(), 1e-12) << method.name();
    }
  }
}

TEST(OdeintDirect, HasNoRosenbrockMethod) {
  const ivp::Direct direct(chapters::PlainDuffing{});
  EXPECT_THROW((void)ivp::integrate(direct, {1, 0}, 0, 1, inlined(Odeint::Formula::rosenbrock4)),
               std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::peers::native_test

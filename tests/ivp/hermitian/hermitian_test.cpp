// Integration by Hermitian operators: symmetry, closed form of one step, energy, degrees of freedom.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "nlmech/ivp/hermitian/hermitian.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/methods.hpp"

namespace nlmech::ivp::hermitian_test {
namespace {

using namespace testing;

// f, its derivative along the solution, and both Jacobians, against van der Pol's equation differentiated by
// hand: j = mu (1 - q^2) a - 2 mu q v^2 - v. Tolerance: rounding errors of a few terms.
RC_GTEST_PROP(SecondDerivative, IsThatOfVanDerPol, ()) {
  const double q = *rc::gen::inRange(-300, 300) / 100.0, v = *rc::gen::inRange(-300, 300) / 100.0, mu = 2.5;
  const System system(problems::TextProblem("van-der-pol", {{"mu", mu}}));
  State f(2), g(2), f2(2), g2(2);
  Jacobian fx, gx;
  RC_ASSERT(system.second_derivative(0, {q, v}, f, g));
  RC_ASSERT(system.second_derivative(0, {q, v}, f2, g2, fx, gx));
  const double s = 1 - q * q, a = mu * s * v - q;
  const double jerk = mu * s * a - 2 * mu * q * v * v - v;
  const double aq = -2 * mu * q * v - 1, av = mu * s;
  const double jq = -2 * mu * q * a + mu * s * aq - 2 * mu * v * v, jv = mu * s * av - 4 * mu * q * v - 1;
  const auto near = [](double x, double y) { return std::abs(x - y) <= 1e4 * eps; };  // terms up to some 1000
  RC_ASSERT(near(f[1], a) && near(g[1], jerk) && f[0] == v && near(g[0], a));
  RC_ASSERT(near(f2[1], a) && near(g2[1], jerk));
  RC_ASSERT(near(fx(1, 0), aq) && near(fx(1, 1), av) && fx(0, 0) == 0 && fx(0, 1) == 1);
  RC_ASSERT(near(gx(1, 0), jq) && near(gx(1, 1), jv) && near(gx(0, 0), aq) && near(gx(0, 1), av));
}

// The same with a load: j = -f w sin(w t) - c a - (k + 3 m q^2) v.
TEST(SecondDerivative, KnowsTheLoad) {
  const System system(problems::TextProblem(
      "driven-duffing",
      {{"damping", 0.4}, {"stiffness", 1}, {"hardening", 0.5}, {"force", 0.5}, {"frequency", 0.5}}));
  State f(2), g(2);
  ASSERT_TRUE(system.second_derivative(1.2, {0.7, -0.3}, f, g));
  const double a = 0.5 * std::cos(0.6) + 0.12 - 0.7 - 0.5 * 0.343;
  EXPECT_NEAR(f[1], a, 4 * eps);
  EXPECT_NEAR(g[1], -0.25 * std::sin(0.6) - 0.4 * a + (1 + 1.5 * 0.49) * 0.3, 8 * eps);
}

// Newmark's row in Laier's table is the method newmark: the same equations for other unknowns. Newton's
// tolerance of 1e-12 a step is met with quadratic convergence.
TEST(Hermitian, NewmarksRowIsNewmark) {
  const System system(problems::TextProblem("driven-duffing"));
  const auto hermitian =
      integrate(system, State{1, 0}, 0, 10, Hermitian{.operators = newmark_pair, .step = 0.05});
  const auto newmark = integrate(system, State{1, 0}, 0, 10, Newmark{.step = 0.05});
  EXPECT_NEAR(hermitian.x[0], newmark.x[0], 1e-11);
  EXPECT_NEAR(hermitian.x[1], newmark.x[1], 1e-11);
  for (const HermitianPair& pair : {hoff, bazzi})
    EXPECT_EQ(integrate(system, State{1, 0}, 0, 10, Hermitian{.operators = pair, .step = 0.05}).x,
              hermitian.x);
}

// One step of q'' = -w^2 q in closed form: M (q0, h v0) with the half trace and the determinant of
// amplification().
TEST(Hermitian, TurnsTheLinearOscillator) {
  for (const HermitianPair& pair : hermitian_table) {
    for (const double z : {0.3, 3.3, 20.0, 1e3, 1e6}) {
      const System system(Oscillator{z});
      const Hermitian method{.operators = pair, .step = 1};
      const State a = integrate(system, State{1, 0}, 0, 1, method).x;
      const State b = integrate(system, State{0, 1}, 0, 1, method).x;
      const auto expected = amplification(solved_for_end(pair), z);
      // Velocities are z times as large; their rounding errors enter the determinant.
      EXPECT_NEAR((a[0] + b[1]) / 2, expected.half_trace,
                  64 * eps * std::max(1.0, std::abs(expected.half_trace)))
          << pair.name << z;
      EXPECT_NEAR(a[0] * b[1] - a[1] * b[0], 1, 64 * eps * (1 + std::abs(a[0] * b[1]))) << pair.name << z;
    }
  }
}

// Forwards and backwards: a symmetric step is reversible up to rounding errors. All rows are symmetric:
// exchanging q0 and q1, h and -h gives the same equations. A fourth-order Runge-Kutta step of that size is
// not reversible.
TEST(Hermitian, StepsAreSymmetric) {
  const System system(problems::TextProblem("duffing"));
  const auto return_error = [&](const auto& method) {
    const auto there = integrate(system, State{1, 0.3}, 0, 25, method);
    const auto back = integrate(system, there.x, 25, 0, method);
    return (back.x - State{1, 0.3}).cwiseAbs().maxCoeff();
  };
  // Tolerance: Newton's tolerance and rounding errors of 200 steps, amplified some tens of times.
  for (const HermitianPair& pair : hermitian_table)
    EXPECT_LT(return_error(Hermitian{.operators = pair, .step = 0.25}), 1e-11) << pair.name;
  EXPECT_GT(return_error(Rk4{.step = 0.25}), 1e-5);
}

// The energy error is bounded: that of the second half of a long integration does not exceed that of the
// first half.
TEST(Hermitian, EnergyErrorIsBounded) {
  const problems::Duffing problem;
  const double at_first = problem.energy(State{1, 0.3});
  for (const HermitianPair& pair : {laier, argyris, newmark_pair}) {
    double first = 0, second = 0;
    const auto look = [&](const Step& s) {
      const double error = std::abs(problem.energy(s.x1) / at_first - 1);
      (s.t1 < 500 ? first : second) = std::max(s.t1 < 500 ? first : second, error);
      return true;
    };
    ASSERT_TRUE(integrate(System(problem.text()), State{1, 0.3}, 0, 1000,
                          Hermitian{.operators = pair, .step = 0.2}, look)
                    .status.ok());
    EXPECT_LT(second, 1.01 * first) << pair.name;
    EXPECT_GT(first, 1e-6) << pair.name;  // otherwise the bound would test nothing
  }
}

// Two degrees of freedom: masses with equal motion are two identical Duffing oscillators.
TEST(Hermitian, TwoDegreesOfFreedomMoveAsOne) {
  const problems::TextProblem pair("two-dof", {{"damping", 0}, {"force", 0}});
  const problems::TextProblem one("driven-duffing", {{"damping", 0}, {"force", 0}});
  const Hermitian method{.step = 0.1};
  const auto both = integrate(System(pair), State{1, 1, 0.2, 0.2}, 0, 20, method);
  const auto alone = integrate(System(one), State{1, 0.2}, 0, 20, method);
  ASSERT_TRUE(both.status.ok() && alone.status.ok());
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(both.x[i], alone.x[i / 2], 1e-11) << i;  // Newton's tolerance
}

TEST(Hermitian, RefusesWhatCannotBeMeant) {
  EXPECT_NE(refusal(Hermitian{.step = -1}).find("laier: step"), std::string::npos);
  EXPECT_NE(refusal(Hermitian{.relative_tolerance = 1}).find("relative_tolerance"), std::string::npos);
  EXPECT_NE(refusal(Hermitian{.absolute_tolerance = 0}).find("absolute_tolerance"), std::string::npos);
  EXPECT_NE(refusal(Hermitian{.step = 0.1, .branch_tolerance = 0}).find("branch_tolerance"),
            std::string::npos);
  EXPECT_EQ(refusal(Hermitian{.step = 0.1, .branch_tolerance = infinity}), "accepted");
}

}  // namespace
}  // namespace nlmech::ivp::hermitian_test

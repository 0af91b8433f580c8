// Central differences, backward Euler, Newmark, HHT and generalised alpha against their difference equations,
// solved in closed form or with 50 digits, and against exact solutions.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <complex>

#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/support/extended_real.hpp"
#include "tests/ivp/methods.hpp"

namespace nlmech::ivp::structural_methods_test {
namespace {

using namespace testing;
using Real = ExtendedReal<50>;

// Runs a method on q'' = -q from (1, 0) and compares every step with exact(n).
template <class Method, class Exact>
void expect_states(const Method& method, double t1, double tolerance, const Exact& exact) {
  const auto compare = [&](const Step& step) {
    const State expected = exact(static_cast<double>(step.index));
    EXPECT_NEAR(step.x1[0], expected[0], tolerance) << step.index;
    EXPECT_NEAR(step.x1[1], expected[1], tolerance) << step.index;
    return true;
  };
  EXPECT_TRUE(integrate(System(Oscillator{}), State{1, 0}, 0, t1, method, compare).status.ok());
}

// Central differences on q'' = -q are a rotation: q_n = cos n phi with sin(phi/2) = h/2, v_n = -sin(n phi)
// sin(phi)/h. Tolerance: some rounding errors a step, which a rotation neither damps nor amplifies.
TEST(CentralDifference, RotatesTheLinearOscillator) {
  for (const double h : {0.1, 0.5, 1.9}) {
    const double phi = 2 * std::asin(h / 2);
    const int steps = 400;
    expect_states(CentralDifference{.step = h}, steps * h, 16 * steps * eps, [&](double k) {
      return State{std::cos(k * phi), -std::sin(k * phi) * std::sin(phi) / h};
    });
  }
}

// For h omega > 2 the solution grows by exp(2 arcosh(h/2)) a step: 6.85 for h = 3.
TEST(CentralDifference, BlowsUpBeyondItsStabilityLimit) {
  const auto solution = integrate(System(Oscillator{}), State{1, 0}, 0, 30, CentralDifference{.step = 3});
  const double growth = std::exp(2 * std::acosh(1.5));
  EXPECT_NEAR(std::abs(solution.x[0]), std::pow(growth, 10) / 2, 1e-6 * std::pow(growth, 10));
  EXPECT_EQ(
      integrate(System(Oscillator{}), State{1, 0}, 0, 3000, CentralDifference{.step = 3}).status.outcome(),
      Outcome::non_finite);
}

// q'' = -c v with r = h c: v(t - h/2) is multiplied by the roots of z^2 - (1 - 3r/2) z - r/2, one of which is
// -1 for r = 1.
TEST(CentralDifference, DampingLimitsTheStep) {
  const auto speed = [](double step) {
    const Manufactured damped{.damping = 1, .stiffness = 0, .cubic = 0};
    double largest = 0;
    const auto late = [&](const Step& s) {
      if (s.index > 900) largest = std::max(largest, std::abs(s.x1[1] - s.x0[1]));
      return true;
    };
    (void)integrate(System(damped), State{1, 1}, 0, 1000 * step, CentralDifference{.step = step}, late);
    return largest;
  };
  EXPECT_LT(speed(0.98), 2);    // the forced motion, sin and cos of size 1
  EXPECT_GT(speed(1.02), 100);  // 1.027 to the power 900
}

// On q'' = -q, z = q + iv satisfies z' = -iz, and a step divides z by 1 + ih.
TEST(BackwardEuler, DampsTheLinearOscillatorAsItMust) {
  for (const double h : {0.1, 1.0, 100.0}) {
    const auto solution = integrate(System(Oscillator{}), State{1, 0}, 0, 20 * h, BackwardEuler{.step = h});
    const std::complex<double> z = std::pow(std::complex<double>(1, h), -20);
    const double tolerance = 100 * eps * std::max(std::abs(z), 1e-13);  // Newton stops at 1e-12 absolute
    EXPECT_NEAR(solution.x[0], z.real(), tolerance + 1e-13);
    EXPECT_NEAR(solution.x[1], z.imag(), tolerance + 1e-13);
  }
}

// The energy decreases in every step.
TEST(BackwardEuler, OnlyLosesEnergy) {
  const problems::Duffing problem;
  double before = 0.75;
  const auto compare = [&](const Step& step) {
    const double energy = problem.energy(step.x1);
    EXPECT_LT(energy, before);
    before = energy;
    return true;
  };
  EXPECT_TRUE(integrate(System(problem.text()), State{1, 0}, 0, 20, BackwardEuler{.step = 0.05}, compare)
                  .status.ok());
}

// Newmark with beta = 1/4, gamma = 1/2 is the trapezoidal rule, a rotation of (q, v) by 2 arctan(h/2).
TEST(Newmark, RotatesTheLinearOscillator) {
  for (const double h : {0.1, 1.0, 50.0}) {
    const double phi = 2 * std::atan(h / 2);
    const int steps = 400;
    // Rounding error of a step: that of h^2 a/4 and of Newton's solution, relative to a state of size 1.
    expect_states(Newmark{.step = h}, steps * h, 16 * steps * (1 + h * h / 4) * eps, [&](double k) {
      return State{std::cos(k * phi), -std::sin(k * phi)};
    });
  }
}

// Newmark's method with beta = 0, gamma = 1/2 is the method of central differences.
TEST(Newmark, WithoutBetaIsCentralDifferences) {
  const double h = 0.5, phi = 2 * std::asin(h / 2);
  expect_states(Newmark{.step = h, .beta = 0}, 100 * h, 3200 * eps, [&](double k) {
    return State{std::cos(k * phi), -std::sin(k * phi) * std::sin(phi) / h};
  });
}

struct Linear {
  Real q = 1, v = 0, a, g;
  Real damping, stiffness;
  explicit Linear(const Manufactured& problem) : damping(problem.damping), stiffness(problem.stiffness) {
    a = g = acceleration(0, q, v);
  }
  [[nodiscard]] Real acceleration(const Real& t, const Real& x, const Real& rate) const {
    return -damping * rate - stiffness * x - damping * sin(t) + (stiffness - 1) * cos(t);
  }
  // One step by the equations of AlphaScheme, which are linear in the new acceleration.
  void step(const Real& t, const Real& h, const Real& alpha_m, const Real& alpha_f, const Real& beta,
            const Real& gamma, bool printed) {
    const Real old = printed ? g : a;
    const Real free_q = q + h * v + h * h * (Real(0.5) - beta) * old, free_v = v + h * (1 - gamma) * old;
    const Real free_g = acceleration(t + h, free_q, free_v);
    const Real slope = -(stiffness * beta * h * h + damping * gamma * h);
    const Real next =
        ((1 - alpha_f) * free_g + alpha_f * g - alpha_m * a) / (1 - alpha_m - (1 - alpha_f) * slope);
    q = free_q + h * h * beta * next;
    v = free_v + h * gamma * next;
    g = free_g + slope * next;
    a = next;
  }
};

// Tolerance: Newton's 1e-12 and rounding errors in each step, which are not amplified.
template <class Method>
void expect_linear(const Method& method, const Real& alpha_m, const Real& alpha_f, const Real& beta,
                   const Real& gamma, bool printed = false) {
  const Manufactured problem{.damping = 0.25, .stiffness = 4, .cubic = 0};
  Linear oracle(problem);
  const Real h(method.step);
  const auto compare = [&](const Step& step) {
    oracle.step((step.index - 1) * h, h, alpha_m, alpha_f, beta, gamma, printed);
    EXPECT_NEAR(step.x1[0], static_cast<double>(oracle.q), 1e-13 * static_cast<double>(step.index));
    EXPECT_NEAR(step.x1[1], static_cast<double>(oracle.v), 1e-13 * static_cast<double>(step.index));
    return true;
  };
  const auto solution = integrate(System(problem), problem.exact(0), 0, 200 * method.step, method, compare);
  EXPECT_TRUE(solution.status.ok()) << solution.status.text();
  EXPECT_EQ(solution.statistics.steps, 200);
}

TEST(Hht, FollowsItsDifferenceEquation) {
  for (const double alpha : {-1. / 3, -0.1, 0.0}) {
    const Real a(alpha);
    expect_linear(Hht{.step = 0.125, .alpha = alpha}, 0, -a, (1 - a) * (1 - a) / 4, Real(0.5) - a);
    expect_linear(Hht{.step = 0.125, .alpha = alpha, .form = Hht::Form::as_printed}, 0, -a,
                  (1 - a) * (1 - a) / 4, Real(0.5) - a, true);
  }
}

TEST(GeneralizedAlpha, FollowsItsDifferenceEquation) {
  for (const double rho : {0.0, 0.5, 0.8, 1.0}) {
    const Real r(rho), am = (2 * r - 1) / (r + 1), af = r / (r + 1);
    expect_linear(GeneralizedAlpha{.step = 0.125, .rho_inf = rho}, am, af, (1 - am + af) * (1 - am + af) / 4,
                  Real(0.5) - am + af);
  }
}

// For h omega -> infinity a step multiplies the state by rho_inf. The limit is a double eigenvalue, hence a
// factor n in addition to rho^n; in a quotient over 100 steps from n = 100 on it appears as 2^(1/100).
TEST(GeneralizedAlpha, LeavesRhoOfHighFrequencies) {
  for (const double rho : {0.5, 0.8, 0.95}) {
    const auto after = [&](int steps) {
      return std::abs(integrate(System(Oscillator{1e6}), State{1, 0}, 0, steps,
                                GeneralizedAlpha{.step = 1, .rho_inf = rho})
                          .x[0]);
    };
    EXPECT_NEAR(std::pow(after(200) / after(100), 0.01), rho, 0.02 * rho);
  }
}

// The error of Table 4.4: a velocity of half a step before, used with another step size h', is wrong by (h' -
// h)/2 a. On q'' = 2 from rest it is the only error: exactly (h' - h) in v, growing linearly in q.
TEST(CentralDifference, RestartFaultIsTheStatedOne) {
  const JumpingForce constant{.at = 100, .before = 2};
  const System system(constant);
  const double h = 0.125, other = 0.5;
  const auto first = integrate(system, State{0, 0}, 0, 1,
                               CentralDifference{.step = h, .reported = VelocityTime::half_step_before});
  EXPECT_EQ(first.x[1], 2 * (1 - h / 2));
  const auto second = integrate(system, first.x, 1, 3,
                                CentralDifference{.step = other, .initial = VelocityTime::half_step_before});
  EXPECT_NEAR(second.x[1], 2 * 3 + (other - h), 16 * eps);
  EXPECT_NEAR(second.x[0], 9 + 2 * (other - h), 32 * eps);
  const auto right = integrate(system, State{0, 0}, 0, 1, CentralDifference{.step = h});
  const auto end = integrate(system, right.x, 1, 3, CentralDifference{.step = other});
  EXPECT_NEAR(end.x[0], 9, 32 * eps);
  EXPECT_NEAR(end.x[1], 6, 16 * eps);
}

// Both conventions of the velocity give the same trajectory.
TEST(CentralDifference, HalfStepVelocitiesContinueARun) {
  const System system(problems::TextProblem("duffing"));
  const auto whole = integrate(system, State{1, 0}, 0, 8, CentralDifference{.step = 0.0625});
  const auto half = integrate(system, State{1, 0}, 0, 4,
                              CentralDifference{.step = 0.0625, .reported = VelocityTime::half_step_before});
  const auto rest = integrate(system, half.x, 4, 8,
                              CentralDifference{.step = 0.0625, .initial = VelocityTime::half_step_before});
  EXPECT_NEAR(rest.x[0], whole.x[0], 1e-13);  // 128 steps' rounding
  EXPECT_NEAR(rest.x[1], whole.x[1], 1e-13);
}

// The convention of the reported velocity does not change the trajectory, not even across a jump.
TEST(CentralDifference, HalfStepVelocitiesCrossJumps) {
  const System system(JumpingForce{});
  const auto usual = integrate(system, State{0, 0}, 0, 1, CentralDifference{.step = 0.1});
  const auto half = integrate(system, State{0, 0}, 0, 1,
                              CentralDifference{.step = 0.1, .reported = VelocityTime::half_step_before});
  EXPECT_EQ(half.x[0], usual.x[0]);
  EXPECT_NEAR(half.x[1], usual.x[1] - 0.05 * 2, 8 * eps);
}

// Symmetric methods are reversible. Tolerance: Newton's 1e-12 a step (far less in fact), amplified at most
// linearly by the change of the Duffing oscillator's frequency with its amplitude.
RC_GTEST_PROP(StructuralMethods, SymmetricOnesAreReversible, ()) {
  const double amplitude = *rc::gen::inRange(1, 200) / 100.0, h = *rc::gen::inRange(1, 20) / 100.0;
  const System system(problems::TextProblem("duffing"));
  const State x0{amplitude, 0.25};
  const auto return_error = [&](const auto& method) {
    const auto there = integrate(system, x0, 0, 50 * h, method);
    const auto back = integrate(system, there.x, 50 * h, 0, method);
    RC_ASSERT(there.status.ok() && back.status.ok());
    return (back.x - x0).cwiseAbs().maxCoeff();
  };
  RC_ASSERT(return_error(Newmark{.step = h}) < 1e-9);
  RC_ASSERT(return_error(CentralDifference{.step = h}) < 1e-11);
}

// Central differences conserve a modified energy: the energy error oscillates and does not drift.
TEST(CentralDifference, EnergyDoesNotDrift) {
  const problems::Duffing problem;
  const double period = problem.period(1.0);
  double early = 0, late = 0;
  const auto measure = [&](const Step& step) {
    const double error = std::abs(problem.energy(step.x1) - 0.75);
    (step.t1 < 10 * period ? early : late) = std::max(step.t1 < 10 * period ? early : late, error);
    return true;
  };
  EXPECT_TRUE(integrate(System(problem.text()), State{1, 0}, 0, 500 * period,
                        CentralDifference{.step = period / 50}, measure)
                  .status.ok());
  EXPECT_GT(early, 1e-4);         // there is an energy error
  EXPECT_LT(late, 1.02 * early);  // 50 times as long
}

TEST(StructuralMethods, SayWhichOptionIsWrong) {
  EXPECT_EQ(refusal(Newmark{.beta = 0.6}), "newmark: beta must be between 0 and 0.5, not 0.6");
  EXPECT_EQ(refusal(Newmark{.gamma = -0.1}), "newmark: gamma must be between 0 and 1, not -0.1");
  EXPECT_EQ(refusal(Hht{.alpha = 0.1}), "hht: alpha must be between -0.333333 and 0, not 0.1");
  EXPECT_NE(refusal(Hht{.alpha = -0.4}).find("-0.4"), std::string::npos);
  EXPECT_EQ(refusal(GeneralizedAlpha{.rho_inf = 1.1}),
            "generalized-alpha: rho_inf must be between 0 and 1, not 1.1");
  EXPECT_NE(refusal(GeneralizedAlpha{.rho_inf = nan}).find("nan"), std::string::npos);
}

// A spring of 1e8 holds the first mass at k2 x2/k1; the other masses move with frequencies near 1. Newton's
// iteration must stop at the rounding noise of such equations, for long and for short steps.
TEST(StructuralMethods, CopeWithAStiffSpring) {
  const problems::TextProblem problem("three-dof", {{"k1", 1e8}});
  for (const double h : {0.625, 0.0625, 1e-3}) {
    const auto check = [&](const auto& method) {
      const auto solution = integrate(System(problem), State::Zero(6), 0, 2.5, method);
      EXPECT_TRUE(solution.status.ok()) << solution.status.text();
      EXPECT_LT(std::abs(solution.x[0]), 2e-8);
      EXPECT_GT(std::abs(solution.x[1]), 0.05);
    };
    check(Newmark{.step = h});
    check(Hht{.step = h});
    check(GeneralizedAlpha{.step = h});
    check(BackwardEuler{.step = h});
  }
}

// Accelerations are 1e8 times the difference of two numbers of size `amplitude`; their relative accuracy is
// 1e-8. Newton's updates never fall below 1e-12, and the iteration must recognise rounding noise. Steps of
// 1e-3 resolve the smooth motion: error h^2 and, for backward Euler, h in the velocity, relative to the
// amplitude.
TEST(StructuralMethods, KnowRoundingNoiseOfStiffForces) {
  for (const double amplitude : {1.0, 100.0}) {
    const Manufactured problem{.stiffness = 1e8, .cubic = 0, .amplitude = amplitude};
    EXPECT_LT(largest_error(problem, Newmark{.step = 1e-3}, 0, 2), 1e-3 * amplitude);
    EXPECT_LT(largest_error(problem, Hht{.step = 1e-3}, 0, 2), 1e-3 * amplitude);
    EXPECT_LT(largest_error(problem, GeneralizedAlpha{.step = 1e-3}, 0, 2), 1e-3 * amplitude);
    EXPECT_LT(largest_error(problem, BackwardEuler{.step = 1e-3}, 0, 2), 1e-3 * amplitude);
  }
}

}  // namespace
}  // namespace nlmech::ivp::structural_methods_test

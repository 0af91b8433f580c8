/// Collocation and Picard's iteration for equations that are stiff or have a pole, and for extreme options:
/// solutions and statuses.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "nlmech/ivp/collocation/collocation.hpp"
#include "nlmech/ivp/collocation/picard.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/oracle.hpp"
#include "tests/ivp/reference.hpp"

namespace nlmech::ivp::stiff_test {
namespace {

using collocation::NodeFamily;
using oracle::distance;
using testing::eps;

constexpr PolynomialCollocation lobatto(double step, int nodes = 7) { return {.step = step, .nodes = nodes}; }
constexpr PolynomialCollocation radau(double step, int nodes = 7) {
  return {.step = step, .nodes = nodes, .points = NodeFamily::left_end_and_radau};
}

/// Expects that a failure names its method and its place.
void expect_sentence(const Status& status, std::string_view method, std::string_view place) {
  EXPECT_NE(status.sentence().find(method), std::string::npos) << status.text();
  EXPECT_NE(status.sentence().find(place), std::string::npos) << status.text();
}

// Duffing with eta = 1e6: 100 periods of 7.416e-3.
const problems::Duffing hard{.hardening = 1e6};

/// Root mean square of the error of the position at the ends of steps.
template <class Method>
double rms(const Method& method, double end) {
  double sum = 0;
  const Observer watch = [&](const Step& step) {
    const double error = step.x1[0] - oracle::duffing(step.t1, hard)[0];
    sum += error * error;
    return true;
  };
  const auto s = integrate(System(hard.text()), {1, 0}, 0, end, method, watch);
  EXPECT_TRUE(s.status.ok()) << s.status.text();
  return std::sqrt(sum / static_cast<double>(s.statistics.steps));
}

// Recorded errors: 2.9e-3 and 2.7e-5, printed with two digits; 1.1e-10 with 35 nodes, where another rounding
// of the node times may change the error.
TEST(StiffDuffing, ErrorsOverHundredPeriods) {
  const double P = hard.period(1.0);
  EXPECT_NEAR(rms(lobatto(P / 10), 100 * P), 2.9e-3, 0.06e-3);
  EXPECT_NEAR(rms(radau(P / 10), 100 * P), 2.7e-5, 0.06e-5);
  EXPECT_LT(rms(lobatto(P / 2, 35), 100 * P), 1.1e-10);
}

// From the constant initial guess Newton's iteration does not converge for a step of a whole period.
TEST(StiffDuffing, AWholePeriodIsTooMuchForNewton) {
  const double P = hard.period(1.0);
  const auto s = integrate(System(hard.text()), {1, 0}, 0, P, lobatto(P, 35));
  EXPECT_TRUE(s.status.outcome() == Outcome::newton_diverged || s.status.outcome() == Outcome::not_converged)
      << s.status.text();
  expect_sentence(s.status, "lgl-coll", "t = 0");
  expect_sentence(s.status, "lgl-coll", "take a smaller step");
  EXPECT_EQ(s.t, 0);
  EXPECT_EQ(s.x, (State{1, 0}));
}

// Three masses; a spring of 1e8 holds the first one: omega = 7071.
problems::TextProblem stiff_chain() { return problems::TextProblem("three-dof", {{"k1", 1e8}}); }
const double omega = std::sqrt((1e8 + 1) / 2);

/// Growth of the amplitude of the first mass from step 20 to step 25.
template <class Method>
double growth(const Method& method) {
  State x0 = State::Zero(6);
  x0[0] = 1e-9;
  const auto amplitude = [&](int steps) {
    const auto s = integrate(System(stiff_chain()), x0, 0, steps * method.step, method);
    EXPECT_TRUE(s.status.ok()) << s.status.text();
    return std::hypot(s.x[0], s.x[3] / omega);
  };
  return std::pow(amplitude(25) / amplitude(20), 1.0 / 5);
}

// LGL nodes are not A-stable: |R(8.485 i)| = 1.3321 and |R(7.000 i)| = 1.0980 (from the nodes alone, with 50
// digits: Hairer & Wanner II, Theorem IV.3.9); an independent integration with the second step size grew from
// 1e-9 to 1.3e-3 in 150 steps. Radau nodes are L-stable.
TEST(StiffChain, LobattoNodesHaveAnInstabilityWindow) {
  EXPECT_NEAR(growth(lobatto(1.2e-3)), 1.3321, 2e-4);
  EXPECT_NEAR(growth(lobatto(9.9e-4)), 1.0980, 2e-4);
  EXPECT_LT(growth(radau(1.2e-3)), 1);
  EXPECT_LT(growth(radau(9.9e-4)), 1);
}

TEST(StiffChain, RadialFunctionsHaveItToo) {
  // The matrix in double precision differs from the exact one, whose |R| is 1.2940, by about 1e-4.
  EXPECT_NEAR(growth(RbfCollocation{.step = 1.2e-3, .nodes = 7, .shape = 0.367 / 1.2e-3}), 1.2940, 1e-3);
}

template <class Method>
double van_der_pol_error(double mu, double end, const Method& method) {
  const problems::TextProblem problem("van-der-pol", {{"mu", mu}});
  const auto s = integrate(System(problem), {2, 0}, 0, end, method);
  EXPECT_TRUE(s.status.ok()) << s.status.text();
  return distance(s.x, testing::reference(problem, {2, 0}, 0, end));
}

// Steps that resolve the fast transitions, where the solution moves by 200 times an error of time.
TEST(VanDerPol, LeapsWithShortSteps) {
  EXPECT_LT(van_der_pol_error(10, 20, radau(0.01, 10)), 1e-9);
  EXPECT_LT(van_der_pol_error(10, 20, lobatto(0.01, 10)), 1e-9);
  EXPECT_LT(van_der_pol_error(100, 85, radau(0.001, 7)), 1e-7);
}

// On the slow branch the fast eigenvalue is -3000: steps of 3000 time constants, after short first steps that
// bring v from 0 to the branch.
TEST(VanDerPol, SlowBranchWithLongSteps) {
  EXPECT_LT(van_der_pol_error(1000, 20, radau(1)), 1e-6);
  EXPECT_LT(van_der_pol_error(1000, 20, lobatto(1)), 1e-5);
}

// The fast transition of mu = 1000 at t = 807 in steps a thousand times as long as it: Newton's iteration
// fails there or in a later step, and the message states where.
TEST(VanDerPol, LeapWithLongStepsEndsWithAStatus) {
  for (const PolynomialCollocation& method : {lobatto(1), radau(10)}) {
    const auto s =
        integrate(System(problems::TextProblem("van-der-pol", {{"mu", 1000}})), {2, 0}, 0, 1000, method);
    EXPECT_TRUE(s.x.allFinite());
    EXPECT_FALSE(s.status.ok());
    EXPECT_GT(s.t, 790);
    expect_sentence(s.status, name_of(method), "t = ");
  }
}

// y' = y^3 from y = 1 has a pole at t = 1/2. Picard's iteration diverges there.
TEST(BlowUp, EndsPicardsIteration) {
  const auto s = integrate(System(problems::TextProblem("blow-up")), State{1.0}, 0, 1, Mcpi{.step = 1e-2});
  EXPECT_EQ(s.status.outcome(), Outcome::not_converged);
  EXPECT_LE(s.t, 0.51);
  EXPECT_GT(s.t, 0.4);
  expect_sentence(s.status, "mcpi", "t = ");
  expect_sentence(s.status, "mcpi", "take a shorter step");
}

// Polynomials of degree 1 that satisfy the equation at the end of the step: backward Euler.
TEST(NumberOfNodes, TwoAreBackwardEuler) {
  const System system(problems::TextProblem("duffing"));
  const auto euler = integrate(system, {1, 0}, 0, 2, BackwardEuler{.step = 0.1});
  for (const PolynomialCollocation& method : {lobatto(0.1, 2), radau(0.1, 2)}) {
    const auto s = integrate(system, {1, 0}, 0, 2, method);
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_LT(distance(s.x, euler.x), 20 * 1e-12);  // tolerance of both Newton iterations times 20 steps
  }
}

TEST(NumberOfNodes, TwoHundred) {
  const System system(problems::TextProblem("duffing"));
  const double P = oracle::duffing_period;
  // |D| is 200^2/2: the rounding error of the state enters the equations with that factor, and the solution
  // with less.
  for (const PolynomialCollocation& method : {lobatto(P / 2, 200), radau(P / 2, 200)}) {
    const auto s = integrate(system, {1, 0}, 0, P, method);
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_LT(distance(s.x, State{1, 0}), 1000 * eps);
  }
  const auto picard = integrate(system, {1, 0}, 0, P, Mcpi{.step = P / 4, .order = 199});
  ASSERT_TRUE(picard.status.ok()) << picard.status.text();
  EXPECT_LT(distance(picard.x, State{1, 0}), 1000 * eps);
}

// For extreme shape parameters the basis is unusable, and the status reports it; no value gives NaN with
// success.
TEST(Shape, FromOneMillionthToAMillion) {
  const System system(problems::TextProblem("duffing"));
  const double P = oracle::duffing_period, step = P / 10;
  for (int exponent = -6; exponent <= 6; ++exponent) {
    const double relative = std::pow(10.0, exponent);
    const auto s = integrate(system, {1, 0}, 0, P, RbfCollocation{.step = step, .shape = relative / step});
    EXPECT_TRUE(s.x.allFinite()) << relative;
    if (s.status.ok()) {
      EXPECT_GT(relative, 1e-3);
      EXPECT_LT(relative, 1e2);
      EXPECT_EQ(s.t, P);
    } else {
      EXPECT_FALSE(s.status.sentence().empty());
    }
    if (exponent == 0) {
      EXPECT_TRUE(s.status.ok()) << s.status.text();
    }
    if (exponent == -6) {
      EXPECT_EQ(s.status.outcome(), Outcome::singular_matrix) << s.status.text();
    }
    if (exponent == 6) {
      EXPECT_EQ(s.status.outcome(), Outcome::outside_validity) << s.status.text();
    }
  }
}

}  // namespace
}  // namespace nlmech::ivp::stiff_test

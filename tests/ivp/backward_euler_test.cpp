#include "nlmech/ivp/implicit/backward_euler.hpp"

#include <gtest/gtest.h>

#include <complex>

#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/methods.hpp"

namespace nlmech::ivp::backward_euler_test {
namespace {

using namespace testing;

// On q'' = -q, z = q + iv obeys z' = -iz, and a step divides by 1 + ih.
TEST(BackwardEuler, DampsTheLinearOscillatorAsItMust) {
  for (const double h : {0.1, 1.0, 100.0}) {
    const auto solution = integrate(System(Oscillator{}), State{1, 0}, 0, 20 * h, BackwardEuler{.step = h});
    const std::complex<double> z = std::pow(std::complex<double>(1, h), -20);
    const double tolerance = 100 * eps * std::max(std::abs(z), 1e-13);  // Newton stops at 1e-12 absolute
    EXPECT_NEAR(solution.x[0], z.real(), tolerance + 1e-13);
    EXPECT_NEAR(solution.x[1], z.imag(), tolerance + 1e-13);
  }
}

TEST(BackwardEuler, IsOfFirstOrderAlsoWithinSteps) {
  const Manufactured problem;
  for (const bool within : {false, true}) {
    const double coarse = largest_error(problem, BackwardEuler{.step = 2 / 500.4}, 0, 2, within);
    const double fine = largest_error(problem, BackwardEuler{.step = 2 / 1000.4}, 0, 2, within);
    EXPECT_NEAR(std::log2(coarse / fine), 1, 0.1);
  }
}

// Its energy falls from step to step.
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

// y' = y^3: a step from y0 has a real solution near y0 as long as 27 h y0^2 <= 4; then none is near.
TEST(BackwardEuler, StopsBeforeABlowUp) {
  const auto solution =
      integrate(System(problems::TextProblem("blow-up")), State{1.0}, 0, 1, BackwardEuler{.step = 0.01});
  EXPECT_FALSE(solution.status.ok());
  EXPECT_TRUE(solution.x.allFinite());
  EXPECT_GT(solution.t, 0.4);
  EXPECT_LT(solution.t, 0.55);
  EXPECT_NE(solution.status.sentence().find("backward-euler"), std::string::npos);
}

// Force limits from the side of the segment, not across the jump: the result is that of two runs, one on
// either side.
TEST(BackwardEuler, RespectsJumps) {
  const JumpingForce problem;
  const auto first =
      integrate(System(JumpingForce{.at = 9}), State{0, 0}, 0, 0.3, BackwardEuler{.step = 0.1});
  const auto second = integrate(System(JumpingForce{.at = -9}), first.x, 0.3, 1, BackwardEuler{.step = 0.1});
  const auto both = integrate(System(problem), State{0, 0}, 0, 1, BackwardEuler{.step = 0.1});
  EXPECT_EQ(both.x, second.x);
}

}  // namespace
}  // namespace nlmech::ivp::backward_euler_test

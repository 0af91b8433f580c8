/// The Taylor series method on Lorenz's equations and on four bodies, against computations in more digits.
#include <gtest/gtest.h>

#include "chapters/plain_equations.hpp"
#include "nlmech/ivp/series/series.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/series.hpp"

namespace nlmech::ivp::series_problems_test {
namespace {

using testing::reference;
using testing::with_tolerance;

// mpfr, 70 digits. Errors grow by exp(0.9 20) = 6.6e7: rounding of some hundred steps of size 20 leaves 1e-6
// at worst; 8/3 as a double alone moves the end by 4e-13.
TEST(SeriesOnProblems, LorenzToTwenty) {
  const chapters::PlainLorenz lorenz;
  const State truth{-1.356348984580380, -2.387300052277071, 12.38998499408597};
  const auto s = integrate(Direct(lorenz), State{0, 1, 0}, 0, 20, with_tolerance(1e-15));
  EXPECT_LT((s.x - truth).cwiseAbs().maxCoeff(), 1e-8);
  const auto taped = integrate(System(lorenz), State{0, 1, 0}, 0, 20, with_tolerance(1e-15));
  EXPECT_LT((taped.x - truth).cwiseAbs().maxCoeff(), 1e-8);
}

// The printed settings, T = 0.1 and N = 20, step over the radius of convergence, 0.119 at its least: wrong by
// more than 0.1 after half a unit of time (findings: 0.83), and by more than 1 at the end. Chosen steps are
// not.
TEST(SeriesOnProblems, StepsBeyondTheRadiusOfConvergenceShowTheirError) {
  const problems::TextProblem lorenz("lorenz");
  const State x0{0, 1, 0}, truth = reference(lorenz, x0, 0, 0.5);
  const auto printed = integrate(System(lorenz), x0, 0, 0.5, Series{.order = 20, .step = 0.1});
  EXPECT_TRUE(printed.status.ok());
  EXPECT_GT((printed.x - truth).cwiseAbs().maxCoeff(), 0.1);
  const auto chosen = integrate(System(lorenz), x0, 0, 0.5, with_tolerance(1e-9, 20));
  EXPECT_LT((chosen.x - truth).cwiseAbs().maxCoeff(), 1e-7);
  const auto fine = integrate(System(lorenz), x0, 0, 0.5, Series{.order = 20, .step = 0.01});
  EXPECT_LT((fine.x - truth).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(SeriesOnProblems, CloseEncounterOfFourBodies) {
  const problems::TextProblem bodies("bodies");
  const State& x0 = bodies.initial_state();
  const auto s = integrate(System(bodies), x0, 0, 3000, with_tolerance(1e-14));
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  // Errors of 1e-16 grow to 1e-12 by t = 3000; those of a hundred steps to some 1e-10.
  EXPECT_NEAR(s.x[9], -0.2510470313435667, 1e-9);
  EXPECT_NEAR(s.x[10], 3.071464269641001, 1e-9);
  EXPECT_NEAR(s.x[0], 1.882222659858648, 1e-9);
}

}  // namespace
}  // namespace nlmech::ivp::series_problems_test

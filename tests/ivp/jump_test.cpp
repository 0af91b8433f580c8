// A right-hand side that jumps in value, announced: every method must see one smooth function on each side of
// the jump. Both sides are parabolas, so that methods of order two or more are exact.
#include <gtest/gtest.h>

#include "nlmech/ivp/collocation/adaptive_collocation.hpp"
#include "nlmech/ivp/collocation/collocation.hpp"
#include "nlmech/ivp/collocation/picard.hpp"
#include "nlmech/ivp/hermitian/hermitian.hpp"
#include "nlmech/ivp/runge_kutta/rkn1210.hpp"
#include "nlmech/ivp/series/series.hpp"
#include "nlmech/ivp/transversal/mtl.hpp"
#include "tests/ivp/methods.hpp"

namespace nlmech::ivp::jump_test {
namespace {

using namespace testing;

// The jump, at t = 0.3, as the end of the run, its start, and within it, in both directions of time; errors
// at the ends of steps and within them.
template <class Method>
void expect_exact(const Method& method, double most, bool within = true) {
  const JumpingForce problem;
  for (const double end : {0.3, 1.0})
    EXPECT_LT(largest_error(problem, method, 0, end, within), most) << method_name(method) << ' ' << end;
  EXPECT_LT(largest_error(problem, method, 0.3, 1, within), most) << method_name(method);
  for (const double begin : {0.3, 0.4, 1.0})
    EXPECT_LT(largest_error(problem, method, begin, 0, within), most) << method_name(method) << ' ' << begin;
}

// Rounding of states of size 1 in up to 40 steps.
TEST(Jump, IsNeverLookedAcross) {
  for_each_method([&](const auto& method) {
    if constexpr (!std::is_same_v<std::decay_t<decltype(method)>, BackwardEuler>) {
      for (const double h : {0.1, 0.03, 0.07}) expect_exact(with_step(method, h), 1e-14);
    }
  });
  expect_exact(Rk6{.step = 0.0625}, 1e-14);
}

TEST(Jump, IsNeverLookedAcrossByStepsOfTheirChoice) {
  expect_exact(Ode45{}, 1e-12);
  expect_exact(Dop853{}, 1e-12);
  expect_exact(Rkn1210{}, 16 * eps);
  expect_exact(Series{}, 16 * eps);
  expect_exact(Series{.order = 3, .step = 0.07}, 16 * eps);
  expect_exact(AdaptiveCollocation{}, 16 * eps);
}

// Rounding to the norm of matrices (some 50), and Newton's tolerance.
TEST(Jump, IsNeverLookedAcrossByCollocation) {
  constexpr double h = 0.0625;
  expect_exact(Mcpi{.step = h}, 1e-12);
  expect_exact(PolynomialCollocation{.step = h, .nodes = 5}, 1e-12);
  expect_exact(
      PolynomialCollocation{.step = h, .nodes = 5, .points = collocation::NodeFamily::left_end_and_radau},
      1e-12);
  for (const HermitianPair& pair : hermitian_table) {
    for (const double step : {0.1, 0.03, 0.0})
      expect_exact(Hermitian{.operators = pair, .step = step}, 1e-13);
  }
  for (const int p : {1, 3}) expect_exact(Mtl{.step = 0.07, .points = p}, 100 * eps, false);
}

// Euler's methods are exact for the velocity alone.
TEST(Jump, ShowsEulerTheRightSide) {
  const JumpingForce problem;
  const auto s = integrate(System(problem), {0, 0}, 0, 1, Euler{.step = 0.0625});
  EXPECT_NEAR(s.x[1], problem.exact(1)[1], 1e-14);
  const auto b = integrate(System(problem), {0, 0}, 0, 1, BackwardEuler{.step = 0.0625});
  EXPECT_NEAR(b.x[1], problem.exact(1)[1], 1e-12);
}

}  // namespace
}  // namespace nlmech::ivp::jump_test

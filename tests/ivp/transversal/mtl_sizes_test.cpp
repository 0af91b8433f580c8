/// Multi-step transversal linearisation of a problem that is inlined, and of a size that only the program
/// knows.
#include <gtest/gtest.h>

#include "nlmech/ivp/transversal/mtl.hpp"
#include "nlmech/problems/two_dof.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/oracle.hpp"

namespace nlmech::ivp::mtl_sizes_test {
namespace {

using problems::TwoDof;
using testing::eps;

// Compiled for a size that only the running program knows, or with the problem inlined: the same method.
TEST(Mtl, DynamicSizeAndInlinedProblem) {
  const TwoDof problem;
  const State<4> x0 = TwoDof::initial_state();
  const Mtl method{.step = 0.05, .points = 3};
  const auto fixed = integrate(System(problem), x0, 0, 5, method);
  const auto free = integrate(System<Eigen::Dynamic>(problem), State<Eigen::Dynamic>(x0), 0, 5, method);
  const auto inlined = integrate(Direct(problem), x0, 0, 5, method);
  ASSERT_TRUE(fixed.status.ok()) << fixed.status.text();
  EXPECT_NEAR(oracle::distance(fixed.x, State<4>(free.x)), 0, 200 * eps);
  EXPECT_NEAR(oracle::distance(fixed.x, inlined.x), 0, 200 * eps);
}

}  // namespace
}  // namespace nlmech::ivp::mtl_sizes_test

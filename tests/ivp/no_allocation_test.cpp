// Eigen counts nothing, but it can refuse: every allocation of a matrix while it is told so ends the test.
#define EIGEN_RUNTIME_NO_MALLOC
#include <gtest/gtest.h>

#include "nlmech/ivp/backward_euler.hpp"
#include "nlmech/ivp/central_difference.hpp"
#include "nlmech/ivp/collocation.hpp"
#include "nlmech/ivp/dormand_prince.hpp"
#include "nlmech/ivp/explicit_runge_kutta.hpp"
#include "nlmech/ivp/generalized_alpha.hpp"
#include "nlmech/ivp/hermitian.hpp"
#include "nlmech/ivp/hht.hpp"
#include "nlmech/ivp/mtl.hpp"
#include "nlmech/ivp/newmark.hpp"
#include "nlmech/ivp/picard.hpp"
#include "nlmech/ivp/rkn1210.hpp"
#include "nlmech/ivp/series.hpp"
#include "nlmech/problems/three_mass_chain.hpp"

namespace nlmech::ivp {
namespace {

// Forbids the heap from the end of the first step to the begin of the last.
template <class Method>
void expect_no_allocation(const Method& method, const problems::ThreeMassChain& chain = {}) {
  const Direct<problems::ThreeMassChain> system{chain};
  const Observer<6> forbid = [](const Step<6>& step) {
    Eigen::internal::set_is_malloc_allowed(step.index >= 9);
    return true;
  };
  const auto s = integrate(system, State<6>::Zero(), 0, 5, method, forbid);
  Eigen::internal::set_is_malloc_allowed(true);
  EXPECT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_EQ(s.statistics.steps, 10);
}

TEST(NoAllocation, InSteps) {
  expect_no_allocation(Rk4{.step = 0.5});
  expect_no_allocation(Rk6{.step = 0.5});
  expect_no_allocation(BackwardEuler{.step = 0.5});
  expect_no_allocation(CentralDifference{.step = 0.5});
  expect_no_allocation(Newmark{.step = 0.5});
  expect_no_allocation(Hht{.step = 0.5});
  expect_no_allocation(GeneralizedAlpha{.step = 0.5});
  expect_no_allocation(
      Ode45{.relative_tolerance = 0.1, .absolute_tolerance = 0.1, .initial_step = 0.5, .largest_step = 0.5});
  expect_no_allocation(
      Rkn1210{.relative_tolerance = 0.1, .absolute_tolerance = 0.1, .initial_step = 0.5, .largest_step = 0.5},
      problems::ThreeMassChain{.c2 = 0});
  expect_no_allocation(Series{.order = 12, .step = 0.5});
  expect_no_allocation(Series{.largest_step = 0.5});
  expect_no_allocation(Mcpi{.step = 0.5, .order = 8});
  expect_no_allocation(Hermitian{.step = 0.5});
  expect_no_allocation(Mtl{.step = 0.125, .points = 4});
  expect_no_allocation(Mtl{.step = 0.125, .points = 4, .linear = MtlLinear::jacobian, .error_tolerance = 10});
  expect_no_allocation(RbfCollocation{.step = 0.5, .nodes = 7, .shape = 0.4});
  expect_no_allocation(PolynomialCollocation{.step = 0.5, .nodes = 7});
}

}  // namespace
}  // namespace nlmech::ivp

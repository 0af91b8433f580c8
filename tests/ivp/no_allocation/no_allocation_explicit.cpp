// Eigen refuses the heap here: see no_allocation_test.cpp.
#define EIGEN_RUNTIME_NO_MALLOC
#include "nlmech/ivp/runge_kutta/dop853.hpp"
#include "nlmech/ivp/runge_kutta/dormand_prince.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/ivp/runge_kutta/rkn1210.hpp"
#include "nlmech/ivp/structural/central_difference.hpp"
#include "tests/ivp/no_allocation/no_allocation.hpp"

namespace nlmech::ivp::testing {

void forbid_heap_to_explicit_methods() {
  expect_no_allocation(Rk4{.step = 0.5});
  expect_no_allocation(Rk6{.step = 0.5});
  expect_no_allocation(CentralDifference{.step = 0.5});
  expect_no_allocation(
      Ode45{.relative_tolerance = 0.1, .absolute_tolerance = 0.1, .initial_step = 0.5, .largest_step = 0.5});
  expect_no_allocation(
      Dop853{.relative_tolerance = 0.1, .absolute_tolerance = 0.1, .initial_step = 0.5, .largest_step = 0.5});
  expect_no_allocation(
      Rkn1210{.relative_tolerance = 0.1, .absolute_tolerance = 0.1, .initial_step = 0.5, .largest_step = 0.5},
      problems::ThreeMassChain{.c2 = 0});
}

}  // namespace nlmech::ivp::testing

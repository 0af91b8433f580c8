// Eigen refuses the heap here: see no_allocation_test.cpp.
#define EIGEN_RUNTIME_NO_MALLOC
#include "nlmech/ivp/hermitian/hermitian.hpp"
#include "nlmech/ivp/implicit/backward_euler.hpp"
#include "nlmech/ivp/structural/generalized_alpha.hpp"
#include "nlmech/ivp/structural/hht.hpp"
#include "nlmech/ivp/structural/newmark.hpp"
#include "tests/ivp/no_allocation/no_allocation.hpp"

namespace nlmech::ivp::testing {

void forbid_heap_to_implicit_methods() {
  expect_no_allocation(BackwardEuler{.step = 0.5});
  expect_no_allocation(Newmark{.step = 0.5});
  expect_no_allocation(Hht{.step = 0.5});
  expect_no_allocation(GeneralizedAlpha{.step = 0.5});
  expect_no_allocation(Hermitian{.step = 0.5});
}

}  // namespace nlmech::ivp::testing

// Eigen refuses the heap here: see no_allocation_test.cpp.
#define EIGEN_RUNTIME_NO_MALLOC
#include "nlmech/ivp/collocation/collocation.hpp"
#include "nlmech/ivp/collocation/picard.hpp"
#include "tests/ivp/no_allocation/no_allocation.hpp"

namespace nlmech::ivp::testing {

void forbid_heap_to_collocation() {
  expect_no_allocation(Mcpi{.step = 0.5, .order = 8});
  expect_no_allocation(RbfCollocation{.step = 0.5, .nodes = 7, .shape = 0.4});
  expect_no_allocation(PolynomialCollocation{.step = 0.5, .nodes = 7});
}

}  // namespace nlmech::ivp::testing

// Eigen refuses the heap here: see no_allocation_test.cpp.
#define EIGEN_RUNTIME_NO_MALLOC
#include "nlmech/ivp/transversal/mtl.hpp"
#include "tests/ivp/no_allocation/no_allocation.hpp"

namespace nlmech::ivp::testing {

void forbid_heap_to_mtl() {
  expect_no_allocation(Mtl{.step = 0.125, .points = 4});
  expect_no_allocation(Mtl{.step = 0.125, .points = 4, .linear = MtlLinear::jacobian, .error_tolerance = 10});
}

}  // namespace nlmech::ivp::testing

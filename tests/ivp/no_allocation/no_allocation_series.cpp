// Eigen refuses the heap here: see no_allocation_test.cpp.
#define EIGEN_RUNTIME_NO_MALLOC
#include "nlmech/ivp/series/series.hpp"
#include "tests/ivp/no_allocation/no_allocation.hpp"

namespace nlmech::ivp::testing {

void forbid_heap_to_series() {
  expect_no_allocation(Series{.order = 12, .step = 0.5});
  expect_no_allocation(Series{.largest_step = 0.5});
}

}  // namespace nlmech::ivp::testing

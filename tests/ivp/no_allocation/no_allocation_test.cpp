// Eigen counts nothing, but it can refuse: every allocation of a matrix while it is told so ends the test.
#define EIGEN_RUNTIME_NO_MALLOC
#include "tests/ivp/no_allocation/no_allocation.hpp"

namespace nlmech::ivp::no_allocation_test {
namespace {

TEST(NoAllocation, InSteps) {
  testing::forbid_heap_to_explicit_methods();
  testing::forbid_heap_to_implicit_methods();
  testing::forbid_heap_to_series();
  testing::forbid_heap_to_mtl();
  testing::forbid_heap_to_collocation();
}

}  // namespace
}  // namespace nlmech::ivp::no_allocation_test

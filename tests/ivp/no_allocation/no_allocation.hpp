/// What the files of the test of allocations share. Each of them defines EIGEN_RUNTIME_NO_MALLOC first.
#pragma once

#include <gtest/gtest.h>

#include "nlmech/ivp/integrate.hpp"
#include "nlmech/problems/three_mass_chain.hpp"

namespace nlmech::ivp::testing {

/// Forbids the heap from the end of the first step to the begin of the last.
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

/// Each tells expect_no_allocation() the methods of one kind.
void forbid_heap_to_explicit_methods();
void forbid_heap_to_implicit_methods();
void forbid_heap_to_series();
void forbid_heap_to_mtl();
void forbid_heap_to_collocation();

}  // namespace nlmech::ivp::testing

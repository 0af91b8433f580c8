// Reference state at the end of an integration, in extended precision.
#pragma once

#include <gtest/gtest.h>

#include "nlmech/ivp/state.hpp"
#include "nlmech/problems/reference_trajectory.hpp"

namespace nlmech::ivp::testing {

// State at t1, computed in long double.
template <class Problem>
State reference(const Problem& problem, const State& x0, double t0, double t1) {
  const problems::ReferenceTrajectory<long double, Problem> path(problem, x0.template cast<long double>(), t0,
                                                                 t1);
  EXPECT_TRUE(path.status().ok()) << path.status().text();
  return path(t1).template cast<double>();
}

}  // namespace nlmech::ivp::testing

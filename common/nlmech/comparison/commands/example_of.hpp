/// @file
/// An example made of a problem alone: its solution is a Taylor series of high order in extended precision.
#pragma once

#include <algorithm>
#include <memory>
#include <string>

#include "nlmech/comparison/commands/example.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::comparison {

/// A problem from its own initial state at 0 to @p end. Amplitudes: the greatest of 4000 samples.
/// @throws Failure if the reference does not get there
template <class Problem>
[[nodiscard]] Example<Problem::dimension> example_of(const Problem& problem, double end) {
  constexpr int n = Problem::dimension;
  using Trajectory = problems::ReferenceTrajectory<long double, Problem>;
  const ivp::State<n> x0 = Problem::initial_state();
  const Vector<long double, n> exact = x0.template cast<long double>();
  const auto path = std::make_shared<const Trajectory>(problem, exact, 0, end);
  if (!path->status().ok()) throw Failure(path->status());
  constexpr int samples = 4000;
  ivp::State<n> amplitude = x0.cwiseAbs();
  for (int i = 1; i <= samples; ++i)
    amplitude = amplitude.cwiseMax((*path)(end * i / samples).template cast<double>().cwiseAbs());
  return {.name = std::string(Problem::name),
          .system = ivp::System<n>(problem),
          .x0 = x0,
          .t0 = 0,
          .t1 = end,
          .amplitude = amplitude,
          .reference = [path, end](double t) { return (*path)(std::min(t, end)); }};
}

}  // namespace nlmech::comparison

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

/// A problem from @p x0 at 0 to @p end. Amplitudes: the greatest of 4000 samples.
/// @throws Failure if the reference does not get there
template <class Problem>
[[nodiscard]] Example example_of(const Problem& problem, const std::string& name, const ivp::State& x0,
                                 double end) {
  constexpr int n = Problem::dimension;
  using Path = problems::ReferenceTrajectory<long double, Problem>;
  const Vector<long double, n> exact = x0.template cast<long double>();
  const auto path = std::make_shared<const Path>(problem, exact, 0, end);
  if (!path->status().ok()) throw Failure(path->status());
  constexpr int samples = 4000;
  ivp::State amplitude = x0.cwiseAbs();
  for (int i = 1; i <= samples; ++i)
    amplitude = amplitude.cwiseMax((*path)(end * i / samples).template cast<double>().cwiseAbs());
  return {.name = name,
          .system = ivp::System(problem),
          .x0 = x0,
          .t0 = 0,
          .t1 = end,
          .amplitude = amplitude,
          .reference = [path, end](double t) { return (*path)(std::min(t, end)); }};
}

/// A problem from its own initial state.
template <class Problem>
[[nodiscard]] Example example_of(const Problem& problem, double end) {
  return example_of(problem, std::string(Problem::name), Problem::initial_state(), end);
}

}  // namespace nlmech::comparison

/// @file
/// Examples of problems whose reference solution is a Taylor series of high order in extended precision.
#pragma once

#include <algorithm>
#include <memory>
#include <string>

#include "nlmech/comparison/commands/example.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::comparison {

/// Example of a problem from @p x0 at @p t0 to @p end. Its amplitudes are the greatest of 4000 samples.
/// @tparam Real precision of the reference @param beyond time by which the reference extends beyond the end
/// @throws Failure if the reference does not reach its end
template <class Real = long double>
[[nodiscard]] Example example_of(const program::Problem& problem, const std::string& name,
                                 const ivp::State& x0, double t0, double end, double beyond = 0) {
  using Path = problems::ReferenceTrajectory<Real, program::Problem>;
  const Vector<Real, Eigen::Dynamic> exact = x0.template cast<Real>();
  const auto path = std::make_shared<const Path>(problem, exact, t0, end + beyond);
  if (!path->status().ok()) throw Failure(path->status());
  const auto at = [path](double t) -> ivp::LongState {
    return (*path)(std::min(Real(t), path->end())).template cast<long double>();
  };
  constexpr int samples = 4000;
  ivp::State amplitude = x0.cwiseAbs();
  for (int i = 1; i <= samples; ++i)
    amplitude = amplitude.cwiseMax(at(t0 + (end - t0) * i / samples).template cast<double>().cwiseAbs());
  return {.name = name,
          .system = ivp::System(problem),
          .x0 = x0,
          .t0 = t0,
          .t1 = end,
          .amplitude = amplitude,
          .reference = at};
}

/// Example of a library problem with its own initial state and end.
template <class Real = long double>
[[nodiscard]] Example example_of(const problems::TextProblem& problem, double beyond = 0) {
  return example_of<Real>(problem, problem.name, problem.initial_state(), problem.initial_time,
                          problem.final_time, beyond);
}

}  // namespace nlmech::comparison

/// @file
/// An example with its reference in more digits. Included where one is made: the reference is compiled there.
#pragma once

#include <memory>
#include <string>
#include <type_traits>

#include "nlmech/comparison/commands/example.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::chapters::algebraic_series {

/// Lorenz's motion loses sixteen digits in 40 units of time. The strong oscillator loses six in 750; 64 bits
/// are left with 4e-14 there, a thousandth of what double can reach, in a twentieth of the time.
using Digits35 = ExtendedReal<35>;

/// An example from the time @p t0 on.
/// @tparam Problem the equation; its parameters are taken in the precision of the reference
/// @tparam Extended precision of the reference
/// @param t0 begin, @param duration of the example, @param beyond how far the reference goes on
template <template <class> class Problem, class Extended = Digits35>
comparison::Example example_of(const std::type_identity_t<Extended>& t0, double duration, double beyond) {
  using Trajectory = problems::ReferenceTrajectory<Extended, Problem<Extended>>;
  constexpr int size = Problem<double>::dimension;
  const auto x0 = Problem<double>::initial_state();
  const auto trajectory = std::make_shared<const Trajectory>(
      Problem<Extended>{}, Vector<Extended, size>(x0.template cast<Extended>()), t0, t0 + duration + beyond);
  if (!trajectory->status().ok()) throw Failure(trajectory->status());
  // Times are doubles; that of the begin is not pi but the double next to it.
  const auto begin = static_cast<double>(t0);
  const auto at = [trajectory, t0, begin](double t) -> ivp::LongState {
    const Extended exact = t == begin ? t0 : Extended(t);
    return (*trajectory)(exact).template cast<long double>();
  };
  ivp::State amplitude = at(begin).template cast<double>().cwiseAbs();
  constexpr int samples = 4000;
  for (int i = 1; i <= samples; ++i) {
    const ivp::LongState x = at(begin + duration * i / samples);
    amplitude = amplitude.cwiseMax(x.template cast<double>().cwiseAbs());
  }
  return {.name = std::string(Problem<double>::name),
          .system = ivp::System(Problem<double>{}),
          .x0 = x0,
          .t0 = begin,
          .t1 = begin + duration,
          .amplitude = amplitude,
          .reference = at};
}

}  // namespace nlmech::chapters::algebraic_series

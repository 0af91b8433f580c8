/// @file
/// Analytic continuation: orbits by Taylor series, of fixed order and step, or adaptive in both.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "nlmech/orbit/gravity.hpp"
#include "nlmech/support/instruction_set.hpp"
#include "nlmech/support/solution.hpp"

namespace nlmech::orbit {

/// Analytic continuation adaptive in order and step.
///
/// Every step takes the Taylor series of the position to the degree K and that of the velocity to K - 1. Its
/// length makes the last term of the velocity `tolerance` times the larger of |v| and the circular speed
/// sqrt(mu/r) (so that a body at rest has a step too), by the terms of both last degrees; the position's last
/// term is K r/(v h) times smaller; nor may it be so long that terms cancel by more than the tolerance
/// (circles). No step is ever rejected. Then K itself goes up or down by one where that promises a longer
/// step for the same work; from 4 to 40 the sums are unrolled (see the page "Architecture").
///
/// Time and state are carried with compensation, and quotients by integers are exact to rounding of the
/// result: with a tolerance of 1e-17 the energy performs a random walk over ten thousand orbits and does not
/// drift. What the default leaves out, 4.5 eps a step, is the same at every passage of an eccentric orbit and
/// adds up after some hundred of them.
///
/// Tests hold the error to the condition of the orbit times (2 n tolerance + (8 + sqrt n) eps) after n steps
/// from a periapsis. In general each step adds 2 tolerance + 9 eps times the condition of the rest of the way
/// from there: what is left out in a near passage of the centre changes the period by far more than an error
/// of the start does. Set the tolerance by the passage then, or use propagate_kepler().
struct AnalyticContinuation {
  static constexpr std::string_view name = "analytic-continuation";  ///< on command lines and in tables
  double tolerance = 1e-15;  ///< of a step, relative to |r| and |v|; from 1e-18 to 0.1
  int order = 0;             ///< K, from 4 to 100; 0: chosen step by step from 12 to 40
  double largest_step = std::numeric_limits<double>::infinity();  ///< positive
  bool compensated = true;                                        ///< carry the rounding errors of the sums
  /// For a point mass and orders from 4 to 40; others are portable code. Nothing: the best of this
  /// processor.
  std::optional<InstructionSet> instructions = std::nullopt;
};

/// Analytic continuation as in the dissertation: one order and one step. The last step is shortened to end at
/// the asked time.
struct FixedContinuation {
  static constexpr std::string_view name = "fixed-continuation";  ///< on command lines and in tables
  double step = 1;                                                ///< length of a step, positive
  int order = 10;             ///< degree of the position's series, from 2 to 100
  int velocity_degree = 0;    ///< degree of the velocity's, from 1 to 100; 0: order - 1
  bool compensated = false;   ///< carry the rounding errors of the sums; the dissertation does not
  bool true_division = true;  ///< false: rounded reciprocals -mu/((n+1)(n+2)), to show what they cost
  /// For a point mass and degrees from 4 to 40. Nothing: the best of this processor.
  std::optional<InstructionSet> instructions = std::nullopt;
};

/// The end of a propagation. Statistics::right_hand_sides counts orders: the degree of the position's series
/// a step.
using Solution = BasicSolution<State>;
/// One step; its dense output is the series, as accurate as the end of the step.
using Step = BasicStep<State, std::span<const State>>;
/// Called after each step.
using Observer = BasicObserver<Step>;

/// Moves @p start from @p t0 to @p t1 (forwards or backwards) in the field @p gravity.
///
/// Never throws for what happens on the way: `collision` where the step becomes shorter than the spacing of
/// times because |r| goes to 0, `step_underflow` where it does so otherwise, `non_finite`, `step_limit`,
/// `time_limit` and `interrupted` are the result's status. Units are the caller's: inside, lengths and times
/// are scaled by powers of two, so that no order underflows, and digits differ between units by rounding of
/// the data alone.
/// @throws std::invalid_argument for a position 0, values that are not finite, or options out of range
[[nodiscard]] Solution propagate(const State& start, double t0, double t1, const Gravity& gravity,
                                 const AnalyticContinuation& method = {}, const Observer& observer = {},
                                 const Limits& limits = {});

/// The same with fixed order and step. A step beyond the radius of convergence_radius() is not noticed, as in
/// the dissertation.
[[nodiscard]] Solution propagate(const State& start, double t0, double t1, const Gravity& gravity,
                                 const FixedContinuation& method, const Observer& observer = {},
                                 const Limits& limits = {});

}  // namespace nlmech::orbit

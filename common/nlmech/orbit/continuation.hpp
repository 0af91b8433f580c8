/// @file
/// Analytic continuation: propagation of orbits by Taylor series, with fixed or adaptive order and step size.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "nlmech/orbit/gravity.hpp"
#include "nlmech/support/instruction_set.hpp"
#include "nlmech/support/solution.hpp"

namespace nlmech::orbit {

/// Analytic continuation with adaptive order and step size.
///
/// Every step uses the Taylor series of the position to the degree K and of the velocity to K - 1. The step
/// size makes the last term of the velocity `tolerance` times the larger of |v| and the circular speed
/// sqrt(mu/r) (which bounds the step of a body at rest), estimated from the last two terms; the last term of
/// the position is K r/(v h) times smaller. The step size is also limited so that cancellation stays below
/// the tolerance (circles). Steps are never rejected. After each step K changes by one if that gives a larger
/// step for the same work; orders from 4 to 40 are unrolled (see the page "Architecture").
///
/// Time and state use compensated summation, and quotients by integers are correctly rounded: with a
/// tolerance of 1e-17 the energy performs a random walk over ten thousand orbits without drift. The
/// truncation error of the default, 4.5 eps per step, is the same at every periapsis of an eccentric orbit
/// and accumulates after some hundred of them.
///
/// Tests check that the error after n steps from a periapsis is at most (2 n tolerance + (8 + sqrt n) eps)
/// times the condition number of the orbit. In general each step adds 2 tolerance + 9 eps times the condition
/// number of the remaining interval: a truncation error near the centre changes the period far more than an
/// error of the initial state. Choose the tolerance for the closest passage then, or use propagate_kepler().
struct AnalyticContinuation {
  static constexpr std::string_view name = "analytic-continuation";  ///< on command lines and in tables
  double tolerance = 1e-15;  ///< relative tolerance of a step for |r| and |v|; from 1e-18 to 0.1
  int order = 0;             ///< K, from 4 to 100; 0: adaptive, from 12 to 40
  double largest_step = std::numeric_limits<double>::infinity();  ///< positive
  bool compensated = true;                                        ///< compensated summation of time and state
  /// Instruction set for a point mass and orders from 4 to 40; other cases use portable code. Empty: the best
  /// of this processor.
  std::optional<InstructionSet> instructions = std::nullopt;
};

/// Analytic continuation as in the dissertation: fixed order and step size. The last step is shortened to end
/// at the requested time.
struct FixedContinuation {
  static constexpr std::string_view name = "fixed-continuation";  ///< on command lines and in tables
  double step = 1;                                                ///< step size, positive
  int order = 10;             ///< degree of the position series, from 2 to 100
  int velocity_degree = 0;    ///< degree of the velocity series, from 1 to 99; 0: order - 1
  bool compensated = false;   ///< compensated summation; not used in the dissertation
  bool true_division = true;  ///< false: rounded reciprocals -mu/((n+1)(n+2)), to show their error
  /// Instruction set for a point mass, degrees from 4 to 40 and a velocity of degree order - 1; other cases
  /// use portable code. Empty: the best of this processor.
  std::optional<InstructionSet> instructions = std::nullopt;
};

/// Result of a propagation. Statistics::right_hand_sides counts orders: the degree of the position series per
/// step.
using Solution = BasicSolution<State>;
/// One step; its dense output is the series, with the accuracy of the end of the step.
using Step = BasicStep<State, std::span<const State>>;
/// Called after each step.
using Observer = BasicObserver<Step>;

/// Propagates @p start from @p t0 to @p t1 (forwards or backwards) in the field @p gravity.
///
/// Failures of the propagation are reported in the status: `collision` if the step size falls below the
/// spacing of times because |r| goes to 0, `step_underflow` if it does so otherwise, `non_finite`,
/// `step_limit`, `time_limit` and `interrupted`. Any consistent units: lengths and times are scaled
/// internally by powers of two, so no order underflows, and results in different units differ only by
/// rounding of the data.
/// @throws std::invalid_argument for a zero position, values that are not finite, or options out of range
[[nodiscard]] Solution propagate(const State& start, double t0, double t1, const Gravity& gravity,
                                 const AnalyticContinuation& method = {}, const Observer& observer = {},
                                 const Limits& limits = {});

/// Propagation with fixed order and step size. A step beyond convergence_radius() is not detected, as in the
/// dissertation.
[[nodiscard]] Solution propagate(const State& start, double t0, double t1, const Gravity& gravity,
                                 const FixedContinuation& method, const Observer& observer = {},
                                 const Limits& limits = {});

}  // namespace nlmech::orbit

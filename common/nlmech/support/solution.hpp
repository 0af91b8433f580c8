/// @file
/// What an integration gives back, what an observer sees of it on the way, and what bounds it: one vocabulary
/// for states of any type.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>

#include "nlmech/support/statistics.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech {

/// The end of an integration. After a failure, time and state are those of the last good step.
template <class State>
struct BasicSolution {
  double t = 0;           ///< time reached; the asked end time exactly, if the status is success
  State x;                ///< state at that time
  Status status;          ///< success, or which failure, where, and what to change
  Statistics statistics;  ///< what it cost
};

/// Evaluates the solution within one step; a method's stepper has one.
template <class State>
class BasicDenseOutput {
 public:
  BasicDenseOutput() = default;
  /// Copies.
  BasicDenseOutput(const BasicDenseOutput&) = default;
  /// Copies.
  BasicDenseOutput& operator=(const BasicDenseOutput&) = default;
  virtual ~BasicDenseOutput() = default;
  /// State at @p t within the latest step, in the accuracy that the method's header states.
  virtual void at(double t, State& x) const = 0;
};

/// One accepted step as an observer sees it. The references hold only during the call.
template <class State, class States>
struct BasicStep {
  std::int64_t index;             ///< counts from 1
  double t0;                      ///< begin of the step
  double t1;                      ///< its end; smaller than t0 if the integration runs backwards
  const State& x0;                ///< state at t0
  const State& x1;                ///< state at t1
  std::span<const double> times;  ///< times within (t0, t1] where the method has values of its own, t1 last:
                                  ///< nodes of a collocation, refined output of ode45; often t1 alone
  const States& states;           ///< states at these times, at least as many as times
  const BasicDenseOutput<State>& dense;  ///< state at any time within the step
  /// The same as a value, at t1 x1 itself.
  [[nodiscard]] State at(double t) const {
    State x = x1;
    if (t != t1) dense.at(t, x);
    return x;
  }
};

/// Called after each accepted step; returns true to go on, false to end with `interrupted`.
template <class Step>
using BasicObserver = std::function<bool(const Step&)>;

/// Bounds on the work and on the steps of one integration, for every method and peer.
struct Limits {
  std::int64_t steps = 100'000'000;                          ///< accepted and rejected steps: step_limit
  double seconds = std::numeric_limits<double>::infinity();  ///< wall time: time_limit
  /// Longest step of a method that chooses its steps, positive; to rounding of the time. Methods of fixed
  /// step take the step that they are given.
  double largest_step = std::numeric_limits<double>::infinity();
};

}  // namespace nlmech

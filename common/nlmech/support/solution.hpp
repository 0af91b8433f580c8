/// @file
/// Result of an integration, argument of its observers, and its limits, for states of any type.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>

#include "nlmech/support/statistics.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech {

/// Result of an integration. After a failure, time and state are those of the last good step.
template <class State>
struct BasicSolution {
  double t = 0;           ///< time reached; exactly the requested end time after success
  State x;                ///< state at that time
  Status status;          ///< success, or the failure with place and remedy
  Statistics statistics;  ///< work counters
};

/// Dense output: evaluates the solution within one step.
template <class State>
class BasicDenseOutput {
 public:
  BasicDenseOutput() = default;
  /// Copies.
  BasicDenseOutput(const BasicDenseOutput&) = default;
  /// Copies.
  BasicDenseOutput& operator=(const BasicDenseOutput&) = default;
  virtual ~BasicDenseOutput() = default;
  /// State at @p t within the latest step; the header of the method states the accuracy.
  virtual void at(double t, State& x) const = 0;
  /// Are the states within the step as accurate as that at its end?
  [[nodiscard]] virtual bool is_as_accurate_as_step() const { return false; }
  /// Sets bounds on x - x_0 within the latest step, which ends at @p t1, with x_0 the state at its start.
  /// @return false if the method knows none
  virtual bool bound_change([[maybe_unused]] double t1, [[maybe_unused]] State& least,
                            [[maybe_unused]] State& most) const {
    return false;
  }
};

/// One accepted step, as passed to an observer. The references are valid only during the call.
template <class State, class States>
struct BasicStep {
  std::int64_t index;                    ///< number of the step, from 1
  double t0;                             ///< start of the step
  double t1;                             ///< end of the step; smaller than t0 in backward integration
  const State& x0;                       ///< state at t0
  const State& x1;                       ///< state at t1
  std::span<const double> times;         ///< times in (t0, t1] at which the method computes values, t1 last:
                                         ///< collocation nodes, refined output of ode45; often t1 only
  const States& states;                  ///< states at these times, at least as many as times
  const BasicDenseOutput<State>& dense;  ///< state at any time within the step
  /// State at @p t by value; x1 itself at t1.
  [[nodiscard]] State at(double t) const {
    State x = x1;
    if (t != t1) dense.at(t, x);
    return x;
  }
};

/// Callback after each accepted step; returns true to continue, false to stop with `interrupted`.
template <class Step>
using BasicObserver = std::function<bool(const Step&)>;

/// Limits of work and step size of one integration, for all methods and compared libraries.
struct Limits {
  std::int64_t steps = 100'000'000;                          ///< accepted and rejected steps: step_limit
  double seconds = std::numeric_limits<double>::infinity();  ///< wall time: time_limit
  /// Largest step size of adaptive methods, positive; to rounding of the time. Methods with fixed step size
  /// ignore it.
  double largest_step = std::numeric_limits<double>::infinity();
  /// First step size that adaptive methods of nlmech try on each smooth segment; 0: they choose one.
  double first_step = 0;
};

}  // namespace nlmech

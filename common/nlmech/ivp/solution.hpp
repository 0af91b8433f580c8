/// @file
/// What an integration gives back, and what an observer sees of it on the way.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>

#include "nlmech/ivp/direct.hpp"
#include "nlmech/support/statistics.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::ivp {

/// The end of an integration. After a failure, time and state are those of the last good step.
template <int n>
struct Solution {
  double t = 0;           ///< time reached; the asked end time exactly, if the status is success
  State<n> x;             ///< state at that time
  Status status;          ///< success, or which failure, where, and what to change
  Statistics statistics;  ///< what it cost
};

/// Evaluates the solution within one step; a method's stepper has one.
template <int n>
class DenseOutput {
 public:
  DenseOutput() = default;
  /// Copies.
  DenseOutput(const DenseOutput&) = default;
  /// Copies.
  DenseOutput& operator=(const DenseOutput&) = default;
  virtual ~DenseOutput() = default;
  /// State at @p t within the latest step, in the accuracy that the method's header states.
  virtual void at(double t, State<n>& x) const = 0;
};

/// One accepted step as an observer sees it. The references hold only during the call.
template <int n>
struct Step {
  std::int64_t index;             ///< counts from 1
  double t0;                      ///< begin of the step
  double t1;                      ///< its end; smaller than t0 if the integration runs backwards
  const State<n>& x0;             ///< state at t0
  const State<n>& x1;             ///< state at t1
  std::span<const double> times;  ///< times within (t0, t1] where the method has values of its own, t1 last:
                                  ///< nodes of a collocation, refined output of ode45; often t1 alone
  const Nodes<n>& states;         ///< states at these times, one a column, at least as many as times
  const DenseOutput<n>& dense;    ///< state at any time within the step
};

/// Called after each accepted step; returns true to go on, false to end with `interrupted`.
template <int n>
using Observer = std::function<bool(const Step<n>&)>;

/// Bounds on the work of one integration, for every method and peer.
struct Limits {
  std::int64_t steps = 100'000'000;                          ///< accepted and rejected steps: step_limit
  double seconds = std::numeric_limits<double>::infinity();  ///< wall time: time_limit
};

}  // namespace nlmech::ivp
